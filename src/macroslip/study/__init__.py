"""Studies: many cases from one study file, on one machine or several, stopped and resumed at will.

`study_file` reads the study; `work` computes one run; `workers` and `cluster` compute many; `store` and `journal` keep
them; `session` and `run` bring these together; `reader`, `lifetime` and `exceedance` look at what was kept.
"""

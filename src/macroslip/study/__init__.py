"""Studies: many cases from one study file, on one machine or several, which can be stopped and resumed at any time.

`study_file` reads the study; `work` computes one run; `workers` and `cluster` compute many; `store` and `journal` keep
them; `session` and `run` bring these together; `reader`, `lifetime` and `exceedance` read the stored results.
"""

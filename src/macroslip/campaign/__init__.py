"""Campaigns: many cases from one study file, on one machine or several, stopped and resumed at will.

`study_file` reads the study; `plan` lists its runs; `work` computes one; `local` and `cluster` compute many; `store` keeps
them; `run` brings these together; `reader`, `lifetime`, `exceedance` and `worst` look at what was kept.
"""

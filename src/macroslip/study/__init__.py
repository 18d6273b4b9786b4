"""Studies: many cases from one study file, on one machine or several.

A study can be stopped and resumed at any time.

`study_file` reads the study, with `loads_list` and `settings`; `work` computes one run, `workers`
have many computed, `run` records them in the `store`; `reader`, `lifetime`, `exceedance` and
`export` read the results.
"""

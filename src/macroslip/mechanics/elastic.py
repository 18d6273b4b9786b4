"""Elastic load of a roller between its rings over their approach, and the approach over the load.

Crowned and barrel rollers touch in ellipses, whose contacts in series have Q = K δ^1.5; those that
touch along a line have the law of `macroslip.contact.line_approach`.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit_evaluation, jit_inline
from macroslip.contact.line_approach import line_approach, line_load


@jit_evaluation
def elastic_load(body, approach):
    """Load Q of both contacts in series [N] at an elastic approach [m]; 0 with play."""
    if approach <= 0.0:
        return 0.0
    if body.line_stiffness > 0.0:
        return line_load(body.line_stiffness, body.profile_depth, approach).load
    return body.stiffness * approach * math.sqrt(approach)


@jit_inline
def approach_under_load(body, load):
    """Elastic approach [m] of both contacts in series under a load Q > 0 [N]."""
    if body.line_stiffness > 0.0:
        return line_approach(body.line_stiffness, body.profile_depth, math.log(load)).approach
    return body.compliance * load ** (2.0 / 3.0)

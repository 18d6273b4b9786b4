"""Elastic load of a roller between its rings by their approach, and the approach by the load.

Crowned and barrel rollers touch in ellipses, whose contacts in series have Q = K δ^1.5; those that
touch along a line have the law of `macroslip.contact.line_approach`.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit_evaluation
from macroslip.contact.line_approach import line_approach, line_load


@jit_evaluation
def elastic_load(body, approach):
    """Load of both raceway contacts in series at an elastic approach, Q = K δ^1.5 of ellipses.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    approach : float
        δ [m]; negative where there is play.

    Returns
    -------
    float
        Q [N]; 0 with play.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> elastic_load(SimpleNamespace(line_stiffness=0.0, stiffness=1e11), 1e-4)
    100000.0
    """
    if approach <= 0.0:
        return 0.0
    if body.line_stiffness > 0.0:
        return line_load(body.line_stiffness, body.profile_depth, approach).load
    return body.stiffness * approach * math.sqrt(approach)


def approach_under_load(body, load):
    """Elastic approach of both raceway contacts in series under a load, δ = (Q/K)^(2/3) of ellipses.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    load : float
        Q > 0 [N].

    Returns
    -------
    float
        δ [m].

    Examples
    --------
    >>> body = {"line_stiffness": 0.0, "compliance": 1e11 ** (-2 / 3)}
    >>> round(approach_under_load(body, 1e5), 12)
    0.0001
    """
    if body["line_stiffness"] > 0.0:
        log_load = math.log(load)
        return line_approach(body["line_stiffness"], body["profile_depth"], log_load).approach
    return body["compliance"] * load ** (2.0 / 3.0)

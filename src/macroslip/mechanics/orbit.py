r"""Motion of a roller on its free orbit: spin equation (16) and orbit equation (17), coupled.

The orbit equation (17), the moment about the bearing's axis, becomes Newton's law for the roller's
centre with the spin equation (16) put into it; the spin terms cancel
(`tests/whole/test_equations.py` proves it by symbols). With the slips

    v_in = −(Ω_in − Ω) r~_in − ω r,        v_out = −Ω r~_out − ω r

as unknowns, S_i and S_o the frictions of the raceways in the spin equation (16) with rolling
resistance, P_i and P_o their pulls on the centre, N the push and F_c the friction of the cage,
G = F_g,x' + F_d,x' and I_z' = m r²/2, the pair reads

    m v_in'  = −P_i + P_o − 2 (S_i + S_o + F_c) + (N − G) − m r~_in Ω_in'
    m v_out' =  P_i − P_o − 2 (S_i + S_o + F_c) − (N − G)

`macroslip.whole` solves it for all rollers together with their cages.
"""

from __future__ import annotations

from typing import NamedTuple

from macroslip.compiled import jit_inline


class SlipDrive(NamedTuple):
    """The two forces that change a roller's slips on a free orbit [N].

    The slip of the inner raceway obeys m v_in' = driving − turning − m r~_in Ω_in'.
    """

    turning: float  #: 2 (S_i + S_o + F_c), which changes both slips by the spin
    #: N − G − P_i + P_o, which changes them by the centre's motion, with opposite signs
    driving: float


@jit_inline
def slip_drive(friction, inner_pull, outer_pull, push, tangential):
    """Forces on a roller that is free on its orbit, by the equations of spin and orbit (16), (17).

    Parameters
    ----------
    friction : float
        S_i + S_o + F_c [N].
    inner_pull, outer_pull : float
        P_i and P_o [N].
    push : float
        N, positive where the cage pushes the roller along the orbit [N].
    tangential : float
        G, against the orbit [N].

    Returns
    -------
    SlipDrive

    Examples
    --------
    >>> slip_drive(1.0, 5.0, 2.0, 4.0, 0.5)
    SlipDrive(turning=2.0, driving=0.5)
    """
    return SlipDrive(2.0 * friction, push - tangential - inner_pull + outer_pull)

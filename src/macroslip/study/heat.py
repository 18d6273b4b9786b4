"""Heat of a main bearing from ten-minute means, with the friction of a study beside it."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from macroslip.scada.friction_table import FrictionTable
from macroslip.scada.heat import BearingHeat, bearing_heat
from macroslip.scada.reader import Scada
from macroslip.study.friction import friction_table


def heat_fit(
    scada: Scada | str | PathLike[str],
    study: FrictionTable | str | PathLike[str],
    sibling: Scada | str | PathLike[str] | None = None,
) -> BearingHeat:
    """Fit the heat balance of a main bearing to its ten-minute means, and follow its heat in time.

    Over windows of two hours

        dT/dt = q0 + 3600 [P_f(T) + M_s n]/C − k_n (T − T_nacelle) − k_o (T − T_ambient)

    with P_f of the study; beside it rivals with less physics. What it can and cannot tell is in
    the documentation's page on ten-minute means: lubrication cannot be read off one turbine, and
    an index is no alarm.

    Parameters
    ----------
    scada : Scada or path
        Ten-minute means, or the YAML file that describes them.
    study : FrictionTable or path
        Folder of a study of turbulent cases over `lubricant.at` and `oil_supply`.
    sibling : Scada or path, optional
        Another bearing or turbine beside which the index is put. A description that is given by its
        path names its own.

    Returns
    -------
    BearingHeat

    Raises
    ------
    InputError
        If the record or the study cannot support a fit.
    """
    if not isinstance(scada, Scada):
        path = Path(scada)
        scada = Scada.read(path)
        if sibling is None and scada.description.sibling:
            sibling = path.parent / scada.description.sibling
    if sibling is not None and not isinstance(sibling, Scada):
        sibling = Scada.read(sibling)
    friction = study if isinstance(study, FrictionTable) else friction_table(study)
    return bearing_heat(scada, friction, sibling)

"""Numbers in the words of summaries, captions and labels: three digits, no powers of ten."""

from __future__ import annotations


def told(value: float) -> str:
    """A number with three digits, without a power of ten where one can do without.

    Examples
    --------
    >>> told(0.21014), told(1925.7)
    ('0.21', '1,926')
    """
    return f"{value:,.0f}" if abs(value) >= 1000.0 else f"{value:.3g}"


def told_energy(energy: float) -> str:
    """An energy [J], in mJ below one joule.

    Examples
    --------
    >>> told_energy(0.1651), told_energy(25.226)
    ('165 mJ', '25.2 J')
    """
    return f"{told(energy)} J" if abs(energy) >= 1.0 else f"{told(1e3 * energy)} mJ"

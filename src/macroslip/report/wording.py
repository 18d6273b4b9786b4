"""Numbers in the words of summaries, captions and labels: three digits, no powers of ten."""

from __future__ import annotations


def three_digits(value: float) -> str:
    """A number with three digits, without a power of ten where one can do without.

    Examples
    --------
    >>> three_digits(0.21014), three_digits(1925.7)
    ('0.21', '1,926')
    """
    return f"{value:,.0f}" if abs(value) >= 1000.0 else f"{value:.3g}"


def energy_text(energy: float) -> str:
    """An energy [J], in mJ below one joule.

    Examples
    --------
    >>> energy_text(0.1651), energy_text(25.226)
    ('165 mJ', '25.2 J')
    """
    return f"{three_digits(energy)} J" if abs(energy) >= 1.0 else f"{three_digits(1e3 * energy)} mJ"

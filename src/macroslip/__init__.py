"""macroslip: how every roller of a wind-turbine main bearing slips."""

__version__ = "0.1.0"

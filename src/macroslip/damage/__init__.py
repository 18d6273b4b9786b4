"""Formulas of damage by slip: smearing, friction energy, micropitting, wear."""

"""Criteria of damage by slip, each with its source: smearing, friction energy, micropitting, wear."""

"""Mechanics of one roller, one function an equation.

Its loads, tractions, the cage, the spin and frictional power are computed here. Both engines, one
roller on its imposed orbit and the whole bearing, compute with these functions. Signs follow the
roller frame: x tangential, against a positive orbit; a tangential force that drives the spin ω up
is positive. Δu = u2 − u1 is the slip of the surfaces (28)-(31). Compiled functions get a roller as `body`,
the record of its numbers (`macroslip.roller.model`), and `tables`, the address of one flat array.
"""

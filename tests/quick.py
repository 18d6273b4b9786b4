"""What makes a case of a test quick, where its subject is not how exact it is."""

from macroslip import Radau

#: A tolerance from which on tables are the coarsest: they take an eighth of the work of those of the default one.
COARSE = Radau(tolerance=2e-3)

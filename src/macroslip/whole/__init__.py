"""The whole bearing: orbit and spin of all rollers together, pockets with play, and cages."""

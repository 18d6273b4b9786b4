"""The published study of slip in a main bearing, computed again with converged solutions and judged: `python -m paper`."""

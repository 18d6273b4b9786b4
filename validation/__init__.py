"""The program beside what was measured: nothing fitted, measured values with their scatter, and what each comparison decides."""

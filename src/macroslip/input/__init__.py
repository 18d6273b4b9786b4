"""Input: units, checked fields, and the files that hold them, with file, line, allowed values and remedy in messages."""

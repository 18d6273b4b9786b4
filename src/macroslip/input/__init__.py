"""Input: units, checked fields, and files; messages have line, allowed values and remedy."""

"""The disk: files written whole or not at all, caches, and the hash of the program."""

"""The disk: files written whole or not at all, caches of tables and kernels, and the hash of the program they belong to."""

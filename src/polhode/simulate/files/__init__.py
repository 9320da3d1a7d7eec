"""Computed motions as plain data, in files and in tables."""

"""Closed forms of motions, and the recognition of equations that have one."""

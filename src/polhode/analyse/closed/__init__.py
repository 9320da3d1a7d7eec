"""Closed forms of motions, and how equations are recognised that have one."""

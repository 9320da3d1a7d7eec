"""Prescribed functions of time: expressions, Python functions and samples."""

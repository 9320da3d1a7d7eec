"""Expressions as straight-line programs for numbers."""

"""Numeric Newton-Euler balance of every body: a second opinion that shares nothing with `derive`.

It uses the declaration (`model`, `algebra`) and the LaTeX tree, and nothing else of claims.
"""

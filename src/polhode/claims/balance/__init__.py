"""Balance of every body by numbers: a second opinion that shares nothing with `derive`.

It knows the declaration (`model`, `algebra`) and the LaTeX tree; nothing else of claims.
"""

"""The states on which a claim should hold.

Within claims, packages import one way only: `latex`, then `balance` (numbers from the declaration
alone), `meaning`, `states`, `contexts`, `repair`.
"""

"""The contexts of claims, and how a claim is judged in each.

A file for each context: `_equations` (identity, motion), `_steady`, `_threshold`, `_limit`,
`_initial_value` (launch), `_number`; `_contexts` chooses one. They share `_inequality`,
`_counterexample` and `_sampled_motion`. Built on `states`, `meaning` and `balance`; `repair` is
built on them.
"""

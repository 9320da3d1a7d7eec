"""Judging in processes of their own, which end where it takes too much."""

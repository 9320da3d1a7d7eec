"""Worked solutions."""

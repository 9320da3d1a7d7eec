"""Motions in numbers of higher precision than doubles."""

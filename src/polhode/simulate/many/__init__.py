"""Motions side by side: in the lanes of vector instructions, and with their derivatives."""

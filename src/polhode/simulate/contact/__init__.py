"""The course of a motion through its contact modes: slip, shocks, lift-off, rest."""

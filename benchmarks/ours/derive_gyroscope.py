"""Ours: the gyroscope with one point fixed and the force on its pivot."""

from __future__ import annotations

from common import report

from polhode.catalogue import CATALOGUE

if __name__ == "__main__":
    report(
        CATALOGUE["gyroscope"].build(),
        lambda equations: equations.components,
        {
            "M": 0.5,
            "a": 0.07,
            "g": 9.81,
            "I_1": 4e-4,
            "I_2": 3e-4,
            "theta": 1.1,
            "theta_dot": 0.7,
            "phi_dot": -1.3,
            "omega_1": 120,
        },
    )

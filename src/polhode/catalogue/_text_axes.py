"""Axes that the problem set describes disks and gyroscopes with."""

import polhode as ph


def following_axes(ground: ph.Frame) -> ph.Frame:
    """Axes 1, 2, 3 that follow a disk but do not spin with it.

    1 is horizontal, 2 points up the steepest diameter, 3 is the symmetry axis at θ to the
    vertical; φ turns them about the vertical (problem 2).
    """
    theta, phi = ph.coordinates("theta phi")
    return ground.rotated(phi, "z").rotated(theta, "x", labels="1 2 3", name="axes")


def cylindrical_axes(ground: ph.Frame) -> ph.Frame:
    """Directions ρ, φ, z that turn with the azimuth φ about the vertical (problem 7)."""
    return ground.rotated(ph.coordinate("phi"), "z", labels="rho phi z", name="cylindrical")


def axle_axes(cylindrical: ph.Frame) -> ph.Frame:
    """Axes 1 along the axle at θ to the vertical, 2 along φ, 3 = 1 × 2 (equation 90)."""
    theta = ph.coordinate("theta")
    return cylindrical.rotated(theta - ph.pi / 2, "phi", labels="1 2 3", name="axes")

"""A shock with friction in small steps of the normal impulse."""

from __future__ import annotations

import numpy as np

from .parts import Array


def felt_inertia(mass: float, inertia: Array, arm: Array) -> Array:
    """Velocity of the point of contact per impulse there."""
    hat = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
    return np.eye(3) / mass - hat @ np.linalg.inv(inertia) @ hat


def random_shock(rng: np.random.Generator) -> tuple[Array, Array]:
    """Inverse inertia felt by a random body, and the velocity it lands with."""
    basis, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    spread = rng.uniform(0.05, 1, 3)
    moments = np.sum(spread) - spread
    inertia = basis @ np.diag(moments) @ basis.T
    arm = np.array([*rng.normal(size=2) * 0.3, -rng.uniform(0.2, 1.0)])
    velocity = rng.normal(size=3)
    velocity[2] = -abs(velocity[2]) - 0.05
    return felt_inertia(float(rng.uniform(0.5, 2)), inertia, arm), velocity


def lost(felt: Array, before: Array, after: Array) -> float:
    """Energy that a shock takes away."""
    inverse = np.linalg.inv(felt)
    return float(before @ inverse @ before - after @ inverse @ after) / 2


def stepped(
    felt: Array, velocity: Array, mu: float, restitution: float, steps: int
) -> tuple[Array, Array]:
    """Impulse and velocity after a shock, its friction taken implicitly in every step.

    In each step of the normal impulse friction is what would end the slip, cut to the cone.
    """
    scale = float(np.linalg.norm(velocity)) / felt[2, 2]
    step = scale / steps
    v, impulse, stored = velocity.copy(), np.zeros(3), 0.0
    plane = np.linalg.inv(felt[:2, :2])
    compressing = True
    while True:
        moved = v[:2] + felt[:2, 2] * step
        friction = -plane @ moved
        size = float(np.hypot(*friction))
        if size > mu * step:
            slip = v[:2] if np.hypot(*v[:2]) > 3 * step * felt.max() else moved
            friction = -mu * step * slip / np.hypot(*slip)
        push = np.array([*friction, step])
        after = v + felt @ push
        work = step * (v[2] + after[2]) / 2
        if compressing and after[2] >= 0:
            compressing = False
            stored -= work
            budget = restitution**2 * stored
        elif compressing:
            stored -= work
        else:
            budget -= work
        v, impulse = after, impulse + push
        if not compressing and budget <= 0:
            return impulse, v

"""Impacts at several contacts at once, by the law of Moreau.

With the velocities u at all contacts and the impulses P, u' = u + W P. Each contact obeys Newton's
law with its coefficient e, P_N ≥ 0, u'_N + e u_N ≥ 0, one of them zero, and Coulomb's law for the
impulses: |P_T| ≤ μ P_N, and P_T = -μ P_N u'_T/|u'_T| where it slips after the impact (J. J. Moreau,
in Nonsmooth Mechanics and Applications, CISM 302, 1988). Contacts that are pressed on their
supports and whose velocities the impulses of others would make negative take part.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from polhode.base import NumericError
from polhode.simulate.integrate._arrays import Array

_ROUNDS = 20_000  # of relaxation, each of which shrinks the error by a factor
_SETTLED = 1e-13  # of the largest impulse: changes of a round at which it ends
_FOUND = 1e-10  # the same: what further rounds would still change
_POLISHED = 20  # rounds in which directions of slip are made exact
_GAINED = 1e-10  # of the energy before: more energy than this after an impact is no rounding


@dataclass(frozen=True)
class ImpactLaw:
    """What a contact does in an impact.

    Attributes:
        restitution: normal, and tangential.
        friction: coefficient; infinite without slip, zero without friction.
    """

    restitution: tuple[float, float]
    friction: float


def joint_impact(
    inverse_mass: Array, velocities: Array, laws: Sequence[ImpactLaw], where: str
) -> tuple[Array, Array]:
    """Impulses at all contacts, and the velocities after them, both of shape (contacts, 3).

    Args:
        inverse_mass: W, of shape (3 contacts, 3 contacts), 1/kg.
        velocities: before, along the support twice and away from it, m/s.
        laws: of the contacts.
        where: what an error calls the impact.

    Raises:
        NumericError: where no impulses are found, or the law would add energy.
    """
    before = velocities.ravel()
    # Velocities that the laws bring to zero: of contacts that reverse them, plus that part.
    bounces = np.ravel([(law.restitution[1],) * 2 + (law.restitution[0],) for law in laws])
    right = (1 + bounces) * before
    felt = _felt(inverse_mass)
    relaxed = _relaxed(inverse_mass, right, laws, felt)
    polished = _polished(inverse_mass, right, laws, relaxed)

    def error(of: Array) -> float:
        return float(np.max(np.abs(_round(inverse_mass, right, laws, felt, of) - of)))

    impulses = min(polished, relaxed, key=error)
    if not error(impulses) <= _FOUND * np.max(np.abs(impulses), initial=0.0):
        raise NumericError(
            f"{where}, whose impulses are not found",
            expected="contacts whose impulses determine one another",
            advice="end the motion before that time",
        )
    after = before + inverse_mass @ impulses
    gained = impulses @ (before + after) / 2
    if gained > _GAINED * np.abs(impulses) @ np.abs(before):
        raise NumericError(
            f"{where}: with these coefficients of restitution and friction the impact adds energy",
            expected="a law that takes energy away",
            advice="give all contacts the same restitution, or none",
        )
    return impulses.reshape(-1, 3), after.reshape(-1, 3)


def _relaxed(
    inverse_mass: Array,
    right: Array,
    laws: Sequence[ImpactLaw],
    felt: Sequence[tuple[float, float]],
) -> Array:
    """The impulses by relaxation, as far as they settle."""
    impulses = np.zeros_like(right)
    for _ in range(_ROUNDS):
        after = _round(inverse_mass, right, laws, felt, impulses)
        change, impulses = np.max(np.abs(after - impulses)), after
        if change <= _SETTLED * np.max(np.abs(impulses), initial=0.0):
            break
    return impulses


def _felt(inverse_mass: Array) -> list[tuple[float, float]]:
    """How much a contact feels its own impulse, at most: along the normal, along the support."""
    places = range(0, len(inverse_mass), 3)
    along = (inverse_mass[k : k + 2, k : k + 2] for k in places)
    return [
        (float(inverse_mass[k + 2, k + 2]), float(np.max(np.linalg.eigvalsh(block))))
        for k, block in zip(places, along, strict=True)
    ]


def _round(
    inverse_mass: Array,
    right: Array,
    laws: Sequence[ImpactLaw],
    felt: Sequence[tuple[float, float]],
    old: Array,
) -> Array:
    """One round of relaxation: each contact by itself, beside the latest impulses of the others.

    It leaves impulses as they are that obey all laws.
    """
    impulses = old.copy()
    for k, (law, (pressed, rubbed)) in enumerate(zip(laws, felt, strict=True)):
        up, flat = 3 * k + 2, slice(3 * k, 3 * k + 2)
        velocity = right[up] + inverse_mass[up] @ impulses
        impulses[up] = max(impulses[up] - velocity / pressed, 0.0)
        if law.friction:
            slip = right[flat] + inverse_mass[flat] @ impulses
            impulses[flat] = _limited(impulses[flat] - slip / rubbed, law.friction, impulses[up])
    return impulses


def _limited(along: Array, friction: float, normal: float) -> Array:
    """An impulse along the support, cut to what friction allows."""
    most = friction * normal if normal > 0 else 0.0
    size = float(np.hypot(*along))
    return along if size <= most else along * (most / size)


def _polished(inverse_mass: Array, right: Array, laws: Sequence[ImpactLaw], rough: Array) -> Array:
    """The same impulses to rounding: which contacts open, stick and slip is known now."""
    impulses = rough
    for _ in range(_POLISHED):
        after = (right + inverse_mass @ impulses).reshape(-1, 3)
        columns, rows = list[Array](), list[int]()
        for k, (law, own) in enumerate(zip(laws, rough.reshape(-1, 3), strict=True)):
            if own[2] <= 0:
                continue
            unit = np.zeros(len(right))
            unit[3 * k + 2] = 1.0
            sticks = np.hypot(*own[:2]) < law.friction * own[2] * (1 - 1e-9)
            if not sticks and law.friction:
                # against the slip; along the impulse found where there is hardly any slip
                slip = after[k, :2]
                size = np.hypot(*slip)
                along = -slip / size if size > 0 else own[:2] / np.hypot(*own[:2])
                unit[3 * k : 3 * k + 2] = law.friction * along
            columns.append(unit)
            rows.append(3 * k + 2)
            if sticks:
                columns += list(np.eye(len(right))[3 * k : 3 * k + 2])
                rows += [3 * k, 3 * k + 1]
        if not rows:
            return np.zeros_like(right)
        given = np.array(columns).T
        shares = np.linalg.lstsq((inverse_mass @ given)[rows], -right[rows], rcond=1e-13)[0]
        found = np.asarray(given @ shares, dtype=float)
        change, impulses = np.max(np.abs(found - impulses)), found
        if change <= 1e-16 * np.max(np.abs(found)):
            break
    return impulses

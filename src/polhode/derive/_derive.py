"""Derivation: the balance of every body, projected on the motions that the constraints allow."""

from __future__ import annotations

from collections.abc import Sequence

from polhode.algebra import (
    ZERO,
    Expr,
    Matrix,
    OutgrownError,
    Row,
    Symbol,
    length,
    linear_parts,
    total,
)
from polhode.base import DeclarationError
from polhode.derive._applied_loads import applied_loads, refuse_reactions_outside_loads
from polhode.derive._balance import Wrench, reaction_columns, required_wrenches
from polhode.derive._checks import (
    refuse_misaligned,
    refuse_shared_names,
    refuse_unbalanced,
    refuse_undetermined,
    refuse_unknown_coordinates,
    refuse_unresisted,
)
from polhode.derive._constraints import partial_velocity
from polhode.derive._equations import Equations
from polhode.derive._form import CLOSED, IN_PARTS, Form
from polhode.derive._motion import Kinematics, motion_of
from polhode.derive._reactions import solve_reactions
from polhode.model import Body, System

# Bodies whose equations are found in minutes: of a chain of joints, and in all. The time grows with
# the fourth power of the length of a chain.
_LONGEST_CHAIN, _MOST_BODIES = 64, 256
#: In the rate of one component of a velocity; further ones are kept under names.
MOST_PRODUCTS = 30_000


def derive(system: System) -> Equations:
    """Exact equations of motion and reactions of a system as declared.

    Newton's and Euler's equations of every body are projected on the motions that the velocity
    constraints allow (Jourdain's principle; Kane's equations), which removes all reactions that do
    no work. Where that grows too long to be written out, long expressions are kept under names.

    Raises:
        ConstraintError: for constraints that contradict one another.
        DeclarationError: for bodies that share coordinates or reactions that share names, and for
            more bodies than can be derived in minutes.
    """
    if not isinstance(system, System):
        raise DeclarationError(
            f"derive of {system!r}",
            expected="a System",
            advice="collect bodies, contacts and loads in a System(...) first",
        )
    joined = {b for e in system.elements if len(e.bodies) > 1 for b in e.bodies}
    for count, most, what in (
        (len(joined), _LONGEST_CHAIN, "bodies that joints hold to one another"),
        (len(system.bodies), _MOST_BODIES, "bodies in one system"),
    ):
        if count > most:
            raise DeclarationError(
                f"{count} {what}",
                expected=f"at most {most}, since exact equations of more take hours",
                advice="declare bodies that do not interact as systems of their own",
            )
    try:
        return _derived(system, CLOSED)
    except OutgrownError:
        return _derived(system, IN_PARTS)


def derive_in_parts(system: System) -> Equations:
    """The same with all long expressions under names: quick for any system, harder to read."""
    return _derived(system, IN_PARTS)


def _derived(system: System, form: Form) -> Equations:
    """Kinematics, required wrenches and reaction columns, then one row per independent speed.

    The row of speed u is Σ ∂v/∂u · (m dv/dt - F) + ∂ω/∂u · (dL/dt - τ) over the bodies: Kane's
    equations with partial velocities ∂v/∂u and ∂ω/∂u (Kane and Levinson, Dynamics: Theory and
    Applications, 1985).
    """
    motion = motion_of(system, form)
    if motion.form is CLOSED:
        _refuse_long_derivatives(motion)
    refuse_misaligned(motion)
    refuse_reactions_outside_loads(motion)
    applied = applied_loads(motion)
    required = required_wrenches(motion, applied.given)
    refuse_shared_names(motion, required)
    refuse_unknown_coordinates(motion, required)
    columns = reaction_columns(motion, applied.proportional)
    rows: list[Expr] = []
    for speed in motion.speeds:
        row = total(_power(motion, body, need, speed) for body, need in required.items())
        rows.append(motion.form.keep(row, motion.accelerations))
        motion.form.refuse_outgrown(rows)
    working = [column for column in columns if column.does_work]
    if working:
        # Sliding friction and loads that depend on reactions do work, so the projection does not
        # remove them. The reactions follow from the other balances and enter the rows in terms of
        # the accelerations.
        solved = solve_reactions(motion, required, columns)
        refuse_undetermined(solved, working)
        for i, speed in enumerate(motion.speeds):
            works = ZERO
            for column in working:
                wrenches = column.with_loads.items()
                virtual = sum((_power(motion, b, w, speed) for b, w in wrenches), ZERO)
                works = works + solved.values[column.name] * virtual
            rows[i] = rows[i] - works
    parts = [linear_parts(row, motion.accelerations) for row in rows]
    mass = _mirrored([coefficients for coefficients, _ in parts])
    forcing = tuple(-rest for _, rest in parts)
    equations = Equations(system, motion, required, columns, tuple(rows), mass, forcing)
    refuse_unresisted(equations)
    refuse_unbalanced(equations)
    return equations


def _refuse_long_derivatives(motion: Kinematics) -> None:
    """Refuse velocities of closed loops whose accelerations would take minutes to multiply out."""
    rates = {symbol: length(motion.rate(symbol)) for symbol in motion.coordinates}
    for velocity in (v for pair in motion.velocities.values() for v in pair):
        for component in velocity.components:
            occurring = rates.keys() & component.symbols()
            products = sum(length(component.diff(s)) * rates[s] for s in occurring)
            if products > MOST_PRODUCTS:
                raise OutgrownError(
                    f"accelerations with {products} products of terms",
                    expected=f"at most {MOST_PRODUCTS}",
                    advice="keep long expressions under names",
                )


Equations.rederived = staticmethod(_derived)


def _power(motion: Kinematics, body: Body, wrench: Wrench, speed: Symbol) -> Expr:
    """Virtual power of a wrench on a body, per unit of one speed."""
    velocity, angular = (partial_velocity(v, speed) for v in motion.velocities[body])
    return velocity.dot(wrench.force) + angular.dot(wrench.couple)


def _mirrored(rows: Sequence[Row]) -> Matrix:
    """The mass matrix, with equal entries across the diagonal written identically.

    In named parts, equal entries may be different expressions. Once identical, `mass == mass.T`
    holds and linear equations are solved by LDLᵀ. Sliding friction makes the matrix unsymmetric.
    """

    def entry(i: int, j: int) -> Expr:
        above, below = rows[min(i, j)][max(i, j)], rows[max(i, j)][min(i, j)]
        return rows[i][j] if above - below else above

    size = range(len(rows))
    return Matrix(tuple(tuple(entry(i, j) for j in size) for i in size))

"""Lagrange's equations with multipliers by SymPy: an oracle that shares no code with polhode."""

import numpy as np
import sympy as sp


class Lagrangian:
    """A Lagrangian with constraints linear in the rates, evaluated at numbers.

    The accelerations solve M q̈ = f + Aᵀ λ with A q̇ = 0.

    Args:
        lagrangian: of coordinates and rates.
        coordinates: symbols.
        rates: symbols, in the same order.
        constraints: expressions linear in the rates, equal to zero.
        forces: generalized forces.
    """

    def __init__(self, lagrangian, coordinates, rates, constraints=(), forces=None):
        q, v = sp.Matrix(coordinates), sp.Matrix(rates)
        momenta = sp.Matrix([lagrangian]).jacobian(v).T
        mass = momenta.jacobian(v)
        force = sp.Matrix([lagrangian]).jacobian(q).T - momenta.jacobian(q) * v
        if forces is not None:
            force += sp.Matrix(forces)
        rows = sp.Matrix(list(constraints)).jacobian(v) if constraints else sp.zeros(0, len(q))
        drift = -(rows * v).jacobian(q) * v if constraints else sp.zeros(0, 1)
        self._state = [*coordinates, *rates]
        parts = [mass, force, rows, drift]
        others = set().union(*(part.free_symbols for part in parts)) - {*self._state}
        self._parameters = sorted(others, key=str)
        self._parts = sp.lambdify([self._state, self._parameters], parts, cse=True)

    def accelerations(self, numbers, state):
        """Second derivatives of the coordinates.

        Args:
            numbers: values of parameters by symbol.
            state: coordinates and rates, in their order.
        """
        parameters = [numbers[symbol] for symbol in self._parameters]
        mass, force, rows, drift = self._parts(list(state), parameters)
        count, held = len(mass), len(rows)
        whole = np.block([[mass, -rows.T], [rows, np.zeros((held, held))]])
        return np.linalg.solve(whole, np.concatenate([force, drift]))[:count, 0]

"""A ball that rolls on a surface S(x, y), by Newton and Euler in Cartesian components.

With the normal n, the centre is at c = S + a n. Rolling gives ċ = a ω × n, and with F the force of
the surface, F/m + g = c̈ = a ω̇ × n + a ω × ṅ and (I/a) ω̇ = −n × F: along the surface
F (1/m + a²/I) = a ω × ṅ − g, along the normal F/m = (a ω × ṅ − g) · n. Nothing is shared with
polhode: sympy differentiates, scipy integrates.
"""

import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp

X, Y = sp.symbols("x y")


class BallOnSurface:
    """Args: height f, or place S, of X and Y, m; radius a, m; I = k m a²; g along −z.

    The normal is that of ∂S/∂x × ∂S/∂y, times the side.
    """

    def __init__(self, f, a, k=0.4, m=1.0, g=9.81, side=1):
        self.a, self.k, self.m = a, k, m
        self.gravity = np.array([0.0, 0.0, -g])
        surface = sp.Matrix(f) if isinstance(f, tuple) else sp.Matrix([X, Y, f])
        across = side * surface.diff(X).cross(surface.diff(Y))
        normal = across / sp.sqrt(across.dot(across))
        centre = surface + a * normal
        jacobians = [expression.jacobian([X, Y]) for expression in (normal, centre)]
        self._functions = sp.lambdify((X, Y), [normal, *jacobians, centre], "numpy")

    def at(self, x, y):
        """Normal, derivatives of normal and centre by x and y, and the centre."""
        n, dn, dc, c = (np.array(part, dtype=float) for part in self._functions(x, y))
        return n.ravel(), dn, dc, c.ravel()

    def rates(self, t, state):
        x_y, omega = state[:2], state[2:]
        n, _, dc, _ = self.at(*x_y)
        x_y_dot = np.linalg.lstsq(dc, self.a * np.cross(omega, n), rcond=None)[0]
        omega_dot = -np.cross(n, self.force(state)) / (self.k * self.m * self.a)
        return np.concatenate([x_y_dot, omega_dot])

    def force(self, state):
        """Of the surface on the ball."""
        x_y, omega = state[:2], state[2:]
        n, dn, dc, _ = self.at(*x_y)
        x_y_dot = np.linalg.lstsq(dc, self.a * np.cross(omega, n), rcond=None)[0]
        needed = self.a * np.cross(omega, dn @ x_y_dot) - self.gravity
        along = needed @ n * n
        return self.m * along + (needed - along) / (1 / self.m + 1 / (self.k * self.m))

    def rolls(self, x_y, omega, times):
        """States (x, y, ω) at some times."""
        span, start = (0.0, times[-1]), [*x_y, *omega]
        run = solve_ivp(self.rates, span, start, "DOP853", times, rtol=1e-13, atol=1e-14)
        return run.y

    def spin(self, x, y, x_dot, y_dot, omega_n):
        """ω of a ball whose contact moves so, and that turns at this rate about the normal."""
        n, _, dc, _ = self.at(x, y)
        return np.cross(n, dc @ [x_dot, y_dot]) / self.a + omega_n * n

r"""True lines of mechanics on systems of our own, in every context, and what tells their truth.

The states, motions and conditions are written out here from the textbooks: Landau and Lifshitz § 14
(spherical pendulum) and § 35 (top), Routh, Advanced Part (rolling disk), Goldstein ch. 5. Nothing
of polhode decides whether a line is true.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.integrate import solve_ivp

from judge.text_evaluator import Array, Formula, UnknownTextError

Numbers = dict[str, Array]
State = Callable[[Numbers], Numbers]

_STATES = 24
_CLOSE = 1e-7
_SIZES = (2e-2, 4e-3)  # of what is small: coarse enough for doubles, fine enough for an order
_POINTS = 20_000


def drawn(names: str, count: int, seed: int, spread: bool = False) -> Numbers:
    """Positive numbers for parameters; of both signs for angles and speeds, marked by ±."""
    random = np.random.default_rng(seed)
    found = {}
    for name in names.split():
        size = 10 ** random.uniform(-1, 1, count) if spread else random.uniform(0.4, 1.3, count)
        sign = random.choice([-1, 1], count) if name.startswith("±") else 1.0
        found[name.removeprefix("±")] = size * sign
    return found


# -- what decides the truth of a line -------------------------------------------------------------


def _met(sides: tuple[Array, str, Array], share: float = _CLOSE) -> Array:
    left, sign, right = sides
    scale = 1 + np.abs(left) + np.abs(right)  # all numbers are drawn around 1
    close = np.abs(left - right) <= share * scale
    found = {
        "=": close,
        "≈": close,
        "<": right - left > 1e-13 * scale,
        ">": left - right > 1e-13 * scale,
        "<=": (left < right) | close,
        ">=": (left > right) | close,
    }[sign]
    return np.asarray(found & np.isfinite(left) & np.isfinite(right))


@dataclass(frozen=True)
class Everywhere:
    """A line is true where it holds at every state; ± is one choice at each of them."""

    names: str
    state: State

    def is_true(self, formula: Formula) -> bool | None:
        try:
            values = self.state(drawn(self.names, _STATES, 1))
            ways = [formula.sides(values, upper) for upper in self._choices(formula)]
        except UnknownTextError:
            return None
        each = [np.all([_met(s) * np.ones(_STATES, bool) for s in way], axis=0) for way in ways]
        if len(each) > 1 and any(np.all(way) for way in each) and not all(np.all(w) for w in each):
            return False  # the other sign is never meant
        return bool(np.all(np.any(each, axis=0)))

    def _choices(self, formula: Formula) -> tuple[bool, ...]:
        return (True, False) if formula.has_choice else (True,)


@dataclass(frozen=True)
class Steadily:
    """A line is true where it holds on steady motions, or gives a speed that makes them so.

    Attributes:
        names: what is drawn.
        state: all numbers of a steady motion.
        speed: the speed that a line may give by a root.
        excess: what vanishes in steady motion.
    """

    names: str
    state: State
    speed: str
    excess: State

    def is_true(self, formula: Formula) -> bool | None:
        first = formula.relations[0]
        if len(formula.relations) == 1 and first.sign == "=" and self._is_speed(first.left):
            return self._stays(formula)
        return Everywhere(self.names, self.state).is_true(formula)

    def _is_speed(self, side: tuple[str, ...]) -> bool:
        return "".join(side).replace("{", "").replace("}", "") == self.speed

    def _stays(self, formula: Formula) -> bool | None:
        values = self.state(drawn(self.names, _STATES, 1))
        name = self.speed.removeprefix("\\dot\\") + "_dot"
        if formula.relations[0].right == formula.relations[0].left:
            return True
        try:
            for upper in (True, False):
                known = {k: v for k, v in values.items() if k != name}
                (_, _, value), *_ = formula.sides({**known, name: values[name]}, upper)
                try:
                    formula.sides({**known, name: values[name] * 2}, upper)
                except UnknownTextError:
                    return None
                left = self.excess({**values, name: value})["excess"]
                good = np.isfinite(left)
                if not np.any(good) or np.any(
                    np.abs(left[good]) > 1e-6 * (1 + np.abs(value[good] ** 2))
                ):
                    return False
        except UnknownTextError:
            return None
        return True


@dataclass(frozen=True)
class ToOrder:
    """A line is true where its remainder falls as steeply with what is small as the original's.

    Attributes:
        names: what is drawn.
        state: all numbers, given the size of what is small under `size`.
        kept: the power up to which terms are kept.
        original: the true line.
        energy: for a line that gives an energy, some energy of the system: it may be counted from
            another level, which is a number times that.
    """

    names: str
    state: State
    kept: float
    original: str
    energy: Callable[[Numbers], Array] | None = None

    def is_true(self, formula: Formula) -> bool | None:
        """None for a remainder between what is asked for and what the original reaches."""
        found, best = self.slopes(formula), self._reached
        if found is None or best is None or len(found) != len(best):
            return None
        if all(one > other - 0.4 for one, other in zip(found, best, strict=True)):
            return True
        return False if any(one < self.kept + 0.5 for one in found) else None

    @cached_property
    def _reached(self) -> list[float] | None:
        return self.slopes(Formula(self.original))

    def slopes(self, formula: Formula) -> list[float] | None:
        """The power with which the remainder of each relation falls, the worst of all states."""
        choices = (True, False) if formula.has_choice else (True,)
        try:
            found = [self._slopes(formula, upper) for upper in choices]
        except UnknownTextError:
            return None
        return [min(each) for each in zip(*found, strict=True)]

    def _slopes(self, formula: Formula, upper: bool) -> list[float]:
        remainders = [self._remainders(formula, upper, size) for size in _SIZES]
        with np.errstate(all="ignore"):
            return [
                float(
                    np.median(
                        np.where(
                            (fine == 0) | (coarse == 0),
                            20.0,
                            np.log(coarse / fine) / np.log(_SIZES[0] / _SIZES[1]),
                        )
                    )
                )
                for coarse, fine in zip(*remainders, strict=True)
            ]

    def _remainders(self, formula: Formula, upper: bool, size: float) -> list[Array]:
        found = []
        levels = self._levels(formula, upper)
        for i, (left, right) in enumerate(self._sides(formula, upper, size)):
            rest = left - right - levels.get(i, 0.0)
            nothing = np.abs(rest) < 1e-11 * (np.abs(left) + np.abs(right))
            found.append(np.where(nothing, 0.0, np.abs(rest)))
        return found

    def _levels(self, formula: Formula, upper: bool) -> dict[int, Array]:
        """By how much the levels of an energy differ in each relation, if they do."""
        if self.energy is None:
            return {}
        unit = self.energy(drawn(self.names, _STATES, 2))
        levels = [left - right for left, right in self._sides(formula, upper, 0.0)]
        return {i: e for i, e in enumerate(levels) if np.ptp(e / unit) < 1e-9}

    def _sides(self, formula: Formula, upper: bool, size: float) -> list[tuple[Array, Array]]:
        values = self.state({**drawn(self.names, _STATES, 2), "size": np.full(_STATES, size)})
        values["upper"] = np.full(_STATES, float(upper))
        return [(left, right) for left, _, right in formula.sides(values, upper)]


@dataclass(frozen=True)
class SameSet:
    """Inequalities are true where they hold exactly where a condition of the model does.

    Attributes:
        names: what is drawn, over two decades.
        condition: positive where the condition holds, with all numbers.
    """

    names: str
    condition: State

    def is_true(self, formula: Formula) -> bool | None:
        try:
            values = self.condition(drawn(self.names, _POINTS, 3, spread=True))
            if any(r.sign in ("=", "≈") for r in formula.relations):
                equal = [s for s in formula.sides(values) if s[1] in ("=", "≈")]
                if not all(np.all(_met(s)) for s in equal):
                    return False
            sides = [s for s in formula.sides(values) if s[1] not in ("=", "≈")]
        except UnknownTextError:
            return None
        said = np.all([self._holds(s) for s in sides], axis=0)
        margin = values["condition"]  # nan where there is no such body
        return bool(np.all((said == (margin > 0)) | np.isnan(margin)))

    def _holds(self, sides: tuple[Array, str, Array]) -> Array:
        left, sign, right = sides
        with np.errstate(all="ignore"):
            found = {"<": left < right, ">": left > right, "<=": left <= right, ">=": left >= right}
        return np.asarray(found[sign]) & np.isfinite(left) & np.isfinite(right)


@dataclass(frozen=True)
class Along:
    """A line is true where it holds along the motion from a start, or when it says.

    Attributes:
        motions: numbers along several motions, and the times.
        when: always, never, sometimes, initially, finally.
    """

    motions: Callable[[], list[Numbers]]
    when: str = "always"

    def is_true(self, formula: Formula) -> bool | None:
        try:
            each = [self._along(formula, values) for values in self.motions()]
        except UnknownTextError:
            return None
        return all(each)

    def _along(self, formula: Formula, values: Numbers) -> bool:
        met = np.all(
            [_met(s, 1e-5) * np.ones(len(values["t"]), bool) for s in formula.sides(values)], axis=0
        )
        return bool(
            {
                "always": np.all(met[1:]),
                "never": not np.any(met[1:]),
                "sometimes": np.any(met),
                "initially": np.all(met[1:3]),
                "finally": met[-1],
            }[self.when]
        )


@dataclass(frozen=True)
class ToDigits:
    """A number is true within half a unit of its last digit."""

    values: Mapping[str, float]

    def is_true(self, formula: Formula) -> bool | None:
        try:
            ((left, _, right),) = formula.sides(self.values)
        except (UnknownTextError, ValueError):
            return None
        printed = "".join(formula.relations[0].right)
        digits = len(printed.partition(".")[2]) if printed.replace(".", "").isdigit() else None
        if digits is None:
            return bool(abs(left - right) <= 1e-9 * abs(right))
        return bool(abs(left - right) <= 0.5 * 10.0**-digits * (1 + 1e-9))


Truth = Everywhere | Steadily | ToOrder | SameSet | Along | ToDigits


@dataclass(frozen=True)
class OwnClaim:
    """A true line, where it is judged, and what decides."""

    system: str
    latex: str
    truth: Truth
    context: str = "motion"
    options: Mapping[str, list[str]] = field(default_factory=dict)


# -- a point on a massless rod --------------------------------------------------------------------


def _plane(n: Numbers) -> Numbers:
    x, v = n["theta"], n["theta_dot"]
    T, V = n["m"] * n["l"] ** 2 * v**2 / 2, -n["m"] * n["g"] * n["l"] * np.cos(x)
    return {
        **n,
        "theta_ddot": -n["g"] / n["l"] * np.sin(x),
        "T": T,
        "V": V,
        "E": T + V,
        "calL": T - V,
        "p_theta": n["m"] * n["l"] ** 2 * v,
    }


def _weight(n: Numbers) -> Array:
    return n["m"] * n["g"] * n["l"]


def _small_swing(n: Numbers) -> Numbers:
    return _plane({**n, "theta": n["theta"] * n["size"], "theta_dot": n["theta_dot"] * n["size"]})


def _spherical(n: Numbers) -> Numbers:
    x, v, w = n["theta"], n["theta_dot"], n["phi_dot"]
    s, c, m, l = np.sin(x), np.cos(x), n["m"], n["l"]
    T, V = m * l**2 * (v**2 + w**2 * s**2) / 2, -m * n["g"] * l * c
    return {
        **n,
        "theta_ddot": s * c * w**2 - n["g"] / l * s,
        "phi_ddot": -2 * c / s * v * w,
        "T": T,
        "V": V,
        "E": T + V,
        "calL": T - V,
        "p_phi": m * l**2 * s**2 * w,
        "p_theta": m * l**2 * v,
    }


def _conical(n: Numbers) -> Numbers:
    rate = np.sqrt(n["g"] / (n["l"] * np.cos(n["theta"])))
    sign = np.where(np.arange(len(rate)) % 2, 1.0, -1.0)
    return _spherical({**n, "theta_dot": 0 * rate, "phi_dot": rate * sign})


def _conical_excess(n: Numbers) -> Numbers:
    return {"excess": n["phi_dot"] ** 2 * np.cos(n["theta"]) - n["g"] / n["l"]}


# -- a heavy top about its point: A across, C along the axis --------------------------------------


def _top(n: Numbers) -> Numbers:
    x, v, w, s3 = n["theta"], n["theta_dot"], n["phi_dot"], n["omega_3"]
    s, c, A, C = np.sin(x), np.cos(x), n["A"], n["C"]
    weight = n["M"] * n["g"] * n["h"]
    T, V = A * (v**2 + w**2 * s**2) / 2 + C * s3**2 / 2, weight * c
    return {
        **n,
        "psi_dot": s3 - w * c,
        "theta_ddot": w**2 * s * c - C * s3 * w * s / A + weight * s / A,
        "phi_ddot": (C * s3 - 2 * A * w * c) * v / (A * s),
        "omega_3_dot": 0 * s,
        "T": T,
        "V": V,
        "E": T + V,
        "calL": T - V,
        "p_psi": C * s3,
        "p_phi": A * w * s**2 + C * s3 * c,
    }


def _precession(n: Numbers) -> Numbers:
    """A steady top: the spin that goes with a rate of precession."""
    w, c = n["phi_dot"], np.cos(n["theta"])
    spin = (n["M"] * n["g"] * n["h"] + n["A"] * w**2 * c) / (n["C"] * w)
    return _top({**n, "theta_dot": 0 * w, "omega_3": spin})


def _precession_excess(n: Numbers) -> Numbers:
    w, c = n["phi_dot"], np.cos(n["theta"])
    return {
        "excess": n["A"] * w**2 * c - n["C"] * n["omega_3"] * w + n["M"] * n["g"] * n["h"],
    }


def _sleeping(n: Numbers) -> Numbers:
    """Of given inclination: steady motions exist for a fast enough spin."""
    c = np.cos(n["theta"])
    return {
        **n,
        "condition": (n["C"] * n["omega_3"]) ** 2 - 4 * n["A"] * n["M"] * n["g"] * n["h"] * c,
    }


def _fast(n: Numbers) -> Numbers:
    """The slow rate of a fast top, 1/ω₃ small."""
    spin = n["omega_3"] / n["size"]
    a, b = n["A"] * np.cos(n["theta"]), n["C"] * spin
    weight = n["M"] * n["g"] * n["h"]
    slow = 2 * weight / (b + np.sqrt(b**2 - 4 * a * weight))
    return {**n, "omega_3": spin, "phi_dot": slow}


# -- other systems --------------------------------------------------------------------------------


def _hoop(n: Numbers) -> Numbers:
    s, c = np.sin(n["theta"]), np.cos(n["theta"])
    return {**n, "theta_ddot": n["omega"] ** 2 * s * c - n["g"] / n["R"] * s}


def _hoop_steady(n: Numbers) -> Numbers:
    """Off the axis of the hoop, which turns at the rate that goes with the angle."""
    omega = np.sqrt(n["g"] / (n["R"] * np.cos(n["theta"])))
    return {**n, "omega": omega, "theta_dot": 0 * omega, "theta_ddot": 0 * omega}


def _free(n: Numbers) -> Numbers:
    inertia = [n["I_1"], n["I_2"], n["I_3"]]
    spin = [n["omega_1"], n["omega_2"], n["omega_3"]]
    rates = {
        f"omega_{i + 1}_dot": (inertia[j] - inertia[k]) * spin[j] * spin[k] / inertia[i]
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
    }
    L = {f"L_{i + 1}": inertia[i] * spin[i] for i in range(3)}
    T = sum(inertia[i] * spin[i] ** 2 for i in range(3)) / 2
    both = (inertia[0] - inertia[2]) * (inertia[1] - inertia[2]) * spin[2] ** 2
    return {**n, **rates, **L, "T": T, "E": T, "both": both}


def _nearly_about_3(n: Numbers) -> Numbers:
    state = _free({**n, "omega_1": n["omega_1"] * n["size"], "omega_2": n["omega_2"] * n["size"]})
    rate = (state["I_2"] - state["I_3"]) / state["I_1"]
    second = rate * (
        state["omega_2_dot"] * state["omega_3"] + state["omega_2"] * state["omega_3_dot"]
    )
    return {**state, "omega_1_ddot": second}


def _upright_disk(n: Numbers) -> Numbers:
    return {**n, "condition": 3 * n["a"] * n["omega_3"] ** 2 - n["g"]}


def _upright_coin(n: Numbers) -> Numbers:
    return {**n, "condition": n["a"] * n["phi_dot"] ** 2 - 4 * n["g"]}


def _upright_gyroscope(n: Numbers) -> Numbers:
    across = n["I_2"] + n["M"] * n["a"] ** 2
    return {
        **n,
        "I_3": n["I_2"],
        "condition": np.where(
            n["I_1"] <= 2 * n["I_2"],
            (n["I_1"] * n["omega_1"]) ** 2 - 4 * n["M"] * n["g"] * n["a"] * across,
            np.nan,
        ),
    }


def _rolling_steady(n: Numbers) -> Numbers:
    """A thin disk of uniform density: φ̇² sinθ cosθ - 6 ω₃ φ̇ sinθ - (4g/a) cosθ = 0."""
    w, s, c = n["phi_dot"], np.sin(n["theta"]), np.cos(n["theta"])
    spin = (w**2 * s * c - 4 * n["g"] / n["a"] * c) / (6 * w * s)
    return {**n, "omega_3": spin, "theta_dot": 0 * w}


def _rolling_excess(n: Numbers) -> Numbers:
    w, s, c = n["phi_dot"], np.sin(n["theta"]), np.cos(n["theta"])
    return {"excess": w**2 * s * c - 6 * n["omega_3"] * w * s - 4 * n["g"] / n["a"] * c}


def _swings() -> list[Numbers]:
    """A pendulum let go at rest from 1 rad, of several lengths."""
    return [_swing({"m": 0.7 + k, "l": 0.6 + 0.5 * k, "g": 9.0 + k}) for k in range(3)]


def _swing(given: dict[str, float]) -> Numbers:
    times = np.linspace(0, 4, 60)

    def rates(_: float, y: Array) -> list[float]:
        return [y[1], -given["g"] / given["l"] * np.sin(y[0])]

    path = solve_ivp(rates, (0, 4), [1.0, 0.0], t_eval=times, rtol=1e-10, atol=1e-12).y
    constant = {k: np.full(times.shape, v) for k, v in given.items()}
    return _plane({**constant, "t": times, "theta": path[0], "theta_dot": path[1]})


# -- the lines ------------------------------------------------------------------------------------

_PLANE = "m l g ±theta ±theta_dot"
_SPHERE = "m l g theta ±phi ±theta_dot ±phi_dot"
_TOP = "M A C g h theta ±phi ±psi ±theta_dot ±phi_dot ±omega_3"
_FREE = "I_1 I_2 I_3 ±omega_1 ±omega_2 ±omega_3"


def _at_all(system: str, names: str, state: State, context: str, *lines: str) -> list[OwnClaim]:
    return [OwnClaim(system, line, Everywhere(names, state), context) for line in lines]


def _to_order(
    system: str, names: str, state: State, kept: int, small: list[str], *lines: str
) -> list[OwnClaim]:
    return [
        OwnClaim(
            system,
            line,
            ToOrder(names, state, kept, line, _weight if line[0] in "VE" else None),
            "limit",
            {"small": small},
        )
        for line in lines
    ]


def _threshold(
    system: str, names: str, condition: State, given: list[str], *lines: str
) -> list[OwnClaim]:
    options = {"given": given} if given else {}
    return [
        OwnClaim(system, line, SameSet(names, condition), "threshold", options) for line in lines
    ]


def own_claims() -> list[OwnClaim]:
    """Every line."""
    return [
        *_at_all(
            "plane",
            _PLANE,
            _plane,
            "motion",
            r"\ddot\theta + \frac{g}{l}\sin\theta = 0",
            r"ml^2\ddot\theta = -mgl\sin\theta",
            r"\dot\theta^2 = \frac{2}{ml^2}(E + mgl\cos\theta)",
        ),
        *_at_all(
            "plane",
            _PLANE,
            _plane,
            "identity",
            r"E = \tfrac12 ml^2\dot\theta^2 - mgl\cos\theta",
            r"\mathcal L = \tfrac12 ml^2\dot\theta^2 + mgl\cos\theta",
            r"T = \frac{p_\theta^2}{2ml^2}",
        ),
        *_at_all(
            "spherical",
            _SPHERE,
            _spherical,
            "motion",
            r"\ddot\theta = \sin\theta\cos\theta\,\dot\phi^2 - \frac{g}{l}\sin\theta",
            r"\ddot\phi\sin\theta = -2\dot\theta\dot\phi\cos\theta",
        ),
        *_at_all(
            "spherical",
            _SPHERE,
            _spherical,
            "identity",
            r"E = \tfrac12ml^2\dot\theta^2 + \frac{p_\phi^2}{2ml^2\sin^2\theta} - mgl\cos\theta",
            r"p_\phi = ml^2\dot\phi\sin^2\theta",
        ),
        *_at_all(
            "top",
            _TOP,
            _top,
            "motion",
            r"A\ddot\theta = A\dot\phi^2\sin\theta\cos\theta - C\omega_3\dot\phi\sin\theta"
            r" + Mgh\sin\theta",
            r"A\ddot\phi\sin\theta = (C\omega_3 - 2A\dot\phi\cos\theta)\dot\theta",
        ),
        *_at_all(
            "top",
            _TOP,
            _top,
            "identity",
            r"T = \frac12 A(\dot\theta^2 + \dot\phi^2\sin^2\theta) + \frac12 C\omega_3^2",
            r"p_\phi = A\dot\phi\sin^2\theta + C\omega_3\cos\theta",
            r"\omega_3 = \dot\psi + \dot\phi\cos\theta",
        ),
        *_at_all(
            "tennis-racquet",
            _FREE,
            _free,
            "motion",
            r"I_1\dot\omega_1 = (I_2 - I_3)\omega_2\omega_3",
            r"I_3\dot\omega_3 + (I_2 - I_1)\omega_1\omega_2 = 0",
        ),
        *_at_all(
            "tennis-racquet",
            _FREE,
            _free,
            "identity",
            r"2E = \frac{L_1^2}{I_1} + \frac{L_2^2}{I_2} + \frac{L_3^2}{I_3}",
            r"T = \frac12(I_1\omega_1^2 + I_2\omega_2^2 + I_3\omega_3^2)",
        ),
        *_at_all(
            "hoop",
            "m R g omega ±theta ±theta_dot",
            _hoop,
            "motion",
            r"\ddot\theta = \left(\omega^2\cos\theta - \frac{g}{R}\right)\sin\theta",
        ),
        OwnClaim(
            "hoop",
            r"\cos\theta = \frac{g}{\omega^2R}",
            Everywhere("m R g theta", _hoop_steady),
            "steady",
        ),
        *(
            OwnClaim(
                "spherical",
                line,
                Steadily("m l g theta ±phi", _conical, r"\dot\phi", _conical_excess),
                "steady",
            )
            for line in (
                r"\dot\phi^2 = \frac{g}{l\cos\theta}",
                r"\dot\phi = \pm\sqrt{\frac{g}{l\cos\theta}}",
                r"E = \tfrac12 ml^2\dot\phi^2\sin^2\theta - mgl\cos\theta",
            )
        ),
        *(
            OwnClaim(
                "top",
                line,
                Steadily(
                    "M A C g h theta ±phi ±psi ±phi_dot",
                    _precession,
                    r"\dot\phi",
                    _precession_excess,
                ),
                "steady",
            )
            for line in (
                r"A\dot\phi^2\cos\theta - C\omega_3\dot\phi + Mgh = 0",
                r"\dot\phi = \frac{C\omega_3}{2A\cos\theta}"
                r"\left(1 \pm \sqrt{1 - \frac{4AMgh\cos\theta}{C^2\omega_3^2}}\right)",
                r"Mgh = \dot\phi(C\omega_3 - A\dot\phi\cos\theta)",
            )
        ),
        OwnClaim(
            "rolling-disk",
            r"6\omega_3\dot\phi\sin\theta = (\dot\phi^2\sin\theta - \frac{4g}{a})\cos\theta",
            Steadily("m a g theta ±phi_dot", _rolling_steady, r"\dot\phi", _rolling_excess),
            "steady",
        ),
        *_to_order(
            "plane",
            _PLANE,
            _small_swing,
            1,
            ["theta:1", "theta_dot:1"],
            r"\ddot\theta \approx -\frac{g}{l}\theta",
            r"l\ddot\theta + g\theta \approx 0",
        ),
        *_to_order(
            "plane",
            _PLANE,
            _small_swing,
            3,
            ["theta:3", "theta_dot:3"],
            r"\ddot\theta \approx -\frac{g}{l}\left(\theta - \frac{\theta^3}{6}\right)",
        ),
        *_to_order(
            "plane",
            _PLANE,
            _small_swing,
            2,
            ["theta:2", "theta_dot:2"],
            r"V \approx -mgl + \frac12 mgl\theta^2",
            r"E \approx \frac12 ml^2\dot\theta^2 + \frac12 mgl\theta^2 - mgl",
        ),
        *_to_order(
            "top",
            "M A C g h theta ±phi ±psi omega_3",
            _fast,
            1,
            ["1/omega_3"],
            r"\dot\phi \approx \frac{Mgh}{C\omega_3}",
        ),
        *_to_order(
            "tennis-racquet",
            _FREE,
            _nearly_about_3,
            1,
            ["omega_1:1", "omega_2:1"],
            r"\dot\omega_3 \approx 0",
            r"\ddot\omega_1 \approx -\frac{(I_1 - I_3)(I_2 - I_3)}{I_1I_2}\omega_3^2\omega_1",
        ),
        *_threshold(
            "rolling-disk",
            "m a g omega_3",
            _upright_disk,
            ["theta = pi/2", "phi_dot = 0"],
            r"\omega_3 > \sqrt{\frac{g}{3a}}",
            r"3a\omega_3^2 > g",
            r"\frac{g}{a} < 3\omega_3^2",
        ),
        *_threshold(
            "spinning-coin",
            "m a g phi_dot",
            _upright_coin,
            ["theta = pi/2", "omega_3 = 0"],
            r"\dot\phi > 2\sqrt{\frac{g}{a}}",
            r"\dot\phi^2 > \frac{4g}{a}",
        ),
        *_threshold(
            "gyroscope/upright",
            "M a g I_1 I_2 omega_1",
            _upright_gyroscope,
            ["alpha = 0", "beta = 0"],
            r"I_1^2\omega_1^2 > 4Mga(I_2 + Ma^2)",
            r"\omega_1 > \frac{2}{I_1}\sqrt{Mga(I_2 + Ma^2)}",
        ),
        *(
            OwnClaim(
                "plane",
                line,
                Along(_swings),
                "launch",
                {"given": ["theta = 1", "theta_dot = 0"]},
            )
            for line in (
                r"\dot\theta^2 = \frac{2g}{l}(\cos\theta - \cos 1)",
                r"\ddot\theta = -\frac{g}{l}\sin\theta",
                r"E = -mgl\cos 1",
                r"\theta \le 1",
            )
        ),
        *(
            OwnClaim("plane", line, ToDigits(known), "number", {"given": ["g = 9.81", "l = 0.5"]})
            for known in ({"g": 9.81, "l": 0.5},)
            for line in (
                r"\sqrt{\frac{g}{l}} = 4.43",
                r"2\pi\sqrt{\frac{l}{g}} = 1.42",
                r"\frac{3g}{2l} = 29.4",
            )
        ),
    ]

r"""What decides the truth of the problem set's claims on limits, thresholds and motions.

Accelerations and reactions come from the oracles, which have every body in the inertial frame and
know nothing of polhode; the letters are those of the text, read by `text_evaluator`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial

import numpy as np
from scipy.integrate import solve_ivp

from judge.oracle import MOTIONS
from judge.text_claims import Along, Numbers, SameSet, ToOrder, Truth
from judge.text_evaluator import Array

#: Rates that the text names as if they were functions.
_RATES = {r"\omega_p(\text{slow})": r"\omega_{slow}", r"\omega_p(\text{fast})": r"\omega_{fast}"}


def spelled(latex: str) -> str:
    """The text with such rates as letters."""
    for printed, letter in _RATES.items():
        latex = latex.replace(printed, letter)
    return latex


def _moving(system: str, n: Numbers) -> Numbers:
    """With accelerations and reactions of the motion at each of the states."""
    states = [{k: float(v[i]) for k, v in n.items()} for i in range(len(next(iter(n.values()))))]
    found = [MOTIONS[system](state) for state in states]
    return {**n, **{k: np.array([f[k] for f in found]) for k in found[0]}}


# -- disks: I₁ = ma²/4, I₃ = ma²/2; on edge θ = π/2 + ε -------------------------------------------


def _thin(n: Numbers) -> Numbers:
    ring = n["m"] * n["a"] ** 2
    return {**n, "I_1": ring / 4, "I_2": ring / 4, "I_3": ring / 2}


def _nearly_on_edge(system: str, small: str, n: Numbers) -> Numbers:
    """ε and the speeds named are small; a speed of −1 is that of (w22), φ̇ = 2 ε ω₃."""
    size = n["size"]
    n = _thin({**n, "epsilon": n["epsilon"] * size, "theta_dot": n["theta_dot"] * size})
    if "phi_dot" in small:
        n["phi_dot"] = n["phi_dot"] * size
    if "wobble" in small:
        n["phi_dot"] = 2 * n["epsilon"] * n["omega_3"]
    zero = 0 * size
    n = {**n, "theta": np.pi / 2 + n["epsilon"], "psi": zero, "phi": zero}
    n = _moving(system, {**n, "v_x": zero, "v_y": zero})
    return {
        **n,
        "epsilon_dot": n["theta_dot"],
        "epsilon_ddot": n["theta_ddot"],
        "L_3": n["I_3"] * n["omega_3"],
    }


def _upright(speed: str, n: Numbers) -> Numbers:
    """A coin spins on edge for φ̇² > 4g/a, a disk rolls on edge for ω₃² > g/3a."""
    n = _thin(n)
    margin = {
        "phi_dot": lambda: n["a"] * n["phi_dot"] ** 2 - 4 * n["g"],
        "omega_3": lambda: 3 * n["a"] * n["omega_3"] ** 2 - n["g"],
    }[speed]()
    return {**n, "condition": margin}


# -- the gyrocompass, and rates of precession -----------------------------------------------------


def _compass(small: tuple[str, ...], n: Numbers) -> Numbers:
    n = {**n, "I_3": 2 * n["I_1"], "lambda_": n["lambda"]}
    n |= {name: n[name] * n["size"] for name in small}
    if "theta" in small:
        n["theta_dot"] = n["theta_dot"] * n["size"]
    return _moving("gyrocompass", n)


def _precession(n: Numbers) -> Numbers:
    across = n["I_2"] + n["M"] * n["a"] ** 2
    spin = n["omega_1"] / n["size"]
    b, c = n["I_1"] * spin, across * np.cos(n["theta_0"])
    weight = n["M"] * n["g"] * n["a"]
    root = np.sqrt(b**2 - 4 * c * weight)
    return {
        **n,
        "omega_1": spin,
        "I_2p": across,
        "omega_slow": 2 * weight / (b + root),
        "omega_fast": (b + root) / (2 * c),
    }


# -- motions --------------------------------------------------------------------------------------


@cache
def _separatrices() -> tuple[Numbers, ...]:
    return tuple(map(_separatrix, (0, 1, 2)))


def _separatrix(seed: int) -> Numbers:
    """Euler's equations from ω₂ = 0 with L² = 2 I₂ T."""
    I_1, I_2, I_3 = np.sort(np.random.default_rng(seed).uniform(0.6, 1.1, 3))
    first = 0.8 + 0.1 * seed
    third = first * np.sqrt(I_1 * (I_2 - I_1) / (I_3 * (I_3 - I_2)))
    start, times = 0.3, np.linspace(0.3, 4.0, 40)

    def rates(_: float, w: Array) -> list[float]:
        return [
            (I_2 - I_3) * w[1] * w[2] / I_1,
            (I_3 - I_1) * w[2] * w[0] / I_2,
            (I_1 - I_2) * w[0] * w[1] / I_3,
        ]

    path = solve_ivp(
        rates, (start, 4.0), [first, 0.0, third], t_eval=times, rtol=1e-11, atol=1e-13
    ).y
    size = np.sqrt((I_1 * first) ** 2 + (I_3 * third) ** 2)
    known = {
        "I_1": I_1,
        "I_2": I_2,
        "I_3": I_3,
        "L": size,
        "T": (I_1 * first**2 + I_3 * third**2) / 2,
        "t_0": start,
        "omega_1max": first,
        "omega_2max": size / I_2,
        "omega_3max": third,
        "k": np.sqrt((I_3 - I_2) * (I_2 - I_1) / (I_1 * I_3)),
    }
    constant = {k: np.full(times.shape, v) for k, v in known.items()}
    return {**constant, "t": times, **{f"omega_{i + 1}": path[i] for i in range(3)}}


_AZIMUTHS = (-0.8, 0.4, 1.3)  # at the start, about which the text says nothing


@cache
def _launches() -> tuple[Numbers, ...]:
    return tuple(map(_launched, (0, 1, 2)))


def _launched(seed: int) -> Numbers:
    """A gyroscope let go at 60° with its axle at rest."""
    random = np.random.default_rng(seed)
    known = {name: float(random.uniform(0.5, 1.2)) for name in ("M", "a", "I_1", "I_2", "g")}
    known |= {"omega_1": 150.0, "phi": 0.0, "psi": 0.0}
    motion = MOTIONS["gyroscope"]
    known["g"] = (0.6, 3.0, 9.0)[seed]
    known["M"] = (1.6, 0.7, 1.1)[seed]

    def rates(_: float, y: Array) -> list[float]:
        found = motion({**known, "theta": y[0], "theta_dot": y[1], "phi_dot": y[2]})
        return [y[1], found["theta_ddot"], found["phi_ddot"], y[2]]

    across = known["I_2"] + known["M"] * known["a"] ** 2
    period = 2 * np.pi * across / (known["I_1"] * known["omega_1"])
    times = np.concatenate(([0.0], period * np.geomspace(1e-3, 2.5, 120)))
    path = solve_ivp(
        rates,
        (0, times[-1]),
        [np.pi / 3, 0.0, 0.0, _AZIMUTHS[seed]],
        t_eval=times,
        rtol=1e-9,
        atol=1e-11,
    ).y
    constant = {k: np.full(times.shape, v) for k, v in known.items()}
    n = {**constant, "t": times, "theta": path[0], "theta_dot": path[1], "phi_dot": path[2]}
    n["phi"] = path[3]
    n = _moving("gyroscope", n)
    b, c = known["I_1"] * known["omega_1"], across * np.cos(np.pi / 3)
    weight = known["M"] * known["g"] * known["a"]
    slow = 2 * weight / (b + np.sqrt(b**2 - 4 * c * weight))
    torque = n["a"] * (n["F_z"] * np.sin(n["theta"]) - n["F_rho"] * np.cos(n["theta"]))
    return {**n, "omega_p": np.full(times.shape, slow), "tau_phi": torque}


# -- by claim -------------------------------------------------------------------------------------

_EDGE = "m a g epsilon ±theta_dot ±phi_dot ±omega_3"
_COMPASS = "I_1 Omega lambda ±theta ±theta_dot omega"
_AXLE = "M a g I_1 I_2 theta_0 omega_1"


def _limits() -> Mapping[str, tuple[str, Callable[[Numbers], Numbers], int]]:
    coin, disk = (partial(_nearly_on_edge, name) for name in ("spinning-coin", "rolling-disk"))
    slow = partial(disk, "phi_dot")
    return {
        "26": (_EDGE, partial(coin, ""), 1),
        "w10": (_EDGE, partial(coin, ""), 1),
        "w22": (_EDGE, partial(disk, "wobble"), 1),
        **dict.fromkeys(("w23", "w26"), (_EDGE, slow, 1)),
        "w25": (_EDGE, slow, 2),
        "73": (_COMPASS, partial(_compass, ("Omega",)), 1),
        **dict.fromkeys(("74", "w46"), (_COMPASS, partial(_compass, ("Omega", "theta")), 2)),
        "129": (_AXLE, _precession, 1),
        "130": (_AXLE, _precession, -1),
    }


_THRESHOLDS = {
    **dict.fromkeys(("27", "w11"), ("m a g phi_dot", "phi_dot")),
    **dict.fromkeys(("w24", "w27"), ("m a g omega_3", "omega_3")),
}
_SEPARATRIX = ("12", "13", "14", "84", "85", "86")
_LAUNCHED = ("w68", "w69", *(f"w{n}" for n in range(70, 80) if n != 74))


def truth_of(ident: str, formula: str, when: str) -> Truth | None:
    """What decides the claim of this number; None where nothing here does."""
    limits = _limits()
    if ident in limits:
        names, state, kept = limits[ident]
        return ToOrder(names, state, kept, spelled(formula))
    if ident in _THRESHOLDS:
        names, speed = _THRESHOLDS[ident]
        return SameSet(names, partial(_upright, speed))
    if ident in _SEPARATRIX:
        return Along(lambda: list(_separatrices()), when or "always")
    if ident in _LAUNCHED:
        return Along(lambda: list(_launches()), when or "always")
    return None

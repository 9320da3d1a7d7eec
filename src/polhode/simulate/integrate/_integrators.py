"""The available integrators, and which one is used."""

from __future__ import annotations

import os
from importlib.util import find_spec

from polhode.base import DeclarationError
from polhode.simulate.integrate._stepping import Integrator

CHOICE = "POLHODE_INTEGRATOR"
"""Environment variable that names the integrator to use."""

# in the order of preference: what each needs
_LIBRARIES = {"heyoka": "heyoka", "kernel": "wasmtime", "scipy": "scipy"}


def chosen() -> Integrator:
    """heyoka's Taylor method where it is installed, else polhode's own; SciPy's if asked for.

    Raises:
        DeclarationError: where POLHODE_INTEGRATOR names one that is not installed.
    """
    there = [name for name, library in _LIBRARIES.items() if find_spec(library)]
    name = os.environ.get(CHOICE) or there[0]
    if name not in there:
        raise DeclarationError(
            f"{CHOICE} = {name!r}",
            expected=f"one of {', '.join(there)}",
            advice="unset it to use the default",
        )
    if name == "heyoka":
        from polhode.simulate.integrate._heyoka import Taylor

        return Taylor()
    if name == "kernel":
        from polhode.simulate.integrate._kernel import KernelTaylor

        return KernelTaylor()
    from polhode.simulate.integrate._scipy import DormandPrince

    return DormandPrince()

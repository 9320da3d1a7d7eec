"""Which integrator follows a motion, and where heyoka is used."""

from __future__ import annotations

import os
from importlib.util import find_spec

from polhode.base import DeclarationError
from polhode.simulate.integrate._stepping import Integrator

CHOICE = "POLHODE_INTEGRATOR"
"""Environment variable that names the integrator to use."""

_KERNEL, _HEYOKA = "kernel", "heyoka"


def chosen() -> Integrator:
    """Polhode's own kernel; heyoka's Taylor method if asked for.

    Raises:
        DeclarationError: where POLHODE_INTEGRATOR names another, or one that is not installed.
    """
    if _named() == _HEYOKA:
        from polhode.simulate.integrate._heyoka import Taylor

        return Taylor()
    from polhode.simulate.integrate._kernel import KernelTaylor

    return KernelTaylor()


def heyoka_is_used() -> bool:
    """Whether heyoka does what it is quicker at: many motions side by side, and many digits.

    Raises:
        DeclarationError: as `chosen`.
    """
    return _named() != _KERNEL and find_spec(_HEYOKA) is not None


def _named() -> str:
    """The integrator that is asked for; empty if none is."""
    name = os.environ.get(CHOICE, "")
    if name not in ("", _KERNEL, _HEYOKA):
        was = "; SciPy's is no longer used: the kernel needs no more than it did"
        raise DeclarationError(
            f"{CHOICE} = {name!r}",
            expected=f"{_KERNEL} or {_HEYOKA}",
            advice="unset it to use the default" + (was if name == "scipy" else ""),
        )
    if name == _HEYOKA and find_spec(_HEYOKA) is None:
        raise DeclarationError(
            f"{CHOICE} = {name!r}, which is not installed",
            expected=f"{_KERNEL}, or heyoka to be installed",
            advice="pip install 'polhode[fast]' on Linux, or unset it to use the kernel",
        )
    return name

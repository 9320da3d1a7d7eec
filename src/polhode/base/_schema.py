"""The schema number and the origin that every document carries."""

from functools import cache
from typing import TypedDict

SCHEMA = 2
"""Number of the layout of every JSON document, file, page and store."""

LIBRARIES = ("python-flint", "numpy", "scipy", "heyoka", "sympy", "matplotlib", "latex2mathml")
"""Distributions whose version a result may depend on."""


class Provenance(TypedDict):
    """What a document was made with; a library that is not installed has the version None."""

    schema: int
    versions: dict[str, str | None]
    seed: int | None


def provenance(seed: int | None = None) -> Provenance:
    """What the document being written is made with, found without importing any library.

    Args:
        seed: of the random numbers that went into it, None if none did.
    """
    import platform

    versions: dict[str, str | None] = {
        "polhode": installed_version("polhode"),
        "python": platform.python_version(),
    }
    versions |= {library: installed_version(library) for library in LIBRARIES}
    return {"schema": SCHEMA, "versions": versions, "seed": seed}


@cache
def installed_version(distribution: str) -> str | None:
    """The version of an installed distribution, None where it is not installed."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(distribution)
    except PackageNotFoundError:
        return None

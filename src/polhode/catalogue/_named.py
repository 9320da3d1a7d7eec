"""The system that a document names: one of the catalogue, since a document may run no code."""

from __future__ import annotations

from polhode.base import DeclarationError, did_you_mean
from polhode.catalogue._entry import CatalogueEntry
from polhode.catalogue._systems import CATALOGUE

_LONGEST = 80  # characters of a name that are shown


def entry_named_in(document: str, name: str, *, advice: str) -> CatalogueEntry:
    """The entry of the catalogue that a document names.

    A system in a file would be Python code, and whoever wrote the document would choose which code
    runs. Only those who run polhode name files, on the command line or in Python.

    Args:
        document: what names it, for messages, such as the path of a text.
        name: what stands there.
        advice: how to name a system of one's own instead.

    Raises:
        DeclarationError: for a name that is not in the catalogue.
    """
    if name in CATALOGUE:
        return CATALOGUE[name]
    shown = name if len(name) <= _LONGEST else f"{name[:_LONGEST]}..."
    is_path = ".py" in name.lower() or "/" in name or "\\" in name
    near = "" if is_path else did_you_mean(name, CATALOGUE)
    raise DeclarationError(
        f"{document} names the system {shown!r}",
        expected="one of 'polhode list': a document names systems of the catalogue, and no files",
        advice=near or f"a system of your own: {advice}",
    )

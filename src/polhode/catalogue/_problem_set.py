"""The problem set as a document of claims: what it states, and how its symbols are meant."""

from importlib.resources import files


def problem_set() -> str:
    """The document, as the TOML text that `polhode.claims` reads; docs/claims-format.md tells how.

    It holds all 162 numbered equations of the problem set, byte for byte as its transcript prints
    them, and statements in words.
    """
    return (files("polhode.catalogue") / "problem_set.toml").read_text("utf-8")

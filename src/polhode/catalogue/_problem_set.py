"""The problem set as a document of claims."""

from importlib.resources import files


def problem_set() -> str:
    """The problem set as a document of claims: TOML text, in the format of docs/claims-format.md.

    It holds all 162 numbered equations of the problem set, byte for byte as its transcript prints
    them, and statements in words.
    """
    return (files("polhode.catalogue") / "problem_set.toml").read_text("utf-8")

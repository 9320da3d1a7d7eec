"""Letters by their published names, and spelled in ASCII for messages."""

from __future__ import annotations

from polhode.claims.latex._tree import At, Component, Differential, Dots, Name, Node, Number

_DOTS = {"_dot": 1, "_ddot": 2, "_dddot": 3}


def name_of(published: str) -> Node:
    """The letter that a published name is printed as: `Fprime_rho`, `theta_ddot`."""
    for ending, count in _DOTS.items():
        if published.endswith(ending):
            return Dots(name_of(published.removesuffix(ending)), count)
    stem, *subscripts = published.rstrip("_").split("_")
    letter = stem
    while letter.endswith("prime") and letter != "prime":
        letter = letter.removesuffix("prime")
    primes = (len(stem) - len(letter)) // len("prime")
    return Name(letter, ",".join(subscripts), primes)


def spelled(node: Node) -> str:
    """A letter in ASCII for messages: `omega_3`, `theta_dot`, `hat 3`, `vector L_cm`."""
    match node:
        case Name(letter, subscript, primes, decoration):
            below = f"_{subscript}" if subscript else ""
            prefix = f"{decoration} " if decoration else ""
            return f"{prefix}{letter}{'prime' * primes}{below}"
        case Number(text):
            return text
        case Dots(of, count):
            return f"{spelled(of)}_{'d' * (count > 1) * (count - 1)}dot"
        case Differential(of, sign):
            return f"{sign}{spelled(of)}"
        case At(of, argument):
            return f"{spelled(of)}({spelled(argument)})"
        case Component(of, subscript):
            return f"({spelled(of)})_{subscript}"
    return type(node).__name__.lower()

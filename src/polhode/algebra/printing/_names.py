"""A published ASCII name split up for printing: letter, primes, subscripts, dots."""

from __future__ import annotations

from dataclasses import dataclass

from polhode.algebra._ring import Symbol, SymbolKind

_GREEK_LETTERS = dict(
    zip(
        (
            *("alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta"),
            *("iota", "kappa", "lambda", "mu", "nu", "xi", "pi", "rho"),
            *("sigma", "tau", "upsilon", "phi", "chi", "psi", "omega"),
        ),
        "αβγδεζηθικλμνξπρστυφχψω",
        strict=True,
    )
)
_GREEK_CAPITALS = dict(
    zip(
        (
            *("Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi"),
            *("Sigma", "Upsilon", "Phi", "Psi", "Omega"),
        ),
        "ΓΔΘΛΞΠΣΥΦΨΩ",
        strict=True,
    )
)
#: Greek letters by their names.
GREEK = _GREEK_LETTERS | _GREEK_CAPITALS

_PRIME = "prime"


@dataclass(frozen=True)
class Spelling:
    """The parts of a name: `Fprime_rho` of order 1 is F, one prime, subscript ρ, one dot."""

    stem: str
    primes: int
    subscripts: tuple[str, ...]
    dots: int

    @classmethod
    def of(cls, symbol: Symbol) -> Spelling:
        """The spelling of a symbol; a trailing underscore (`lambda_`) is dropped."""
        if symbol.kind is SymbolKind.TIME:
            return cls("t", 0, (), 0)
        stem, *subscripts = symbol.name.rstrip("_").split("_")
        letter = stem
        while letter.endswith(_PRIME) and letter != _PRIME:
            letter = letter.removesuffix(_PRIME)
        primes = (len(stem) - len(letter)) // len(_PRIME)
        return cls(letter, primes, tuple(subscripts), symbol.order)

    @property
    def place(self) -> tuple[bool, str, str, tuple[str, ...]]:
        """Alphabetical order: Latin before Greek, each in its own alphabet."""
        glyph = GREEK.get(self.stem, self.stem)
        return (glyph != self.stem, glyph.casefold(), glyph, self.subscripts)

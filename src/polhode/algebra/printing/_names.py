"""A published ASCII name split up for printing: letter, primes, subscripts, dots."""

from __future__ import annotations

import re
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
#: Letters with a number, as programs write x₁ and θ₂, and with the axes of a moment of inertia.
_NUMBERED = re.compile(rf"([A-Za-z]|{'|'.join(GREEK)})([0-9]+)|([A-Z])([xyz]{{2}})")


@dataclass(frozen=True)
class LetterParts:
    """A published name as it is printed: `Fprime_rho` is F, one prime, label ρ; `x1` is x₁.

    Attributes:
        letter: one letter, the name of a Greek one, or a word.
        primes: how many stand behind it.
        labels: below it.
    """

    letter: str
    primes: int
    labels: tuple[str, ...]

    @classmethod
    def of(cls, published: str) -> LetterParts:
        """The parts of a name without dots; a trailing underscore (`lambda_`) is dropped."""
        stem, *labels = published.rstrip("_").split("_")
        letter = stem
        while letter.endswith(_PRIME) and letter != _PRIME:
            letter = letter.removesuffix(_PRIME)
        primes = (len(stem) - len(letter)) // len(_PRIME)
        if parted := _NUMBERED.fullmatch(letter):
            letter, label = filter(None, parted.groups())
            labels = [label, *labels]
        return cls(letter, primes, tuple(labels))

    @property
    def is_word(self) -> bool:
        """Whether it is printed as an upright word, and not as a letter or in capitals."""
        return len(self.letter) > 1 and self.letter not in GREEK and not self.letter.isupper()


@dataclass(frozen=True)
class Spelling:
    """The parts of a name: `Fprime_rho` of order 1 is F, one prime, subscript ρ, one dot."""

    stem: str
    primes: int
    subscripts: tuple[str, ...]
    dots: int

    @classmethod
    def of(cls, symbol: Symbol) -> Spelling:
        """The spelling of a symbol."""
        if symbol.kind is SymbolKind.TIME:
            return cls("t", 0, (), 0)
        parts = LetterParts.of(symbol.name)
        return cls(parts.letter, parts.primes, parts.labels, symbol.order)

    @property
    def place(self) -> tuple[bool, str, str, tuple[str, ...]]:
        """Alphabetical order: Latin before Greek, each in its own alphabet."""
        glyph = GREEK.get(self.stem, self.stem)
        return (glyph != self.stem, glyph.casefold(), glyph, self.subscripts)

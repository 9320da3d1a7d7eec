"""Functions read with their arguments, as texts print them: sin 2θ cos φ, cos Ωt, tanh⁻¹ x."""

from __future__ import annotations

from abc import abstractmethod

from polhode.claims.latex import _lexicon as lexicon
from polhode.claims.latex._differentials import product
from polhode.claims.latex._letters import LetterReader
from polhode.claims.latex._tree import Call, Dots, Name, Negative, Node, Number, Power

_COUNTS = {"n", "k", "pi"}  # letters that stand before an angle: sin nθ
_RATES = {"omega", "Omega", "nu", "kappa"}  # and, with the Latin ones, before a time: cos Ωt


class CallReader(LetterReader):
    """Reads functions; their arguments are read by what builds on it."""

    @abstractmethod
    def _factor(self) -> Node:
        """A factor with all that belongs to it."""

    @abstractmethod
    def _bracket(self) -> Node:
        """What a bracket holds."""

    def _call(self) -> Node:
        """A function with its argument: in a bracket, or the angle that stands behind it."""
        start = self._start
        function = self._take().text
        exponent = self._exponent()
        if exponent == Negative(Number("1")) and function in lexicon.INVERSES:
            function, exponent = lexicon.INVERSES[function], None
        with self._deeper():
            argument = self._bracket() if self._at("(", "[", "\\{") else self._angle()
        call = Call(function, argument, span=self._since(start))
        exponent = exponent or self._exponent()
        return call if exponent is None else Power(call, exponent, span=self._since(start))

    def _exponent(self) -> Node | None:
        if not self._took("^"):
            return None
        with self._deeper():
            return self._argument()

    def _angle(self) -> Node:
        """A number, a count and one more factor; a time t behind it belongs to it."""
        start = self._start
        if self._took("-"):
            with self._deeper():
                of = self._angle()
            return Negative(of, span=self._since(start))
        factors: list[Node] = []
        while not factors or (_counts(factors[-1]) and self._starts_angle()):
            factors.append(self._factor())
        if _is_rate(factors[-1]) and self._token.kind == "letter" and self._token.text == "t":
            factors.append(self._factor())
        return product(factors, self._since(start))

    def _starts_angle(self) -> bool:
        token = self._token
        return self._starts_letter(token) or token.kind == "fraction" or token.is_mark("(", "[")


def _counts(node: Node) -> bool:
    """Whether it stands before an angle: 2θ, nθ, πt/T."""
    return isinstance(node, Number) or (isinstance(node, Name) and node.letter in _COUNTS)


def _is_rate(node: Node) -> bool:
    """Whether a time behind it makes an angle with it."""
    if isinstance(node, Name):
        return node.letter in _RATES or (len(node.letter) == 1 and node.letter != "t")
    return isinstance(node, Dots)

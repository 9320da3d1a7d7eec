"""How expressions print; the printers are fetched when first asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from polhode.base import Shown

if TYPE_CHECKING:
    from polhode.algebra._expression import Expr


class Printed(Shown):
    """The face that expressions show: plain text, Greek letters, LaTeX and MathML.

    A notebook shows them as MathML, which needs no script from a network.
    """

    @property
    def _whole(self) -> Expr:
        return cast("Expr", self)

    def __repr__(self) -> str:
        return str(self)

    def __str__(self) -> str:
        from polhode.algebra.printing._text import text

        return text(self._whole)

    def pretty(self) -> str:
        """One line with Greek letters, dots and superscripts."""
        from polhode.algebra.printing._text import pretty

        return pretty(self._whole)

    def latex(self) -> str:
        """LaTeX as a text would print it."""
        from polhode.algebra.printing._latex import latex

        return latex(self._whole)

    def mathml(self) -> str:
        """Presentation MathML."""
        from polhode.algebra.printing._latex import mathml

        return mathml(self.latex())

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"

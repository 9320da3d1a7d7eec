"""A relation of a text with what stands for it: words around it, and what the text has stated."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, Symbol
from polhode.analyse import reduced
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge._notation import Notation
from polhode.judge.latex import Statement, read_latex
from polhode.judge.latex._names import name_of
from polhode.judge.latex._tree import Name, Node, UnitSymbol, walk
from polhode.judge.meaning._mechanics import Mechanics
from polhode.judge.source import SourceRelation
from polhode.judge.text._cues import Cues
from polhode.judge.text._in_force import InForce, Section

TIME_LETTER = Name("t")
#: Components of an angular velocity along the axes of a body.
SPINS = ("omega_1", "omega_2", "omega_3")
_IN_A_PLANE = re.compile(
    r"\bin (?:a|one|the) (?:vertical |horizontal )?plane\b|\bplan(?:e|ar) motion\b"
    r"|\balong (?:a|one|the) (?:straight )?line\b|\bone[- ]dimension|\bslid(?:e|es|ing)\b"
    r"|\b(?:down|up) (?:a|an|the) (?:\w+ )?(?:incline|slope|ramp|hill|plane)\b",
    re.I,
)


@dataclass(frozen=True)
class TextLine:
    """A relation of a text with what stands for it.

    Attributes:
        relation: as read from its file.
        cues: what the words around it say.
        section: the part it stands in.
        in_force: what the text has stated for it.
        tacit: speeds that the text nowhere mentions.
        earlier: letters of the lines before it.
        cited: the numbers of the lines that its words say it is drawn from.
        read_as: how a slash in it, or what words say of it, was read: "read as" and its LaTeX.
    """

    relation: SourceRelation
    cues: Cues
    section: Section
    in_force: InForce
    tacit: tuple[Symbol, ...] = ()
    earlier: frozenset[Node] = frozenset()
    cited: frozenset[int] = frozenset()
    read_as: str = ""

    @cached_property
    def latex(self) -> str:
        """What is judged: the relation as printed, or as it was read where that differs."""
        relation = self.relation
        text = relation.latex
        try:
            if read_latex(text).relations != (relation.relation,):
                text = relation.printed
        except PolhodeError:
            text = relation.printed
        conditions = (rf"\quad\text{{if }} {condition}" for condition in relation.under)
        return "".join([text, *conditions])

    @cached_property
    def statement(self) -> Statement:
        """Its tree."""
        return read_latex(self.latex)

    @property
    def prints_a_unit(self) -> bool:
        """Whether a unit of measurement stands in it."""
        return any(isinstance(piece, UnitSymbol) for piece in walk(self.statement))

    @property
    def is_steady(self) -> bool:
        """Whether the text speaks of steady motion, or has spoken of equilibrium."""
        return self.says_that_it_is_steady or self.in_force.is_of_equilibrium

    @property
    def says_that_it_is_steady(self) -> bool:
        """Whether it stands among words on steady motion, or beside some on equilibrium.

        That a text has named equilibria before does not make what it goes on to say one of them.
        """
        return self.in_force.is_steady or self.cues.is_steady or self.cues.is_of_equilibrium

    @property
    def letters(self) -> Iterator[Node]:
        """The letters in it."""
        return (piece for piece in walk(self.statement) if isinstance(piece, Name))


def essential_coordinates(equations: Equations) -> Sequence[Symbol]:
    """The coordinates on which the motion depends."""
    try:
        return reduced(equations).essential
    except PolhodeError:
        return equations.coordinates


def components_of_turning(notation: Notation) -> frozenset[Expr]:
    """The components of the angular velocity along axes of the body, as far as these have letters.

    They are as free as the speeds that a declaration has chosen, such as rates of Euler's angles.
    """
    meanings = (notation.vocabulary.find(name_of(name)) for name in SPINS)
    return frozenset(m for m in meanings if isinstance(m, Expr) and m.varies)


def unmentioned_speeds(
    relations: Sequence[SourceRelation], equations: Equations
) -> tuple[Symbol, ...]:
    """Independent speeds and given motions of which no line speaks.

    A text that treats a coin whose centre does not travel may take that for granted, and so may one
    on a sheet of paper that does not turn. Speeds of turning count only where words speak of motion
    in a plane or of sliding: else a term that is missing would be taken for granted.
    """
    read = (way.relation for r in relations for way in (r, *r.ways))
    used = {n for relation in read if relation is not None for n in walk(relation)}
    # A text that prints x or its rate speaks of the speed that the rate is.
    moving = {
        symbol
        for rate, value in equations.kinematics.items()
        if name_of(rate.base().published) in used
        for symbol in value.symbols()
    }
    is_plane = any(_IN_A_PLANE.search(relation.before) for relation in relations)

    def is_mentioned(symbol: Symbol) -> bool:
        names = {name_of(each) for each in (symbol.published, symbol.base().published)}
        return symbol in moving or not used.isdisjoint(names)

    functions = Mechanics(equations).declared.functions
    sliding = [s for s in equations.speeds if is_plane or s.name.startswith("v_")]
    return tuple(s for s in (*functions, *sliding) if not is_mentioned(s))

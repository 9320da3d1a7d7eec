"""Documents of claims: what a text states, byte for byte, and what its symbols mean."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeVar

from polhode.base import ParseError

CONTEXTS = ("identity", "motion", "steady", "threshold", "limit", "launch", "number")
QUANTIFIERS = ("always", "never", "sometimes", "initially", "finally")


@dataclass(frozen=True)
class Definition:
    """A definition that the text states.

    Attributes:
        latex: an equation with the new symbol on its left, such as ``I_{2p} = I_2 + Ma^2``.
        where: the place in the text that states it.
    """

    latex: str
    where: str = ""


@dataclass(frozen=True)
class Part:
    """A section of the text with one set of conventions.

    Attributes:
        id: the name by which claims refer to it.
        title: heading.
        system: name of the system it treats, which a resolver looks up.
        convention: of angles, axes and signs, in words.
        bindings: meanings of symbols, as LaTeX → quantity of the model.
        definitions: those the text states, in order; later ones may use earlier ones.
        constants: symbols, as LaTeX, that stand for constants without a value.
        positive: symbols and quantities that the text takes as positive.
        given: relations, as LaTeX, that restrict everything in this part.
    """

    id: str
    title: str
    system: str
    convention: str = ""
    bindings: Mapping[str, str] = field(default_factory=dict)
    definitions: tuple[Definition, ...] = ()
    constants: tuple[str, ...] = ()
    positive: tuple[str, ...] = ()
    given: tuple[str, ...] = ()


@dataclass(frozen=True)
class Note:
    """A line on how a claim was read, shown wherever its verdict is.

    Attributes:
        label: "read as", "because" or "given".
        text: LaTeX, or words.
        is_formula: whether it is LaTeX.
    """

    label: str
    text: str
    is_formula: bool = False


@dataclass(frozen=True)
class Claim:
    """One statement of the text.

    Attributes:
        id: number of the equation, or any other name.
        part: the part it stands in.
        context: where it should hold; one of the contexts of the command line.
        latex: the equation, byte for byte; empty for a statement in words.
        words: for a statement in words: the words, shortened, formulas spelled in plain letters.
        means: the statement of those words, as LaTeX.
        when: for a statement about a motion: always, never, sometimes, initially or finally.
        read_as: the equation before the transcript was damaged.
        reason: the evidence of the damage.
        where: the place in the text, if the number does not give it.
        follows_from: ids of the claims it is derived from.
        bindings: as in `Part`, for this claim alone.
        definitions: as in `Part`, for this claim alone.
        given: restrictions, as LaTeX relations.
        small: order to which each small quantity, as LaTeX, is kept; None if none is stated.
        start: for the context launch, initial values by published name.
        line: line of its header in the document.
    """

    id: str
    part: str
    context: str = "motion"
    latex: str = ""
    words: str = ""
    means: str = ""
    when: str = ""
    read_as: str = ""
    reason: str = ""
    where: str = ""
    follows_from: tuple[str, ...] = ()
    bindings: Mapping[str, str] = field(default_factory=dict)
    definitions: tuple[Definition, ...] = ()
    given: tuple[str, ...] = ()
    small: Mapping[str, int | None] = field(default_factory=dict)
    start: Mapping[str, str] = field(default_factory=dict)
    line: int = field(default=0, compare=False)

    @property
    def formula(self) -> str:
        """The LaTeX to be judged."""
        return self.read_as or self.latex or self.means

    @property
    def notes(self) -> tuple[Note, ...]:
        """How it was read beyond what is printed: the formula judged, the reason, restrictions."""
        read = self.read_as or self.means
        return (
            *([Note("read as", read, is_formula=True)] if read else []),
            *([Note("because", self.reason)] if self.reason else []),
            *(Note("given", relation, is_formula=True) for relation in self.given),
        )

    @property
    def printed(self) -> str:
        """The claim as the text prints it: its LaTeX, or its words."""
        return self.latex or self.words


@dataclass(frozen=True)
class Document:
    """All claims of a text, in its order.

    Attributes:
        title: of the text.
        source: who wrote it, and where it is found.
        parts: in order.
        claims: in order.
    """

    title: str
    source: str
    parts: tuple[Part, ...]
    claims: tuple[Claim, ...]

    @cached_property
    def _parts(self) -> dict[str, Part]:
        return {part.id: part for part in self.parts}

    @cached_property
    def _claims(self) -> dict[str, Claim]:
        return {claim.id: claim for claim in self.claims}

    def part(self, id: str) -> Part:
        """The part with this id."""
        return _found(id, self._parts, "part")

    def claim(self, id: str) -> Claim:
        """The claim with this id."""
        return _found(id, self._claims, "claim")

    def part_of(self, claim: Claim) -> Part:
        """The part that a claim stands in."""
        return self.part(claim.part)

    def about(self, system: str) -> tuple[Claim, ...]:
        """The claims about a system, in order."""
        return tuple(claim for claim in self.claims if self.part_of(claim).system == system)

    def consequences(self, id: str) -> tuple[str, ...]:
        """Ids of all claims derived from this one, directly or through others, in order."""
        # Transitive closure: at most one pass for each claim, and circles cannot make it endless.
        reached = {id}
        for _ in self.claims:
            more = {c.id for c in self.claims if reached & set(c.follows_from)}
            if more <= reached:
                break
            reached |= more
        return tuple(c.id for c in self.claims if c.id in reached and c.id != id)


_Thing = TypeVar("_Thing", Part, Claim)


def _found(id: str, known: Mapping[str, _Thing], what: str) -> _Thing:
    if id not in known:
        raise ParseError(f"{what} {id!r}", expected=f"one of {', '.join(known)}")
    return known[id]

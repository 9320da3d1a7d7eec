"""Documents read: every relation with its place, what was read, and whether it is mechanics."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from polhode.base import ParseError, PolhodeError, StoreError
from polhode.claims.latex import Statement, read_latex, write_latex
from polhode.claims.latex._tree import Relation
from polhode.claims.source._formats import FORMATS, plain_formulas
from polhode.claims.source._macros import Macro, expanded
from polhode.claims.source._placed import Lines, PlacedText
from polhode.claims.source._rows import is_relation, parts, relations, without_layout
from polhode.claims.source._scan import Formula, Inclusion
from polhode.claims.source._scope import beyond
from polhode.claims.source._undefined import StandIns, punctuation, with_stand_ins

LARGEST = 20_000_000  # characters of a file
MOST_FILES = 500  # that one document may include


@dataclass(frozen=True)
class SourceRelation:
    """A relation as it stands in a document.

    Args:
        file: the file, by the name it was given or included under.
        line: where it begins, counted from 1.
        column: likewise.
        latex: what stands there, with the macros of its text.
        relation: what was read, or None; undefined macros are letters of their own in it.
        printed: what was read, written back as LaTeX; empty if it was not read.
        why: the cause, where it was not read or is not mechanics of rigid bodies.
        in_scope: whether it speaks of the mechanics of rigid bodies.
        is_display: whether it stands on lines of its own.
        undefined: macros in it that the document does not define, with their arguments.
    """

    file: str
    line: int
    column: int
    latex: str
    relation: Relation | None
    printed: str
    why: str
    in_scope: bool
    is_display: bool
    undefined: tuple[str, ...] = ()

    @property
    def read(self) -> bool:
        """Whether it was read."""
        return self.relation is not None

    def to_json(self) -> dict[str, object]:
        """Plain data, by the names of the contract."""
        return {
            "file": self.file,
            "line": self.line,
            "column": self.column,
            "latex": self.latex,
            "read": self.read,
            "printed": self.printed or None,
            "why": self.why or None,
            "in_scope": self.in_scope,
        }


@dataclass(frozen=True)
class _File:
    """A file of a document, and the formulas in it."""

    name: str
    text: str
    lines: Lines
    formulas: list[Formula] = field(default_factory=list)


def read_source(
    text: str, format: str = ".tex", name: str = "", folder: Path | None = None
) -> list[SourceRelation]:
    """The relations of a document given as text.

    Args:
        text: the whole text.
        format: the ending of its file name: ``.tex``, ``.md``, ``.ipynb``, ``.rst``, ``.lean``.
        name: a name for it.
        folder: where included files are; without one they are not read.
    """
    return _relations_of(list(_Loader(folder).loaded(text, format, name, {}, ())))


def read_file(path: str | Path) -> list[SourceRelation]:
    """The relations of a document in a file, and in the files beside it that it includes.

    Args:
        path: a file; its ending tells the format.

    Raises:
        StoreError: for a file that is missing, no text or too large.
        ParseError: for a damaged notebook.
    """
    path = Path(path)
    return read_source(_text_of(path), path.suffix.lower(), str(path), path.parent)


def read_documents(paths: Iterable[str | Path]) -> Iterator[list[SourceRelation] | PolhodeError]:
    """The relations of several documents, or why one cannot be read, in the order given.

    Of a file that another of them includes, nothing is given a second time.
    """
    included: set[Path] = set()
    waiting = [Path(path) for path in paths]
    outcomes: dict[int, list[_File] | PolhodeError] = {}
    for number, path in enumerate(waiting):
        loader = _Loader(path.parent)
        try:
            files = loader.loaded(_text_of(path), path.suffix.lower(), str(path), {}, ())
            outcomes[number] = list(files)
        except PolhodeError as error:
            outcomes[number] = error
        included |= loader.included
    for number, path in enumerate(waiting):
        outcome = outcomes.pop(number)
        if isinstance(outcome, PolhodeError):
            yield outcome
        else:
            yield [] if path.resolve() in included else _relations_of(outcome)


def _relations_of(files: list[_File]) -> list[SourceRelation]:
    stops = punctuation(f.text.text for file in files for f in file.formulas)
    return [
        relation
        for file in files
        for formula in file.formulas
        for relation in _FormulaReader(file, formula, stops).relations()
    ]


def _text_of(path: Path) -> str:
    try:
        if path.is_dir():
            raise StoreError(f"{path} is a folder", expected="a file")
        if path.stat().st_size > 4 * LARGEST:
            raise StoreError(f"{path} is larger than {LARGEST} characters", expected="a document")
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise StoreError(
            f"{path} cannot be read: {error.strerror}", expected="a file"
        ) from error
    except UnicodeDecodeError as error:
        raise StoreError(
            f"{path} is not UTF-8: byte {error.start + 1} is {error.object[error.start]:#04x}",
            expected="a text file in UTF-8",
            advice="convert it with iconv -f latin1 -t utf-8",
        ) from error
    return text.replace("\r\n", "\n").replace("\r", "\n")


class _Loader:
    """Reads the files of one document, each within the folder of the first."""

    def __init__(self, folder: Path | None) -> None:
        self._folder = folder
        self.included: set[Path] = set()

    def loaded(
        self, text: str, format: str, name: str, macros: dict[str, Macro], open_: tuple[Path, ...]
    ) -> Iterator[_File]:
        """The file, in pieces where it includes others."""
        lines = Lines(text)
        piece = _File(name, text, lines)
        formulas = FORMATS.get(format, plain_formulas)
        for found in formulas(PlacedText.of(text), macros):
            if isinstance(found, Formula):
                piece.formulas.append(found)
                continue
            included = self._beside(found, open_)
            if included is not None:
                yield piece
                piece = _File(name, text, lines)
                shown = str(Path(name).parent / included.relative_to(self._folder.resolve()))
                yield from self.loaded(
                    _text_of(included), ".tex", shown, macros, (*open_, included)
                )
        yield piece

    def _beside(self, inclusion: Inclusion, open_: tuple[Path, ...]) -> Path | None:
        """The included file, if there is one within the folder that is not being read already."""
        if self._folder is None or len(self.included) >= MOST_FILES:
            return None
        folder = self._folder.resolve()
        for name in (inclusion.name, f"{inclusion.name}.tex"):
            try:
                path = (folder / name).resolve()
                if path.is_file() and path.is_relative_to(folder) and path not in open_:
                    self.included.add(path)
                    return path
            except (OSError, ValueError):
                return None
        return None


class _FormulaReader:
    """Reads the relations of one formula of a file."""

    def __init__(self, file: _File, formula: Formula, stops: frozenset[str]) -> None:
        self._file = file
        self._formula = formula
        self._stops = stops

    def relations(self) -> Iterator[SourceRelation]:
        formula = self._formula
        if not formula.text.text.strip():
            return
        try:
            text = without_layout(expanded(formula.text, formula.macros))
        except ParseError as error:
            yield self._unread(formula.text, str(error))
            return
        if formula.problem:
            if is_relation(text.text):
                yield self._unread(formula.text, formula.problem)
            return
        if not is_relation(text.text):
            return
        found = self._read(text)
        if found is not None:
            yield from found
            return
        for row in relations(text):
            if is_relation(row.text):
                yield from self._of_row(row)

    def _of_row(self, row: PlacedText) -> Iterator[SourceRelation]:
        found = self._read(row)
        pieces = [part for part in parts(row) if is_relation(part.text)]
        if found is None and len(pieces) > 1:
            for part in pieces:
                yield from self._read(part) or [self._failed(part)]
        else:
            yield from found if found is not None else [self._failed(row)]

    def _read(self, text: PlacedText) -> list[SourceRelation] | None:
        """The relations of a statement; None if it cannot be read."""
        try:
            stand_ins, statement = self._statement(text)
        except ParseError:
            return None
        stated = (*statement.relations, *statement.conditions, *statement.assumptions)
        return [
            self._relation(stand_ins, relation) for relation in stated if relation.is_claim
        ]

    def _statement(self, text: PlacedText) -> tuple[StandIns, Statement]:
        stand_ins = with_stand_ins(text, self._stops)
        return stand_ins, read_latex(stand_ins.formula.text)

    def _relation(self, stand_ins: StandIns, relation: Relation) -> SourceRelation:
        part = stand_ins.formula[slice(*relation.span)]
        printed = stand_ins.restored(write_latex(relation))
        return self._placed(part, relation, printed, "", tuple(stand_ins.printed.values()))

    def _failed(self, text: PlacedText) -> SourceRelation:
        try:
            self._statement(text)
        except ParseError as error:
            return self._unread(text, str(error))
        return self._unread(text, "no relation in it")

    def _unread(self, text: PlacedText, why: str) -> SourceRelation:
        return self._placed(text, None, "", " ".join(why.split()))

    def _placed(
        self,
        text: PlacedText,
        relation: Relation | None,
        printed: str,
        why: str,
        undefined: Sequence[str] = (),
    ) -> SourceRelation:
        start, latex = self._source_of(text)
        line, column = self._file.lines.place(start)
        outside = beyond(text.text, self._formula.heading)
        return SourceRelation(
            self._file.name,
            line,
            column,
            latex,
            relation,
            printed,
            f"out of scope: {outside}" if outside else why,
            not outside,
            self._formula.is_display,
            tuple(undefined),
        )

    def _source_of(self, text: PlacedText) -> tuple[int, str]:
        """Where a part of the formula begins in the file, and what stands there."""
        text = text.stripped()
        source = self._formula.text
        places = list(source.places)
        first = min(text.places, default=source.end)
        start, stop = bisect_left(places, first), bisect_left(places, text.end)
        while start and source.text[start:stop].count("}") > source.text[start:stop].count("{"):
            start -= 1
        found = source[start:stop].stripped()
        return (found.places[0] if len(found) else first), found.text.rstrip("\\ \n\t&,.;")

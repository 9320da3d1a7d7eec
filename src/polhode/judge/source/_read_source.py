"""Documents read: every relation with its place, what was read, and whether it is mechanics."""

from __future__ import annotations

import re
from bisect import bisect_left
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from polhode.base import ParseError, PolhodeError, StoreError, read_at_most
from polhode.judge.latex import (
    Statement,
    UnclearSlashError,
    read_latex,
    slash_readings,
    write_latex,
)
from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._tree import Relation
from polhode.judge.source._formats import FORMATS, plain_formulas
from polhode.judge.source._macros import Macro, Macros, expanded
from polhode.judge.source._ordinary import ordinary
from polhode.judge.source._placed import Lines, PlacedText
from polhode.judge.source._rows import (
    is_fragment,
    parts,
    relations,
    without_layout,
    without_membership,
)
from polhode.judge.source._scan import SourceFormula
from polhode.judge.source._scope import beyond
from polhode.judge.source._signs import is_relation, signs
from polhode.judge.source._standard import PACKAGE_MACROS
from polhode.judge.source._systems import without_systems
from polhode.judge.source._undefined import StandIns, Undefined, undefined, with_stand_ins

LARGEST = 50_000_000  # bytes of a file
MOST_FILES = 500  # that one document may include
MOST_FORMULAS = 20_000  # of a file

_NO_TEXTS = (b"%PDF", b"PK\x03\x04", b"\xd0\xcf\x11\xe0", b"\x1f\x8b")  # begin such files

_COUNTED = re.compile(r" at character [0-9]+")  # of the expanded formula, which nobody sees
_ROW_END = re.compile(r"\\\\(?:\[[^\]]*\])?|\\q?quad(?![A-Za-z])")
_BOLD_RELATION = re.compile(r"\\(?:mathbf|boldsymbol|bm|bf)\s*\{[^{}=]+=")
_OPENER = re.compile(rf"\\(?:left|[bB]igg?l?|qty|{'|'.join(lexicon.REWRITTEN)})\*?\s*\Z")
_PUNCTUATION = re.compile(r"(?:[\s&,;]|(?<!\\right)\.|\\\\|\\[,;:! ])+\Z")


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
        headings: those above it, outermost first.
        before: the words of its paragraph before it; what stands between it and the relation
            before it, where both are in one formula.
        after: the words of its paragraph behind it.
        is_condition: whether it restricts the relations of its formula, as after "if".
        under: the conditions that its formula states for it, as LaTeX.
        ways: where it was not read for a slash that may divide by more or less, the relation in
            each of these readings.
        macros: those that the text has defined up to there, which the words around it may use.
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
    headings: tuple[str, ...] = ()
    before: str = ""
    after: str = ""
    is_condition: bool = False
    under: tuple[str, ...] = ()
    ways: tuple[SourceRelation, ...] = ()
    macros: Macros = field(default_factory=dict, repr=False, compare=False)

    def spelled_out(self, latex: str) -> str:
        """A formula in the words around it, with the macros of the text expanded."""
        with suppress(ParseError):
            return expanded(PlacedText.of(latex), self.macros).text
        return latex

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
    lines: Lines
    formulas: list[SourceFormula] = field(default_factory=list)


def read_source(
    text: str, format: str = ".tex", name: str = "", folder: Path | None = None
) -> list[SourceRelation]:
    """The relations of a document given as text.

    Args:
        text: the whole text.
        format: the ending of its file name: ``.tex``, ``.md``, ``.ipynb``, ``.rst``, ``.lean``,
            ``.typ``.
        name: a name for it.
        folder: where included files are; without one they are not read.
    """
    return list(read_text(text, format, name, folder).relations)


def read_text(
    text: str, format: str = ".tex", name: str = "", folder: Path | None = None
) -> DocumentRead:
    """What reading a document given as text gives; arguments as for `read_source`."""
    loader = _Loader(Path(name), folder)
    loader.load(text, format, name)
    return loader.document()


def read_file(path: str | Path) -> list[SourceRelation]:
    """The relations of a document in a file, and in the files beside it that it includes.

    Args:
        path: a file; its ending tells the format.

    Raises:
        StoreError: for a file that is missing, no text or too large.
        ParseError: for a damaged notebook.
    """
    (document,) = read_documents([path])
    if document.is_damaged:
        raise document.refused[0]
    return list(document.relations)


@dataclass(frozen=True)
class DocumentRead:
    """What reading one document gave.

    Args:
        path: its file.
        relations: in order, with those of the files that it includes.
        refused: why it, or a file that it includes, was not read.
        texts: of it and the files that it includes, by their names.
    """

    path: Path
    relations: tuple[SourceRelation, ...]
    refused: tuple[PolhodeError, ...] = ()
    texts: Mapping[str, str] = field(default_factory=dict, repr=False)

    @property
    def is_damaged(self) -> bool:
        """Whether the file itself could not be read."""
        return bool(self.refused) and not self.texts


def read_documents(paths: Iterable[str | Path]) -> Iterator[DocumentRead]:
    """The relations of several documents, in the order given; one that is damaged stops no other.

    A file that another of them includes is read there, and not a second time.
    """
    loaders = [_Loader.of(Path(path)) for path in paths]
    included = {path for loader in loaders for path in loader.included}
    for loader in loaders:
        document = loader.document()
        is_part = bool(document.relations) and loader.path.resolve() in included
        yield replace(document, relations=()) if is_part else document


def _relations_of(files: Sequence[_File]) -> list[SourceRelation]:
    own = undefined(text for file in files for f in file.formulas for text in _texts(f))
    found: list[SourceRelation] = []
    for file in files:
        left = ""
        for formula in file.formulas:
            read = list(_FormulaReader(file, formula, own, left).relations())
            found += read
            if formula.is_display:
                left = _left_side(read)
    return found


def _left_side(relations: Sequence[SourceRelation]) -> str:
    """The left side of the last relation of a display, which the next may go on with, as LaTeX."""
    printed = relations[-1].printed if relations else ""
    place = next(signs(printed), 0)
    return printed[:place]


def _texts(formula: SourceFormula) -> Iterator[str]:
    with suppress(ParseError):
        yield expanded(formula.text, formula.macros).text


def _text_of(path: Path) -> str:
    try:
        if path.is_dir():
            raise StoreError(f"{path} is a folder", expected="a file")
        content = read_at_most(path, LARGEST + 1)
        if content.startswith(_NO_TEXTS):
            raise StoreError(
                f"{path} is a PDF, an archive or a document of an office program",
                expected="the source of a text: LaTeX, Markdown, a notebook or Typst",
            )
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        encoding = "utf-16" if error.object.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) else "latin1"
        raise StoreError(
            f"{path} is not UTF-8: byte {error.start + 1} is {error.object[error.start]:#04x}",
            expected="a text file in UTF-8",
            advice=f"convert it, for instance with iconv -f {encoding} -t utf-8",
        ) from error
    except (OSError, ValueError) as error:  # the latter for a name with a null byte
        why = error.strerror if isinstance(error, OSError) else error
        raise StoreError(f"{path} cannot be read: {why}", expected="a file") from error
    if len(content) > LARGEST:
        raise StoreError(f"{path} is larger than {LARGEST} bytes", expected="a document")
    return text.replace("\r\n", "\n").replace("\r", "\n")


class _Loader:
    """Reads the files of one document, each within the folder of the first."""

    def __init__(self, path: Path, folder: Path | None) -> None:
        self.path = path
        self._folder = folder.resolve() if folder is not None else None
        self.files: list[_File] = []
        self.included: set[Path] = set()
        self.refused: list[PolhodeError] = []

    @classmethod
    def of(cls, path: Path) -> _Loader:
        """With all files of the document that begins with this one."""
        loader = cls(path, path.parent)
        try:
            loader.load(_text_of(path), path.suffix.lower(), str(path), (path.resolve(),))
        except ParseError as error:
            given = f"{path}: {error.given}"
            loader.refused = [ParseError(given, expected=error.expected, advice=error.advice)]
            loader.files.clear()
        except StoreError as error:
            loader.refused.append(error)
        return loader

    def document(self) -> DocumentRead:
        """All that was read."""
        texts = {file.name: file.lines.text for file in self.files}
        relations = tuple(_relations_of(self.files))
        return DocumentRead(self.path, relations, tuple(self.refused), texts)

    def load(
        self,
        text: str,
        format: str,
        name: str,
        open_: tuple[Path, ...] = (),
        macros: dict[str, Macro] | None = None,
    ) -> None:
        """Take in a text, in pieces where it includes others.

        Args:
            text: the whole text.
            format: the ending of its file name.
            name: a name for it.
            open_: the files that include one another down to this one.
            macros: those known before it begins; it adds its own.
        """
        macros = dict(PACKAGE_MACROS) if macros is None else macros
        piece = _File(name, Lines(text))
        self.files.append(piece)
        formulas = FORMATS.get(format, plain_formulas)
        for found in formulas(PlacedText.of(text), macros):
            if isinstance(found, SourceFormula):
                piece.formulas.append(found)
                if len(piece.formulas) >= MOST_FORMULAS:
                    what = f"{name}: more than {MOST_FORMULAS} formulas; the others were not read"
                    self.refused.append(ParseError(what, advice="give it in several files"))
                    return
                continue
            try:
                self._include(found.name, macros, open_)
            except PolhodeError as error:
                line, _ = piece.lines.place(found.place)
                where = f"{name}:{line}" if name else f"line {line}"
                what = f"{where} includes {found.name}, {error.given}; what it holds was not read"
                self.refused.append(ParseError(what, advice=error.advice))
            piece = _File(name, piece.lines)
            self.files.append(piece)

    def _include(self, name: str, macros: dict[str, Macro], open_: tuple[Path, ...]) -> None:
        """Take in a file named from the folder of the document, or of the file that includes it.

        Raises:
            PolhodeError: for one that is missing, outside the folder, open already, or no text.
        """
        if self._folder is None:
            raise ParseError("a file that is not at hand")
        folders = [self._folder, *(path.parent for path in open_[-1:])]
        try:
            places = (folder / f"{name}{end}" for folder in folders for end in ("", ".tex"))
            path = next((place.resolve() for place in places if place.is_file()), None)
        except (OSError, ValueError):  # no name of a file
            path = None
        if path is None:
            raise ParseError("a file that is not there")
        if not path.is_relative_to(self._folder):
            raise ParseError(f"outside the folder of {self.path}")
        if path in open_:
            raise ParseError("which includes itself")
        if len(self.included) >= MOST_FILES:
            raise ParseError(f"after {MOST_FILES} other files")
        self.included.add(path)
        shown = str(self.path.parent / path.relative_to(self._folder))
        self.load(_text_of(path), ".tex", shown, (*open_, path), macros)


def _restored(error: ParseError, stand_ins: StandIns) -> ParseError:
    """An error of the reader in the letters of the text, with what stands near its place."""
    given = _COUNTED.sub("", stand_ins.restored(error.given))
    near = [line for line in error.advice.splitlines()[1:2] if line.strip()]
    advice = f"near {' '.join(stand_ins.restored(near[0]).split())}" if near else error.advice
    return ParseError(given, expected=error.expected, advice=advice)


def _claims_in(statement: Statement) -> dict[Relation, str]:
    """The relations in a statement and in its conditions, each with its LaTeX."""
    stated = (*statement.relations, *statement.conditions, *statement.assumptions)
    return {relation: write_latex(relation) for relation in stated if relation.is_claim}


class _FormulaReader:
    """Reads the relations of one formula of a file."""

    def __init__(self, file: _File, formula: SourceFormula, own: Undefined, left: str = "") -> None:
        self._file = file
        self._formula = formula
        self._own = own
        self._left = left  # side of the display before

    def relations(self) -> Iterator[SourceRelation]:
        formula = self._formula
        if not formula.text.text.strip():
            return
        try:
            text = ordinary(expanded(formula.text, formula.macros))
            text = without_systems(without_layout(text))
        except ParseError as error:
            yield self._unread(formula.text, str(error))
            return
        if formula.problem:
            if is_relation(text.text):
                yield self._unread(formula.text, formula.problem)
            return
        if formula.is_display and _BOLD_RELATION.search(text.text):
            yield self._unread(text, "a relation within the braces that set it in bold")
            return
        if not is_relation(text.text) or (not formula.is_display and is_fragment(text.text)):
            return
        text = self._continued(text)
        found = self._read(text)
        if found is not None:
            yield from found
            return
        for row in relations(text):
            if is_relation(row.text):
                yield from self._of_row(row)

    def _continued(self, text: PlacedText) -> PlacedText:
        """A display that begins with a sign, behind the left side of the one before it."""
        start = text.stripped()
        if not self._left or next(signs(start.text), None) != 0:
            return text
        place = start.places[0]
        return PlacedText.joined([PlacedText.at(f"{self._left} ", place, place), start])

    def _of_row(self, row: PlacedText) -> Iterator[SourceRelation]:
        found = self._read(row)
        if found is not None:
            yield from found
            return
        for part in [part for part in parts(row) if is_relation(part.text)] or [row]:
            yield from self._of_part(part)

    def _of_part(self, part: PlacedText) -> Iterator[SourceRelation]:
        shorter = without_membership(part)
        found = self._read(part)
        if found is None and shorter is not None:
            found = self._read(shorter)
        yield from [self._failed(part)] if found is None else found

    def _read(self, text: PlacedText) -> list[SourceRelation] | None:
        """The relations of a statement; None if it cannot be read."""
        try:
            return self._stated(text)
        except ParseError:
            return None

    def _stated(self, text: PlacedText) -> list[SourceRelation]:
        """The relations of a statement.

        Raises:
            ParseError: where it cannot be read.
        """
        stand_ins = with_stand_ins(text, self._own)
        try:
            statement = read_latex(stand_ins.formula.text)
        except ParseError as error:
            raise _restored(error, stand_ins) from error
        found = _claims_in(statement)
        stand_ins.refuse_loss(found.values())
        conditions = (*statement.conditions, *statement.assumptions)
        under = tuple(stand_ins.restored(found[c]) for c in conditions if c in found)
        placed = (
            self._placed(
                stand_ins.formula[slice(*relation.span)],
                relation,
                stand_ins.restored(written),
                "",
                stand_ins.macros_in(written),
            )
            for relation, written in found.items()
        )
        return [
            replace(p, is_condition=True) if p.relation in conditions else replace(p, under=under)
            for p in placed
        ]

    def _failed(self, text: PlacedText) -> SourceRelation:
        try:
            self._stated(text)
        except ParseError as error:
            unread = self._unread(text, str(error))
            if isinstance(error.__cause__, UnclearSlashError):
                return replace(unread, ways=tuple(self._in_every_way(text, unread)))
            return unread
        return self._unread(text, "no relation in it")

    def _in_every_way(self, text: PlacedText, unread: SourceRelation) -> Iterator[SourceRelation]:
        """A relation in every reading of its slashes; nothing beside conditions or others."""
        with suppress(ParseError):
            for way, statement in slash_readings(text.text).items():
                claims = _claims_in(statement)
                if len(claims) > 1:
                    return
                for relation in claims:
                    yield replace(
                        unread, relation=relation, printed=way[slice(*relation.span)], why=""
                    )

    def _unread(self, text: PlacedText, why: str) -> SourceRelation:
        return self._placed(text, None, "", " ".join(why.split()))

    def _placed(
        self,
        text: PlacedText,
        relation: Relation | None,
        printed: str,
        why: str,
        undefined: tuple[str, ...] = (),
    ) -> SourceRelation:
        start, latex = self._source_of(text)
        line, column = self._file.lines.place(start)
        before = self._before(start)
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
            undefined,
            self._formula.heading,
            before,
            self._formula.after,
            macros=self._formula.macros,
        )

    def _before(self, start: int) -> str:
        """The words before a relation that begins here: within its formula, or before that."""
        source = self._formula.text
        inside = source.text[: bisect_left(list(source.places), start)]
        earlier = [match.end() for match in _ROW_END.finditer(inside)]
        return inside[earlier[-1] :] if earlier else f"{self._formula.before} {inside}"

    def _source_of(self, text: PlacedText) -> tuple[int, str]:
        """Where a part of the formula begins in the file, and what stands there.

        Braces that open or close outside of what was read belong to it.
        """
        text = text.stripped()
        source = self._formula.text
        places = list(source.places)
        first = min(text.places, default=source.end)
        start, stop = bisect_left(places, first), bisect_left(places, text.end)
        while start and _open_braces(source.text[start:stop]) < 0:
            start -= 1
        if before := _OPENER.search(
            source.text[:start] if source.text[start : start + 1] in "{([|" else ""
        ):
            start = before.start()
        while stop < len(places) and _open_braces(source.text[start:stop]) > 0:
            stop += 1
        found = source[start:stop].stripped()
        return (found.places[0] if len(found) else first), _PUNCTUATION.sub("", found.text)


def _open_braces(latex: str) -> int:
    return latex.count("{") - latex.count("}")

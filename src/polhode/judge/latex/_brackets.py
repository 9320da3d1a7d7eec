"""Pairing of brackets, and removal of marks that only set the layout of a formula.

Afterwards a line break, a column mark or a wide space stands only where it separates one statement
or entry from the next: between the rows of a display, of a column or of cases, never inside a
bracket.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from polhode.base import ParseError
from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._tokens import Token, refusal

DEEPEST = 60  # levels of nesting; each takes some eight of the thousand calls Python allows

CLOSERS = {
    "(": ")",
    "[": "]",
    "\\{": "\\}",
    "{": "}",
    "bar(": "bar)",
    "null(": "null)",
}
_SHOWN = {"bar(": "\\left|", "bar)": "\\right|", "null(": "\\left.", "null)": "\\right."}
_ENDS = frozenset(CLOSERS.values())
#: Number of arguments that a token takes.
_ARGUMENTS = {"dots": 1, "decoration": 1, "alphabet": 1, "root": 1, "rate": 1, "brace": 1} | {
    "fraction": 2,
    "derivative": 3,
}


@dataclass(frozen=True)
class Paired:
    """Tokens, with the position of the closing token for that of each opening one."""

    tokens: tuple[Token, ...]
    partner: dict[int, int]

    @property
    def around_relations(self) -> frozenset[int]:
        """Positions of the round brackets that contain a relation, such as (θ < π/2)."""
        return frozenset(
            around
            for token, around in _within(self.tokens)
            if token.kind == "sign" and around >= 0 and self.tokens[around].is_mark("(")
        )


def paired(source: str, tokens: Sequence[Token]) -> Paired:
    """The tokens that carry meaning, with their brackets paired.

    Raises:
        ParseError: for a bracket without its partner, and for brackets nested too deeply.
    """
    joined = _joined_rows(tokens)
    listed = _without_braces_around_systems(joined, _partners(source, joined))
    flowing = _without_layouts(listed, _partners(source, listed))
    printed = _without_bare_braces(flowing, _partners(source, flowing))
    kept = _without_breaks_in_brackets(printed)
    return Paired(tuple(kept), _partners(source, kept))


def opens(token: Token) -> bool:
    """Whether a token opens a bracket, a group or an environment."""
    return token.kind == "begin" or (token.kind == "mark" and token.text in CLOSERS)


def closes(token: Token) -> bool:
    """Whether a token closes a bracket, a group or an environment."""
    return token.kind == "end" or (token.kind == "mark" and token.text in _ENDS)


def _partners(source: str, tokens: Sequence[Token]) -> dict[int, int]:
    partner: dict[int, int] = {}
    unclosed: list[int] = []
    for place, token in enumerate(tokens):
        if opens(token):
            unclosed.append(place)
            if len(unclosed) > DEEPEST:
                problem = f"brackets nested more than {DEEPEST} deep"
                raise refusal(source, token.span, problem, "a formula with less nesting")
        elif closes(token):
            if not unclosed or not _match(tokens[unclosed[-1]], token):
                raise _unmatched(source, [tokens[place] for place in unclosed], token)
            partner[unclosed.pop()] = place
    if unclosed:
        opener = tokens[unclosed[-1]]
        problem = f"{shown(opener)} is never closed"
        raise refusal(source, opener.span, problem, "brackets in pairs")
    return partner


def _match(opener: Token, closer: Token) -> bool:
    if "begin" in (opener.kind, closer.kind) or "end" in (opener.kind, closer.kind):
        return (opener.kind, closer.kind, opener.text) == ("begin", "end", closer.text)
    if opener.text == "{" or closer.text == "}":
        return CLOSERS[opener.text] == closer.text
    # \left. and \right. close any bracket, as in \left. x \right|.
    return CLOSERS[opener.text] == closer.text or "null" in opener.text + closer.text


def _unmatched(source: str, unclosed: Sequence[Token], closer: Token) -> ParseError:
    if not unclosed:
        return refusal(source, closer.span, f"{shown(closer)} closes nothing", "an opening bracket")
    opener = unclosed[-1]
    problem = f"{shown(opener)} at character {opener.span[0] + 1} closed by {shown(closer)}"
    return refusal(source, closer.span, problem, "brackets in pairs")


def shown(token: Token) -> str:
    """A bracket as it is written."""
    if token.kind in ("begin", "end"):
        return f"\\{token.kind}{{{token.text}}}"
    return _SHOWN.get(token.text, token.text)


def _joined_rows(tokens: Sequence[Token]) -> list[Token]:
    r"""Rows of one bracket joined: without each ``\right. \\ \left.`` between them."""
    joined: list[Token] = []
    for token in tokens:
        kept = len(joined)
        while token.is_mark("null(") and kept:  # look back past breaks for the \right.
            if joined[kept - 1].kind != "row" and not joined[kept - 1].is_mark("&"):
                break
            kept -= 1
        if 0 < kept < len(joined) and joined[kept - 1].is_mark("null)"):
            del joined[kept - 1 :]
        else:
            joined.append(token)
    return joined


def _without_braces_around_systems(tokens: Sequence[Token], partner: dict[int, int]) -> list[Token]:
    r"""The tokens without the brace beside equations that belong together, one in each row.

    Such as ``\begin{cases} x = 1 \\ y = 2 \end{cases}``, or aligned rows up to a ``\right\}``;
    behind a relation sign, cases are the values of one quantity.
    """
    dropped: set[int] = set()
    for place, token in enumerate(tokens):
        if place in dropped or not _begins_statement(tokens, place):
            continue
        edges = {place, partner.get(place, place)}
        if _is_brace_of_system(token, tokens[partner.get(place, place)]):
            inner = place + 1
            if tokens[inner].kind == "begin" and partner[inner] == partner[place] - 1:
                edges |= {inner, partner[inner]}
        elif token.kind != "begin" or token.text not in lexicon.CASES:
            continue
        if _states_relations(tokens, partner, place):
            dropped |= edges
    return [token for place, token in enumerate(tokens) if place not in dropped]


def _begins_statement(tokens: Sequence[Token], place: int) -> bool:
    before = tokens[place - 1] if place else None
    if before is None or before.kind in ("row", "gap", "arrow", "words"):
        return True
    return before.is_mark("&", ",", ";", ".") or before.text in lexicon.LAYOUTS


def _is_brace_of_system(opener: Token, closer: Token) -> bool:
    return (opener.is_mark("\\{") and closer.is_mark("null)")) or (
        opener.is_mark("null(") and closer.is_mark("\\}")
    )


def _states_relations(tokens: Sequence[Token], partner: dict[int, int], place: int) -> bool:
    """Whether each row inside states something: a sign in its first column, or before a second."""
    end = partner[place]
    if tokens[place + 1].kind == "begin" and partner[place + 1] == end - 1:
        place, end = place + 1, end - 1
    states, is_first, count = False, True, 0
    place += 1
    while place < end:
        token = tokens[place]
        if token.kind == "row":
            if not states and place + 1 < end:
                return False
            count += states
            states, is_first = False, True
        elif token.is_mark("&"):
            is_first = False
        elif token.kind == "sign":
            states = states or is_first or tokens[place - 1].is_mark("&")
        place = partner.get(place, place) + 1
    return states or count > 0


def _without_layouts(tokens: Sequence[Token], partner: dict[int, int]) -> list[Token]:
    """The tokens without environments that only set a display.

    An array is one of these unless it stands in brackets, where it is a column or a matrix.
    """
    dropped: set[int] = set()
    end_of_bracket = 0
    for place, token in enumerate(tokens):
        is_layout = token.text in lexicon.LAYOUTS or (
            token.text == "array" and place >= end_of_bracket
        )
        if token.kind == "begin" and is_layout:
            dropped |= {place, partner[place]}
        elif place in partner:
            end_of_bracket = max(end_of_bracket, partner[place])
    return [token for place, token in enumerate(tokens) if place not in dropped]


def _without_bare_braces(tokens: Sequence[Token], partner: dict[int, int]) -> list[Token]:
    r"""The tokens without braces that print nothing: those with no argument and no ``\over``."""
    dropped: set[int] = set()
    overs = {around for token, around in _within(tokens) if token.is_mark("over")}
    pending = [0]  # arguments still expected, for each open bracket
    for place, token in enumerate(tokens):
        if place in dropped:
            continue
        if closes(token):
            pending.pop()
            continue
        is_argument = (
            pending[-1] > 0
            or (place > 0 and tokens[place - 1].kind == "function")
            or _is_labelled_again(tokens, partner, place)
        )
        if token.is_mark("{") and not is_argument and place not in overs:
            dropped |= {place, partner[place]}
            continue
        arguments = 1 if token.is_mark("^", "_") else _ARGUMENTS.get(token.kind, 0)
        pending[-1] = max(0, pending[-1] - 1) + arguments
        if opens(token):
            pending.append(0)
    return [token for place, token in enumerate(tokens) if place not in dropped]


def _is_labelled_again(tokens: Sequence[Token], partner: dict[int, int], place: int) -> bool:
    """Whether braces hold a letter with its label, and another label follows: ``{I_T}_{xx}``."""
    if not tokens[place].is_mark("{"):
        return False
    end = partner[place]
    again = end + 1 < len(tokens) and tokens[end + 1].is_mark("_", "^")
    return again and any(token.is_mark(tokens[end + 1].text) for token in tokens[place:end])


def _without_breaks_in_brackets(tokens: Sequence[Token]) -> list[Token]:
    """The tokens without breaks inside brackets; an environment keeps its rows."""

    def is_kept(token: Token, around: int) -> bool:
        is_break = token.kind in ("row", "gap") or token.is_mark("&")
        is_row = around < 0 or (tokens[around].kind == "begin" and token.kind != "gap")
        return is_row or not is_break

    return [token for token, around in _within(tokens) if is_kept(token, around)]


def _within(tokens: Sequence[Token]) -> Iterator[tuple[Token, int]]:
    """Each token, and where the innermost bracket around it opens; -1 outside of all."""
    around = [-1]
    for place, token in enumerate(tokens):
        if closes(token):
            around.pop()
        yield token, around[-1]
        if opens(token):
            around.append(place)

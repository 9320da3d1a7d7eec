r"""Macros that a text defines with ``\newcommand``, ``\def`` and the like, and their expansion."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial

from polhode.base import ParseError
from polhode.judge.source._placed import PlacedText

LONGEST = 20_000  # characters of a formula with all macros expanded
MOST = 5_000  # expansions in one formula

CONTROL = re.compile(r"\\(?:[A-Za-z@]+|.)", re.DOTALL)
_SPACE = re.compile(r"\s*")
_BRACE = re.compile(r"\\.|[{}]", re.DOTALL)
_NEAR = 1000  # characters within which most arguments end
_NAME = re.compile(r"\s*(?:\{\s*(\\(?:[A-Za-z@]+|.))\s*\}|(\\(?:[A-Za-z@]+|.)))", re.DOTALL)
_COUNT = re.compile(r"\s*\[\s*([0-9])\s*\]")
_KIND = re.compile(r"(\+?m|[so]|O)(?:\{([^{}]*)\})?")
_KINDS = re.compile(rf"(?:{_KIND.pattern})*")
_STAR = re.compile(r"\s*\*")
_PARAMETERS = re.compile(r"(?:#[1-9])*")
_PARAMETER = re.compile(r"#([1-9])")
_NUMBERED = re.compile(r"([1-9])\s*=\s*((?:\{[^{}]*\}|[^,{}])*)")  # of xargs: [1=, 3=t]
_IF = re.compile(r"\\If(?:(No)?Value|Boolean)(TF|T|F)\s*\{\s*#([1-9])\s*\}")
_ENDS_IN_WORD = re.compile(r"\\[A-Za-z@]+\Z")

_COMMANDS = ("newcommand", "renewcommand", "providecommand", "DeclareRobustCommand")
_HOW = ("New", "Renew", "Provide", "Declare")
_BOX = re.compile(r"\\(?:sbox|resizebox|scalebox|usebox)(?![A-Za-z])")


@dataclass(frozen=True)
class Macro:
    """What stands for a macro: a body with ``#1`` to ``#9`` for its arguments.

    Args:
        body: its replacement.
        arguments: what each is: None for one in braces, "*" for a star that may be there, else the
            default in brackets of one in square brackets.
        problem: why it cannot be expanded; empty if it can.
    """

    body: str
    arguments: tuple[str | None, ...] = ()
    problem: str = ""


Macros = Mapping[str, Macro]


def definition(text: str, place: int, known: Macros) -> tuple[str, Macro, int] | None:
    r"""The definition that begins at a place: the macro's name, what it is, and where it ends.

    None where it is incomplete. Names are given with their backslash.
    """
    match = DEFINING.match(text, place)
    if match is None:
        return None
    name = _NAME.match(text, match.end())
    if name is None:
        return None
    return _READERS[match[1]](text, name[1] or name[2], name.end(), known)


_Found = tuple[str, Macro, int] | None


def _first(default: str) -> dict[int, str]:
    return {1: f"[{default}]"}


def _numbered(defaults: str) -> dict[int, str]:
    """Those of the package xargs, by the place of their arguments."""
    return {int(place): f"[{text.strip('{} ')}]" for place, text in _NUMBERED.findall(defaults)}


def _command(
    text: str,
    name: str,
    place: int,
    known: Macros,
    defaults: Callable[[str], dict[int, str]] = _first,
) -> _Found:
    count = _COUNT.match(text, place)
    place = count.end() if count else place
    default = _optional_span(text, place) if count else None
    body = argument(text, default[1] + 1 if default else place)
    if body is None:
        return None
    given = defaults(text[slice(*default)]) if default else {}
    arguments = [given.get(place) for place in range(1, int(count[1]) + 1 if count else 1)]
    # What measures a formula in a box, to make it smaller, says only where it stands.
    content = "#1" if arguments == [None] and _BOX.search(body[0]) else body[0]
    return name, Macro(content, tuple(arguments)), body[1]


def _document_command(text: str, name: str, place: int, known: Macros) -> _Found:
    signature = argument(text, place)
    body = argument(text, signature[1]) if signature else None
    if signature is None or body is None:
        return None
    kinds = "".join(signature[0].split())
    is_known = _KINDS.fullmatch(kinds) and r"\If" not in _IF.sub("", body[0])
    problem = "" if is_known else "arguments of \\NewDocumentCommand that are not read"
    arguments = {"m": None, "+m": None, "s": "*", "o": "[]"}
    taken = (arguments.get(k[0], f"[{k[1]}]") for k in _KIND.findall(kinds))
    return name, Macro(body[0], tuple(taken), problem), body[1]


def _operator(text: str, name: str, place: int, known: Macros) -> _Found:
    body = argument(text, place)
    return body and (name, Macro(rf"\operatorname{{{body[0]}}}"), body[1])


def _delimiters(text: str, name: str, place: int, known: Macros) -> _Found:
    r"""``\DeclarePairedDelimiter``, or with a number of arguments and a body the one with X."""
    count = _COUNT.match(text, place)
    left = argument(text, count.end() if count else place)
    right = argument(text, left[1]) if left else None
    body = right and (argument(text, right[1]) if count else ("#1", right[1]))
    if left is None or right is None or body is None:
        return None
    inside = _PARAMETER.sub(lambda match: f"#{int(match[1]) + 2}", body[0])
    inside = inside.replace(r"\delimsize", "")
    arguments = ("*", "[]", *[None] * (int(count[1]) if count else 1))
    return name, Macro(rf"\left{left[0]}{inside}\right{right[0]}", arguments), body[1]


def _def(text: str, name: str, place: int, known: Macros) -> _Found:
    brace = text.find("{", place)
    body = argument(text, brace) if brace >= 0 else None
    if body is None:
        return None
    pattern = text[place:brace].strip()
    is_plain = _PARAMETERS.fullmatch(pattern)
    problem = "" if is_plain else "arguments between delimiters"
    return name, Macro(body[0], (None,) * pattern.count("#"), problem), body[1]


def _let(text: str, name: str, place: int, known: Macros) -> _Found:
    match = re.compile(r"\s*=?\s*(\\(?:[A-Za-z@]+|.)|[^\s{}])", re.DOTALL).match(text, place)
    return match and (name, known.get(match[1], Macro(match[1])), match.end())


_READERS: dict[str, Callable[[str, str, int, Macros], _Found]] = {
    **dict.fromkeys(_COMMANDS, _command),
    **{f"{command}x": partial(_command, defaults=_numbered) for command in _COMMANDS},
    **{f"{how}DocumentCommand": _document_command for how in _HOW},
    "DeclareMathOperator": _operator,
    **dict.fromkeys(("DeclarePairedDelimiter", "DeclarePairedDelimiterX"), _delimiters),
    **dict.fromkeys(("def", "gdef", "edef"), _def),
    "let": _let,
}
DEFINING = re.compile(rf"\\({'|'.join(_READERS)})\b\*?")


# -- arguments -----------------------------------------------------------------------------------


def closing(text: str, place: int) -> int | None:
    """Where the brace that opens at a place is closed; None if it is not."""
    depth = 0
    for match in _BRACE.finditer(text, place, place + _NEAR):
        depth += (match[0] == "{") - (match[0] == "}")
        if depth == 0 and match[0] == "}":
            return match.start()
    return _far_closings(text).get(place)


@lru_cache(maxsize=4)
def _far_closings(text: str) -> dict[int, int]:
    """Where braces open and close, of those that do both: a text may have many that do not."""
    found: dict[int, int] = {}
    open_: list[int] = []
    for match in _BRACE.finditer(text):
        if match[0] == "{":
            open_.append(match.start())
        elif match[0] == "}" and open_:
            found[open_.pop()] = match.start()
    return found


def argument_span(text: str, place: int) -> tuple[int, int, int] | None:
    """Start and end of the argument behind a place, without braces, and where reading goes on."""
    match = _SPACE.match(text, place)
    place = match.end() if match else place
    if place >= len(text) or text[place] == "}":
        return None
    if text[place] == "{":
        end = closing(text, place)
        return None if end is None else (place + 1, end, end + 1)
    control = CONTROL.match(text, place)
    end = control.end() if control else place + 1
    return place, end, end


def argument(text: str, place: int) -> tuple[str, int] | None:
    """The argument behind a place, and where reading goes on."""
    span = argument_span(text, place)
    return span and (text[span[0] : span[1]], span[2])


def _optional_span(text: str, place: int) -> tuple[int, int] | None:
    """Start and end of the argument in square brackets behind a place, if there is one."""
    match = _SPACE.match(text, place)
    start = match.end() if match else place
    if text[start : start + 1] != "[":
        return None
    place = start + 1
    last = min(len(text), start + _NEAR)
    while place < last:
        if text[place] == "{":
            end = closing(text, place)
            if end is None:
                return None
            place = end
        elif text[place] == "\\":
            place += 1
        elif text[place] == "]":
            return start + 1, place
        place += 1
    return None


# -- expansion -----------------------------------------------------------------------------------


def expanded(formula: PlacedText, macros: Macros) -> PlacedText:
    """A formula with the macros of its text expanded.

    What a macro stands for keeps the place where the macro is used, and its arguments keep theirs.

    Raises:
        ParseError: for a macro that calls itself or grows too long, or lacks an argument.
    """
    if not macros:
        return formula
    done: list[PlacedText] = []
    waiting = [formula]  # the last one is next
    used = length = 0
    pending = len(formula)  # characters that wait
    while waiting:
        rest = waiting.pop()
        pending -= len(rest)
        found = _first_call(rest.text, macros)
        if found is None:
            _append(done, rest)
            length += len(rest)
        else:
            _append(done, rest[: found.start()])
            length += found.start()
            body, end = _replaced(rest, found[0], found.start(), macros[found[0]])
            waiting += [rest[end:], body]
            pending += len(rest) - end + len(body)
            used += 1
            if used > MOST or length + pending > LONGEST:
                raise ParseError(
                    f"the macro {found[0]}, which grows without end",
                    expected=f"at most {LONGEST} characters once all macros are expanded",
                    advice="look for a macro that calls itself",
                )
    return PlacedText.joined(done) if done else formula[:0]


def _append(done: list[PlacedText], part: PlacedText) -> None:
    """Add a part, with a space where a macro would otherwise run into a letter."""
    if not part.text:
        return
    if done and part.text[0].isalpha() and _ENDS_IN_WORD.search(done[-1].text):
        done.append(PlacedText.at(" ", part.places[0], part.places[0]))
    done.append(part)


def _first_call(text: str, macros: Macros) -> re.Match[str] | None:
    return next((match for match in CONTROL.finditer(text) if match[0] in macros), None)


def _replaced(rest: PlacedText, name: str, start: int, macro: Macro) -> tuple[PlacedText, int]:
    """What stands for a macro used at a place, and where the text goes on."""
    if macro.problem:
        raise ParseError(
            f"the macro {name}, defined with {macro.problem}",
            expected="a macro whose arguments are in braces",
        )
    place = start + len(name)
    given: list[PlacedText] = []
    present: list[bool] = []
    at = rest.places[start]
    for kind in macro.arguments:
        if kind == "*":
            star = _STAR.match(rest.text, place)
            place = star.end() if star else place
            given.append(PlacedText.at("", at, at))
            present.append(star is not None)
        elif kind is not None:
            span = _optional_span(rest.text, place)
            given.append(rest[slice(*span)] if span else PlacedText.at(kind[1:-1], at, at))
            place = span[1] + 1 if span else place
            present.append(span is not None)
        else:
            found = argument_span(rest.text, place)
            if found is None:
                raise ParseError(
                    f"the macro {name} with {len(given)} arguments",
                    expected=f"{len(macro.arguments)}, as it is defined",
                )
            given.append(rest[found[0] : found[1]])
            present.append(True)
            place = found[2]
    return _filled(_decided(macro.body, present), given, rest[start:place]), place


def _decided(body: str, present: Sequence[bool]) -> str:
    r"""The body with one branch of each ``\IfValueTF`` and the like."""
    while match := _IF.search(body):
        end, branches = match.end(), {}
        for branch in match[2]:
            span = argument_span(body, end) or (end, end, end)
            branches[branch], end = body[span[0] : span[1]], span[2]
        place = int(match[3]) - 1
        holds = (place < len(present) and present[place]) != (match[1] is not None)
        body = f"{body[: match.start()]}{branches.get('T' if holds else 'F', '')}{body[end:]}"
    return body


def _filled(body: str, given: list[PlacedText], call: PlacedText) -> PlacedText:
    """The body of a macro with the arguments that a call of it gives."""
    at, end = call.places[0], call.end
    parts: list[PlacedText] = []
    place = 0
    for match in _PARAMETER.finditer(body):
        _append(parts, PlacedText.at(body[place : match.start()], at, end))
        number = int(match[1])
        if number <= len(given):
            _append(parts, given[number - 1])
        place = match.end()
    _append(parts, PlacedText.at(body[place:], at, end))
    found = PlacedText.joined(parts)
    return PlacedText(found.text, found.places, end)

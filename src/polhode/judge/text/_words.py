"""The words of a document as HTML blocks: headings, paragraphs, items, and formulas among them.

LaTeX and Markdown are read as far as a reader needs them: what a command that is not known here
encloses is shown, and the command itself is left out.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from polhode.view import Markup, joined, tag

# Formulas stand in the text as their number between two characters of private use, which a text of
# its own cannot contain since they are taken out first.
_INLINE, _DISPLAY, _END = "\ue000", "\ue001", "\ue002"
_PLACE = re.compile(f"[{_INLINE}{_DISPLAY}]([0-9]+){_END}")
_DOLLARS = re.compile(rf"\$+(?=[{_INLINE}{_DISPLAY}])|(?<={_END})\$+")  # that delimit formulas
_PRIVATE = re.compile(f"[{_INLINE}{_DISPLAY}{_END}]")
# XML has no room for these, and browsers show a sign of replacement.
_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff\ufffe\uffff]")


@dataclass(frozen=True)
class TextBlock:
    """A block of a document.

    Attributes:
        kind: h2, h3, h4, p, li, or formula for one on lines of its own.
        html: its words; the formulas in it are marked by `formula_at`.
        number: of the formula, for that kind.
    """

    kind: str
    html: Markup
    number: int = -1


def formula_at(number: int, *, is_display: bool) -> str:
    """What stands for a formula in a text given to `blocks`."""
    return f"{_DISPLAY if is_display else _INLINE}{number}{_END}"


def without_marks(text: str) -> str:
    """A text without the characters that stand for formulas, and those no page can show."""
    return _CONTROL.sub("\ufffd", _PRIVATE.sub("\ufffd", text))


def with_formulas(html: Markup, formula: Callable[[int], Markup]) -> Markup:
    """Words with their formulas put in."""
    return Markup(_PLACE.sub(lambda found: formula(int(found[1])), html))


def blocks(text: str, format: str = ".tex") -> Iterator[TextBlock]:
    """The blocks of a text whose formulas are numbered places.

    Args:
        text: of words, with `formula_at` for the formulas.
        format: the ending of its file name.
    """
    is_tex = format in (".tex", ".ltx", ".latex")
    source = _DOLLARS.sub("", _body(text) if is_tex else text)
    if format == ".typ":
        source = _TYPST_CODE.sub("", source)
        source = _TYPST_HEADING.sub(lambda found: "#" * len(found[0]), source)
    begin, inline = (_TEX_BLOCK, _tex) if is_tex else (_MARKDOWN_BLOCK, _markdown)
    kind, behind = "p", 0
    for found in begin.finditer(source):
        if found.start() < behind:  # within a heading
            continue
        yield from _block(kind, inline(source[behind : found.start()]))
        kind, behind = "p", found.end()
        match found.lastgroup:
            case "display":
                yield TextBlock("formula", Markup(), int(found["display"][1:-1]))
            case "heading":
                words, behind = _heading(source, found.end() - 1)
                yield from _block(_HEADINGS.get(found["level"], "h4"), inline(words))
            case "title":
                yield from _block(f"h{min(len(found['hashes']) + 1, 4)}", inline(found["title"]))
            case "item":
                kind = "li"
    yield from _block(kind, inline(source[behind:]))


def _block(kind: str, html: Markup) -> Iterator[TextBlock]:
    if html.strip():
        yield TextBlock(kind, Markup(html.strip()))


# -- LaTeX -----------------------------------------------------------------------------------------

_DEEPEST = 20  # commands within one another whose type is shown
_BLANK_LINE = re.compile(r"\n[ \t]*\n")
_HEADINGS = {"part": "h2", "chapter": "h2", "section": "h2", "subsection": "h3"}
_TITLED = (
    "theorem|lemma|corollary|proposition|definition|remark|example|proof|exercise|problem|solution"
)
_TEX_BLOCK = re.compile(
    rf"(?P<display>{_DISPLAY}[0-9]+{_END})"
    r"|\\(?P<level>part|chapter|(?:sub)*section|(?:sub)?paragraph|title)\*?\s*(?P<heading>\{)"
    r"|(?P<item>\\item\b(?:\[[^\]\n]*\])?)"
    r"|(?P<blank>\n[ \t]*\n\s*|\\par\b"
    rf"|(?=\\begin\s*\{{(?:{_TITLED})\*?\}})|\\end\s*\{{(?:{_TITLED})\*?\}})"
)
_DEFINITION = re.compile(r"\\(?:(?:re|provide)?newcommand|DeclareMathOperator|def|newtheorem)\b\*?")
_NAME_OR_COUNT = re.compile(r"(?:\\[A-Za-z@]+|\[[^\]]*\]|#[0-9])*")
_TEX = re.compile(
    r"\\(?P<wrap>emph|textit|textsl|textbf|texttt)\s*\{"
    r"|\\(?P<refer>eq|auto|c|C|page)?ref\*?\s*\{(?P<label>[^{}]*)\}"
    r"|\\[a-z]*cite[a-z]*\*?(?:\[[^\]]*\])*\s*\{(?P<cited>[^{}]*)\}"
    rf"|\\begin\s*\{{(?P<titled>{_TITLED})\*?\}}(?:\[(?P<named>[^\]]*)\])?"
    r"|\\(?:label|index|vspace|hspace|begin|end|usepackage|bibliography|bibliographystyle|bibitem"
    r"|includegraphics)\*?\s*(?:\{[^{}]*\}|\[[^\]]*\])*"
    r"|\\(?P<accent>[\"'`^~=.]|[uvHcdbr](?![A-Za-z]))\s*\{?(?P<letter>\\?[A-Za-z])\}?"
    r"|\\(?P<sign>[%&_#${}])"
    r"|\\(?P<word>ss|ae|oe|o|l|AE|OE|O|L|ldots|dots|textdegree|S|LaTeX|TeX)(?![A-Za-z])\s?"
    r"|(?P<break>\\\\(?:\[[^\]]*\])?)"
    r"|\\(?:[A-Za-z@]+\*?|.)"
    r"|(?P<dash>---?)|(?P<quote>``|''|`)|(?P<space>~)|[{}$]",
    re.DOTALL,
)
_TAGS = {"emph": "em", "textit": "em", "textsl": "em", "textbf": "strong", "texttt": "code"}
_ACCENTS = {
    '"': "\u0308", "'": "\u0301", "`": "\u0300", "^": "\u0302", "~": "\u0303", "=": "\u0304",
    ".": "\u0307", "u": "\u0306", "v": "\u030c", "H": "\u030b", "c": "\u0327", "d": "\u0323",
    "b": "\u0331", "r": "\u030a",
}  # fmt: skip
_NAMED = {
    "ss": "ß", "ae": "æ", "oe": "œ", "o": "ø", "l": "ł", "AE": "Æ", "OE": "Œ", "O": "Ø", "L": "Ł",
    "ldots": "…", "dots": "…", "textdegree": "°", "S": "§", "LaTeX": "LaTeX", "TeX": "TeX",
}  # fmt: skip
_PLAIN = {"--": "–", "---": "—", "``": "“", "''": "”", "`": "‘", "~": "\u00a0"}


def _body(text: str) -> str:
    """What stands between the beginning and the end of the document, without definitions."""
    begin = re.search(r"\\begin\s*\{document\}", text)
    end = re.search(r"\\end\s*\{document\}", text)
    body = text[begin.end() if begin else 0 : end.start() if end else len(text)]
    parts, behind = [], 0
    for found in _DEFINITION.finditer(body):
        if found.start() >= behind:
            parts.append(body[behind : found.start()])
            behind = _behind_definition(body, found.end())
    return "".join([*parts, body[behind:]])


def _behind_definition(text: str, place: int) -> int:
    """Where a definition ends whose command ends at a place: its name, counts and braces."""
    while found := _NAME_OR_COUNT.match(text, place):
        place = found.end()
        if text[place : place + 1] != "{":
            return place
        _, place = _argument(text, place)
    return place


def _argument(text: str, place: int) -> tuple[str, int]:
    """What stands in the braces that open at a place, and where the text goes on."""
    depth, i = 0, place
    while i < len(text):
        if text[i] == "\\":
            i += 1
        elif text[i] in "{}":
            depth += 1 if text[i] == "{" else -1
            if depth == 0:
                return text[place + 1 : i], i + 1
        i += 1
    return text[place + 1 :], len(text)


def _heading(text: str, place: int) -> tuple[str, int]:
    """The words of a heading whose brace opens at a place, and where the text goes on.

    One that is not closed ends with its paragraph.
    """
    blank = _BLANK_LINE.search(text, place)
    words, length = _argument(text[place : blank.start() if blank else None], 0)
    return words, place + length


def _tex(text: str, depth: int = 0) -> Markup:
    """Words of a paragraph, within a number of commands."""
    parts: list[str] = []
    behind = 0
    while found := _TEX.search(text, behind):
        parts.append(text[behind : found.start()])
        behind = found.end()
        if found["wrap"] and depth < _DEEPEST:
            inner, behind = _argument(text, found.end() - 1)
            parts.append(tag(_TAGS[found["wrap"]], _tex(inner, depth + 1)))
        else:
            parts.append(_sign(found))
    return joined([*parts, text[behind:]])


def _sign(found: re.Match[str]) -> str:
    """What a command without words of its own stands for."""
    match found.lastgroup:
        case "label":
            return f"({found['label']})" if found["refer"] == "eq" else found["label"]
        case "cited":
            return f"[{found['cited']}]"
        case "letter":
            letter = found["letter"].removeprefix("\\")
            return unicodedata.normalize("NFC", letter + _ACCENTS[found["accent"]])
        case "sign":
            return found["sign"]
        case "titled" | "named":
            name = f" ({found['named']})" if found["named"] else ""
            return tag("strong", f"{found['titled'].capitalize()}{name}. ")
        case "word":
            return _NAMED[found["word"]]
        case "break":
            return tag("br")
        case "dash" | "quote" | "space":
            return _PLAIN[found[0]]
    return ""


# -- Markdown and plain text -----------------------------------------------------------------------

_MARKDOWN_BLOCK = re.compile(
    rf"(?P<display>{_DISPLAY}[0-9]+{_END})"
    r"|^[ \t]{0,3}(?P<hashes>\#{1,6})[ \t]+(?P<title>[^\n]+?)(?:[ \t]+\#+)?[ \t]*$"
    r"|^[ \t]*(?P<item>(?:[-*+]|[0-9]{1,3}[.)])[ \t]+)"
    r"|(?P<blank>\n[ \t]*\n\s*)",
    re.MULTILINE,
)
_TYPST_CODE = re.compile(  # rules, calls around words, labels, and brackets left alone in a line
    rf"^\#(?:set|show|let|import|include)\b[^\n{_INLINE}{_DISPLAY}]*"
    rf"|\#[a-z][\w.-]*(?:\([^()\n{_INLINE}{_DISPLAY}]*\))?[(\[]?"
    r"|(?<=\s)<[\w:.-]+>|^[ \t]*[\])]+[ \t]*$",
    re.MULTILINE,
)
_TYPST_HEADING = re.compile(r"^=+(?= )", re.MULTILINE)  # otherwise much like Markdown
_MARKDOWN = re.compile(
    r"\\(?P<sign>[!-/:-@\[-`{-~])"
    r"|`(?P<code>[^`\n]+)`"
    r"|\*\*(?P<strong>[^*\n]+)\*\*"
    r"|(?<![*\w])[*_](?P<em>[^*_\n]+)[*_](?![*\w])"
    r"|\[(?P<link>[^\]\n]*)\]\([^)\s]*\)"
    r"|\\(?:begin|end)\s*\{[^{}\n]*\}"
)


def _markdown(text: str) -> Markup:
    """Words of a paragraph; links are shown without their addresses."""
    parts: list[str] = []
    behind = 0
    for found in _MARKDOWN.finditer(text):
        parts.append(text[behind : found.start()])
        behind = found.end()
        match found.lastgroup:
            case "sign" if found["sign"] not in "()[]":
                parts.append(found["sign"])
            case "code" | "strong" | "em" as kind:
                parts.append(tag(kind, found[kind]))
            case "link":
                parts.append(found["link"])
    return joined([*parts, text[behind:]])

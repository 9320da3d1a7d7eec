"""HTML elements, tables and whole pages; text is escaped unless it is `Markup`."""

from __future__ import annotations

import json
from collections.abc import Iterable
from html import escape

_VOID = frozenset({"br", "hr", "img", "link", "meta", "source"})


class Markup(str):
    """Text that is already HTML and must not be escaped again."""

    __slots__ = ()


def tag(name: str, /, *children: str, **attributes: str) -> Markup:
    """An element; in names of attributes (``class_``, ``aria_label``) a trailing underscore is
    dropped and others become hyphens."""
    given = "".join(f" {_attribute(key, value)}" for key, value in attributes.items())
    if name in _VOID:
        return Markup(f"<{name}{given}>")
    return Markup(f"<{name}{given}>{joined(children)}</{name}>")


def joined(parts: Iterable[str], between: str = "") -> Markup:
    """Several pieces one after the other."""
    return Markup(_escaped(between).join(map(_escaped, parts)))


def _attribute(key: str, value: str) -> str:
    quoted = escape(value, quote=False).replace('"', "&quot;")
    return f'{key.rstrip("_").replace("_", "-")}="{quoted}"'


def _escaped(text: str) -> str:
    return text if isinstance(text, Markup) else escape(text, quote=False)


def table(
    header: Iterable[str], rows: Iterable[Iterable[str]], *, caption: str = "", **attributes: str
) -> Markup:
    """A table with its header and, where one is given, a caption."""
    title = [tag("caption", caption)] if caption else []
    head = tag("tr", *(tag("th", cell, scope="col") for cell in header))
    body = (tag("tr", *(tag("td", cell) for cell in row)) for row in rows)
    return tag("table", *title, tag("thead", head), tag("tbody", *body), **attributes)


def json_element(name: str, data: object) -> Markup:
    """Data for a script, as an element with this id."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False)
    # "</script>" within a string would end the element; JavaScript once took U+2028 and U+2029 for
    # line ends.
    for character in "<\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return tag("script", Markup(text), type="application/json", id=name)


def document(
    title: str, style: str, *body: str, head: Iterable[Markup] = (), **attributes: str
) -> str:
    """A whole page without external resources.

    Args:
        title: of the window.
        style: CSS.
        body: its content.
        head: further elements of the head, which come first.
        attributes: of the body.
    """
    first = tag(
        "head",
        tag("meta", charset="utf-8"),
        *head,
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="color-scheme", content="light dark"),
        tag("meta", name="generator", content="polhode"),
        tag("title", title),
        tag("link", rel="icon", href="data:,"),
        tag("style", Markup(style)),
    )
    return f"<!DOCTYPE html>\n{tag('html', first, tag('body', *body, **attributes), lang='en')}\n"

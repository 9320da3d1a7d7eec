"""HTML: text is escaped, markup is not, and data cannot end its element."""

import json

from polhode.view import document, joined, json_element, table, tag


def test_text_is_escaped_and_markup_is_not():
    inner = tag("b", "1 < 2 & 3")
    assert tag("p", "<i>", inner, class_='a"b') == (
        '<p class="a&quot;b">&lt;i&gt;<b>1 &lt; 2 &amp; 3</b></p>'
    )
    assert joined(["<", inner]) == "&lt;<b>1 &lt; 2 &amp; 3</b>"
    assert "<td>&lt;script&gt;</td>" in table(["x"], [["<script>"]])
    assert tag("img", src="x.svg") == '<img src="x.svg">'
    assert tag("p", aria_label="x") == '<p aria-label="x"></p>'


def test_an_f_string_is_text_even_if_it_holds_markup():
    assert tag("p", f"{tag('b', 'x')}") == "<p>&lt;b&gt;x&lt;/b&gt;</p>"


def test_data_cannot_end_its_element():
    data = {"title": "</script><!--\u2028"}
    element = json_element("data", data)
    inner = element.removeprefix('<script type="application/json" id="data">')
    inner = inner.removesuffix("</script>")
    assert "<" not in inner
    assert "\u2028" not in inner
    assert json.loads(inner) == data


def test_a_document_escapes_its_title_and_not_its_style():
    page = document("a < b", "p > q {}", tag("p", "x"), class_="audit")
    assert "<title>a &lt; b</title>" in page
    assert "<style>p > q {}</style>" in page
    assert '<body class="audit"><p>x</p></body>' in page

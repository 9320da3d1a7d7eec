"""The format of documents, and the document of the problem set."""

from pathlib import Path

import pytest

from judge.transcript import NEARBY, digest, document, proof, proven, quoted, transcript
from polhode.base import ParseError, StoreError
from polhode.catalogue import PROBLEM_SET
from polhode.derive import derive
from polhode.judge._notation import Notation
from polhode.judge.document._document import Claim, Definition, Part
from polhode.judge.document._read_document import read_document
from polhode.judge.latex import read_latex

SMALL = r"""
schema = 1

[document]
title = "A text"
source = "Somebody, 1900"

[[part]]
id = "1"
system = "rolling-disk"
convention = "θ from the vertical"
let = [{ says = 'I_1 = ma^2/4', where = "before (1)" }]
given = ['\dot{\theta} = 0']
[part.bindings]
'\alpha' = "theta"

[[part]]
id = "2"
like = "1"
constants = ['k']

[[claim]]
id = "a"
part = "1"
latex = '''
x = \frac{1}{2}
  y'''

[[claim]]
id = "b"
part = "2"
context = "limit"
words = "it is stable"
means = 'x > 0'
small = ['\epsilon:1', '1/\omega']
follows_from = ["a"]

[[claim]]
id = "c"
part = "2"
latex = 'x = y y'
read_as = 'x = y'
reason = "a letter is printed twice"
follows_from = ["b"]
"""


def claim(name: str) -> Claim:
    return read_document(SMALL).claim(name)


def changed(old: str, new: str) -> str:
    assert SMALL.count(old) == 1
    return SMALL.replace(old, new)


def test_latex_is_kept_byte_for_byte() -> None:
    assert claim("a").latex == "x = \\frac{1}{2}\n  y"


def test_what_is_judged_is_the_formula_as_read() -> None:
    assert [claim(name).formula for name in "abc"] == [claim("a").latex, "x > 0", "x = y"]
    assert [claim(name).printed for name in "bc"] == ["it is stable", "x = y y"]


def test_small_quantities_have_their_orders() -> None:
    assert claim("b").small == {r"\epsilon": 1, r"1/\omega": None}


def test_a_part_like_another_inherits_its_conventions() -> None:
    part = read_document(SMALL).part("2")
    assert part.system == "rolling-disk"
    assert part.bindings == {r"\alpha": "theta"}
    assert part.definitions == (Definition("I_1 = ma^2/4", "before (1)"),)
    assert part.given == (r"\dot{\theta} = 0",)
    assert part.constants == ("k",)


def test_a_part_like_another_states_both_conventions() -> None:
    text = SMALL.replace('id = "2"', 'id = "2"\nconvention = "k is small."')
    assert read_document(text).part("2").convention == "θ from the vertical. k is small."


def test_a_claim_says_how_it_was_read() -> None:
    assert claim("a").notes == ()
    labels = [[note.label for note in claim(name).notes] for name in "bc"]
    assert labels[0][0] == "read as"
    assert labels[1][:2] == ["read as", "because"]


def test_every_part_of_the_problem_set_states_its_convention() -> None:
    parts = document().parts
    assert all(part.convention.endswith(".") for part in parts)


def test_consequences_reach_through_claims() -> None:
    found = read_document(SMALL)
    assert found.consequences("a") == ("b", "c")
    assert found.consequences("c") == ()


def test_other_line_ends_make_no_difference(tmp_path: Path) -> None:
    path = tmp_path / "claims.toml"
    path.write_bytes(SMALL.replace("\n", "\r\n").encode("utf-8"))
    assert read_document(path) == read_document(SMALL)


def line(text: str, beginning: str) -> int:
    return next(n for n, row in enumerate(text.splitlines(), 1) if row.startswith(beginning))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('context = "limit"', 'context = "limmit"', "did you mean 'limit'"),
        ('context = "limit"', "context = 3", "a string in quotes"),
        ('words = "it is stable"', 'wrods = "it is stable"', "did you mean 'words'"),
        ("small = [", "small = ['x:two', ", "give the order as a number"),
        ("means = 'x > 0'", "", "write means = '...' in LaTeX"),
        ('reason = "a letter is printed twice"', "", "state the evidence of the damage"),
        ('follows_from = ["a"]', 'follows_from = ["z"]', "ids of other claims"),
        ('follows_from = ["a"]', 'follows_from = "a"', "a list of strings"),
        ('like = "1"', 'like = "9"', "an earlier part"),
        ("{ says = 'I_1 = ma^2/4'", "{ say = 'I_1 = ma^2/4'", "write let ="),
        ("'\\alpha' = \"theta\"", "'\\alpha' = 7", "a table of strings"),
        ("latex = 'x = y y'", "", "latex as printed, or words"),
    ],
)
def test_a_wrong_field_is_named_with_its_line(old: str, new: str, said: str) -> None:
    text = changed(old, new)
    with pytest.raises(ParseError, match=r"^line \d+: ") as caught:
        read_document(text)
    assert said in str(caught.value)


def test_the_line_is_that_of_the_field() -> None:
    text = changed('context = "limit"', 'context = "limmit"')
    with pytest.raises(ParseError) as caught:
        read_document(text)
    assert f"line {line(text, 'context')}:" in str(caught.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[document]\ntitle = "x\n', "not TOML"),
        ("", "no title"),
        ("claim = 3\n[document]\ntitle = 'x'", "one [[claim]] for each"),
        ("[document]\ntitle = 'x'\n[claim]\nid = 'a'", "use double brackets"),
        ("verdict = 3\n[document]\ntitle = 'x'", "'verdict' at the top"),
        ("schema = 99", "schema 99"),
        ("a = " + "[" * 5000, "document"),
        ("x" * 5_000_000, "at most"),
    ],
)
def test_anything_but_a_document_is_refused(text: str, said: str) -> None:
    with pytest.raises(ParseError) as caught:
        read_document(text)
    assert said in str(caught.value)


def test_repeated_ids_are_refused() -> None:
    for old, new in (('id = "b"', 'id = "a"'), ('id = "2"', 'id = "1"')):
        with pytest.raises(ParseError, match="a unique id"):
            read_document(changed(old, new))


def test_a_file_that_is_not_utf_8_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "claims.toml"
    path.write_bytes(b"title = '\xff'")
    with pytest.raises(ParseError, match="UTF-8 from byte 9"):
        read_document(path)


@pytest.mark.parametrize("name", ["none.toml", ".", "/dev/zero"])
def test_an_unreadable_file_is_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(StoreError, match=r"cannot be read.*expected a document of claims in TOML"):
        read_document(tmp_path / name)


@pytest.mark.parametrize("verdict", ["verdict", "correction", "expected", "hint"])
def test_a_document_has_no_place_for_answers(verdict: str) -> None:
    with pytest.raises(ParseError, match="unknown field"):
        read_document(changed('context = "limit"', f'{verdict} = "fails"'))


# -- the problem set --------------------------------------------------------------------------


def test_all_162_equations_and_at_least_60_statements_in_words_are_there() -> None:
    ids = [found.id for found in document().claims]
    assert ids[:162] == [str(number) for number in range(1, 163)]
    assert len(ids) - 162 >= 60
    assert len(set(ids)) == len(ids)


def test_every_part_treats_a_system_of_the_catalogue() -> None:
    assert {part.system for part in document().parts} <= PROBLEM_SET.keys()


def test_every_definition_says_where_the_text_has_it() -> None:
    found = document()
    definitions = [d for owner in (*found.parts, *found.claims) for d in owner.definitions]
    assert definitions
    assert all(definition.where for definition in definitions)


def test_the_two_equations_without_number_are_those_of_the_contract() -> None:
    assert document().claim("78").latex.startswith("2I_2I_3T")
    assert r"\mathbf{v}_{\text{pivot}}" in document().claim("96").latex


def test_every_formula_is_the_one_proven_to_be_in_the_transcript() -> None:
    found = proven()
    assert found.pop("transcript")
    assert found == {name: digest(latex) for name, latex in quoted().items()}


def test_the_transcript_beside_the_checkout_has_every_formula() -> None:
    text = transcript(NEARBY)
    if text is None:
        # Nothing to compare with here: the digests above were made from it.
        assert len(proven()["transcript"]) == 64
        return
    assert {line.split("  ")[1]: line.split("  ")[0] for line in proof(text)} == proven()


def test_a_formula_changed_by_one_letter_is_noticed() -> None:
    latex = quoted()["34"]
    assert digest(latex.replace("+", "-", 1)) != proven()["34"]


def test_the_example_of_the_format_is_a_document() -> None:
    page = (Path(__file__).parents[3] / "docs" / "claims-format.md").read_text("utf-8")
    found = read_document(page.split("```toml\n")[1].split("```")[0])
    assert [claim.id for claim in found.claims] == ["3", "4"]
    for claim in found.claims:
        part = found.part_of(claim)
        equations = derive(PROBLEM_SET[part.system].build())
        own = Notation.of_part(equations, part).of_claim(claim)
        assert own.bound(read_latex(claim.formula)).relations


def test_the_page_of_the_format_names_every_field() -> None:
    page = (Path(__file__).parents[3] / "docs" / "claims-format.md").read_text("utf-8")
    own = {name for owner in (Part, Claim) for name in owner.__dataclass_fields__}
    names = (own - {"definitions", "line"}) | {"let", "like"}
    assert [name for name in sorted(names) if f"`{name}`" not in page] == []

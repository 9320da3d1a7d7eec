"""The page and what lies beside it: well-formed, complete, and in need of nothing else."""

import json
import re
from collections import Counter
from dataclasses import replace
from html.parser import HTMLParser
from itertools import pairwise
from xml.etree import ElementTree

import pytest

import polhode as ph
from pages import scene_in
from polhode.base import SCHEMA, SilentProgress, StoreError
from polhode.catalogue import PROBLEM_SET
from polhode.solution import questions_of
from polhode.tour import TourReport, write_tour
from polhode.tour._motions import MOTIONS
from polhode.tour._pictures import pictures_of
from polhode.tour._sections import source_of
from polhode.tour._work import work_through
from polhode.view import svg_of

VOID = {"meta", "link", "img", "source", "br", "hr"}
SYSTEMS = list(PROBLEM_SET)
PROBLEMS = list(dict.fromkeys(name.partition("/")[0] for name in PROBLEM_SET))
PAGES = ["index", *PROBLEMS]
PLAYED = [
    f"{name.replace('/', '-')}{motion}-3d"
    for name in SYSTEMS
    for motion in ("", *(f"-{motion.name}" for motion in MOTIONS.get(name, ())))
]


class Page(HTMLParser):
    """Reads a page, keeping elements, and refuses tags that do not match."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.elements, self.words = [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        names = [name for name, _ in attrs]
        assert len(names) == len(set(names))
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] not in ("style", "script"):
            self.words.append(data)

    def all(self, tag):
        return [attributes for name, attributes in self.elements if name == tag]


@pytest.fixture(params=PAGES)
def page(tour, request):
    return Page(tour.pages[request.param])


def section(tour, name):
    anchor, text = name.replace("/", "-"), tour.pages[name.partition("/")[0]]
    (found,) = re.findall(rf'<section id="{anchor}">.*?</section>', text, re.DOTALL)
    return found


def formula_text(markup):
    return re.sub(r"<[^>]*>|\s", "", markup)


def test_every_tag_is_closed_and_every_id_is_unique(page):
    ids = Counter(attributes["id"] for _, attributes in page.elements if "id" in attributes)
    assert set(ids.values()) == {1}


def test_nothing_is_fetched_from_elsewhere(tour, page):
    for _tag, attributes in page.elements:
        for name in ("src", "srcset", "href", "action", "data", "poster"):
            target = attributes.get(name, "#").partition("#")[0]
            assert not target or (tour.folder / target).is_file() or target == "data:,"
    for text in tour.pages.values():
        style = text.partition("<style>")[2].partition("</style>")[0]
        assert "url(" not in style
        assert "@import" not in style
    assert [s for s in page.all("script") if s.get("type") != "application/json"] == []


def test_every_link_leads_somewhere(tour):
    pages = {name: Page(text) for name, text in tour.pages.items()}
    ids = {name: {a.get("id") for _, a in page.elements} for name, page in pages.items()}
    assert sorted(tour.pages) == sorted(PAGES)
    links = [(name, a["href"]) for name, page in pages.items() for a in page.all("a")]
    assert {f"{name}.html" for name in PAGES} <= {link for _, link in links}
    for page, link in links:
        target, _, anchor = link.partition("#")
        assert not anchor or anchor in ids[target.removesuffix(".html") or page]


def test_every_picture_is_there_twice_and_described(tour):
    pages = [Page(tour.pages[name]) for name in PROBLEMS]
    images = [image for page in pages for image in page.all("img")]
    sources = [source for page in pages for source in page.all("source")]
    drawn = sum(len(pictures_of(e)) for e in PROBLEM_SET.values()) + len(PLAYED) - len(SYSTEMS)
    assert len(images) == len(sources) == drawn
    for image, source in zip(images, sources, strict=True):
        assert image["alt"]
        assert source["media"] == "(prefers-color-scheme: dark)"
        for target in (image["src"], source["srcset"]):
            root = ElementTree.parse(tour.folder / target).getroot()
            box = [float(side) for side in root.get("viewBox").split()]
            assert [float(image["width"]), float(image["height"])] == pytest.approx(
                box[2:], abs=0.5
            )


def test_the_front_page_shows_every_problem(tour):
    cards = [a for a in Page(tour.pages["index"]).all("a") if a.get("class") == "card"]
    assert [card["href"] for card in cards] == [f"{name}.html" for name in PROBLEMS]
    for image in Page(tour.pages["index"]).all("img"):
        assert (tour.folder / image["src"]).stat().st_size > 5000


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_motion_can_be_seen(tour, name):
    stem = name.replace("/", "-")
    expected = [f"{stem}-3d.html"] + [f"{stem}-{m.name}-3d.html" for m in MOTIONS.get(name, ())]
    frames = Page(section(tour, name)).all("iframe")
    assert sorted(frame["src"] for frame in frames) == sorted(expected)
    for frame in frames:
        assert frame["sandbox"] == "allow-scripts"
        assert 500_000 < (tour.folder / frame["src"]).stat().st_size < 1_600_000


def test_claims_stand_with_their_verdicts(tour):
    assert "3 claims: " in tour.pages["index"]
    rows = {name: tour.pages[name].count('class="claim"') for name in PROBLEMS}
    assert sum(rows.values()) == 3
    for name, count in rows.items():
        assert ("What the text claims" in tour.pages[name]) == (count > 0)


def test_no_picture_holds_what_is_not_a_number(tour):
    files = list((tour.folder / "figures").glob("*.svg"))
    assert files
    for path in files:
        assert not re.search(r"\b(nan|inf)\b", path.read_text("utf-8"), re.IGNORECASE)


def test_nothing_is_left_beside_the_pages(tour):
    left = sorted(path.name for path in tour.folder.iterdir())
    assert left == sorted(["figures", *(f"{name}.html" for name in (*PAGES, *PLAYED))])
    assert {path.suffix for path in (tour.folder / "figures").iterdir()} == {".svg", ".png"}


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_formula_is_shown(tour, name):
    equations = ph.derive(PROBLEM_SET[name].build())
    shown = [
        formula_text(block)
        for block in re.findall(r'<div class="equation".*?</div>', section(tour, name), re.DOTALL)
    ]
    for row in equations.motion:
        assert formula_text(unescaped(row)) + "=0" in shown
    for component, value in equations.components.items():
        if component not in equations.undetermined:
            symbol = ph.Expr.generator(ph.Symbol(component))
            assert f"{formula_text(unescaped(symbol))}={formula_text(unescaped(value))}" in shown


def unescaped(expression):
    return ElementTree.tostring(ElementTree.fromstring(expression.mathml()), encoding="unicode")


@pytest.mark.parametrize("name", SYSTEMS)
def test_what_is_folded_has_all_parts(tour, name):
    entry, found = PROBLEM_SET[name], section(tour, name)
    folded = found.partition('<details class="folded">')[2]
    assert re.findall('<p class="part">(.*?)</p>', folded) == [
        "Declaration",
        "Assumptions",
        "Coordinates and speeds",
        "Equations of motion",
        "Reactions",
        "Energy",
        "Conserved",
        "The default run",
        "Checks",
    ]
    level = "h2" if "/" in name else "h1"
    assert f"<{level}>{entry.title}</{level}>" in found
    assert all(parameter.meaning.split("^")[0] in folded for parameter in entry.parameters)
    assert folded.count("<figure>") == len(pictures_of(entry))
    assert "fails" not in folded


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_solution_answers_every_question_before_anything_is_folded(tour, name):
    shown, found = section(tour, name).partition('<details class="folded">')[::2]
    headings = re.findall('<h[23] class="question">(.*?)</h[23]>', shown)
    assert headings == [question.heading for question in questions_of(name)]
    assert shown.count('class="asked"') == len(headings)
    assert 'class="numbered"' not in found
    rows = {row.system: row.judged for row in tour.report.rows}
    assert shown.count('class="numbered"') == rows[name]
    assert (rows[name] > 0) == bool(headings)


def test_remarks_stand_where_the_text_is_wrong(tour):
    remarks = re.findall('<p class="remark">(.*?)</p>', tour.pages["marble-on-turntable"])
    assert len(remarks) == 1  # of the claims judged here
    assert "wrong power" in remarks[0]
    assert "should read" in remarks[0]


def test_the_number_of_judged_formulas_is_told(tour):
    judged = sum(row.judged for row in tour.report.rows)
    assert judged > 250  # without most remarks
    assert tour.report.audit_table().startswith(f"{judged} formulas displayed in 10 solutions")
    assert f"{judged} formulas are displayed" in tour.pages["index"]


def test_the_page_says_what_it_was_made_with(tour):
    (text,) = re.findall(r'<script type="application/json".*?>(.*?)</script>', tour.pages["index"])
    made_with = json.loads(text)
    assert made_with["schema"] == SCHEMA
    assert list(made_with["runs"]) == sorted(SYSTEMS)
    assert made_with["runs"]["gyroscope"]["parameters"]["a"] == 0.06


def test_the_report_has_a_row_for_every_system(tour):
    report = tour.report
    assert [row.system for row in report.rows] == SYSTEMS
    assert report.page == tour.folder / "index.html"
    assert report.all_hold
    assert all(row.passed == row.checks >= 7 for row in report.rows)
    assert all(row.energy_drift < 1e-12 for row in report.rows)
    assert all(row.constraint_drift < 1e-12 for row in report.rows)


def test_the_table_is_aligned(tour):
    lines = tour.report.table().splitlines()
    assert len(lines) == len(SYSTEMS) + 1
    assert len({len(line) for line in lines}) == 1
    assert lines[0].split()[0] == "system"


def test_one_failed_check_spoils_the_report(tour):
    first, *others = tour.report.rows
    spoilt = TourReport(tour.report.page, (replace(first, passed=first.passed - 1), *others))
    assert not spoilt.all_hold


def test_every_system_is_printed_to_the_terminal(tour):
    assert len(tour.printed) == len(SYSTEMS)
    for name, text in zip(SYSTEMS, tour.printed, strict=True):
        equations = ph.derive(PROBLEM_SET[name].build())
        assert text.startswith(PROBLEM_SET[name].title)
        assert all(f"{row.pretty()} = 0" in text for row in equations.motion)
        assert text.count("✓") == tour.report.rows[SYSTEMS.index(name)].checks
        assert "✗" not in text


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_declaration_shown_is_a_program(name):
    source = source_of(PROBLEM_SET[name].build)
    compile(source, name, "exec")
    assert f"def {PROBLEM_SET[name].build.__name__}(" in source
    called = set(re.findall(r"\b(_?[a-z_]+)\(", source))
    ours = {"following_axes", "cylindrical_axes", "axle_axes", "_top", "_with_hand"}
    assert all(f"def {helper}(" in source for helper in called & ours)


def test_the_same_system_gives_the_same_pictures(tour):
    for drawing in work_through(PROBLEM_SET["ball-on-paper"]).drawings:
        assert drawing.svg == (tour.folder / "figures" / f"{drawing.name}.svg").read_text("utf-8")


def test_verdicts_stand_on_the_page_in_three_dimensions(tour):
    scenes = {name: scene_in((tour.folder / f"{name}-3d.html").read_text()) for name in PROBLEMS}
    judged = {name: scene["judgements"] for name, scene in scenes.items() if scene["judgements"]}
    assert sum(map(len, judged.values())) == 3
    for judgements in judged.values():
        assert all("<math" in judgement["formula"] for judgement in judgements)


def test_claims_are_typeset_without_their_marks(tour):
    for name in PROBLEMS:
        claims = tour.pages[name].partition('id="claims"')[2]
        assert "$" not in claims
        assert "tag{" not in claims


@pytest.mark.parametrize("name", SYSTEMS)
def test_pictures_have_names_of_their_own(name):
    names = [picture.name for picture in pictures_of(PROBLEM_SET[name])]
    assert len(names) == len(set(names))
    assert names[0] == "run"
    assert names[-1] == "energy"


def test_a_disk_that_nods_fast_is_shown_for_a_moment_only(worked_out):
    _, run = worked_out("rolling-disk")
    histories = pictures_of(PROBLEM_SET["rolling-disk"])[0]
    figure = histories.draw(run)
    assert "first 1 s" in histories.caption
    assert figure.axes[-1].get_xlim() == (0.0, 1.0)
    assert len(svg_of(figure)) > 1000


def test_a_folder_that_cannot_be_made_is_an_error(tmp_path, monkeypatch):
    (tmp_path / "tour").write_text("in the way")
    monkeypatch.setattr("polhode.tour._tour.PROBLEM_SET", {})
    with pytest.raises(StoreError, match="cannot be created"):
        write_tour(tmp_path / "tour", SilentProgress())


def test_headings_go_down_by_one_level_at_a_time(tour):
    for page in tour.pages.values():
        levels = [int(level) for level in re.findall(r"<h(\d)", page)]
        assert levels[0] == 1
        assert all(after <= before + 1 for before, after in pairwise(levels))

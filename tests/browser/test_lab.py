"""The lab in a browser: what is slid, dragged, shared and typed has its effect, and stays here."""

import json
import re
import subprocess
import sys
from contextlib import contextmanager

import numpy as np
import pytest

import polhode as ph
from browser.conftest import AXE, PATIENCE, PHONE, RULES, WIDE, Opened
from browser.test_in_view import CAMERA, is_in_view
from polhode.catalogue import CATALOGUE, numbers_of

COIN = "#system=spinning-coin"


@pytest.fixture(scope="module")
def lab():
    """The address of a lab that `polhode lab` serves."""
    command = [sys.executable, "-m", "polhode", "lab", "--no-browser", "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as serving:
        said = serving.stdout.readline()
        yield re.search(r"http://\S+/", said)[0]
        serving.terminate()


@pytest.fixture(scope="module")
def visit(browser, lab):
    """Opens the lab; nothing but the lab may be asked for anything."""

    @contextmanager
    def opened(state=COIN, *, viewport=WIDE, **options):
        context = browser.new_context(viewport=viewport, locale="en-US", **options)
        page = context.new_page()
        page.set_default_timeout(PATIENCE)
        shown = Opened(page)
        page.on("console", lambda m: shown.complaints.append(m.text) if _bad(m) else None)
        page.on("pageerror", lambda error: shown.complaints.append(str(error)))
        page.on("request", lambda request: shown.requests.append(request.url))
        page.goto(lab + state)
        page.wait_for_selector("body[data-ready]", timeout=PATIENCE)
        yield shown
        assert shown.complaints == []
        assert [url for url in shown.requests if not url.startswith((lab, "blob:", "data:"))] == []
        context.close()

    return opened


@pytest.fixture(scope="module")
def shared(visit):
    with visit() as shown:
        yield shown


@pytest.fixture
def coin(shared):
    """One page for several tests; at rest at the start, with the usual numbers."""
    _pause(shared)
    shared.page.get_by_role("button", name="Back to the start").click()
    if shared.page.url.partition("#")[2] != COIN[1:]:
        with answered(shared):
            shared.page.get_by_role("button", name="Usual numbers").click()
    yield shared
    _pause(shared)  # so as to leave the processor to others


def _pause(shown):
    pause = shown.page.get_by_role("button", name="Pause")
    if pause.count():
        pause.click()


def _bad(message):
    return message.type in ("error", "warning") and "GPU stall" not in message.text


@contextmanager
def answered(shown):
    """Waits until a motion has come that was asked for within."""
    before = shown.page.locator("body").get_attribute("data-answers")
    yield
    shown.page.wait_for_selector(f"body:not([data-answers='{before}'])", timeout=PATIENCE)


def slider(shown, name):
    return shown.page.locator(f".slider[data-name='{name}'] input[type=range]")


def field(shown, name):
    return shown.page.locator(f".slider[data-name='{name}'] input[type=text]")


def differing(one, other):
    return np.count_nonzero(np.abs(one - other).sum(axis=2) > 60)


def dark(pixels):
    """How much of a picture is in the dark colours that only bodies have."""
    return np.count_nonzero(pixels.max(axis=2) < 130)


def test_the_body_is_seen_and_plays(coin, tmp_path):
    before = coin.picture(tmp_path)
    middle = before[before.shape[0] // 4 : -before.shape[0] // 4]
    assert len(np.unique(middle.reshape(-1, 3) // 16, axis=0)) > 30
    coin.page.get_by_role("button", name="Play").click()
    coin.wait_until_past(0.05)
    coin.page.get_by_role("button", name="Pause").click()
    assert differing(coin.picture(tmp_path), before) > 200


def test_a_slider_changes_the_motion_and_the_picture(coin, tmp_path):
    before = coin.picture(tmp_path)
    assert float(coin.value()) == pytest.approx(70)
    with answered(coin):
        slider(coin, "theta").fill("200")
    assert field(coin, "theta").input_value() == "36 deg"
    assert float(coin.value()) == pytest.approx(36, abs=0.1)
    assert differing(coin.picture(tmp_path), before) > 500
    assert "start=theta%3D36+deg" in coin.page.url


def test_a_larger_body_is_seen_from_farther_away(coin, tmp_path):
    before = coin.picture(tmp_path)
    with answered(coin):
        field(coin, "a").fill("0.1 m")
        field(coin, "a").press("Enter")
    # It falls more slowly: the view is fitted to a shorter path. From the same place it would
    # cover seventy times the area.
    assert 0.8 * dark(before) < dark(coin.picture(tmp_path)) < 2 * dark(before)


WATCH_SIZES = """() => {
  window.sized = 0;
  const size = Object.getOwnPropertyDescriptor(HTMLCanvasElement.prototype, "width");
  const set = function (width) { window.sized += 1; size.set.call(this, width); };
  Object.defineProperty(HTMLCanvasElement.prototype, "width", { ...size, set });
}"""


def test_another_motion_is_drawn_on_the_same_canvases(coin):
    """To give one a size clears it, and costs a picture more."""
    canvases = coin.page.locator("canvas").element_handles()
    coin.page.evaluate(WATCH_SIZES)
    with answered(coin):
        slider(coin, "theta").fill("300")
    coin.page.wait_for_timeout(300)
    assert coin.page.evaluate("window.sized") == 0
    assert len(canvases) > 1
    assert all(canvas.evaluate("c => c.isConnected") for canvas in canvases)


def answers(shown):
    return int(shown.page.locator("body").get_attribute("data-answers"))


STEP = 20  # ms of the page's clock between two moves of a slider
HURRY = 1000  # ms of the page's clock within which a moving slider has to be followed


def test_the_picture_follows_a_slider_that_does_not_rest(visit):
    """Without waiting for it to come to rest, and it ends where the slider does.

    Only the test moves the page's clock, from one move of the slider to the next; the server may
    take its time to answer in between.
    """
    under_way = set()
    with visit() as shown:
        page = shown.page
        page.on("request", lambda request: under_way.add(request))
        for end in ("requestfinished", "requestfailed"):
            page.on(end, lambda request: under_way.discard(request))
        page.clock.install()
        page.clock.pause_at(page.evaluate("Date.now()") + 1000)
        before = answers(shown)
        for move in range(HURRY // STEP):
            slider(shown, "theta").fill(str(500 + move))
            page.clock.run_for(STEP)
            waits = 0
            while under_way and waits < PATIENCE // STEP:
                page.wait_for_timeout(STEP)
                waits += 1
            if answers(shown) > before:
                break
        assert answers(shown) > before
        assert move > 0
        slider(shown, "theta").fill("200")
        page.clock.resume()
        page.wait_for_selector(".theatre[aria-busy=false]", timeout=PATIENCE)
        assert float(shown.value()) == pytest.approx(36, abs=0.1)


def test_the_old_motion_plays_on_while_the_new_one_is_computed(coin):
    coin.page.get_by_role("button", name="Play").click()
    coin.wait_until_past(0.02)
    with answered(coin):
        slider(coin, "omega_3").fill("600")
        coin.wait_until_past(coin.time())
    assert coin.page.get_by_role("button", name="Pause").count() == 1


def test_numbers_are_typed_with_units(coin):
    with answered(coin):
        field(coin, "theta").fill("0.5 rad")
        field(coin, "theta").press("Enter")
    assert float(coin.value()) == pytest.approx(np.degrees(0.5), abs=0.1)


def test_a_number_without_a_unit_is_in_the_unit_that_is_shown(coin):
    with answered(coin):
        field(coin, "theta").fill("40")
        field(coin, "theta").press("Enter")
    assert field(coin, "theta").input_value() == "40 deg"
    assert float(coin.value()) == pytest.approx(40, abs=0.1)
    with answered(coin):
        field(coin, "duration").fill("1.5")
        field(coin, "duration").press("Enter")
    assert field(coin, "duration").input_value() == "1.5 s"


def test_a_formula_says_which_unit_it_is_in(coin):
    remark = coin.page.locator(".slider[data-name='theta'] .remark")
    with answered(coin):
        field(coin, "theta").fill("2*0.5")
        field(coin, "theta").press("Enter")
    assert remark.inner_text() == "a formula, in rad"
    assert float(coin.value()) == pytest.approx(np.degrees(1), abs=0.1)
    with answered(coin):
        field(coin, "theta").fill("70")
        field(coin, "theta").press("Enter")
    assert remark.inner_text() == ""


def test_a_link_with_a_number_in_si_units_shows_what_it_means(visit):
    with visit(f"{COIN}&start=theta%3D0.5") as shown:
        assert field(shown, "theta").input_value() == f"{np.degrees(0.5):.8g} deg"
        assert float(shown.value()) == pytest.approx(np.degrees(0.5), abs=0.1)


def test_what_cannot_be_read_is_told_and_the_picture_is_marked(coin):
    page = coin.page
    page.get_by_role("button", name="Play").click()
    coin.complaints.clear()
    field(coin, "theta").fill("2 furlongs")
    field(coin, "theta").press("Enter")
    coin.page.wait_for_selector(".message.wrong", timeout=PATIENCE)
    assert "furlongs" in coin.page.locator(".message").inner_text()
    assert field(coin, "theta").get_attribute("aria-invalid") == "true"
    assert "still of the numbers before" in coin.page.locator(".message").inner_text()
    assert page.locator(".picture .mark").inner_text() == "Out of date"
    assert page.get_by_role("button", name="Pause").count() == 0
    stopped = coin.time()
    page.wait_for_timeout(200)
    assert coin.time() == stopped
    coin.page.get_by_role("tab", name="Steady motions").click()  # another may have been left open
    coin.page.wait_for_selector("[role=tabpanel] >> text=furlongs", timeout=PATIENCE)
    assert all("422" in complaint for complaint in coin.complaints)
    coin.complaints.clear()
    with answered(coin):
        field(coin, "theta").fill("70 deg")
        field(coin, "theta").press("Enter")
    assert not page.locator(".picture .mark").is_visible()
    assert page.get_by_role("button", name="Pause").count() == 1  # and goes on


MOVED = [("ball-on-paper", "v_x", "0.8 m/s"), ("rolling-disk", "theta", "101.5 deg")]


@pytest.mark.parametrize(("system", "name", "value"), MOVED)
def test_the_body_stays_in_view_whatever_its_numbers(visit, system, name, value):
    """At every time of the motion, by the camera of the page; and again with the usual numbers."""
    entry = CATALOGUE[system]
    equations = ph.derive(entry.build())
    with visit(f"#system={system}") as shown:
        for wanted in (value, entry.start.get(name)):
            with answered(shown):
                field(shown, name).fill(wanted)
                field(shown, name).press("Enter")
            numbers = numbers_of(entry, equations, {}, {**entry.start, name: wanted})
            run = ph.simulate(
                equations,
                numbers.parameters,
                numbers.start,
                numbers.duration,
                forcing=numbers.forcing,
            )
            (body,) = ph.scene(run).bodies
            for share in (0, 0.5, 1):
                shown.page.get_by_role("slider", name="Time").fill(str(round(2000 * share)))
                shown.page.wait_for_timeout(100)
                camera = shown.page.evaluate(CAMERA)
                place = body.pose.place[round(share * (len(body.pose.place) - 1))]
                assert is_in_view(camera, place, body.reach), (wanted, share)


@pytest.mark.parametrize("text", ["-1 s", "soon", "1e9 s"])
def test_a_duration_that_cannot_be_is_marked(coin, text):
    duration = field(coin, "duration")
    usual = duration.input_value()
    duration.fill(text)
    duration.press("Enter")
    coin.page.wait_for_selector("[data-name=duration] [aria-invalid=true]", timeout=PATIENCE)
    assert coin.page.locator(".message.wrong").inner_text()
    with answered(coin):
        duration.fill("")
        duration.press("Enter")
    assert all("422" in complaint for complaint in coin.complaints)
    coin.complaints.clear()
    assert duration.input_value() == usual
    assert duration.get_attribute("aria-invalid") == "false"


def test_an_emptied_field_is_as_usual_again(coin):
    with answered(coin):
        field(coin, "theta").fill("50 deg")
        field(coin, "theta").press("Enter")
    with answered(coin):
        field(coin, "theta").fill("")
        field(coin, "theta").press("Enter")
    assert field(coin, "theta").input_value() == "70 deg"
    assert float(coin.value()) == pytest.approx(70)


def test_contacts_are_switched(coin):
    with answered(coin):
        coin.page.get_by_role("radio", name="Rolling").check(force=True)
    assert "contact=rolling" in coin.page.url
    with answered(coin):
        coin.page.get_by_role("radio", name="Friction").check(force=True)
    coin.page.wait_for_selector(".slider[data-name=mu]")
    with answered(coin):
        coin.page.get_by_role("radio", name="Smooth").check(force=True)
    assert "contact" not in coin.page.url


def test_steady_motions_say_where_one_stands(coin):
    coin.page.get_by_role("tab", name="Steady motions").click()
    coin.page.wait_for_selector("[role=tabpanel][aria-busy=false] .family math", timeout=PATIENCE)
    assert coin.page.get_by_text("the start is not such a motion").count() > 0
    assert coin.page.locator(".family .scale").count() == 0
    start = coin.page.get_by_role("button", name="Start there")
    with answered(coin):
        start.last.click()
    coin.page.wait_for_selector(".verdict:text('you are here')", timeout=PATIENCE)
    on_it = coin.page.locator(".family", has=coin.page.locator(".verdict:text('you are here')"))
    assert coin.page.locator(".family .scale").count() == on_it.locator(".scale").count()


def test_a_typed_claim_is_judged(coin):
    coin.page.get_by_role("tab", name="Try an equation").click()
    claim = coin.page.get_by_label("Equation in LaTeX")
    for latex, verdict in ((r"\dot{\omega}_3 = 0", "holds"), (r"\dot{\omega}_3 = 1", "fails")):
        claim.fill(latex)
        claim.press("Enter")
        badge = coin.page.locator(f".result .verdict.{verdict}")
        badge.wait_for(timeout=PATIENCE)
        assert badge.inner_text() == verdict


def test_claims_of_the_problem_set_come_with_verdicts(coin):
    coin.page.get_by_role("tab", name="Claims").click()
    coin.page.wait_for_selector(".claim .verdict", timeout=PATIENCE)
    assert coin.page.locator(".claim").count() > 5


def test_everything_is_reached_by_the_keyboard(coin):
    page = coin.page
    page.get_by_role("tab", name="Steady motions").click()
    page.evaluate("document.activeElement.blur(); window.scrollTo(0, 0)")
    wanted = page.locator(
        ":is(button, input, select, summary, .picture, textarea):visible:not([tabindex='-1'])"
    )
    names = ["theta", "System", "Play", "Save as a file", "Time"]
    reached = []
    for _ in range(wanted.count() + 3):
        page.keyboard.press("Tab")
        reached.append(page.evaluate("document.activeElement.outerHTML.slice(0, 160)"))
    for name in names:
        assert any(name in element for element in reached), name
    page.locator("[role=tab][aria-selected=true]").focus()
    page.keyboard.press("ArrowRight")
    assert page.locator("[role=tab][aria-selected=true]").inner_text() == "Equations"


def test_the_keyboard_stays_where_it_is_when_sliders_are_made_anew(coin):
    page = coin.page
    focused = "document.activeElement.value || document.activeElement.textContent"
    page.locator(".contact input:checked").focus()
    with answered(coin):
        page.keyboard.press("ArrowRight")
    assert page.evaluate(focused) == "friction"
    page.get_by_role("button", name="Usual numbers").focus()
    with answered(coin):
        page.keyboard.press("Enter")
    assert page.evaluate(focused) == "Usual numbers"


def test_a_file_is_saved(coin, tmp_path):
    with coin.page.expect_download() as started:
        coin.page.get_by_label("Save as a file").select_option("csv")
    path = tmp_path / "motion.csv"
    started.value.save_as(path)
    assert path.read_text("utf-8").startswith("# polhode {")


def test_axe_finds_no_serious_fault(visit):
    """In the light with all rules, and in the dark with that on contrast."""
    with visit("#system=ball-on-paper", bypass_csp=True) as shown:
        shown.page.evaluate(AXE.read_text("utf-8"))
        for scheme, rules in RULES.items():
            shown.page.emulate_media(color_scheme=scheme)
            faults = shown.page.evaluate(rules)["violations"]
            serious = [fault for fault in faults if fault["impact"] in ("serious", "critical")]
            assert not serious, json.dumps(serious, indent=1)[:3000]


def is_followed(response):
    return response.ok and response.url.endswith("/follow")


def test_the_sheet_is_dragged_shared_and_restored_on_a_phone(visit, tmp_path):
    """The velocity returns; the address of it opens the same on a telephone."""
    with visit("#system=ball-on-paper") as shown:
        page = shown.page
        with page.expect_response(is_followed):
            page.get_by_role("button", name="Drag the sheet").click()
        box = page.locator(".picture").bounding_box()
        x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.6 * box["height"]
        page.mouse.move(x, y)
        page.mouse.down()
        before = shown.picture(tmp_path)
        with page.expect_response(is_followed):  # the ball goes with the sheet as it is pulled
            for step in range(6):
                page.mouse.move(x + 20 * step, y + 5 * step)
                page.wait_for_timeout(30)
        assert differing(shown.picture(tmp_path), before) > 200
        with answered(shown):
            page.mouse.up()
        assert "the velocity has returned" in page.locator(".outcome").inner_text()
        shown.wait_until_past(0.1)
        address, outcome = page.url, page.locator(".outcome").inner_text()
    assert "sheet=" in address
    state = "#" + address.partition("#")[2]
    with visit(state, viewport=PHONE, is_mobile=True, has_touch=True) as shown:
        assert shown.page.locator(".outcome").inner_text() == outcome
        assert shown.page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
        play = shown.page.get_by_role("button", name="Play").bounding_box()
        assert min(play["width"], play["height"]) >= 40


def test_the_sheet_is_pushed_with_the_keyboard_alone(visit):
    with visit("#system=ball-on-paper") as shown:
        page = shown.page
        page.get_by_role("button", name="Drag the sheet").press("Enter")
        assert page.evaluate("document.activeElement.className").startswith("picture")
        for key in ("ArrowRight", "ArrowUp"):
            page.keyboard.down(key)
            page.wait_for_timeout(1000)
        page.keyboard.up("ArrowUp")
        with answered(shown):
            page.keyboard.press("Enter")
        assert "the velocity has returned" in page.locator(".outcome").inner_text()
        assert "sheet=" in page.url
        armed = page.get_by_role("button", name="Drag the sheet")
        armed.press("Enter")
        page.keyboard.press("Escape")
        assert armed.get_attribute("aria-pressed") == "false"


def test_a_shared_state_is_restored(visit):
    state = "#system=gyroscope&start=theta%3D45+deg&set=M%3D0.7+kg&duration=1+s"
    with visit(state) as shown:
        assert field(shown, "theta").input_value() == "45 deg"
        assert field(shown, "M").input_value() == "0.7 kg"
        assert float(shown.value()) == pytest.approx(45, abs=0.1)


def test_a_hostile_address_is_text(visit):
    script = "%3Cimg+src%3Dx+onerror%3Dalert(1)%3E"
    with visit(f"#system=gyroscope&start=theta%3D{script}&set={script}%3D1") as shown:
        shown.page.wait_for_selector(".message.wrong")
        assert shown.page.locator("main img").count() == 0
        shown.complaints[:] = [c for c in shown.complaints if "422" not in c]


def test_a_solution_that_is_pasted_in_gets_its_marks(coin):
    coin.page.get_by_role("tab", name="Mark a solution").click()
    hostile = "<img src=x onerror=alert(1)>"
    text = "Here $\\omega_1 = \\dot\\theta$, and the potential energy is "
    text += f"$V = m g a \\cos\\theta$ {hostile}."
    coin.page.get_by_label("Solution in LaTeX or Markdown").fill(text)
    coin.page.get_by_role("button", name="Mark it").click()
    lines = coin.page.locator(".marked-line")
    lines.nth(1).wait_for(timeout=PATIENCE)
    assert lines.nth(0).locator(".verdict").inner_text() == "✓ true"
    assert lines.nth(1).locator(".verdict").inner_text() == "✗ error"
    assert "where sin is right" in lines.nth(1).inner_text()
    assert coin.page.locator(".marked-line math").count() >= 3

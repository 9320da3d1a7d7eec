"""A page in a browser: it plays, it can be steered, and it keeps to itself."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

import polhode as ph
from browser.conftest import AXE, PHONE, SMALL
from browser.runs import HOSTILE, run_of
from polhode.cli import main
from polhode.view import page_of
from polhode.view._scene import Panel, PlotSeries

#: `test_in_view` opens the pages of all others.
SYSTEMS = ["ball-on-paper", "gyroscope/upright", "double pendulum"]
NO_WEBGL = "HTMLCanvasElement.prototype.getContext = new Proxy(\
HTMLCanvasElement.prototype.getContext, {apply: (get, canvas, asked) => \
asked[0].startsWith('webgl') ? null : Reflect.apply(get, canvas, asked)})"
TIPS = "e => [...e.querySelectorAll('line')].map(l => [l.x2, l.y2].map(v => v.baseVal.value))"
MOST = 1_500_000  # bytes


@pytest.fixture(scope="module")
def shared(opened, written):
    with opened(written("rolling-disk")) as shown:
        yield shown


@pytest.fixture
def disk(shared):
    """A page that several tests steer, one after the other; at rest at the start."""
    pause = shared.page.get_by_role("button", name="Pause")
    if pause.count():
        pause.click()
    shared.page.get_by_role("button", name="Back to the start").click()
    shared.page.get_by_role("button", name="Reset view").click()
    shared.page.evaluate("document.activeElement.blur()")
    return shared


def colours(pixels):
    """How many different colours there are, but for small differences."""
    return len(np.unique(pixels.reshape(-1, 3) // 16, axis=0))


def vivid(pixels):
    """Where there is the colour of an arrow or a body, none of the sky or the ground."""
    return np.ptp(pixels, axis=2) > 90


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_system_is_seen(opened, written, tmp_path, name):
    path = written(name)
    assert path.stat().st_size < MOST
    with opened(path, viewport=SMALL) as shown:
        before = shown.picture(tmp_path)
        shown.page.locator("input[type=range]").fill("713")
        after = shown.picture(tmp_path)
        assert not np.any(vivid(before[:3])), "something leaves the picture at the top"
        assert colours(after[after.shape[0] // 6 : -after.shape[0] // 6]) > 30
        assert np.count_nonzero(np.abs(after - before).sum(axis=2) > 60) > 100
        assert shown.page.locator(".plot canvas").count() > 0
        assert shown.page.locator("math").count() > 3
        assert shown.requests == [path.as_uri()]
        assert shown.complaints == []


def test_playing_moves_on_and_pausing_stops(disk, tmp_path):
    assert disk.time() == 0
    before = disk.picture(tmp_path)
    disk.page.get_by_role("button", name="Play").click()
    disk.wait_until_past(0.3)
    disk.page.get_by_role("button", name="Pause").click()
    stopped = disk.time()
    after = disk.picture(tmp_path)
    assert np.count_nonzero(np.abs(after - before).sum(axis=2) > 60) > 200
    assert disk.time() == stopped
    assert disk.complaints == []


def test_slider_seeks(disk):
    disk.page.locator("input[type=range]").fill("1000")
    assert disk.time() == pytest.approx(5.0)


def test_what_is_shown_is_the_motion(disk):
    """The number beside θ at a time is θ there."""
    from browser.runs import run_of

    disk.page.locator("input[type=range]").fill("800")
    theta = np.degrees(run_of("rolling-disk").evaluate("theta", 4.0))
    assert float(disk.value()) == pytest.approx(float(theta), abs=0.15)


WATCH_TEXT = """(() => {
  window.written = [];
  const { fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.fillText = function (text, ...more) {
    window.written.push(text);
    return fillText.call(this, text, ...more);
  };
})()"""


@pytest.mark.parametrize("swing", [3e-5, 2e-3, 5.0])
def test_the_numbers_at_an_axis_differ(opened, tmp_path, swing):
    shown = ph.scene(run_of("gyrocompass"))
    values = 11.21 + swing * np.sin(np.linspace(0, 9, 400))
    panel = Panel("rad/s", (PlotSeries("q", "<math><mi>q</mi></math>", values),))
    path = tmp_path / "page.html"
    path.write_text(page_of(replace(shown, panels=(panel,))), "utf-8")
    with opened(path, script=WATCH_TEXT) as page:
        written = page.page.evaluate("window.written")
        ticks = [
            t for t in written if re.fullmatch(r"[−\d.]+", t) and abs(float(t) - 11.21) < swing
        ]
        assert len(ticks) >= 2
        assert len(set(ticks)) == len(ticks)
        page.page.locator(".plots > .plot").screenshot(path=tmp_path / "plot.png")


@pytest.mark.parametrize("viewport", [SMALL, PHONE])
@pytest.mark.parametrize("name", ["rolling-disk", "gyroscope"])
def test_the_whole_path_is_in_view(opened, written, tmp_path, name, viewport):
    """No path runs out of the picture: none of its colour is at the edge of it.

    The disk, which travels far, is followed at first, with a plan of its path.
    """
    with opened(written(name), viewport=viewport, color_scheme="light") as shown:
        follow = shown.page.get_by_role("button", name="Follow")
        is_far = name == "rolling-disk"
        assert follow.get_attribute("aria-pressed") == str(is_far).lower()
        assert shown.page.locator(".plan").is_visible() == is_far
        if is_far:
            follow.click()
            assert shown.page.locator(".plan").is_hidden()
        shown.page.locator("input[type=range]").first.fill("1000000")
        pixels = shown.picture(tmp_path)
        red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
        orange = (red > 170) & (green < 110) & (blue < 70)  # where it touched the ground
        azure = (blue > 140) & (red < 80) & (green < 130)  # where its centre was
        path = (orange if name == "rolling-disk" else azure) & (red != green)
        edge = np.ones(path.shape, bool)
        edge[4:-4, 4:-4] = False
        assert np.count_nonzero(path) > 200
        assert np.count_nonzero(path & edge) == 0


def test_click_on_a_plot_seeks(disk):
    over = disk.page.locator(".plot .u-over").first
    size = over.bounding_box()
    over.click(position={"x": 0.3 * size["width"], "y": 0.5 * size["height"]})
    assert disk.time() == pytest.approx(3.0, abs=0.05)
    mark = disk.page.locator(".plot .now").first.bounding_box()
    assert mark["x"] - size["x"] == pytest.approx(0.3 * size["width"], abs=3)


def test_keys_do_what_buttons_do(disk):
    page = disk.page
    page.keyboard.press("ArrowRight")
    assert disk.time() == pytest.approx(0.1)
    page.keyboard.press("End")
    assert disk.time() == pytest.approx(10)
    page.keyboard.press("Home")
    page.keyboard.press("Space")
    disk.wait_until_past(0)
    page.keyboard.press("Space")
    page.get_by_role("button", name="Play").wait_for()


def test_every_control_is_reached_by_the_keyboard(disk):
    page = disk.page
    controls = "button, select, input, .picture, .u-over"
    place = f"[...document.querySelectorAll('{controls}')].indexOf(document.activeElement)"
    wanted = page.locator(controls).count()
    reached = set()
    for _ in range(wanted + 2):
        page.keyboard.press("Tab")
        reached.add(page.evaluate(place))
    page.evaluate("document.activeElement.blur(); scrollTo(0, 0)")  # for the tests after this one
    assert reached >= set(range(wanted))


def test_the_view_turns_and_zooms(disk, tmp_path):
    before = disk.picture(tmp_path)
    disk.page.locator(".picture").focus()
    disk.page.keyboard.press("ArrowLeft")
    turned = disk.picture(tmp_path)
    assert np.count_nonzero(np.abs(turned - before).sum(axis=2) > 40) > 1000
    box = disk.page.locator(".picture").bounding_box()
    disk.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    disk.page.mouse.wheel(0, -600)
    assert np.count_nonzero(np.abs(disk.picture(tmp_path) - turned).sum(axis=2) > 40) > 1000
    assert disk.time() == 0


def scrolled(shown):
    """How far the page is scrolled, once it has come to rest."""
    last = None
    while (now := shown.page.evaluate("scrollY")) != last:
        last = now
        shown.page.wait_for_timeout(300)
    return now


def test_the_wheel_scrolls_the_page_until_the_picture_is_clicked(disk, tmp_path):
    before = disk.picture(tmp_path)
    disk.page.mouse.move(300, 400)
    disk.page.mouse.wheel(0, 200)
    assert scrolled(disk) == 200
    disk.page.evaluate("scrollTo(0, 0)")
    assert np.count_nonzero(np.abs(disk.picture(tmp_path) - before).sum(axis=2) > 40) < 2000
    disk.page.mouse.click(300, 400)
    disk.page.mouse.wheel(0, 200)
    assert scrolled(disk) == 0
    assert np.count_nonzero(np.abs(disk.picture(tmp_path) - before).sum(axis=2) > 40) > 2000


def swiped(shown):
    """How far the page is scrolled after a vertical swipe over the middle of the picture."""
    box = shown.page.locator(".picture").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    session = shown.page.context.new_cdp_session(shown.page)

    def touch(kind, *points):
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": list(points)})

    touch("touchStart", {"x": x, "y": y})
    for step in range(1, 13):
        touch("touchMove", {"x": x, "y": y - 12 * step})
        shown.page.wait_for_timeout(16)
    touch("touchEnd")
    return scrolled(shown)


def test_a_swipe_scrolls_the_page_until_the_picture_is_tapped(opened, written):
    with opened(written("rolling-disk"), viewport=PHONE, is_mobile=True, has_touch=True) as shown:
        assert swiped(shown) > 50
        shown.page.evaluate("scrollTo(0, 0)")
        shown.page.locator(".picture").tap()
        assert swiped(shown) == 0


def test_a_constant_is_drawn_level_though_its_last_digits_differ(opened, written):
    """The energy of the compass in the frame of the turning Earth varies by 2·10⁻⁸ of itself."""
    with opened(written("gyrocompass")) as shown:
        plot = shown.page.locator(".plots > .plot").last
        pixels = shown.picture_of(plot.locator("canvas"))
        beside_cursor = pixels[:, pixels.shape[1] // 2 :]
        line = np.argwhere((beside_cursor[..., 2] - beside_cursor[..., 0]) > 100)
        assert np.ptp(line[:, 0]) <= 3 < np.ptp(line[:, 1])


def test_moments_and_weights_say_what_they_are(opened, written):
    with opened(written("gyroscope")) as shown:
        names = shown.page.locator(".switch").all_inner_texts()
        assert sum("about pivot" in name for name in names) == 2
        weight = shown.page.get_by_role("button", name="loads")
        assert weight.locator("math").text_content() == "Mg"
        torque = shown.page.get_by_role("button", name="torque about the pivot")
        assert torque.locator(".value").inner_text() == "0.255 N m"


LETTERS = """() => [...document.querySelectorAll(".letter:not([hidden])")].map((letter) => {
  const box = letter.getBoundingClientRect();
  return [letter.textContent, box.x + box.width / 2, box.y + box.height / 2];
})"""


def letters(shown):
    """The letters in the picture, and where the middle of each is, in pixels."""
    return {text: np.array(place) for text, *place in shown.page.evaluate(LETTERS)}


def test_arrows_and_angles_have_their_letters(opened, written):
    with opened(written("gyroscope")) as shown:
        shown.page.get_by_role("slider", name="Time").fill("500")
        shown.until(lambda: letters(shown).keys() == {"F", "θ", "ϕ"})
        for name in ("angular momentum", "loads"):
            shown.page.get_by_role("button", name=name).click()
        shown.page.get_by_role("button", name="Axes").click()
        wanted = {"F", "Mg", "L", "θ", "ϕ", *"123", *"xyz"}
        shown.until(lambda: letters(shown).keys() == wanted)
        everything = letters(shown)
        frame = shown.page.locator(".picture").bounding_box()
        for place in everything.values():
            assert frame["x"] < place[0] < frame["x"] + frame["width"]
            assert frame["y"] < place[1] < frame["y"] + frame["height"]
        shown.page.get_by_role("button", name="Angles").click()
        shown.until(lambda: not letters(shown).keys() & {"θ", "ϕ"})
        assert shown.complaints == []


def test_a_torque_is_drawn_at_the_tip_of_the_momentum_that_it_changes(opened, written):
    """So that dL/dt = τ is seen; without the momentum it begins at the pivot."""
    with opened(written("gyroscope")) as shown:
        shown.page.get_by_role("button", name="torque").click()
        shown.until(lambda: "τ" in letters(shown))
        alone = letters(shown)["τ"]
        shown.page.get_by_role("button", name="angular momentum").click()
        shown.until(lambda: "L" in letters(shown))
        found = letters(shown)
        assert np.linalg.norm(found["τ"] - alone) > 30
        assert np.linalg.norm(found["τ"] - found["L"]) < np.linalg.norm(alone - found["L"])


def test_a_contact_force_has_its_parts_and_a_scale(opened, tmp_path):
    path = tmp_path / "rough.html"
    assert main(["run", "rolling-disk", "--mu", "0.4", "--page", str(path)]) == 0
    with opened(path) as shown:
        shown.page.get_by_role("button", name="N, f").click()
        shown.until(lambda: letters(shown).keys() >= {"N", "f", "F"})
        assert shown.page.locator(".scales > div:visible").all_inner_texts() == ["0.5 N"]
        assert shown.complaints == []


def test_fast_cycles_are_an_envelope_until_there_is_room_for_their_line(opened, written):
    with opened(written("rolling-disk")) as shown:
        inset = shown.page.locator(".plot").first.locator(".inset")
        assert inset.is_visible()
        drawn = inset.locator("path").get_attribute("d")
        shown.page.get_by_role("slider", name="Time").fill("1013")
        assert inset.locator("path").get_attribute("d") != drawn
        closer = shown.page.get_by_role("button", name="Plots: zoom in")
        for _ in range(4):
            closer.click()
        assert not inset.is_visible()
        shown.page.get_by_role("button", name="Plots: the whole motion").click()
        assert inset.is_visible()
        assert shown.complaints == []


def cursor(shown):
    """Where the present time is across the first plot, from 0 to 1."""
    now, plot = (
        shown.page.locator(f".plot {part}").first.bounding_box() for part in (".now", ".u-over")
    )
    return (now["x"] + now["width"] / 2 - plot["x"]) / plot["width"]


def test_plots_are_zoomed_by_wheel_and_keys_and_follow_the_time(opened, written):
    with opened(written("gyroscope")) as shown:
        slider = shown.page.get_by_role("slider", name="Time")
        slider.fill("500")
        plot = shown.page.locator(".plot .u-over").first
        plot.scroll_into_view_if_needed()
        assert cursor(shown) == pytest.approx(0.25, abs=0.01)
        before = shown.page.evaluate("scrollY")
        plot.focus()
        box = plot.bounding_box()
        # the time under the pointer stays there
        shown.page.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + box["height"] / 2)
        shown.page.mouse.wheel(0, -300)
        shown.page.wait_for_timeout(300)
        assert cursor(shown) == pytest.approx(0.25, abs=0.02)
        assert shown.page.evaluate("scrollY") == before
        plot.press("-")
        plot.press("0")
        assert cursor(shown) == pytest.approx(0.25, abs=0.01)
        for _ in range(3):
            plot.press("+")
        slider.fill("1900")
        assert 0 < cursor(shown) < 1
        assert shown.complaints == []


def test_portraits_have_the_present_time(opened, written):
    with opened(written("gyroscope")) as shown:
        portraits = shown.page.locator(".portrait")
        titles = portraits.locator("figcaption > span:first-child").all_inner_texts()
        assert titles == ["effective potential", "phase portrait", "axis of gyroscope"]
        dots = portraits.locator(".dot")
        before = [dots.nth(i).bounding_box() for i in range(3)]
        shown.page.get_by_role("slider", name="Time").fill("77")
        after = [dots.nth(i).bounding_box() for i in range(3)]
        assert all(one != other for one, other in zip(before, after, strict=True))
        assert "NaN" not in portraits.first.evaluate("e => e.parentElement.innerHTML")


def test_conserved_quantities_have_letters(opened, tmp_path):
    path = tmp_path / "gyroscope.html"
    assert main(["run", "gyroscope", "--page", str(path)]) == 0
    with opened(path) as shown:
        text = shown.page.locator("section", has_text="Evidence").inner_text()
        assert "_" not in text
        assert shown.page.locator("th[aria-label='L_pivot_z'] msub").count() > 0


def test_a_verdict_has_the_colour_that_it_has_everywhere(opened, tmp_path):
    judged = [
        ph.Judgement("one", "holds", ""),
        ph.Judgement("two", "approximate", ""),
        ph.Judgement("three", "fails", ""),
        ph.Judgement("four", "not applicable", ""),
    ]
    path = tmp_path / "page.html"
    ph.page(run_of("spinning-coin"), path, judgements=judged)
    with opened(path, color_scheme="light") as shown:
        colours = [
            badge.evaluate("e => getComputedStyle(e).color")
            for badge in shown.page.locator(".verdict").all()
        ]
        assert len(set(colours)) == 4
        red, green, blue = np.array([re.findall(r"\d+", c) for c in colours], dtype=int)[[2, 0, 1]]
        assert (np.argmax(red), np.argmax(green), np.argmax(blue)) == (0, 1, 2)


def test_arrows_are_switched_and_seen_through_the_disk(disk, tmp_path):
    button = disk.page.get_by_role("button", name="forces of supports")
    disk.page.locator("input[type=range]").fill("700")
    on = disk.picture(tmp_path)
    button.click()
    assert button.get_attribute("aria-pressed") == "false"
    off = disk.picture(tmp_path)
    red = (on - off)[..., 0] - (on - off)[..., 2]
    assert np.count_nonzero(red > 60) > 150
    assert "N" in button.inner_text()


def test_phone(opened, written, tmp_path):
    with opened(written("rolling-disk"), viewport=PHONE, is_mobile=True, has_touch=True) as shown:
        width = shown.page.evaluate("document.documentElement.scrollWidth")
        assert width <= PHONE["width"]
        assert colours(shown.picture(tmp_path)) > 30
        play = shown.page.get_by_role("button", name="Play").bounding_box()
        assert min(play["width"], play["height"]) >= 40
        assert play["y"] + play["height"] < PHONE["height"]


def test_without_webgl_the_plots_stay(opened, written):
    with opened(written("rolling-disk"), script=NO_WEBGL) as shown:
        assert "no WebGL" in shown.page.locator(".picture").inner_text()
        shown.page.locator("input[type=range]").fill("1000")
        assert shown.time() == pytest.approx(5.0)
        assert float(shown.value()) > 70
        drawn = shown.page.evaluate(
            "(() => { const c = document.querySelector('.plot canvas');"
            "return c.getContext('2d').getImageData(0, 0, c.width, c.height).data"
            ".some((v, i) => i % 4 === 3 && v > 0); })()"
        )
        assert drawn


def test_dark_pages_are_dark(disk):
    """As soon as the machine turns dark, without a new start."""
    means = {}
    for scheme in ("dark", "light"):
        disk.page.emulate_media(color_scheme=scheme)
        colour = disk.page.evaluate("getComputedStyle(document.body).backgroundColor")
        means[scheme] = np.mean([int(part) for part in colour[4:-1].split(",")])
    assert means["light"] > 200
    assert means["dark"] < 50


@pytest.mark.parametrize("duration", [1e-6, 1e6])
def test_a_motion_of_any_length_can_be_watched(opened, tmp_path, duration):
    """It takes 9 s or more of one's time, and not more than half a minute."""
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    system = ph.System(ph.Rolling(ball, on=ph.Plane(lab)), ph.Gravity(g), name="ball")
    run = ph.simulate(ph.derive(system), {m: 1, a: 1, g: 9.81}, {"v_x": 1 / duration}, duration)
    ph.page(run, tmp_path / "ball.html")
    with opened(tmp_path / "ball.html", viewport=SMALL) as shown:
        speed = float(shown.page.get_by_label("Speed").input_value())
        assert 9 <= duration / speed < 30
        assert shown.complaints == []


def test_nothing_moves_by_itself(disk, tmp_path):
    before = disk.picture(tmp_path)
    disk.page.wait_for_timeout(300)
    assert disk.time() == 0
    assert np.array_equal(disk.picture(tmp_path), before)


def test_who_asks_for_less_motion_gets_none_unasked(opened, written, tmp_path):
    with opened(written("rolling-disk"), viewport=SMALL, reduced_motion="reduce") as shown:
        before = shown.picture(tmp_path)
        moving = shown.page.evaluate(
            "[...document.querySelectorAll('*')].map(e => getComputedStyle(e)).filter(s => "
            "[s.transitionDuration, s.animationDuration].some(d => parseFloat(d) > 0)"
            " || s.scrollBehavior === 'smooth').length"
        )
        assert moving == 0
        assert np.array_equal(shown.picture(tmp_path), before)
        shown.page.get_by_role("button", name="Play").click()
        shown.wait_until_past(0)


def test_the_directions_turn_with_the_view(disk):
    triad = disk.page.locator(".triad")
    assert triad.locator("text").all_text_contents() == ["x", "y", "z"]
    before = np.array(triad.evaluate(TIPS))
    assert before[2][0] == pytest.approx(0, abs=0.1)
    assert before[2][1] < -10
    disk.page.locator(".picture").focus()
    disk.page.keyboard.press("ArrowLeft")
    disk.until(lambda: np.abs(np.array(triad.evaluate(TIPS)) - before)[:2].max() > 1)
    after = np.array(triad.evaluate(TIPS))
    assert after[2][0] == pytest.approx(0, abs=0.1)


def test_pulling_sideways_turns_about_the_upright(disk):
    triad = disk.page.locator(".triad")
    before = np.array(triad.evaluate(TIPS))
    box = disk.page.locator(".picture").bounding_box()
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    disk.page.mouse.move(*middle)
    disk.page.mouse.down()
    disk.page.mouse.move(middle[0] + 120, middle[1], steps=4)
    disk.page.mouse.up()
    disk.until(lambda: np.abs(np.array(triad.evaluate(TIPS)) - before)[:2].max() > 10)
    after = np.array(triad.evaluate(TIPS))
    assert after[2] == pytest.approx(before[2], abs=0.1)


@pytest.fixture(scope="module")
def pendulum(opened, written):
    """A page of names that would like to be markup, in the dark."""
    with opened(written("double pendulum"), color_scheme="dark") as shown:
        yield shown


def test_names_are_text(pendulum):
    assert pendulum.page.locator("h1").inner_text().split() == HOSTILE.split()
    assert pendulum.page.locator("main script, main img").count() == 0
    assert pendulum.complaints == []


def test_verdicts_stand_on_the_page(pendulum):
    rows = pendulum.page.locator(".judged")
    assert rows.locator(".verdict").all_text_contents() == ["holds", "fails"]
    assert "to the damper" in rows.first.inner_text()
    assert rows.last.locator("math").count() == 2
    assert rows.last.locator("math script").count() == 0


@pytest.mark.parametrize("name", ["disk", "pendulum"])
def test_axe_finds_no_serious_fault(request, name):
    """On a light page and on a dark one."""
    page = request.getfixturevalue(name).page
    page.evaluate(AXE.read_text("utf-8"))
    faults = page.evaluate("axe.run()")["violations"]
    serious = [fault for fault in faults if fault["impact"] in ("serious", "critical")]
    assert not serious, json.dumps(serious, indent=1)[:3000]

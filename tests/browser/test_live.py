"""Live pages in a browser: sliders run the physics, offline, and what the page saves is exact."""

import io
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

import polhode as ph
from browser.conftest import AXE, PHONE, RULES
from polhode.catalogue import PROBLEM_SET
from polhode.cli import main
from view.live_host import table

MOST = 900_000  # bytes
NO_WORKERS = "globalThis.Worker = class { constructor() { throw new Error('forbidden'); } };"
NO_WASM = f"{NO_WORKERS} WebAssembly.compile = () => Promise.reject(new Error('forbidden'));"


@pytest.fixture(scope="module")
def live(tmp_path_factory):
    """The live page for the words after `polhode page`; written once."""
    folder, known = tmp_path_factory.mktemp("live"), {}

    def path_of(*words):
        if words not in known:
            known[words] = folder / f"page-{len(known)}.html"
            assert main(["page", *words, "--live", "-o", str(known[words])]) == 0
        return known[words]

    return path_of


@pytest.fixture(scope="module")
def shared(opened, live):
    with opened(
        live("rolling-disk", "--mu", "0.3", "--duration", "2s"), accept_downloads=True
    ) as s:
        yield s


@pytest.fixture
def disk(shared):
    """A page that several tests use, one after the other; as it opens."""
    shared.page.get_by_role("button", name="Reset", exact=True).click()
    settled(shared)
    return shared


def settled(shown):
    """Wait until no motion is computed, nor about to be."""
    shown.page.wait_for_timeout(250)
    shown.until(lambda: shown.page.locator(".panel.live[aria-busy]").count() == 0)


def set_field(shown, name, text):
    field = shown.page.locator(f'[data-name="{name}"] input[type=text]')
    field.fill(text)
    field.press("Enter")
    settled(shown)


def saved(shown, button):
    with shown.page.expect_download() as download:
        shown.page.get_by_role("button", name=button).click()
    return download.value.path()


def message(shown):
    return shown.page.locator(".panel .message").inner_text()


def test_a_slider_moves_the_body_and_the_plots_with_no_request(disk, tmp_path):
    before = disk.picture(tmp_path)
    value = disk.value()
    requests = list(disk.requests)
    slider = disk.page.locator('[data-name="theta"] input[type=range]')
    slider.evaluate("e => { e.value = 300; e.dispatchEvent(new Event('input')); }")
    settled(disk)
    after = disk.picture(tmp_path)
    assert np.count_nonzero(np.abs(after - before).sum(axis=2) > 60) > 500
    assert disk.value() != value
    assert [url for url in disk.requests[len(requests) :] if not url.startswith("blob:")] == []
    assert disk.complaints == []


def test_the_table_is_the_motion_of_python(opened, live):
    """Through stick and slip, with the numbers of the sliders, to 1e-9."""
    start = ("theta=80deg", "omega_3=10", "v_x=0.5", "v_y=0.4", "phi_dot=2")
    given = [word for value in start for word in ("--start", value)]
    words = ("--mu", "0.3", *given, "--duration", "2s")
    with opened(live("rolling-disk", *words), accept_downloads=True) as shown:
        settled(shown)
        set_field(shown, "theta", "70 deg")
        set_field(shown, "omega_3", "20 rad/s")
        set_field(shown, "v_x", "1 m/s")
        columns = table(saved(shown, "Save table").read_text())
    start = {name: columns[name][0] for name in columns if name in _states()}
    system = ph.automaton(_rough())
    run = ph.simulate(system, {"m": 0.2, "a": 0.03, "g": 9.81, "mu": 0.3}, start, 2)
    assert any(event.kind == "sticks" for event in run.events)
    for name in start:
        expected = run.evaluate(name, np.minimum(columns["t"], run.duration))
        size = max(np.max(np.abs(expected)), 1e-3)
        assert np.max(np.abs(columns[name] - expected)) < 1e-9 * size, name


def _rough():
    from polhode.model import with_friction

    return with_friction(PROBLEM_SET["rolling-disk"].build(), ph.symbol("mu"))


def _states():
    return {"phi", "theta", "psi", "x", "y", "phi_dot", "theta_dot", "omega_3", "v_x", "v_y"}


def test_a_picture_is_saved(disk):
    content = saved(disk, "Save picture").read_bytes()
    assert content.startswith(b"\x89PNG")
    assert len(content) > 5000


def test_what_the_plots_show_is_saved_as_a_film(disk):
    page = disk.page
    for _ in range(5):
        page.get_by_role("button", name="Plots: zoom in").click()
    page.get_by_role("button", name="loop").click()
    page.get_by_label("Speed").select_option("1")
    content = saved(disk, "Save film").read_bytes()
    page.get_by_role("button", name="loop").click()
    page.get_by_role("button", name="Plots: the whole").click()
    film = Image.open(io.BytesIO(content))
    assert film.format == "GIF"
    assert film.size[0] == 480
    assert film.n_frames >= 2
    frames = []
    for place in (0, film.n_frames - 1):
        film.seek(place)
        frames.append(np.asarray(film.convert("RGB"), dtype=float))
    assert np.mean(np.abs(frames[1] - frames[0])) > 1
    assert disk.complaints == []


def test_licences_travel_with_a_live_page(live):
    text = live("rolling-disk", "--mu", "0.3", "--duration", "2s").read_text("utf-8")
    for name in ("three", "uplot", "gifenc"):
        assert f"\n{name} " in text
    assert text.count("Permission is hereby granted") == 3


def test_the_link_holds_the_motion(opened, live, disk):
    set_field(disk, "theta", "60 deg")
    set_field(disk, "a", "4 cm")
    assert "cannot be read" in message(disk)
    set_field(disk, "a", "40 mm")
    address = disk.page.url
    value = disk.value()
    with opened(live("rolling-disk", "--mu", "0.3", "--duration", "2s")) as other:
        other.page.goto(address)
        other.page.reload()
        other.page.wait_for_selector("body[data-ready]")
        settled(other)
        assert other.value() == value
        field = other.page.locator('[data-name="a"] input[type=text]')
        assert field.input_value() == "40 mm"
        assert other.complaints == []


def test_the_link_holds_how_the_motion_is_seen(opened, live, disk):
    page = disk.page
    for name in ("angular velocity", "Angles"):
        page.get_by_role("button", name=name).first.click()
    page.locator(".picture").focus()
    for _ in range(5):
        page.keyboard.press("ArrowLeft")
    page.get_by_role("button", name="Copy link").click()
    camera = "() => document.querySelector('.picture canvas').camera.position.toArray()"
    seen, address = page.evaluate(camera), page.url
    page.get_by_role("button", name="Angles").click()
    page.get_by_role("button", name="angular velocity").click()
    file = live("rolling-disk", "--mu", "0.3", "--duration", "2s")
    with opened(file) as other:
        other.page.goto(address)
        other.page.reload()
        other.page.wait_for_selector("body[data-ready]")
        settled(other)
        assert other.page.evaluate(camera) == pytest.approx(seen, rel=1e-2)
        pressed = other.page.locator(".switches [aria-pressed=true]").all_inner_texts()
        assert any("ω" in text for text in pressed)
        assert "Angles" not in pressed


def test_the_letter_of_an_angle_is_dragged_to_another_start(opened, live):
    with opened(live("gyroscope")) as shown:
        settled(shown)
        page = shown.page
        letter = page.locator(".letter[data-coordinate=theta]").bounding_box()
        x, y = letter["x"] + letter["width"] / 2, letter["y"] + letter["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        for step in range(1, 6):
            page.mouse.move(x + 6 * step, y + 4 * step)
            page.wait_for_timeout(30)
        page.mouse.up()
        settled(shown)
        start = page.locator("[data-name=theta] input[type=text]").input_value()
        angle = float(start.removesuffix(" deg"))
        assert 65 < angle < 150
        assert angle * 2 == pytest.approx(round(angle * 2))  # half degrees
        assert float(page.locator(".plot .value").first.inner_text()) == pytest.approx(angle)
        # what was not dragged stays where it was, the view included
        page.mouse.move(x + 200, y)
        settled(shown)
        field = page.locator("[data-name=theta] input[type=text]")
        assert field.input_value() == start
        assert shown.complaints == []


def drag(page, x, y):
    """From the middle of the picture, where the body is, by so many pixels."""
    box = page.locator(".picture").bounding_box()
    middle = box["x"] + box["width"] / 2, box["y"] + 0.55 * box["height"]
    page.mouse.move(*middle)
    page.mouse.down()
    for step in range(1, 6):
        page.mouse.move(middle[0] + x * step / 5, middle[1] + y * step / 5)
        page.wait_for_timeout(30)
    page.mouse.up()


def test_a_body_is_pushed_in_the_middle_of_its_motion_and_the_link_holds_that(opened, live, disk):
    page = disk.page
    page.get_by_label("Speed").select_option(index=0)  # so that it still plays when it is looked at
    page.get_by_role("slider", name="Time", exact=True).fill("500")
    page.get_by_role("button", name="Push").click()
    drag(page, 90, -20)
    settled(disk)
    disk.until(lambda: page.get_by_role("button", name="Pause").count() == 1)
    assert "let go" in message(disk)
    page.get_by_role("button", name="Pause").click()
    address = page.evaluate("location.href")
    pushed = saved(disk, "Save table").read_text()
    columns = table(pushed)
    assert columns["x"][0] ** 2 + columns["y"][0] ** 2 > 0.3**2  # it had rolled for 0.5 s
    file = live("rolling-disk", "--mu", "0.3", "--duration", "2s")
    with opened(file, accept_downloads=True) as other:
        other.page.goto(address)
        other.page.reload()
        other.page.wait_for_selector("body[data-ready]")
        settled(other)
        assert saved(other, "Save table").read_text() == pushed
        other.page.goto(address.replace("begin=", "begin=1+"))
        settled(other)
        assert "do not fit" in message(other)
        set_field(other, "theta", "70 deg")
        assert "let go" not in message(other)
        assert other.complaints == []


def test_a_body_is_moved_to_another_start(disk):
    page = disk.page
    page.get_by_role("slider", name="Time", exact=True).fill("0")
    before = [
        float(page.locator(f'[data-name="{n}"] input[type=text]').input_value().split()[0])
        for n in "xy"
    ]
    page.get_by_role("button", name="Move").click()
    drag(page, 60, 10)
    settled(disk)
    page.get_by_role("button", name="Turn view").click()
    after = [
        float(page.locator(f'[data-name="{n}"] input[type=text]').input_value().split()[0])
        for n in "xy"
    ]
    assert before == [0, 0]
    assert 1e-3 < abs(after[0]) + abs(after[1]) < 1
    assert disk.complaints == []


def test_what_the_plots_show_is_played_again_and_again(disk):
    page = disk.page
    page.get_by_role("slider", name="Time").fill("0")
    for _ in range(4):
        page.get_by_role("button", name="Plots: zoom in").click()
    page.get_by_role("button", name="loop").click()
    page.get_by_label("Speed").select_option("1")
    page.get_by_role("button", name="Play", exact=True).click()
    times = []
    for _ in range(25):
        page.wait_for_timeout(40)
        times.append(disk.time())
    page.get_by_role("button", name="Pause").click()
    page.get_by_role("button", name="loop").click()
    page.get_by_role("button", name="Plots: the whole motion").click()
    assert max(times) <= 2 / 16 + 0.01
    assert any(later < earlier for earlier, later in pairwise(times))


@pytest.mark.parametrize(
    ("fragment", "words"),
    [
        ("#system=gyroscope&set=a%3D1", "gyroscope"),
        ("#system=rolling-disk&set=size%3D1", "size"),
        ("#system=rolling-disk&set=a%3D%3Cimg%20src%3Dx%20onerror%3Dalert(1)%3E", "cannot be read"),
        ("#system=rolling-disk&set=a%3DNaN", "cannot be read"),
        ("#system=rolling-disk&set=a%3D1e999", "cannot be read"),
        ("#system=rolling-disk&duration=1e9%20s", "duration"),
        ("#system=rolling-disk&run=rm", "run"),
        ("#system=rolling-disk&view=1 2", "three numbers"),
        ("#system=rolling-disk&view=1 2 NaN", "three numbers"),
        ("#system=rolling-disk&view=1e9 0 0", "three numbers"),
        ("#nonsense", "no system"),
    ],
)
def test_what_a_link_cannot_say_is_refused_in_words(disk, fragment, words):
    disk.page.evaluate("fragment => { location.hash = fragment; }", fragment)
    settled(disk)
    assert words in message(disk)
    assert disk.complaints == []


def test_numbers_without_a_motion_leave_the_old_one_marked(disk):
    set_field(disk, "mu", "-1")
    assert "impossible" in message(disk)
    assert disk.page.locator(".theatre.outdated").count() == 1
    set_field(disk, "mu", "0.3")
    assert disk.page.locator(".theatre.outdated").count() == 0


def test_the_strip_of_contact_modes_seeks(opened, live):
    words = ("--mu", "0.3", "--start", "theta=70deg", "--start", "omega_3=20", "--start", "v_x=1")
    path = live("rolling-disk", *words, "--start", "v_y=.4", "--duration", "1s")
    with opened(path) as shown:
        settled(shown)
        told = shown.page.locator("output.mode")
        assert told.inner_text() == "sliding"
        spans = shown.page.locator(".strip rect")
        assert spans.count() > 3
        box = shown.page.locator(".strip").bounding_box()
        last = spans.last.bounding_box()
        x = last["x"] + last["width"] / 2 - box["x"]
        shown.page.locator(".strip").click(position={"x": x, "y": box["height"] / 2})
        assert told.inner_text() == spans.last.locator("title").text_content()
        assert shown.time() == pytest.approx(x / box["width"], abs=0.01)


def test_a_motion_in_one_mode_has_no_strip(shared):
    shared.page.get_by_role("button", name="Reset", exact=True).click()
    settled(shared)
    assert shared.page.locator(".strip").count() == 0


def test_a_path_is_kept_beside_that_of_another_motion(disk, tmp_path):
    keep = disk.page.get_by_role("button", name="Keep path")
    keep.click()
    assert keep.get_attribute("aria-pressed") == "true"
    set_field(disk, "omega_3", "30 rad/s")
    assert keep.get_attribute("aria-pressed") == "true"
    keep.click()
    assert keep.get_attribute("aria-pressed") == "false"
    assert disk.complaints == []


def test_a_motion_is_chosen_by_its_question(opened, live):
    """The cases of the catalogue: the start is that of `polhode run --case`."""
    with opened(live("rolling-disk")) as shown:
        settled(shown)
        motions = shown.page.get_by_role("combobox", name="Motions")
        motions.select_option("Unless ω₃ > √(g/3a), the disk on edge falls over.")
        settled(shown)
        field = shown.page.locator('[data-name="omega_3"] input[type=text]')
        expected = 0.9 * np.sqrt(9.81 / (3 * 0.03))
        assert float(field.input_value().split()[0]) == pytest.approx(expected)
        assert float(shown.value()) == pytest.approx(91)
        set_field(shown, "omega_3", "12 rad/s")
        assert motions.input_value() == ""  # it is another motion now
        assert shown.complaints == []


def test_a_motion_that_ends_early_says_why(disk):
    set_field(disk, "omega_3", "0 rad/s")
    set_field(disk, "phi_dot", "0 rad/s")
    assert "lies flat" in message(disk)
    assert disk.page.locator("section", has_text="Events").count() > 0


@pytest.mark.parametrize("script", ["", NO_WORKERS])
def test_a_page_computes_with_and_without_a_worker(opened, live, script):
    with opened(live("gyroscope", "--duration", "0.5s"), script=script) as shown:
        settled(shown)
        set_field(shown, "theta", "60 deg")
        assert float(shown.value()) == pytest.approx(60)
        assert message(shown) == ""
        assert shown.complaints == []


def test_where_webassembly_is_forbidden_the_recorded_motion_plays(opened, live):
    with opened(live("gyroscope", "--duration", "0.5s"), script=NO_WASM) as shown:
        assert "may not compute" in message(shown)
        assert shown.page.locator('[data-name="theta"] input').first.is_disabled()
        shown.page.get_by_role("button", name="Play").click()
        shown.wait_until_past(0.05)


def test_it_runs_in_a_frame_that_may_only_run_scripts(opened, live, tmp_path):
    page = live("gyroscope", "--duration", "0.5s")
    outer = tmp_path / "course.html"
    outer.write_text(
        f'<!DOCTYPE html><title>Course</title><body data-ready="yes">'
        f'<iframe src="{page.as_uri()}" sandbox="allow-scripts" width="900" height="700"></iframe>'
    )
    with opened(outer) as shown:
        frame = shown.page.frame_locator("iframe")
        frame.locator("body[data-ready]").wait_for()
        field = frame.locator('[data-name="theta"] input[type=text]')
        field.fill("60 deg")
        field.press("Enter")
        shown.until(lambda: frame.locator(".key .value").first.inner_text() == "60")


@pytest.mark.parametrize("scheme", RULES)
def test_axe_finds_no_serious_fault(opened, live, scheme):
    path = live("rolling-disk", "--mu", "0.3", "--duration", "2s")
    with opened(path, color_scheme=scheme) as shown:
        settled(shown)
        shown.page.add_init_script(AXE.read_text())
        shown.page.reload()
        shown.page.wait_for_selector("body[data-ready]")
        found = shown.page.evaluate(RULES[scheme])["violations"]
        assert [rule["id"] for rule in found if rule["impact"] in ("serious", "critical")] == []


def test_on_a_phone_the_picture_stays_beside_the_sliders(opened, live):
    path = live("rolling-disk", "--mu", "0.3", "--duration", "2s")
    with opened(path, viewport=PHONE, has_touch=True, is_mobile=True) as shown:
        settled(shown)
        slider = shown.page.locator('[data-name="omega_3"] input[type=range]')
        slider.scroll_into_view_if_needed()
        picture = shown.page.locator(".picture canvas")
        box, place = picture.bounding_box(), slider.bounding_box()
        assert box["y"] >= -1
        assert box["y"] + box["height"] <= place["y"] + place["height"]
        width = shown.page.evaluate("document.documentElement.scrollWidth")
        assert width <= PHONE["width"]


# `tests/view/test_live.py` follows the motions of all cases
CASES = [("ball-on-paper", "--case", "tablecloth"), ("ball-on-paper", "--case", "jerked")]


@pytest.mark.parametrize("words", [*((name,) for name in PROBLEM_SET), *CASES])
def test_every_system_has_a_live_page_that_opens_without_a_fault(opened, live, words):
    path = live(*words)
    assert path.stat().st_size < MOST
    with opened(path) as shown:
        settled(shown)
        assert shown.complaints == []
        assert message(shown) == ""
        text = shown.page.locator("body").inner_text()
        assert "NaN" not in text
        assert "_dot" not in text

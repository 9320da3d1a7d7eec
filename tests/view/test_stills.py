"""Stills and movies: they show the body where it is, as files that others read."""

import io
import sys

import numpy as np
import pytest
from PIL import Image

import polhode as ph
from polhode.base import DeclarationError, NumericError, StoreError, UnitError
from polhode.view._scene import BodyShape, Pose, SceneBody
from polhode.view.stills._bodies import _wheel, body_mesh
from polhode.view.stills._camera import between, camera_of, place_at, turn_at

SMALL = (200, 130)


@pytest.fixture(scope="module")
def shown(run_of):
    return ph.scene(run_of("rolling-disk"))


def pixels(path):
    return np.asarray(Image.open(path).convert("RGB"), dtype=int)


def test_a_still_shows_the_body_at_its_time(shown, tmp_path):
    for time in ("0 s", "3 s"):
        ph.still(shown, tmp_path / f"{time}.png", time=time, size=(400, 260))
    first, later = pixels(tmp_path / "0 s.png"), pixels(tmp_path / "3 s.png")
    assert first.shape[1] / first.shape[0] == pytest.approx(400 / 260)
    assert len(np.unique(first.reshape(-1, 3) // 16, axis=0)) > 20
    assert np.count_nonzero(np.abs(first - later).sum(axis=2) > 60) > 500


def test_the_body_is_drawn_where_the_camera_sees_it(shown, tmp_path):
    """The pixel of its marked sector, whose place on the page is worked out here."""
    ph.still(shown, tmp_path / "disk.png", size=(400, 260))
    body = shown.bodies[0]
    turn, place = turn_at(body.pose, 0.0), place_at(body.pose, 0.0)
    axis, across = np.array(body.shape.axis), np.array(body.shape.across)
    camera = camera_of(shown, 0.0)
    side = np.sign((turn @ axis) @ (camera.eye - place))
    mark = across * np.cos(0.26) + np.cross(axis, across) * np.sin(0.26)
    spot = place + turn @ (0.6 * body.shape.size[0] * mark + side * axis * body.shape.size[1] / 2)
    x, y = camera.project(spot)
    image = pixels(tmp_path / "disk.png")
    high, wide = image.shape[:2]
    red, green, blue = image[round(high * (1 - y) / 2), round(wide / 2 + x * high / 2)]
    assert red > 1.5 * green > 1.5 * blue


@pytest.mark.parametrize("kind", ["svg", "pdf"])
def test_a_still_is_vectors_and_always_the_same(shown, tmp_path, kind):
    first, second = (tmp_path / f"{name}.{kind}" for name in "ab")
    for path in (first, second):
        ph.still(shown, path, size=SMALL, arrows=("force",))
    assert first.read_bytes() == second.read_bytes()
    assert b"rolling-disk" in first.read_bytes() or kind == "pdf"


def test_arrows_are_drawn_where_requested(shown, tmp_path):
    ph.still(shown, tmp_path / "without.png", size=SMALL)
    ph.still(shown, tmp_path / "with.png", size=SMALL, arrows=("omega",))
    change = pixels(tmp_path / "with.png") - pixels(tmp_path / "without.png")
    assert np.count_nonzero(change[..., 1] - change[..., 0] > 60) > 20


@pytest.mark.parametrize("kind", ["gif", "mp4"])
def test_a_movie_has_its_frames(run_of, tmp_path, kind):
    path = tmp_path / f"top.{kind}"
    ph.movie(run_of("gyroscope"), path, speed=4, rate=12, size=(96, 64))
    content = path.read_bytes()
    if kind == "mp4":
        assert content[4:8] == b"ftyp"
        assert _frames_of_mp4(path) == 6
        return
    movie = Image.open(io.BytesIO(content))
    assert movie.n_frames == 6
    assert movie.size == (96, 64)
    assert movie.info["duration"] == pytest.approx(1000 / 12, abs=10)
    movie.seek(0)
    first = np.asarray(movie.convert("RGB"), dtype=int)
    movie.seek(3)
    assert np.count_nonzero(np.abs(np.asarray(movie.convert("RGB")) - first).sum(axis=2) > 60) > 50


def _frames_of_mp4(path):
    from imageio_ffmpeg import count_frames_and_secs

    return count_frames_and_secs(str(path))[0]


def test_without_ffmpeg_the_extra_is_named(shown, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(StoreError, match=r"pip install 'polhode\[movie\]', or write a \.gif"):
        ph.movie(shown, tmp_path / "top.mp4", size=SMALL)
    assert list(tmp_path.iterdir()) == []


def test_what_cannot_be_drawn_is_refused(shown, tmp_path):
    with pytest.raises(StoreError, match=r"a name that ends in \.gif or \.mp4"):
        ph.movie(shown, tmp_path / "top.avi")
    with pytest.raises(StoreError, match=r"a name that ends in \.svg, \.pdf or \.png"):
        ph.still(shown, tmp_path / "top.bmp", size=SMALL)
    with pytest.raises(NumericError, match="11 s is outside the motion; expected a time from 0 to"):
        ph.still(shown, tmp_path / "top.png", time="11 s")
    with pytest.raises(UnitError, match="time = '3 m'"):
        ph.still(shown, tmp_path / "top.png", time="3 m")
    with pytest.raises(NumericError, match="expected positive numbers"):
        ph.movie(shown, tmp_path / "top.gif", speed=0)
    with pytest.raises(StoreError, match="cannot be written"):
        ph.still(shown, tmp_path / f"{300 * 'x'}.png", size=SMALL)


@pytest.mark.parametrize("size", [(0, 0), (-5, 10), (10**6, 10), (100,), "big", (1.5, 10)])
def test_a_size_that_cannot_be_drawn_is_refused(shown, tmp_path, size):
    for make, ending in ((ph.still, "png"), (ph.movie, "gif")):
        with pytest.raises(NumericError, match="whole numbers from 1 to 10000"):
            make(shown, tmp_path / f"top.{ending}", size=size)


def test_arrows_are_called_by_their_kinds(shown, tmp_path):
    with pytest.raises(
        DeclarationError, match="arrows are called 'forces'; expected some of force, load"
    ):
        ph.still(shown, tmp_path / "top.png", size=SMALL, arrows=("forces",))
    for arrows, name in ((("omega",), "several"), ("omega", "one")):
        ph.still(shown, tmp_path / f"{name}.png", size=SMALL, arrows=arrows)
    assert np.array_equal(pixels(tmp_path / "several.png"), pixels(tmp_path / "one.png"))


def test_a_movie_that_would_never_end_is_refused(shown, tmp_path):
    with pytest.raises(
        NumericError, match=r"2\.5e\+11 frames; expected at most 5000; choose a higher"
    ):
        ph.movie(shown, tmp_path / "top.mp4", speed=1e-9)
    for rate in (60, 1e-3):
        with pytest.raises(NumericError, match=r"0\.01 to 50"):
            ph.movie(shown, tmp_path / "top.gif", rate=rate, size=SMALL)


def test_a_gif_keeps_time_though_it_counts_hundredths(shown, tmp_path):
    """30 frames a second are 33.3 ms each: 3 or 4 hundredths, 100 of them in a second."""
    ph.movie(shown, tmp_path / "disk.gif", speed=10, rate=30, size=(48, 32))
    movie = Image.open(tmp_path / "disk.gif")
    lasts = 0
    for frame in range(movie.n_frames):
        movie.seek(frame)
        lasts += movie.info["duration"]
    assert lasts == 1000


# --- parts ---


SHAPES = {
    "ball": (0.3,),
    "ellipsoid": (0.1, 0.2, 0.3),
    "disk": (0.3, 0.1),
    "rod": (0.5, 0.02),
    "box": (0.3, 0.2, 0.1),
}
VOLUMES = {
    "ball": 4 / 3 * np.pi * 0.027,
    "ellipsoid": 4 / 3 * np.pi * 0.006,
    "disk": np.pi * 0.009,
    "box": 0.006,
}


@pytest.mark.parametrize("kind", VOLUMES)
def test_faces_look_outwards_and_close(kind):
    """The volume within, by Gauss's theorem, is that of the shape."""
    pose = Pose(np.zeros((1, 3)), np.array([[0, 0, 0, 1.0]]), np.zeros(0), (0, 0, 1))
    mesh = body_mesh(SceneBody("it", BodyShape(kind, SHAPES[kind]), pose, ()))
    a, b, c, d = np.moveaxis(mesh.faces, 1, 0)
    volume = np.sum(a * np.cross(b, c) + a * np.cross(c, d)) / 6
    assert volume == pytest.approx(VOLUMES[kind], rel=0.03)


@pytest.mark.parametrize("kind", ["hoop", "wheel", "rod", "racquet"])
def test_other_shapes_have_their_size(kind):
    size = {"hoop": (0.3, 0.02), "wheel": (0.3, 0.02), "rod": (0.5, 0.02)}
    pose = Pose(np.zeros((1, 3)), np.array([[0, 0, 0, 1.0]]), np.zeros(0), (0, 0, 1))
    shape = BodyShape(kind, size.get(kind, (0.7, 0.25, 0.02)))
    mesh = body_mesh(SceneBody("it", shape, pose, ((0.0, 0.0, 0.1),)))
    across = np.ptp(mesh.faces.reshape(-1, 3), axis=0)
    wanted = {"hoop": 0.6, "wheel": 0.6, "rod": 0.5, "racquet": 0.7}[kind]
    assert np.max(across) == pytest.approx(wanted, rel=0.15)


def test_poses_between_frames():
    rows = np.array([[0.0, 1.0], [2.0, 5.0], [4.0, 9.0]])
    np.testing.assert_allclose(between(rows, 1.5), [3, 7])
    np.testing.assert_allclose(between(rows, 2.0), [4, 9])
    np.testing.assert_allclose(between(rows[:1], 2.0), [0, 1])
    about_3 = np.array([[0, 0, 0, 1], [0, 0, np.sin(0.3), np.cos(0.3)]])
    half_way = turn_at(Pose(np.zeros((1, 3)), about_3, np.array([0, 0.2]), (0, 0, 1)), 0.5)
    np.testing.assert_allclose(half_way @ [1, 0, 0], [np.cos(0.4), np.sin(0.4), 0])


@pytest.mark.parametrize("name", ["rolling-disk", "gyroscope", "ball-on-paper", "tennis-racquet"])
def test_the_whole_path_is_in_the_picture(run_of, name):
    """Of what is left in space, all along the motion; on a disk's circle of two metres too."""
    shown = ph.scene(run_of(name))
    paths = np.concatenate([trace.points for trace in shown.traces if trace.support < 0])
    for frame in (0.0, shown.frames - 1.0):
        flat = camera_of(shown, frame).project(paths[np.isfinite(paths).all(axis=1)])
        assert np.max(np.abs(flat)) < 1
        assert np.max(np.abs(flat)) > 0.2  # and not far away


def test_the_spokes_of_a_wheel_end_at_its_rim():
    radius, height = 1.0, 0.06
    mesh = _wheel(radius, height)
    spokes = np.array([c in ("#9aa3ad", "#e0672b") for c in mesh.colours])
    out = np.linalg.norm(np.mean(mesh.faces, axis=1)[:, :2], axis=1)
    inside = radius - 2 * 0.045 * radius
    rim = out > inside
    assert np.max(out[spokes & ~rim]) < inside
    assert {c for c, far in zip(mesh.colours, rim, strict=True) if far} == {
        *("#f3e9d2", "#2f6f9f", "#e0672b")
    }

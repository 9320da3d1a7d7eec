"""Stills and movies of a motion, made without a screen and without WebGL."""

from __future__ import annotations

import io
import json
import tempfile
from collections.abc import Callable, Collection, Iterator
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode.base import TIME, DeclarationError, NumericError, StoreError, Value, to_si, write_whole
from polhode.simulate import Trajectory
from polhode.view._scene import Scene
from polhode.view._scene_build import scene
from polhode.view.figures import new_figure, save_figure
from polhode.view.stills._picture import ARROWS, SKY, picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from PIL.Image import Image


_WIDEST = 10_000  # pixels
_LONGEST = 5_000  # frames of a movie
_DOTS = 100  # per inch
_SMOOTH = 2  # a movie is drawn at twice its size and reduced, which smooths edges
_GIF_LEAST, _GIF_MOST = 0.01, 50  # frames per second


def still(
    run: Trajectory | Scene,
    path: str | Path,
    *,
    time: Value = 0.0,
    size: tuple[int, int] = (800, 520),
    arrows: Collection[str] = (),
) -> None:
    """Write a picture of a motion at an instant, as PNG, SVG or PDF by the ending of the name.

    The view is the initial one of the page. An existing file is replaced only once the new one
    is complete.

    Args:
        run: the motion, or a scene of it.
        path: of the file.
        time: s.
        size: width and height, pixels.
        arrows: kinds of arrows to draw: force, load, torque, omega, momentum.

    Raises:
        DeclarationError: for an unknown kind of arrow.
        NumericError: for a time outside the motion, or a size that cannot be drawn.
        StoreError: for another ending, or where the file cannot be written.
    """
    target = Path(path)
    wide_high, drawn = _pixels(size), _kinds(arrows)
    seconds = to_si(time, TIME, "time")
    shown = _scene(run)
    if not 0 <= seconds <= shown.duration:
        raise NumericError(
            f"{seconds:g} s is outside the motion",
            expected=f"a time from 0 to {shown.duration:g} s",
        )
    frame = seconds / shown.duration * (shown.frames - 1)
    figure = _drawn(shown, frame, wide_high, drawn)
    save_figure(figure, target, origin=json.dumps(dict(shown.origin), sort_keys=True))


def movie(
    run: Trajectory | Scene,
    path: str | Path,
    *,
    speed: float = 1.0,
    rate: float = 25.0,
    size: tuple[int, int] = (640, 400),
    arrows: Collection[str] = (),
) -> None:
    """Write a motion as a movie, GIF or MP4 by the ending of the name.

    MP4 is encoded by ffmpeg, which comes with the extra `movie`.

    Args:
        run: the motion, or a scene of it.
        path: of the file.
        speed: seconds of motion in a second of the movie.
        rate: frames per second.
        size: width and height, pixels; even numbers.
        arrows: kinds of arrows to draw: force, load, torque, omega, momentum.

    Raises:
        DeclarationError: for an unknown kind of arrow.
        NumericError: for a speed or rate that is not positive, for more than some thousands of
            frames, or a size that cannot be drawn.
        StoreError: for another ending, where ffmpeg is not there, or where the file cannot be
            written.
    """
    target = Path(path)
    write = _WRITERS.get(target.suffix.lower())
    if write is None:
        raise StoreError(
            f"cannot write a movie as {target.name}", expected="a name that ends in .gif or .mp4"
        )
    wide_high, drawn = _pixels(size), _kinds(arrows)
    count = _count_of_frames(run.duration, speed, rate)
    shown = _scene(run)
    instants = np.arange(count) / count * (shown.frames - 1)
    images = (_image(shown, float(frame), wide_high, drawn) for frame in instants)
    write_whole(target, write(images, rate, wide_high))


def _scene(run: Trajectory | Scene) -> Scene:
    return run if isinstance(run, Scene) else scene(run)


def _drawn(shown: Scene, frame: float, size: tuple[int, int], arrows: Collection[str]) -> Figure:
    width, height = size
    figure = new_figure(height / _DOTS, width / _DOTS)
    figure.set_layout_engine("none")
    figure.set_facecolor(SKY)
    picture(shown, frame, figure.add_axes((0.0, 0.0, 1.0, 1.0)), arrows)
    return figure


def _image(shown: Scene, frame: float, size: tuple[int, int], arrows: Collection[str]) -> Image:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    figure = _drawn(shown, frame, size, arrows)
    figure.set_dpi(_SMOOTH * _DOTS)
    canvas: Any = FigureCanvasAgg(figure)
    canvas.draw()
    large = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    return large.resize(size, Image.Resampling.LANCZOS)


def _gif(images: Iterator[Image], rate: float, size: tuple[int, int]) -> bytes:
    from PIL import Image

    if not _GIF_LEAST <= rate <= _GIF_MOST:
        raise NumericError(
            f"a rate of {rate:g} frames per second for a GIF",
            expected=f"{_GIF_LEAST} to {_GIF_MOST}, which browsers play at the right speed",
            advice="write an .mp4, or choose another rate",
        )
    first, *others = (image.quantize(128, dither=Image.Dither.NONE) for image in images)
    ends = np.rint(np.arange(len(others) + 2) * 100 / rate).astype(int)  # GIFs count 1/100 s
    buffer = io.BytesIO()
    first.save(
        buffer,
        "GIF",
        save_all=True,
        append_images=others,
        duration=[10 * int(n) for n in np.diff(ends)],
        loop=0,
    )
    return buffer.getvalue()


def _mp4(images: Iterator[Image], rate: float, size: tuple[int, int]) -> bytes:
    try:
        from imageio_ffmpeg import write_frames
    except ImportError as error:
        raise StoreError(
            "an MP4 needs ffmpeg, which is not installed",
            expected="the extra `movie`",
            advice="pip install 'polhode[movie]', or write a .gif",
        ) from error
    with tempfile.TemporaryDirectory(prefix="polhode-movie-") as folder:
        path = Path(folder) / "movie.mp4"
        sink = write_frames(path, size, fps=rate, quality=7, macro_block_size=2)
        sink.send(None)
        for image in images:
            sink.send(image.tobytes())
        sink.close()
        return path.read_bytes()


_WRITERS: dict[str, Callable[[Iterator[Image], float, tuple[int, int]], bytes]] = {
    ".gif": _gif,
    ".mp4": _mp4,
}


# --- arguments, checked before anything is drawn ---


def _pixels(size: tuple[int, int]) -> tuple[int, int]:
    """Width and height that can be drawn.

    Raises:
        NumericError: for anything but two whole numbers from 1 to some thousands.
    """
    whole = [n for n in size if isinstance(n, int) and 0 < n <= _WIDEST]
    if len(whole) != 2 or len(size) != 2:
        raise NumericError(
            f"a picture of {size} pixels",
            expected=f"width and height, whole numbers from 1 to {_WIDEST}",
        )
    return whole[0], whole[1]


def _kinds(arrows: Collection[str]) -> frozenset[str]:
    """Kinds of arrows, given by one name or by several.

    Raises:
        DeclarationError: for an unknown kind.
    """
    kinds = frozenset([arrows] if isinstance(arrows, str) else arrows)
    unknown = sorted(kinds - set(ARROWS))
    if unknown:
        raise DeclarationError(
            f"no arrows are called {', '.join(map(repr, unknown))}",
            expected=f"some of {', '.join(ARROWS)}",
        )
    return kinds


def _count_of_frames(duration: float, speed: float, rate: float) -> int:
    """How many frames show a motion of this duration, s.

    Raises:
        NumericError: for a speed or rate that is not positive, or for too many frames.
    """
    if not (speed > 0 and rate > 0 and isfinite(rate)):
        raise NumericError(
            f"a speed of {speed} at {rate} frames per second", expected="positive numbers"
        )
    frames = duration / speed * rate
    if frames > _LONGEST:
        raise NumericError(
            f"the movie would have {frames:.3g} frames",
            expected=f"at most {_LONGEST}",
            advice=f"choose a higher speed than {speed:g}, or a lower rate than {rate:g}",
        )
    return max(2, round(frames))

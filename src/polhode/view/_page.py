"""A motion as one file: a page that plays it, from disk, with no network."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Mapping
from functools import cache
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from typing import Any

from polhode.base import StoreError, write_whole
from polhode.simulate import Trajectory
from polhode.view._html import Markup, document, json_element, tag
from polhode.view._judgement import Judgement
from polhode.view._live import live_document
from polhode.view._mathml import styled
from polhode.view._packed import packed, packed_scene
from polhode.view._quantities import Groups
from polhode.view._scene import Scene
from polhode.view._scene_build import scene

_OPENING = 121  # frames of the motion that a live page opens with, until it has computed it itself
_FRONT_END = "built"  # folder beside this file that the package's build fills

_ALLOWED = (
    "default-src 'none'; script-src {scripts}; style-src 'unsafe-inline'; img-src data: blob:; "
    "base-uri 'none'; form-action 'none'"
)
# A live page runs its kernels, in a worker that is made from the page itself.
_COMPUTES = " 'wasm-unsafe-eval'"
_WORKS = "; worker-src blob:"


def page(
    run: Trajectory,
    path: str | Path,
    *,
    title: str = "",
    about: str = "",
    plots: Groups = (),
    meanings: Mapping[str, str] | None = None,
    judgements: Iterable[Judgement] = (),
    live: bool = False,
    written: Mapping[str, str] | None = None,
    duration: float | None = None,
    presets: Mapping[str, Mapping[str, float]] | None = None,
) -> None:
    """Write a page that plays a motion: one file that works from disk without a network.

    It shows the bodies in three dimensions, forces and other vectors as arrows, plots that follow
    the same clock, the equations, parameters and the evidence. An existing file is replaced only
    once the new one is complete.

    A live page has sliders besides, and integrates the equations itself: in the contact mode that
    the motion starts in, up to the first instant at which a contact would slip, stick, lift off or
    touch down. It opens with the motion that it was made with, in all its contact modes.

    Args:
        run: the motion.
        path: of the file.
        title: heading; the system's name by default.
        about: the problem in a few sentences.
        plots: names of quantities to plot, or groups of names; by default coordinates, speeds
            and reactions.
        meanings: of parameters, in words, by name.
        judgements: verdicts on claims about the system.
        live: whether the page can compute other motions.
        written: of a live page, how parameters and start values were written, by name, such as
            {"a": "30 mm", "I": "m*a**2/2"}: sliders take these units, and a parameter that is a
            formula follows the others. SI units by default, degrees for angles.
        duration: of the motions that a live page computes, s; by default that of `run`, which is
            shorter than requested where it ended at an event.
        presets: of a live page, further motions to choose from: for each title or question values
            of parameters, of coordinates and speeds at the start, and of the duration, by name,
            SI. What is not named is as in `run`.

    Raises:
        DeclarationError: for the name of a quantity that the run does not have; of a live page,
            for a motion that it cannot compute by itself, with the reason.
        StoreError: if the file cannot be written.
    """
    shown = scene(
        run,
        title=title,
        about=about,
        plots=plots,
        meanings=meanings,
        judgements=judgements,
        frames=_OPENING if live else None,
    )
    alive = live_document(run, shown, written or {}, duration, presets or {}) if live else None
    write_whole(Path(path), page_of(shown, alive).encode("utf-8"))


def page_of(shown: Scene, live: Mapping[str, Any] | None = None) -> str:
    """A scene as the text of a page.

    Args:
        live: what the page needs to compute other motions (`live_document`).
    """
    name = "live" if live else "page"
    script, worker = front_end(f"{name}.js"), front_end("worker.js") if live else ""
    works = front_end("LICENSES.live.txt" if live else "LICENSES.txt")
    licences = works.replace("--", "- -")  # which would end the comment
    return document(
        shown.title,
        styled(front_end(f"{name}.css")),
        tag("noscript", tag("p", "This page needs its script to play a motion; please allow it.")),
        scene_element(shown),
        *([json_element("live", packed({"live": live, "worker": worker}))] if live else []),
        tag("script", Markup(script)),
        Markup(f"<!--\nThe script contains these works:\n\n{licences}\n-->"),
        head=[policy(digest(script), computes=bool(live))],
    )


def scene_element(shown: Scene) -> Markup:
    """The element of a page that holds its scene."""
    return json_element("scene", packed_scene(shown))


def digest(script: str) -> str:
    """A script as the policy of a page names it."""
    return f"'sha256-{b64encode(sha256(script.encode()).digest()).decode('ascii')}'"


def policy(scripts: str, *, computes: bool = False) -> Markup:
    """The element by which only these scripts may run in a page, and nothing is fetched.

    Args:
        scripts: as the policy names them.
        computes: whether the page runs kernels of its own, in WebAssembly and a worker.
    """
    content = _ALLOWED.format(scripts=scripts + (_COMPUTES if computes else ""))
    content += _WORKS if computes else ""
    return tag("meta", http_equiv="Content-Security-Policy", content=content)


@cache
def front_end(name: str) -> str:
    """A part of the front end, as the build of the package made it.

    Raises:
        StoreError: where the package was installed without it.
    """
    try:
        return files("polhode.view").joinpath(_FRONT_END, name).read_text("utf-8").strip()
    except OSError as error:
        raise StoreError(
            f"{name}, a part of the front end of pages, is missing",
            expected="a package whose front end was built when it was installed",
            advice="install polhode again; from a checkout, run python build_frontend.py",
        ) from error

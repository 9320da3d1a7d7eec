"""Several scenes in a page of words, of which one at a time is played in a frame."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from polhode.view._html import Markup, json_element, tag
from polhode.view._packed import packed_scene
from polhode.view._page import digest, front_end, page_of, policy, scene_element
from polhode.view._scene import Scene


@dataclass(frozen=True)
class SceneFrame:
    """What a page needs to play scenes.

    Attributes:
        head: for its head: the policy by which only these scripts run and nothing is fetched.
        body: for the end of its body.
    """

    head: tuple[Markup, ...]
    body: tuple[Markup, ...]


def scene_frame(scenes: Mapping[str, Scene]) -> SceneFrame:
    """Elements that play scenes where their buttons (`scene_button`) stand.

    The front end, which is heavy, stands in the page once; without a scene it is left out, and no
    script at all runs in the page.

    Args:
        scenes: by the names that the buttons give.
    """
    if not scenes:
        return SceneFrame((policy("'none'"),), ())
    script = front_end("frame.js")
    first = next(iter(scenes.values()))
    # All pages of scenes are the same but for the element with the scene, and their title.
    page = page_of(first)
    before, after = page.split(scene_element(first))
    player = {"before": re.sub("<title>.*?</title>", "", before, flags=re.DOTALL), "after": after}
    # A frame made from text inherits the policy of its page, so both scripts are named.
    scripts = f"{digest(script)} {digest(front_end('page.js'))}"
    body = (
        json_element("scenes", {name: packed_scene(scene) for name, scene in scenes.items()}),
        json_element("player", player),
        tag("script", Markup(script)),
    )
    return SceneFrame((policy(scripts),), body)


def scene_button(name: str, label: str, title: str) -> Markup:
    """The button that plays a scene behind itself, or ends it; hidden where no script runs.

    Args:
        name: of the scene.
        label: on the button.
        title: of the frame, for those who cannot see it.
    """
    attributes = {"type": "button", "hidden": "", "aria_expanded": "false"}
    return tag("button", label, **attributes, data_scene=name, data_title=title)

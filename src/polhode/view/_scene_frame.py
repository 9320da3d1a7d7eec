"""Several scenes in a page of words, of which one at a time is played in a frame."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256

from polhode.view._html import Markup, json_element, tag
from polhode.view._page import front_end, page_of
from polhode.view._scene import Scene

_POLICY = (
    "default-src 'none'; script-src {scripts}; style-src 'unsafe-inline'; img-src data: blob:; "
    "base-uri 'none'; form-action 'none'"
)
_DIGEST = re.compile(r"script-src ('sha256-[A-Za-z0-9+/=]+')")


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
        return SceneFrame((_policy("'none'"),), ())
    script = front_end("frame.js")
    first = next(iter(scenes.values()))
    # All pages of scenes are the same but for the element with the scene, and their title.
    page = page_of(first)
    before, after = page.split(json_element("scene", first.as_json()))
    player = {"before": re.sub("<title>.*?</title>", "", before, flags=re.DOTALL), "after": after}
    digest = f"'sha256-{b64encode(sha256(script.encode()).digest()).decode('ascii')}'"
    found = _DIGEST.search(before)
    # A frame made from text inherits the policy of its page, so both scripts are named.
    scripts = f"{digest} {found[1]}" if found else digest
    body = (
        json_element("scenes", {name: scene.as_json() for name, scene in scenes.items()}),
        json_element("player", player),
        tag("script", Markup(script)),
    )
    return SceneFrame((_policy(scripts),), body)


def scene_button(name: str, label: str, title: str) -> Markup:
    """The button that plays a scene behind itself, or ends it; hidden where no script runs.

    Args:
        name: of the scene.
        label: on the button.
        title: of the frame, for those who cannot see it.
    """
    attributes = {"type": "button", "hidden": "", "aria_expanded": "false"}
    return tag("button", label, **attributes, data_scene=name, data_title=title)


def _policy(scripts: str) -> Markup:
    content = _POLICY.format(scripts=scripts)
    return tag("meta", http_equiv="Content-Security-Policy", content=content)

"""Bodies are in the picture: their spheres, projected with the camera that the page has."""

import json

import numpy as np
import pytest

from pages import unpacked
from polhode.catalogue import CATALOGUE, cases_of
from polhode.cli import main

#: Matrices of the camera, by columns, as three.js keeps them.
CAMERA = """() => {
  const { camera } = document.querySelector(".picture canvas");
  return [camera.projectionMatrix.elements, camera.matrixWorldInverse.elements];
}"""

#: Of the first size of shapes that it is not the radius of.
HALVES = {"racquet": 0.6, "rod": 0.5, "box": 0.87}


def projected(camera, place, radius):
    """Where a sphere appears, from -1 to 1 to either side: middle, and half its height."""
    projection, view = (np.reshape(elements, (4, 4)).T for elements in camera)
    x, y, z, _ = view @ [*place, 1]
    flat = projection @ [x, y, z, 1]
    return flat[:2] / flat[3], projection[1, 1] * radius / -z


def is_in_view(camera, place, radius):
    middle, half = projected(camera, place, radius)
    aspect = camera[0][5] / camera[0][0]
    sizes = np.array([half / aspect, half])
    return half > 0 and bool(np.all(np.abs(middle) + sizes < 1.0))


MOTIONS = [
    (entry.name, case)
    for entry in CATALOGUE.values()
    for case in ("", *(case.name for case in cases_of(entry)))
]


@pytest.mark.parametrize(("name", "case"), MOTIONS)
def test_the_first_picture_has_the_body_in_view(opened, tmp_path, name, case):
    """And the last one, of the table that a sheet was pulled from as well."""
    path = tmp_path / "page.html"
    asked = ["run", name, "--page", str(path), *(["--case", case] if case else [])]
    assert main(asked) == 0
    with opened(path) as shown:
        scene = unpacked(json.loads(shown.page.locator("#scene").text_content()))
        slider = shown.page.get_by_role("slider", name="Time")
        for share in (0, 0.37, 1):
            slider.fill(str(round(share * 2000)))
            shown.page.wait_for_timeout(100)
            camera = shown.page.evaluate(CAMERA)
            for body in scene["bodies"]:
                places = body["pose"]["place"]
                place = places[round(share * (len(places) - 1))]
                shape = body["shape"]
                radius = HALVES.get(shape["kind"], 1.0) * shape["size"][0]
                assert is_in_view(camera, place, radius), (share, body["name"])
        assert shown.page.locator(".plot canvas").count() > 0
        assert shown.page.locator("math").count() > 3
        assert shown.requests == [path.as_uri()]
        assert shown.complaints == []

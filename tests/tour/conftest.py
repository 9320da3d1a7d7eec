from types import SimpleNamespace

import pytest

import polhode as ph
from polhode.base import SilentProgress
from polhode.catalogue import PROBLEM_SET
from polhode.tour import write_tour
from polhode.tour._work import default_run


@pytest.fixture(scope="session")
def worked_out():
    """Equations and default run of a system, computed once."""
    known = {}

    def parts(name):
        if name not in known:
            equations = ph.derive(PROBLEM_SET[name].build())
            known[name] = equations, default_run(PROBLEM_SET[name], equations)
        return known[name]

    return parts


@pytest.fixture(scope="session")
def tour(tmp_path_factory):
    """The whole tour with a few claims, made once: its folder, pages, report and output."""
    folder = tmp_path_factory.mktemp("tour") / "deep" / "tour"
    printed = []
    report = write_tour(folder, SilentProgress(), printed.append, only=("1", "8", "85"))
    texts = {path.stem: path.read_text("utf-8") for path in folder.glob("*.html")}
    pages = {name: text for name, text in texts.items() if not name.endswith("-3d")}
    return SimpleNamespace(folder=folder, pages=pages, report=report, printed=printed)

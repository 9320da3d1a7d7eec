"""Layers: which package may import which, that no imports form a circle, and what is never called.

Every file is parsed and none is imported. Made-up source text then shows that the rules detect what
they forbid.
"""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from pathlib import Path, PurePosixPath
from types import ModuleType

import pytest

import polhode
from polhode import base

PACKAGE = Path(__file__).parents[1] / "src" / "polhode"

LAYERS = {
    "cli": 12,
    "lab": 11,
    "tour": 11,
    "exercise": 11,
    "solution": 10,
    "judge": 9,
    "catalogue": 8,
    "view": 7,
    "study": 6,
    "simulate": 5,
    "analyse": 4,
    "derive": 3,
    "model": 2,
    "algebra": 1,
    "base": 0,
}
FRONT = {"__init__.py": set(LAYERS), "__main__.py": {"cli"}}  # the modules of polhode itself
MAY_IMPORT_POLHODE = {"catalogue", "lab", "tour", "cli"}
HEAVY = {"numpy", "sympy", "scipy", "matplotlib", "heyoka", "pandas", "pint"}

RUN_TEXT = {"eval", "exec", "sympify", "parse_expr"}
BUILTINS = {"eval", "exec"}  # harmless as the names of methods
PICKLES = {"pickle", "cloudpickle", "dill"}
UNPICKLE = {"load", "loads", "Unpickler"}
OPTION = re.compile(r"(?<![\w(-])--(?!polhode-math)[a-z]{2,}")
UNKNOWN = "a name that only the running program knows"


@dataclass(frozen=True)
class Source:
    """A module: its path below ``polhode/`` and its text."""

    place: PurePosixPath
    text: str

    @property
    def layer(self) -> str:
        """The package that it belongs to; empty for the modules of polhode itself."""
        return self.place.parts[0] if len(self.place.parts) > 1 else ""

    @property
    def package(self) -> list[str]:
        return ["polhode", *self.place.parts[:-1]]

    @property
    def module(self) -> list[str]:
        return self.package + ([] if self.place.stem == "__init__" else [self.place.stem])

    @cached_property
    def nodes(self) -> list[ast.AST]:
        return list(ast.walk(ast.parse(self.text)))


SOURCES = [
    Source(PurePosixPath(path.relative_to(PACKAGE).as_posix()), path.read_text("utf-8"))
    for path in sorted(PACKAGE.rglob("*.py"))
]


# --- what a file imports ---


def imports(source: Source) -> Iterator[str]:
    """All that a file imports, wherever and however it does, as dotted names.

    "polhode" alone is the top-level package, which ``import polhode.x`` binds as well.
    """
    for node in source.nodes:
        match node:
            case ast.Import():
                yield from map(bound, node.names)
            case ast.ImportFrom(module="importlib" | "builtins"):
                yield from (UNKNOWN for alias in node.names if alias.asname and by_name(alias.name))
            case ast.ImportFrom():
                yield ".".join(origin(source, node))
            case ast.Call(func=ast.Name(id=called) | ast.Attribute(attr=called)) if by_name(called):
                yield computed(source, node)


def bound(alias: ast.alias) -> str:
    return alias.name if alias.asname else alias.name.split(".")[0]


def by_name(function: str) -> bool:
    return function in ("import_module", "__import__")


def origin(source: Source, node: ast.ImportFrom) -> list[str]:
    below = node.module.split(".") if node.module else []
    return source.package[: len(source.package) + 1 - node.level] + below if node.level else below


def computed(source: Source, call: ast.Call) -> str:
    """What a call imports, if its text determines at least the package or the library."""
    given = [*call.args[:1], *(word.value for word in call.keywords if word.arg == "name")]
    pieces = given[0].values if given and isinstance(given[0], ast.JoinedStr) else given
    start = ""
    for piece in pieces:
        match piece:
            case ast.Constant(value=str(text)):
                start += text
            case ast.FormattedValue(value=ast.Name(id="__name__")) if not start:
                start = ".".join(source.module)
            case ast.FormattedValue(value=ast.Name(id="__package__")) if not start:
                start = ".".join(source.package)
            case _:
                return start if is_determined(start) else UNKNOWN
    return absolute(source, start)


def is_determined(start: str) -> bool:
    return start.count(".") >= (2 if start.startswith("polhode") else 1) and start[0] != "."


def absolute(source: Source, name: str) -> str:
    below = name.lstrip(".")
    level = len(name) - len(below)
    return ".".join([*source.package[: len(source.package) + 1 - level], below]) if level else name


# --- the rules: what is wrong with a file ---


def wrong_layers(source: Source) -> Iterator[str]:
    """Imports go to lower layers, never up or sideways, and seldom to polhode itself."""
    if source.layer and source.layer not in LAYERS:
        yield f"{source.layer} is not in the table of layers"
        return
    for name in imports(source):
        library, _, target = name.partition(".")
        hidden = name == UNKNOWN and source.layer
        if hidden or (library == "polhode" and not may(source, target)):
            yield f"imports {name}"


def may(source: Source, target: str) -> bool:
    package, _, inner = target.partition(".")
    if not source.layer:
        return package in FRONT.get(source.place.name, set()) and not inner
    if not package:
        return source.layer in MAY_IMPORT_POLHODE
    if package == source.layer:
        return True
    private = any(part.startswith("_") for part in inner.split("."))
    return package in LAYERS and LAYERS[package] < LAYERS[source.layer] and not private


def runs_text(source: Source) -> Iterator[str]:
    """No text is run as a program or unpickled, under whatever name the function is fetched."""
    for node in source.nodes:
        match node:
            case ast.Name(id=name) if name in RUN_TEXT:
                yield f"uses {name}"
            case ast.Attribute(value=ast.Name(id=owner), attr=name) if dangerous(owner, name):
                yield f"uses {owner}.{name}"
            case ast.Attribute(attr=name) if name in RUN_TEXT - BUILTINS:
                yield f"uses {name}"
            case ast.ImportFrom(module=owner, names=names):
                yield from (
                    f"imports {alias.name} from {owner}"
                    for alias in names
                    if dangerous(owner or "", alias.name) or alias.name in RUN_TEXT
                )
            case ast.Import(names=names):
                yield from (
                    f"renames {alias.name}"
                    for alias in names
                    if alias.asname and alias.name in {*PICKLES, "builtins"}
                )


def dangerous(owner: str, name: str) -> bool:
    return (owner in PICKLES and name in UNPICKLE) or (owner == "builtins" and name in BUILTINS)


RULES = [wrong_layers, runs_text]


# --- circles ---


def imported_modules(source: Source, known: set[str]) -> set[str]:
    """The modules among those known that it imports, inside functions too, as dotted names."""
    found = set()
    for node in source.nodes:
        if isinstance(node, ast.ImportFrom):
            base = ".".join(origin(source, node))
            names = (f"{base}.{alias.name}" for alias in node.names)
            found |= {name if name in known else base for name in names} & known
    return found - {".".join(source.module)}


def modules_imported(sources: list[Source]) -> dict[str, set[str]]:
    """For every module, what it imports; packages as such, which only re-export, are left out."""
    modules = {".".join(s.module): s for s in sources if s.place.name != "__init__.py"}
    return {name: imported_modules(source, set(modules)) for name, source in modules.items()}


def folders_imported(modules: dict[str, set[str]]) -> dict[str, set[str]]:
    """The same between folders of which neither contains the other."""
    found: dict[str, set[str]] = {}
    for name, others in modules.items():
        folder = name.rpartition(".")[0]
        targets = {other.rpartition(".")[0] for other in others} - {folder}
        nested = {
            t for t in targets if f"{folder}.".startswith(f"{t}.") or t.startswith(f"{folder}.")
        }
        found.setdefault(folder, set()).update(targets - nested)
    return found


def circle(graph: dict[str, set[str]]) -> list[str]:
    """A circle of imports, if there is one."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


@pytest.mark.parametrize(
    "level", [lambda modules: modules, folders_imported], ids=["files", "folders"]
)
def test_no_imports_form_a_circle(level):
    assert circle(level(modules_imported(SOURCES))) == []


def test_a_circle_is_found_inside_functions_and_between_folders():
    texts = {
        "model/_a.py": "from polhode.model import _b",
        "model/_b.py": "def f():\n    from polhode.model._a import A",
        "judge/x/_c.py": "from polhode.judge.y._d import D",
        "judge/y/_d.py": "x = 1",
        "judge/y/_e.py": "from ..x._f import F",
        "judge/x/_f.py": "x = 1",
    }
    modules = modules_imported([Source(PurePosixPath(p), text) for p, text in texts.items()])
    assert {"polhode.model._a", "polhode.model._b"} <= set(circle(modules))
    judge = {name: others for name, others in modules.items() if "judge" in name}
    assert circle(judge) == []
    assert set(circle(folders_imported(judge))) == {"polhode.judge.x", "polhode.judge.y"}


# --- the package as it is ---


@pytest.mark.parametrize("rule", RULES)
def test_every_file_keeps_the_rule(rule):
    assert [f"{source.place} {fault}" for source in SOURCES for fault in rule(source)] == []


def test_the_package_was_read():
    assert {"", *LAYERS} == {source.layer for source in SOURCES}


@pytest.mark.parametrize("module", ["polhode", "polhode.base"])
def test_importing_is_light(module):
    program = f"import sys, {module}; print(*sorted({HEAVY} & sys.modules.keys()))"
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert run.stdout.strip() == ""


def test_type_checkers_see_the_same_names_as_the_program():
    (front,) = [
        source for source in SOURCES if source.place.name == "__init__.py" and not source.layer
    ]
    declared = {
        alias.asname: node.module
        for node in front.nodes
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("polhode.")
        for alias in node.names
    }
    assert declared == polhode._HOME


def test_every_public_name_is_there():
    assert set(dir(polhode)) == set(polhode.__all__)
    for name in polhode.__all__:
        assert getattr(polhode, name) is not None


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="'polhode' has no attribute 'polehode'"):
        polhode.polehode  # noqa: B018


def test_a_package_does_not_hide_the_function_of_its_name(monkeypatch):
    monkeypatch.setitem(polhode._HOME, "exit_code", "polhode.base")
    polhode.exit_code = ModuleType("polhode.exit_code")  # as importing such a package would do
    assert polhode.exit_code is base.exit_code
    monkeypatch.delitem(vars(polhode), "exit_code")


# --- the rules detect what they forbid ---


def faults(place: str, text: str) -> list[str]:
    source = Source(PurePosixPath(place), text)
    return [fault for rule in RULES for fault in rule(source)]


@pytest.mark.parametrize(
    ("place", "text"),
    [
        ("algebra/_expr.py", "import polhode.model as m"),
        ("algebra/_expr.py", "from polhode.model import Body"),
        ("algebra/_expr.py", "def f():\n    from polhode.derive import derive"),
        ("algebra/_expr.py", "if TYPE_CHECKING:\n    from polhode.model import Body"),
        ("algebra/_expr.py", "from ..model import Body"),
        ("algebra/printing/_latex.py", "from ...model import Body"),
        ("algebra/_expr.py", "import importlib\nimportlib.import_module('polhode.model')"),
        ("algebra/_expr.py", "importlib.import_module('..model', __package__)"),
        ("algebra/_expr.py", "importlib.import_module(name='polhode.model')"),
        ("algebra/_expr.py", "import_module(f'polhode.model.{part}')"),
        ("algebra/_expr.py", "import_module(f'polhode.{package}')"),
        ("algebra/_expr.py", "import_module(name)"),
        ("algebra/_expr.py", "from importlib import import_module as load"),
        ("algebra/_expr.py", "__import__('polhode.model')"),
        ("judge/_read.py", "from polhode.solution import solution"),
        ("study/_sweep.py", "from polhode.judge import check"),
        ("lab/_serve.py", "from polhode.tour import page"),
        ("model/_body.py", "from polhode.algebra._expr import Expr"),
        ("model/_body.py", "import polhode"),
        ("model/_body.py", "import polhode as ph"),
        ("model/_body.py", "import polhode.algebra"),
        ("model/_body.py", "from polhode import Expr"),
        ("model/_body.py", "from polhode import algebra"),
        ("model/_body.py", "from .. import algebra"),
        ("model/_body.py", "from polhode.attic import box"),
        ("attic/_box.py", "x = 1"),
        ("helpers.py", "from polhode.base import UnitError"),
        ("__main__.py", "from polhode.view import page"),
        ("judge/_read.py", "eval(text)"),
        ("judge/_read.py", "run = exec"),
        ("judge/_read.py", "import builtins\nbuiltins.eval(text)"),
        ("judge/_read.py", "from builtins import eval as read"),
        ("judge/_read.py", "import sympy\nsympy.sympify(text)"),
        ("judge/_read.py", "from sympy.parsing.sympy_parser import parse_expr as read"),
        ("judge/_read.py", "import pickle\npickle.loads(data)"),
        ("judge/_read.py", "import pickle as p\np.loads(data)"),
        ("judge/_read.py", "from pickle import Unpickler"),
    ],
)
def test_a_breach_is_found(place, text):
    assert faults(place, text) != []


@pytest.mark.parametrize(
    ("place", "text"),
    [
        ("model/_body.py", "from polhode.algebra import Expr\nfrom polhode.base import UnitError"),
        ("model/_body.py", "import polhode.algebra as algebra"),
        ("model/_body.py", "from polhode.model._frame import Frame"),
        ("model/_body.py", "from ._frame import Frame\nfrom . import _frame"),
        ("model/__init__.py", "from ._frame import Frame"),
        ("algebra/printing/_latex.py", "from .._expr import Expr\nfrom ...base import UnitError"),
        ("model/__init__.py", "import_module(f'{__name__}._{part}')"),
        ("model/_body.py", "import_module(f'{__package__}._frame')"),
        ("model/_body.py", "import_module('._frame', __package__)"),
        ("model/_body.py", "import_module('numpy')\n__import__('scipy.linalg')"),
        ("catalogue/_coin.py", "import polhode as ph"),
        ("cli/_run.py", "import polhode\nimport_module(f'polhode.cli.{command}')"),
        ("__main__.py", "from polhode.cli import main"),
        ("__init__.py", "from polhode.view import page\nimport_module(_HOME[name])"),
        ("simulate/_send.py", "import pickle\npickle.dumps(system)"),
        ("algebra/_program.py", "program.eval(x)\nobj.loads(text)"),
    ],
)
def test_what_is_allowed_passes(place, text):
    assert faults(place, text) == []


def test_only_the_command_line_names_its_options():
    """A message reaches Python, the lab and the shell; only the last has options to advise."""
    for path in sorted(PACKAGE.rglob("*.py")):
        if path.parent.name == "cli":
            continue
        nodes = ast.walk(ast.parse(path.read_text("utf-8")))
        texts = (n.value for n in nodes if isinstance(n, ast.Constant) and isinstance(n.value, str))
        named = [t for t in texts if OPTION.search(t)]
        assert not named, f"{path.relative_to(PACKAGE)}: {named}"

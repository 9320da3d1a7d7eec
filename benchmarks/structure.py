"""How the package is built, in numbers: `python benchmarks/structure.py [FOLDER]`.

Counts files, lines, functions, private helpers with a single use, short modules, class names that
stand for more than one thing, and circles of imports, those inside functions included.
"""

from __future__ import annotations

import ast
import io
import sys
import tokenize
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from statistics import median

SHORT = 100  # lines of a module
FEW = 6  # lines of a helper
Function = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True)
class Module:
    """A file of the package, with its dotted name below it."""

    name: str
    text: str
    is_package: bool

    @cached_property
    def tree(self) -> ast.Module:
        return ast.parse(self.text)

    @cached_property
    def lines(self) -> int:
        return self.text.count("\n")

    @property
    def functions(self) -> Iterator[Function]:
        return (node for node in ast.walk(self.tree) if isinstance(node, Function))

    @property
    def classes(self) -> Iterator[str]:
        return (node.name for node in self.tree.body if isinstance(node, ast.ClassDef))

    @cached_property
    def uses(self) -> Counter[str]:
        """How often names and attributes are read."""
        found = Counter[str]()
        for node in ast.walk(self.tree):
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
                found[node.id] += 1
            elif isinstance(node, ast.Attribute):
                found[node.attr] += 1
        return found

    def imports(self, known: set[str]) -> set[str]:
        """Modules of the package that it imports, wherever it does."""
        return {found for node in ast.walk(self.tree) for found in self._origins(node, known)}

    def _origins(self, node: ast.AST, known: set[str]) -> Iterator[str]:
        if not isinstance(node, ast.ImportFrom):
            return
        base = (node.module or "").split(".")
        if node.level:
            parts = self.name.split(".") if self.name else []
            package = parts if self.is_package else parts[:-1]
            base = [*package[: len(package) + 1 - node.level], *filter(None, base)]
        elif base[:1] == ["polhode"]:
            base = base[1:]
        else:
            return
        for alias in node.names:
            for dotted in (".".join([*base, alias.name]), ".".join(base)):
                if dotted in known:
                    yield dotted
                    break


def modules(folder: Path) -> list[Module]:
    """Every Python file below a folder."""
    found = []
    for path in sorted(folder.rglob("*.py")):
        parts = path.relative_to(folder).with_suffix("").parts
        is_package = parts[-1] == "__init__"
        name = ".".join(parts[:-1] if is_package else parts)
        found.append(Module(name, path.read_text("utf-8"), is_package))
    return found


def circles(graph: dict[str, set[str]]) -> list[set[str]]:
    """Strongly connected sets of more than one node (Tarjan, Depth-first search, 1972)."""
    order: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[set[str]] = []

    def visit(node: str) -> None:
        order[node] = low[node] = len(order)
        stack.append(node)
        for other in graph.get(node, ()):
            if other not in order:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], order[other])
        if low[node] == order[node]:
            at = stack.index(node)
            group = set(stack[at:])
            del stack[at:]
            if len(group) > 1:
                found.append(group)

    sys.setrecursionlimit(10_000)
    for node in graph:
        if node not in order:
            visit(node)
    return found


def between_folders(graph: dict[str, set[str]]) -> dict[str, set[str]]:
    """The same imports between folders, each file standing for the folder it is in."""
    found: dict[str, set[str]] = defaultdict(set)
    for name, others in graph.items():
        for other in others:
            one, two = (n.rpartition(".")[0] for n in (name, other))
            nested = one == two or one.startswith(f"{two}.") or two.startswith(f"{one}.")
            if one and two and not nested:
                found[one].add(two)
    return found


def single_use(every: list[Module]) -> tuple[int, int, int]:
    """Private functions, those of them with one use, and of these those of a few lines."""
    private = [(m, f) for m in every for f in m.functions if is_private(f)]
    once = [f for m, f in private if m.uses[f.name] == 1]
    few = [f for f in once if (f.end_lineno or f.lineno) - f.lineno < FEW]
    return len(private), len(once), len(few)


def comments(module: Module) -> int:
    """Comments, on lines of their own or behind code."""
    tokens = tokenize.generate_tokens(io.StringIO(module.text).readline)
    return sum(token.type == tokenize.COMMENT for token in tokens)


def is_private(function: Function) -> bool:
    """Whether its name says that nobody else calls it; `_` itself registers a method."""
    return (
        function.name.startswith("_")
        and not function.name.startswith("__")
        and function.name != "_"
    )


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "src/polhode")
    every = modules(folder)
    known = {m.name for m in every}
    graph = {m.name: m.imports(known) - {m.name} for m in every}
    fronts = {m.name for m in every if m.is_package}
    files = {n: {o for o in others if o not in fronts} for n, others in graph.items()}
    bodies = [(f.end_lineno or f.lineno) - f.lineno + 1 for m in every for f in m.functions]
    importers = Counter(o for others in graph.values() for o in others)
    names = Counter(name for m in every for name in m.classes)
    twice = sorted(name for name, count in names.items() if count > 1)
    private, once, few = single_use(every)
    lines = sum(m.lines for m in every)
    short = [m for m in every if m.lines < SHORT and not m.is_package]
    rows = [
        ("files", len(every)),
        ("lines", lines),
        ("functions", len(bodies)),
        ("median lines of a function", median(bodies)),
        ("private functions", private),
        (
            "of them with a single use",
            f"{once} ({100 * once / len(bodies):.0f} % of all functions), "
            f"{few} of at most {FEW} lines",
        ),
        ("comments per thousand lines", f"{1000 * sum(map(comments, every)) / lines:.0f}"),
        (f"modules under {SHORT} lines", len(short)),
        ("of them imported by one other module", sum(importers[m.name] == 1 for m in short)),
        ("class names used twice", len(twice)),
        ("circles of imports between files", [len(c) for c in circles(files)]),
        (
            "circles of imports between folders",
            [sorted(c) for c in circles(between_folders(files))],
        ),
    ]
    for what, count in rows:
        print(f"{what:38s} {count}")
    if twice:
        print(f"{'':38s} {' '.join(twice)}")


if __name__ == "__main__":
    main()

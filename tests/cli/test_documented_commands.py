"""The shell commands of README and docs are ones that the command line takes."""

import re
import shlex
from pathlib import Path

import pytest

from polhode.cli._main import COMMANDS, _parser

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"^(?:\$ |- run: )?polhode (.+)$", re.MULTILINE)
INLINE = re.compile(r"`polhode ([a-z][^`]*)`")


def commands():
    """Every command that a page shows, without its comment."""
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        text = page.read_text("utf-8")
        blocks = [block for kind, block in BLOCK.findall(text) if kind not in ("python", "text")]
        shown = [line for block in blocks for line in COMMAND.findall(block.replace("\\\n", " "))]
        shown += INLINE.findall(BLOCK.sub("", text))
        for line in shown:
            yield pytest.param(line, id=f"{page.stem}: {line}")


@pytest.mark.parametrize("line", list(commands()))
def test_a_documented_command_is_accepted(line):
    words = shlex.split(line, comments=True)
    assert words[0] in COMMANDS
    if len(words) > 1:  # a name alone, as in "polhode check", stands for the command
        _parser(words).parse_args(words)

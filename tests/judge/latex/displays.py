"""The displays of the problem set as its transcript prints them, by equation number.

What continues a display on the next lines belongs to it. Behind (79) the transcript repeats a
garbled line twelve times: these are "after 79, 1" and so on.
"""

from pathlib import Path

_BLOCKS = Path(__file__).with_name("displays.txt").read_text("utf-8").split("%% ")[1:]
DISPLAYS = dict(block.rstrip("\n").split("\n", 1) for block in _BLOCKS)
NUMBERED = {number: latex for number, latex in DISPLAYS.items() if number.isdigit()}

# Why the transcript's line cannot be read. The last of the twelve has lost its left edge, and can.
DESTROYED = {"66": "a square bracket closed by a round one"} | {
    f"after 79, {place}": "an index without its letter" for place in range(1, 12)
}

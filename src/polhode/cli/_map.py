"""Draw the results of a sweep over two quantities, with the exact thresholds of stability."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from polhode.cli._parser import Parser
from polhode.cli._printing import print_document
from polhode.study import found_in

_EXAMPLES = """examples:
  polhode map fates -o fates.png
  polhode map fates -o duration.svg --show duration
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    parser.add_argument(
        "store", metavar="STORE", type=Path, help="folder written by 'polhode sweep --out'"
    )
    parser.add_file("-o FILE", "figure to write: .png, .svg or .pdf", dest="file", required=True)
    parser.add_option("--show OUTPUT", "output to draw (default: the fate, if stored)")
    parser.add_json()


def run(options: Namespace) -> int:
    """Draw one map."""
    found = found_in(options.store, options.show)
    from polhode.view.figures import new_figure, outcome_map, save_figure

    figure = new_figure(3.4)
    drawn = outcome_map(found, ax=figure.add_subplot())
    save_figure(figure, options.file, origin=found.origin)
    if options.json:
        thresholds = [f"{t.family}: {t.condition} = 0" for t in found.thresholds]
        print_document(
            {"file": str(options.file), "output": found.output, "thresholds": thresholds}
        )
    else:
        print(f"{options.file}: {found.output} of {found.system}")
        for threshold in drawn.conditions:
            print(f"threshold of {threshold.family}: {threshold.condition} = 0")
    return 0

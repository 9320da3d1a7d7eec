"""The command line: one command per file."""

from polhode.cli._main import main as main

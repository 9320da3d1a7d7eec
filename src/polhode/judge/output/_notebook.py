"""Verdicts, reports and reviews as HTML for a notebook: importing this registers them."""

from polhode.judge.output import _audit_page, _page  # noqa: F401  # they register themselves
from polhode.view import html_of as html_of

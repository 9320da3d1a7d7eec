"""Derivations reviewed as they stand: a mark for every relation, with its evidence.

The code that writes pages is imported on first use, since a review on the terminal needs none.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from polhode.review._review import review as review
from polhode.review._review import review_files as review_files
from polhode.review._reviewed import Mark as Mark
from polhode.review._reviewed import Review as Review
from polhode.review._reviewed import ReviewedLine as ReviewedLine
from polhode.review.output._github import github_annotations as github_annotations
from polhode.review.output._hints import Hints as Hints
from polhode.review.output._hints import with_hints as with_hints
from polhode.review.output._messages import SIGNS as SIGNS
from polhode.review.output._messages import TITLES as TITLES
from polhode.review.output._messages import message_parts as message_parts
from polhode.review.output._messages import sentence as sentence
from polhode.review.output._sarif import sarif as sarif
from polhode.review.output._sarif import write_sarif as write_sarif
from polhode.review.text._systems_of_text import named_system as named_system
from polhode.review.text._systems_of_text import proposed_systems as proposed_systems

if TYPE_CHECKING:
    from polhode.review.output._page import review_html as review_html
    from polhode.review.output._page import review_page as review_page
    from polhode.review.output._page import typesettables as typesettables
    from polhode.review.output._referee import referee_html as referee_html
    from polhode.review.output._referee import referee_report as referee_report
    from polhode.view import html_of as html_of

_LATE = {
    "html_of": "output._page",
    "referee_html": "output._referee",
    "referee_report": "output._referee",
    "review_html": "output._page",
    "review_page": "output._page",
    "typesettables": "output._page",
}


def __getattr__(name: str) -> Any:
    if name not in _LATE:
        raise AttributeError(f"module 'polhode.review' has no attribute {name!r}")
    found = getattr(import_module(f"polhode.review.{_LATE[name]}"), name)
    globals()[name] = found
    return found

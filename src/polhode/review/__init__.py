"""Derivations reviewed as they stand: a mark for every relation, with its evidence."""

from polhode.review._github import github_annotations as github_annotations
from polhode.review._hints import Hints as Hints
from polhode.review._hints import with_hints as with_hints
from polhode.review._reviewed import Mark as Mark
from polhode.review._reviewed import Review as Review
from polhode.review._reviewed import ReviewedLine as ReviewedLine
from polhode.review._sarif import sarif as sarif
from polhode.review._sarif import write_sarif as write_sarif

"""Derivations reviewed as they stand: a mark for every relation, with its evidence."""

from polhode.review._review import review as review
from polhode.review._review import review_files as review_files
from polhode.review._reviewed import Mark as Mark
from polhode.review._reviewed import Review as Review
from polhode.review._reviewed import ReviewedLine as ReviewedLine
from polhode.review._systems_of_text import named_system as named_system
from polhode.review._systems_of_text import proposed_systems as proposed_systems

"""Marks served to learning platforms: an answer or a derivation in, marks and feedback out."""

from polhode.review.service._serve import serve_marks as serve_marks
from polhode.review.service._settings import ServiceSettings as ServiceSettings

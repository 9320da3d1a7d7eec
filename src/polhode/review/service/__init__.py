"""Marks served to learning platforms: an answer or a derivation in, marks and feedback out."""

from polhode.review.service._answer import AnswerTask as AnswerTask
from polhode.review.service._answer import MarkedAnswer as MarkedAnswer
from polhode.review.service._answer import marked_answer as marked_answer
from polhode.review.service._serve import serve_marks as serve_marks
from polhode.review.service._settings import ServiceSettings as ServiceSettings

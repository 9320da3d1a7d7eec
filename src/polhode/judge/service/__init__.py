"""Marks served to learning platforms: an answer or a derivation in, marks and feedback out."""

from polhode.judge.service._answer import AnswerTask as AnswerTask
from polhode.judge.service._answer import MarkedAnswer as MarkedAnswer
from polhode.judge.service._answer import marked_answer as marked_answer
from polhode.judge.service._serve import serve_marks as serve_marks
from polhode.judge.service._settings import ServiceSettings as ServiceSettings

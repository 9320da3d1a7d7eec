"""Exercises: statements with numbers drawn from a seed, whose answers are judged on the model."""

from polhode.exercise._answers import MarkedPart as MarkedPart
from polhode.exercise._answers import PartMark as PartMark
from polhode.exercise._documents import EXERCISE_FILES as EXERCISE_FILES
from polhode.exercise._documents import markdown_of as markdown_of
from polhode.exercise._documents import write_document as write_document
from polhode.exercise._exercise import KINDS as KINDS
from polhode.exercise._exercise import USUAL as USUAL
from polhode.exercise._exercise import Builder as Builder
from polhode.exercise._exercise import Exercise as Exercise
from polhode.exercise._exercise import exercise as exercise
from polhode.exercise._exercise import mark as mark
from polhode.exercise._key import HandedIn as HandedIn
from polhode.exercise._key import counts as counts
from polhode.exercise._key import key_document as key_document
from polhode.exercise._key import marked_submission as marked_submission
from polhode.exercise._key import read_key as read_key
from polhode.exercise._key import read_submission as read_submission
from polhode.exercise._sheet import ExerciseSheet as ExerciseSheet
from polhode.exercise._sheet import sheet_blocks as sheet_blocks
from polhode.exercise._sheet import solution_blocks as solution_blocks
from polhode.exercise._sheet import title_of as title_of

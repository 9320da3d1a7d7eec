"""Exercises: statements with numbers drawn from a seed, whose answers are judged on the model."""

from polhode.exercise._answers import MarkedPart as MarkedPart
from polhode.exercise._answers import PartMark as PartMark
from polhode.exercise._exercise import KINDS as KINDS
from polhode.exercise._exercise import Builder as Builder
from polhode.exercise._exercise import Exercise as Exercise
from polhode.exercise._exercise import exercise as exercise
from polhode.exercise._exercise import mark as mark

"""Documents as people write them: the relations in their files, each with its place."""

from polhode.judge.source._macros import Macro as Macro
from polhode.judge.source._pieces import ShownFormula as ShownFormula
from polhode.judge.source._pieces import SourceWords as SourceWords
from polhode.judge.source._pieces import read_pieces as read_pieces
from polhode.judge.source._read_source import DocumentRead as DocumentRead
from polhode.judge.source._read_source import SourceRelation as SourceRelation
from polhode.judge.source._read_source import read_documents as read_documents
from polhode.judge.source._read_source import read_file as read_file
from polhode.judge.source._read_source import read_source as read_source
from polhode.judge.source._read_source import read_text as read_text

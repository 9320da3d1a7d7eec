"""Documents as people write them: the relations in their files, each with its place."""

from polhode.claims.source._macros import Macro as Macro
from polhode.claims.source._pieces import ShownFormula as ShownFormula
from polhode.claims.source._pieces import SourceWords as SourceWords
from polhode.claims.source._pieces import read_pieces as read_pieces
from polhode.claims.source._read_source import DocumentRead as DocumentRead
from polhode.claims.source._read_source import SourceRelation as SourceRelation
from polhode.claims.source._read_source import read_documents as read_documents
from polhode.claims.source._read_source import read_file as read_file
from polhode.claims.source._read_source import read_source as read_source
from polhode.claims.source._read_source import read_text as read_text

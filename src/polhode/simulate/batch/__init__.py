"""Batches of motions in the lanes of vector instructions; and motions with derivatives."""

from polhode.simulate.batch._batch_results import LAST as LAST
from polhode.simulate.batch._batch_results import BatchResults as BatchResults
from polhode.simulate.batch._batch_system import BatchSolution as BatchSolution
from polhode.simulate.batch._batch_system import Plan as Plan
from polhode.simulate.batch._batch_system import SingleModeBatch as SingleModeBatch
from polhode.simulate.batch._batch_system import batch_of as batch_of
from polhode.simulate.batch._variational_equations import ConstantInterval as ConstantInterval
from polhode.simulate.batch._variational_equations import (
    VariationalEquations as VariationalEquations,
)

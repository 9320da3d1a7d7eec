"""Many submissions reviewed by worker processes, and their marks as tables."""

from polhode.judge.batch._batch import Batch as Batch
from polhode.judge.batch._batch import review_batch as review_batch
from polhode.judge.batch._submissions import Submission as Submission
from polhode.judge.batch._submissions import submissions as submissions
from polhode.judge.batch._tables import slips as slips
from polhode.judge.batch._tables import write_marks as write_marks

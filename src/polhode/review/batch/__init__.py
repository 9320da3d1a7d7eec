"""Many submissions reviewed by worker processes, and their marks as tables."""

from polhode.review.batch._batch import Batch as Batch
from polhode.review.batch._batch import review_batch as review_batch
from polhode.review.batch._submissions import Submission as Submission
from polhode.review.batch._submissions import submissions as submissions
from polhode.review.batch._tables import slips as slips
from polhode.review.batch._tables import write_marks as write_marks

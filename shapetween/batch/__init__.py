"""Many pairs of drawings at once: what is to be done, by whom, and what has come of it."""

from shapetween.batch.jobs import Job, all_pairs_in, pairs_in, read_table
from shapetween.batch.run import Outcome, run_batch

__all__ = ["Job", "Outcome", "all_pairs_in", "pairs_in", "read_table", "run_batch"]

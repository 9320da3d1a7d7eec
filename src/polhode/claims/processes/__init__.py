"""Claims judged in worker processes, which are ended where they take too long."""

"""Claims judged in worker processes, with limits on their time and memory."""

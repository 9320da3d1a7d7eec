"""Settings of every test run."""

import signal

from hypothesis import settings

settings.register_profile("ci", derandomize=True, deadline=None, database=None)
settings.register_profile("proof", max_examples=2000, deadline=None, print_blob=True)
settings.load_profile("ci")

# A shell makes what it runs in the background ignore interrupts, and processes inherit that: those
# that tests start and interrupt would go on.
signal.signal(signal.SIGINT, signal.default_int_handler)

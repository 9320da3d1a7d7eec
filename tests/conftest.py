"""Settings of every test run."""

from hypothesis import settings

settings.register_profile("ci", derandomize=True, deadline=None, database=None)
settings.register_profile("proof", max_examples=2000, deadline=None, print_blob=True)
settings.load_profile("ci")

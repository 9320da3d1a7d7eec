"""Settings of every test run."""

import gc
import signal
from pathlib import Path

from hypothesis import settings

settings.register_profile("ci", derandomize=True, deadline=None, database=None)
settings.register_profile("proof", max_examples=2000, deadline=None, print_blob=True)
settings.load_profile("ci")

# A shell makes what it runs in the background ignore interrupts, and processes inherit that: those
# that tests start and interrupt would go on.
signal.signal(signal.SIGINT, signal.default_int_handler)

#: Folders whose tests share what takes long to make.
COSTLY = {"tour", "browser", "exercise", "lab", "solution"}


def pytest_collection_modifyitems(items):
    """Put those first: a worker without tests takes over the last ones of another, so what the
    first ones share is made by one worker alone."""
    here = Path(__file__).parent
    items.sort(key=lambda item: item.path.relative_to(here).parts[0] not in COSTLY)


def pytest_collection_finish():
    """Spare the collector what imports and tests themselves have made: a tenth of the time."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)

import json
import platform
import subprocess
import sys

import numpy

from polhode.base import SCHEMA, installed_version, provenance


def test_a_document_tells_what_it_was_made_with():
    made = provenance(seed=7)
    assert made["schema"] == SCHEMA
    assert made["seed"] == 7
    assert made["versions"]["python"] == platform.python_version()
    assert made["versions"]["numpy"] == numpy.__version__
    assert made["versions"]["polhode"]
    assert json.loads(json.dumps(made)) == made


def test_no_random_numbers_no_seed():
    assert provenance()["seed"] is None


def test_what_is_not_installed_has_no_version():
    assert installed_version("no-such-distribution-anywhere") is None


def test_telling_imports_no_library():
    program = (
        "import sys; from polhode.base import provenance; provenance();"
        "print(sorted({'numpy', 'scipy', 'heyoka', 'sympy', 'flint'} & sys.modules.keys()))"
    )
    told = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert told.stdout.strip() == "[]"

"""`python -m polhode`: the command line."""

from polhode.cli import main

raise SystemExit(main())

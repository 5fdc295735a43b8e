"""``python -m clearway``: the command line."""

from clearway.cli import main

raise SystemExit(main())

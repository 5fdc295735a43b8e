"""The command line."""

from clearway.cli.main import main

__all__ = ["main"]

"""The command line: arguments to library calls, files, and exit codes."""

from shapetween.cli.main import main

__all__ = ["main"]

"""Run the command line with ``python -m shapetween``."""

from shapetween.cli import main

main()

"""What is written down of one pair of a batch."""

from typing import Any, TypeAlias

__all__ = ["Entry"]

Entry: TypeAlias = dict[str, Any]
"""Paths, how it ended, and the report, ready for JSON."""

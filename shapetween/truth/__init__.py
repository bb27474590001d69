"""Scenes in which it is known what really happens between two drawings."""

from shapetween.truth.case import TIMES, Case
from shapetween.truth.table import Row, format_table, scenes, table

__all__ = ["TIMES", "Case", "Row", "format_table", "scenes", "table"]

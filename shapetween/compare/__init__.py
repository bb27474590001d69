"""Methods side by side on one pair of drawings: animations, figures, and a page that shows both."""

from shapetween.compare.comparison import Comparison, compare

__all__ = ["Comparison", "compare"]

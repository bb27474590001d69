"""Methods that move a mesh pair, behind one interface."""

from shapetween.interpolate.base import Tween
from shapetween.interpolate.methods import INTERIORS, METHODS, check_method, tween

__all__ = ["INTERIORS", "METHODS", "Tween", "check_method", "tween"]

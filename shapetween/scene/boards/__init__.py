"""Boards: quads with what is drawn on them, which go over into each other in perspective."""

from shapetween.scene.boards.find import boards_between

__all__ = ["boards_between"]

"""What is written."""

from dataclasses import dataclass

from shapetween.model.movement import Movement

__all__ = ["Segments"]


@dataclass(frozen=True, slots=True, eq=False)
class Segments:
    """What is written: movements that follow each other, often a single one.

    Attributes
    ----------
    movements : tuple of Movement
        Each starts with the drawing that the one before ends with, all in the box and under the
        title of the first.
    closed : bool
        Whether the last drawing is the first one again.
    ways : tuple of float
        Seconds of the way through each segment where those differ; else they are all as long as
        the options say, and there are none here.
    name : str
        What the format may call it inside the file: the stem of the file's name.
    warnings : tuple of str
        What was lost or is doubtful in it, for formats that show such things.
    """

    movements: tuple[Movement, ...]
    closed: bool = False
    name: str = "morph"
    warnings: tuple[str, ...] = ()
    ways: tuple[float, ...] = ()

    def lengths(self, duration: float) -> tuple[float, ...]:
        """Seconds of the way through each segment, where the options say that one takes so many."""
        return self.ways or (duration,) * len(self.movements)

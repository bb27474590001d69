"""Budgets that keep reading quick and safe, whatever the file."""

from dataclasses import dataclass, fields

from shapetween.base.errors import BudgetError

__all__ = ["Limits"]


@dataclass(frozen=True, slots=True)
class Limits:
    """How much of each thing a file may hold before it is refused.

    The defaults stand far above honest drawings (a map of a large country has some 40,000 path
    commands) and low enough that whatever passes them is read within seconds.

    Attributes
    ----------
    file_bytes : int
        Size of the file as given.
    unpacked_bytes : int
        Size after gunzip.
    elements : int
        Elements in the document.
    nesting : int
        Elements within one another, in the document and again where ``use`` draws them.
    entity_growth : int
        Characters by which entities may lengthen the text, beyond doubling it.
    path_commands : int
        Commands of all path data, and of shapes as paths, counted again for every ``use``.
    use_copies : int
        Elements that ``use`` draws again.
    style_characters : int
        Characters of style sheets, and of the ``style`` attributes that need a CSS parser.
    style_steps : int
        Steps of matching style sheets: selectors tested, and elements passed on the way to a
        sibling or an ancestor.
    clip_points : int
        Points of shapes that clip paths cut, and of the clip paths.
    """

    file_bytes: int = 32_000_000
    unpacked_bytes: int = 32_000_000
    elements: int = 30_000
    nesting: int = 256
    entity_growth: int = 100_000
    path_commands: int = 80_000
    use_copies: int = 10_000
    style_characters: int = 500_000
    style_steps: int = 1_000_000
    clip_points: int = 200_000

    def check(self, limit: str, amount: int, name: str) -> None:
        """Refuse an amount beyond one of the limits.

        Parameters
        ----------
        limit : str
            The attribute it is measured against.
        amount : int
        name : str
            The file, for the message.

        Raises
        ------
        BudgetError
        """
        allowed = getattr(self, limit)
        if amount > allowed:
            words = limit.replace("_", " ")
            raise BudgetError(
                name,
                f"passes the limit of {allowed} {words}; simplify the drawing, "
                f"or read it with Limits({limit}=...) set higher",
            )

    def __post_init__(self) -> None:
        """Refuse limits that would let nothing through."""
        for field in fields(self):
            if getattr(self, field.name) < 1:
                raise ValueError(f"{field.name} must be at least 1")

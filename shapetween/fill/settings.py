"""What the user asked of all filled shapes, and which of it has found its place."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from shapetween.base.arrays import Points
from shapetween.base.errors import MeshError, OptionError
from shapetween.base.observe import Observer
from shapetween.fill.pinned import PinnedRings, pinned_rings
from shapetween.fill.regions import Region
from shapetween.mesh.pair import MeshPair
from shapetween.outline.preview import Effort

__all__ = ["Claimed", "FillSettings", "Given"]


@dataclass(slots=True, eq=False)
class Claimed:
    """Which of what the user asked for has found its place.

    Attributes
    ----------
    pins, meshes : set of int
        By their order.
    choice : bool
        Whether there are two outlines whose matchings can be chosen from.
    """

    pins: set[int] = field(default_factory=set)
    meshes: set[int] = field(default_factory=set)
    choice: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Given:
    """What the user asked of two pieces that become each other.

    Attributes
    ----------
    pins : (K, 4) float64
        On their outer outlines.
    mesh : MeshPair or None
    choice : int
        Which of their distinct matchings to take, the best one being 1.
    holes : mapping of (int, int) to (K, 4) float64
        Pins on holes that become each other, by the holes.
    """

    pins: Points
    mesh: MeshPair | None
    choice: int
    holes: Mapping[tuple[int, int], Points]

    @property
    def decides(self) -> bool:
        """Whether it says what becomes what on their outer outlines."""
        return len(self.pins) > 0 or self.choice > 1


@dataclass(frozen=True, slots=True, eq=False)
class FillSettings:
    """What the user asked of all filled shapes.

    Attributes
    ----------
    method : str
    folds : {"prevent", "allow"}
    quads : int or None
    pins : (K, 4) float64
        In the movement's frame.
    meshes : sequence of (str, MeshPair)
        In the movement's frame, by name of shape.
    observe : Observer
    meshed : bool
        Whether every area moves by a mesh of its own, whatever simpler way there is.
    choice : int
        Which of the distinct matchings of two outlines to take, the best one being 1.
    effort : {"line", "plane", "full"}
        How much is done for the way that outlines take.
    mine : frozenset of int or None
        Which pins may lie on what is moved, others being another part's; None for any.
    claimed : Claimed
        What of it has found its place.
    """

    method: str
    folds: str
    quads: int | None
    pins: Points
    meshes: Sequence[tuple[str, MeshPair]]
    observe: Observer
    meshed: bool = False
    choice: int = 1
    effort: Effort = "full"
    mine: frozenset[int] | None = None
    claimed: Claimed = field(default_factory=Claimed)

    def given_to(
        self, name: str, pairs: Sequence[tuple[Region, Region]], *, alone: bool
    ) -> list[Given]:
        """What is for each pair of pieces of a shape, which nothing else gets then.

        Parameters
        ----------
        name : str
            The shape's.
        pairs : sequence of (Region, Region)
        alone : bool
            Whether they are two outlines and nothing else, whose matchings can be chosen from.
        """
        found = []
        for first, second in pairs:
            mesh = self._mesh_for(name)
            choice = self.choice if alone and mesh is None else 1
            self.claimed.choice |= choice > 1
            on = self._pinned(first, second)
            holes = {pair: self.pins[list(rows)] for pair, rows in on.holes.items()}
            found.append(Given(self.pins[list(on.outer)], mesh, choice, holes))
        return found

    def _mesh_for(self, name: str) -> MeshPair | None:
        """The next mesh given for pieces of a shape, in the order they are written in."""
        free = [k for k in range(len(self.meshes)) if k not in self.claimed.meshes]
        mine = [k for k in free if self.meshes[k][0] == name]
        mine = mine or [k for k in free if not self.meshes[k][0]]
        if not mine:
            return None
        self.claimed.meshes.add(mine[0])
        return self.meshes[mine[0]][1]

    def _pinned(self, first: Region, second: Region) -> PinnedRings:
        """Pins that lie on these two pieces, by rings; rows are those of `pins`."""
        free = [k for k in range(len(self.pins)) if k not in self.claimed.pins]
        rows = [k for k in free if self.mine is None or k in self.mine]
        rings = (first.outer, *first.holes), (second.outer, *second.holes)
        found = pinned_rings(*rings, self.pins[rows]).of_rows(rows)
        self.claimed.pins.update(found.rows)
        return found

    def check_used(self) -> None:
        """Refuse what belongs to no shape."""
        for k, pin in enumerate(self.pins):
            if k not in self.claimed.pins:
                ax, ay, bx, by = pin.tolist()
                raise OptionError(
                    f"pin {k + 1} ({ax:g},{ay:g} to {bx:g},{by:g} in the first drawing's units): "
                    "does not lie on two outlines that become each other; expected a place on each"
                )
        if self.choice > 1 and not self.claimed.choice:
            raise OptionError(
                f"matching: {self.choice} is one of two outlines' matchings; expected drawings of "
                "one filled outline each, without a mesh"
            )
        unused = [name for k, (name, _) in enumerate(self.meshes) if k not in self.claimed.meshes]
        if unused:
            raise MeshError(f"mesh: there is no filled shape {unused[0]!r} to use it for")

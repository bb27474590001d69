"""What the user asked of all filled shapes, and which of it has found its place."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.errors import MeshError, OptionError
from shapetween.base.observe import Observer
from shapetween.fill.regions import Region
from shapetween.mesh.pair import MeshPair
from shapetween.model.arclength import ArcLength

__all__ = ["FillSettings"]

#: Distance of a pin from the pieces it may belong to, as a share of their size.
PIN_REACH = 0.05


@dataclass(slots=True, eq=False)
class FillSettings:
    """What the user asked of all filled shapes, and which of it has found its place.

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
    """

    method: str
    folds: str
    quads: int | None
    pins: Points
    meshes: Sequence[tuple[str, MeshPair]]
    observe: Observer
    meshed: bool = False
    choice: int = 1
    used_pins: set[int] = field(default_factory=set)
    used_meshes: set[int] = field(default_factory=set)
    used_choice: bool = False

    @property
    def settled(self) -> bool:
        """Whether the user said what becomes what on an outline."""
        return len(self.used_pins) > 0 or self.used_choice

    def take_choice(self) -> int:
        """The choice, by the two outlines that it is for."""
        self.used_choice = self.choice > 1
        return self.choice

    def mesh_for(self, name: str) -> MeshPair | None:
        """The next mesh given for pieces of a shape, in the order they are written in."""
        free = [k for k in range(len(self.meshes)) if k not in self.used_meshes]
        mine = [k for k in free if self.meshes[k][0] == name]
        mine = mine or [k for k in free if not self.meshes[k][0]]
        if not mine:
            return None
        self.used_meshes.add(mine[0])
        return self.meshes[mine[0]][1]

    def pins_for(self, first: Region, second: Region) -> Points:
        """Pins that lie on these two pieces, (K, 4)."""
        mine = []
        for k, pin in enumerate(self.pins):
            near = [_near(region, point) for region, point in ((first, pin[:2]), (second, pin[2:]))]
            if k not in self.used_pins and all(near):
                mine.append(k)
        self.used_pins.update(mine)
        return self.pins[mine]

    def check_used(self) -> None:
        """Refuse what belongs to no shape."""
        for k, pin in enumerate(self.pins):
            if k not in self.used_pins:
                ax, ay, bx, by = pin.tolist()
                raise OptionError(
                    f"pin {k + 1} ({ax:g},{ay:g} to {bx:g},{by:g} in the first drawing's units): "
                    "does not lie on two outlines that become each other"
                )
        if self.choice > 1 and not self.used_choice:
            raise OptionError(
                f"matching: {self.choice} is one of two outlines' matchings; expected drawings of "
                "one filled outline each, without a mesh"
            )
        unused = [name for k, (name, _) in enumerate(self.meshes) if k not in self.used_meshes]
        if unused:
            raise MeshError(f"mesh: there is no filled shape {unused[0]!r} to use it for")


def _near(region: Region, point: Points) -> bool:
    size = float(np.linalg.norm(np.ptp(region.outer.box, axis=0)))
    return bool(ArcLength(region.outer).nearest(point)[1] <= PIN_REACH * size)

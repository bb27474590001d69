"""The library's front door: two files in, a movement that can be asked for frames or written."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any, Literal, TypeAlias

import numpy as np

from shapetween import report
from shapetween.base.errors import OptionError
from shapetween.base.observe import Observer, unobserved
from shapetween.io import files
from shapetween.io.linked import pictures_beside
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Drawing
from shapetween.model.fit import Fit, inverted, mapped
from shapetween.outline.correspondence import RingCorrespondence
from shapetween.pipeline import Folds, Options, Prepared, prepare
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.diagram import MeshView
from shapetween.timing.easing import easing_function, even_times

__all__ = ["Morph", "Source", "morph", "name_of", "opened"]

Source: TypeAlias = str | PathLike[str] | Drawing
"""An SVG file, or a drawing already read."""

Pin: TypeAlias = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Morph:
    """A prepared movement between two drawings.

    Attributes
    ----------
    prepared : Prepared
        The movement, with the matching and meshes behind it.
    method : str
    """

    prepared: Prepared = field(repr=False)
    method: str

    @property
    def warnings(self) -> tuple[str, ...]:
        """What was lost or is doubtful, one line each."""
        return self.prepared.warnings

    def at(self, t: float) -> Drawing:
        """The drawing at one time from 0 to 1."""
        if not 0 <= t <= 1:
            raise OptionError(f"t: {t} is not from 0 to 1")
        return self.prepared.movement.at(np.array([float(t)]))[0]

    def frames(self, count: int, easing: str = "linear") -> list[Drawing]:
        """Drawings at `count` times, even along the easing, the ends the first and the last."""
        times = easing_function(easing)(even_times(count))
        return list(self.prepared.movement.at(times))

    def svg(
        self,
        *,
        duration: float = 2.0,
        easing: str = "linear",
        loop: Literal["once", "repeat", "alternate"] = "once",
        hold: float = 0.0,
        keyframes: int | Literal["auto"] = "auto",
        precision: int | None = None,
    ) -> str:
        """The movement as the text of one animated SVG; both drawings stand still for `hold`."""
        from shapetween.svg.write.smil import smil_svg

        return smil_svg(
            self.prepared.movement,
            duration=duration,
            easing=easing,
            loop=loop,
            hold=hold,
            keyframes=keyframes,
            precision=precision,
        )

    def write(self, path: str | PathLike[str], **settings: Any) -> None:
        """Write the movement as one animated SVG, named so; `settings` are those of `svg`."""
        place = Path(path)
        files.check_form(place, "a movement", (".svg",))
        files.write_text(place, self.svg(**settings))

    def report(self) -> dict[str, Any]:
        """How the movement was found and what is known of its quality, ready for JSON."""
        return report.build(self.prepared, self.method)

    @property
    def correspondence(self) -> tuple[RingCorrespondence, ...]:
        """Which points belong together, ring after ring, in each drawing's own user units."""
        back = inverted(self.prepared.fit)
        return tuple(
            RingCorrespondence.of(part.name, ring, back)
            for part in self.prepared.filled
            for body in part.bodies
            for ring in body.nodes.rings
        )

    @property
    def meshes(self) -> tuple[tuple[str, MeshPair], ...]:
        """Name and mesh of every shape, vertices in each drawing's own user units."""
        return tuple((view.name, view.pair) for view in self._views())

    def mesh_json(self) -> str:
        """The meshes as the text of a file that can be edited and given back."""
        from shapetween.mesh.file import dump_meshes

        return dump_meshes([(view.name, view.pair) for view in self._checked_views()])

    def mesh_svg(self, names: tuple[str, str] = ("A", "B")) -> str:
        """A picture of both shapes with numbered quads and the nodes that belong together."""
        from shapetween.svg.write.diagram import mesh_svg

        return mesh_svg(self._checked_views(), names)

    def _checked_views(self) -> list[MeshView]:
        views = self._views()
        if not views:
            raise OptionError("there is no mesh: no filled shape has a partner that is filled")
        return views

    def _views(self) -> list[MeshView]:
        back = inverted(self.prepared.fit)
        views = []
        for part in self.prepared.filled:
            for ring in (ring for body in part.bodies for ring in body.nodes.rings):
                if ring.pair is None:
                    continue
                target = mapped(ring.pair.target, back)
                pair = MeshPair(ring.pair.source, target, ring.pair.quads, ring.pair.triangles)
                nodes = np.arange(len(ring.kept))
                outline = ring.target.transformed(back)
                views.append(MeshView(part.name, ring.source, outline, pair, nodes))
        return views

    def _repr_html_(self) -> str:
        """Show the movement in a notebook."""
        return self.svg(loop="alternate")


def morph(
    a: Source,
    b: Source,
    *,
    method: str = "projective",
    quads: int | None = None,
    pins: Iterable[Pin] = (),
    matches: Iterable[tuple[str, str]] = (),
    mesh: MeshPair | Iterable[tuple[str, MeshPair]] = (),
    fit: Fit = "view",
    folds: Folds = "prevent",
    together: bool = True,
    pictures: bool = False,
    observe: Observer = unobserved,
) -> Morph:
    """Prepare the movement between two drawings.

    Parameters
    ----------
    a, b : path or Drawing
        SVG files, or drawings already read.
    method : str
        "projective", or another of `shapetween.interpolate.METHODS`.
    quads : int, optional
        About how many quads; as few as the shapes need if left out.
    pins : iterable of (ax, ay, bx, by)
        Points that belong together, each in its own drawing's user units.
    matches : iterable of (str, str)
        Ids of shapes that become each other.
    mesh : MeshPair, or iterable of (str, MeshPair), optional
        Meshes to use instead of found ones, with the names of their shapes.
    fit : {"view", "geometry", "none"}
        How `b` is brought into the frame of `a`: view box into view box, drawn box into drawn
        box, or not at all.
    folds : {"prevent", "allow"}
        Move the plane around a shape along, so that nothing folds, or the bare mesh alone.
    together : bool
        Let the shapes of a drawing ride on the movement of its silhouette; else each moves by
        itself.
    pictures : bool
        Keep patterns and pictures in files, for a `shapetween.raster.film.Film` of the movement.
    observe : Observer, optional
        Told of every stage as it begins and ends.

    Raises
    ------
    ShapetweenError
        If a file cannot be read or an option does not fit; its text is one line.
    """
    options = Options(
        method=method,
        quads=quads,
        pins=tuple(_pin(pin) for pin in pins),
        matches=tuple(matches),
        meshes=(("", mesh),) if isinstance(mesh, MeshPair) else tuple(mesh),
        fit=fit,
        folds=folds,
        together=together,
    )
    with observe("read"):
        drawings = opened(a, pictures), opened(b, pictures)
    names = name_of(a, "first drawing"), name_of(b, "second drawing")
    return Morph(prepare(*drawings, options, names=names, observe=observe), method)


def _pin(given: Iterable[float]) -> Pin:
    try:
        ax, ay, bx, by = map(float, given)
    except (TypeError, ValueError) as error:
        raise OptionError(f"pin: {given!r} is not (ax, ay, bx, by)") from error
    return ax, ay, bx, by


def opened(source: Source, pictures: bool = False) -> Drawing:
    """The drawing, read from its file if need be, with patterns and pictures or without."""
    if isinstance(source, Drawing):
        return source
    path = Path(source)
    beside = pictures_beside(path) if pictures else None
    return read_svg(files.read_bytes(path), str(source), pictures=beside)


def name_of(source: Source, default: str) -> str:
    """What messages call a drawing: its file, or some other name."""
    return default if isinstance(source, Drawing) else str(source)

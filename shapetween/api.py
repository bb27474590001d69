"""The library's front door: files in, a movement that can be asked for frames or written."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from os import PathLike
from typing import Any, TypeAlias

import numpy as np

from shapetween import report
from shapetween.base.arrays import Affine
from shapetween.base.errors import OptionError
from shapetween.base.notices import Notice, distinct
from shapetween.base.observe import Observer, unobserved
from shapetween.formats.moving import Moving
from shapetween.geometry.affine import inverted, mapped
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Drawing
from shapetween.model.fit import Fit, Flip, fit_matrix
from shapetween.model.movement import Movement
from shapetween.outline.correspondence import RingCorrespondence
from shapetween.outline.preview import Effort
from shapetween.pipeline import Folds, Options, Prepared, prepare
from shapetween.scene.asked import Change, Pairing
from shapetween.sources import Source, key_of, name_of, opened
from shapetween.svg.write.mesh_panels import MeshView

__all__ = ["Chain", "Morph", "Source", "chain", "morph"]

Pin: TypeAlias = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Morph(Moving):
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

    @property
    def notices(self) -> tuple[Notice, ...]:
        """The same as data, and what needs no warning."""
        return self.prepared.notices

    @property
    def movements(self) -> tuple[Movement, ...]:
        """The one movement."""
        return (self.prepared.movement,)

    @property
    def closed(self) -> bool:
        """A pair is no round."""
        return False

    def report(self) -> dict[str, Any]:
        """How the movement was found and what is known of its quality, ready for JSON."""
        return report.build(self.prepared, self.method)

    @property
    def correspondence(self) -> tuple[RingCorrespondence, ...]:
        """Which points belong together, ring after ring, in each drawing's own user units."""
        back = inverted(self.prepared.fit)
        return tuple(
            RingCorrespondence.of(part.name, ring, back)
            for part in self.prepared.meshed
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
        """A picture of who becomes whom, and of the meshes with the nodes that belong together.

        Parameters
        ----------
        names : (str, str)
            What its titles call the drawings.

        Raises
        ------
        OptionError
            If the drawings are one area each, and no mesh moves it.
        """
        from shapetween.scene.part_views import part_views
        from shapetween.svg.write.diagram import diagram_svg

        scene = self.prepared.scene
        parts = part_views(scene, inverted(self.prepared.fit)) if scene is not None else ()
        if len(parts) < 2:
            return diagram_svg(self._checked_views(), names)
        return diagram_svg(self._views(), names, parts)

    def _checked_views(self) -> list[MeshView]:
        views = self._views()
        if not views:
            raise OptionError("there is no mesh: no filled shape has a partner that is filled")
        return views

    def _views(self) -> list[MeshView]:
        back = inverted(self.prepared.fit)
        views = []
        for part in self.prepared.meshed:
            for ring in (ring for body in part.bodies for ring in body.nodes.rings):
                if ring.pair is None:
                    continue
                target = mapped(ring.pair.target, back)
                pair = MeshPair(ring.pair.source, target, ring.pair.quads, ring.pair.triangles)
                nodes = np.arange(len(ring.kept))
                outline = ring.target.transformed(back)
                views.append(MeshView(part.name, ring.source, outline, pair, nodes))
        return views


@dataclass(frozen=True, slots=True, eq=False)
class Chain(Moving):
    """Prepared movements that follow each other.

    Attributes
    ----------
    legs : tuple of Morph
        From each drawing to the next, all in the frame and the user units of the first.
    names : tuple of str
        What the drawings are called, one more than legs.
    closed : bool
        Whether the last drawing is the first one again.
    fits : tuple of (2, 3) float64
        From each drawing's own user units to those of the first.
    """

    legs: tuple[Morph, ...] = field(repr=False)
    names: tuple[str, ...]
    closed: bool = field()  # else the property it stands for would be its default
    fits: tuple[Affine, ...] = field(repr=False)

    @property
    def correspondence(self) -> tuple[tuple[RingCorrespondence, ...], ...]:
        """Which points belong together on each leg, in each drawing's own user units."""
        back = [inverted(matrix) for matrix in self.fits]
        return tuple(
            tuple(ring.moved(*both) for ring in leg.correspondence)
            for leg, both in zip(self.legs, pairwise(back), strict=True)
        )

    @property
    def warnings(self) -> tuple[str, ...]:
        """What was lost or is doubtful, one line each; what names no drawing names its leg."""
        lines = [
            line if line.startswith(tuple(f"{name}: " for name in names)) else f"{of_leg}: {line}"
            for leg, names in zip(self.legs, pairwise(self.names), strict=True)
            for of_leg in [" to ".join(names)]
            for line in leg.warnings
        ]
        return tuple(dict.fromkeys(lines))

    @property
    def notices(self) -> tuple[Notice, ...]:
        """Those of all legs."""
        return distinct(notice for leg in self.legs for notice in leg.notices)

    @property
    def movements(self) -> tuple[Movement, ...]:
        """Those of the legs."""
        return tuple(leg.prepared.movement for leg in self.legs)

    def report(self) -> dict[str, Any]:
        """How each leg was found and what is known of its quality, ready for JSON."""
        legs = [leg.report() for leg in self.legs]
        return report.build_chain(legs, self.names, self.warnings, self.notices)


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
    matching: int = 1,
    flip: Flip = "none",
    pairing: Pairing = "normal",
    change: Change | None = None,
    effort: Effort = "full",
    pictures: bool = False,
    font: str | PathLike[str] | None = None,
    observe: Observer = unobserved,
) -> Morph:
    """Prepare the movement between two drawings.

    Parameters
    ----------
    a, b : path, str, bytes or Drawing
        SVG files, their text or bytes, or drawings already read.
    method : str
        "projective", or another of `shapetween.interpolate.METHODS`.
    quads : int, optional
        About how many quads; as few as the shapes need if left out.
    pins : iterable of (ax, ay, bx, by)
        Points that belong together, each in its own drawing's user units.
    matches : iterable of (str, str)
        Ids of shapes that become each other, as ``--match`` takes them.
    mesh : MeshPair, or iterable of (str, MeshPair), optional
        Meshes to use instead of found ones, with the names of their shapes.
    fit : {"view", "geometry", "none"}
        How `b` is brought into the frame of `a`: view box into view box, drawn box into drawn
        box, or not at all.
    folds : {"prevent", "allow"}
        Move the plane around a shape along, so that nothing folds, or the bare mesh alone.
    together : bool
        Let parts move as they are seen together; else every area by a mesh of its own.
    matching : int
        Which of the distinct ways for one outline to become the other, the best one being 1; the
        report lists them.
    flip : {"none", "b"}
        "b" mirrors the second drawing about its upright axis first.
    pairing : {"normal", "loose", "strict"}
        How readily parts become others; unless "loose", unlike drawings are exchanged as wholes.
    change : {"fade", "draw", "grow", "slide"}, optional
        How parts without a partner come and go; each as it lies if left out.
    effort : {"full", "plane", "line"}
        What goes where is the same each time; with less effort outlines take a rougher way there,
        in a plane that nothing leads and nobody checks, or straight, found in a blink.
    pictures : bool
        Keep patterns and pictures in files, for a `shapetween.raster.film.Film` of the movement.
    font : path, optional
        A folder with fonts for text in files, looked at before those installed.
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
        matching=matching,
        flip=flip,
        pairing=pairing,
        change=change,
        effort=effort,
    )
    with observe("read"):
        drawings = opened(a, pictures, font), opened(b, pictures, font)
    names = name_of(a, "first drawing"), name_of(b, "second drawing")
    return Morph(prepare(*drawings, options, names=names, observe=observe), method)


def chain(
    drawings: Iterable[Source],
    *,
    method: str = "projective",
    quads: int | None = None,
    pins: Mapping[int, Iterable[Pin]] | None = None,
    matches: Mapping[int, Iterable[tuple[str, str]]] | None = None,
    matching: Mapping[int, int] | None = None,
    fit: Fit = "view",
    folds: Folds = "prevent",
    pairing: Pairing = "normal",
    change: Change | None = None,
    effort: Effort = "full",
    pictures: bool = False,
    font: str | PathLike[str] | None = None,
    observe: Observer = unobserved,
) -> Chain:
    """Prepare the movement through several drawings.

    Parameters
    ----------
    drawings : iterable of path, str, bytes or Drawing
        SVG files, their text or bytes, or drawings already read, at least two. Naming the first
        one again at the end closes the chain.
    method, quads, folds, pairing, change, effort, pictures, font
        As for `shapetween.morph`, for every leg.
    pins : mapping of int to iterable of (ax, ay, bx, by), optional
        Points that belong together, by the leg, counted from 1, each in its own drawing's user
        units.
    matches : mapping of int to iterable of (str, str), optional
        Ids of shapes that become each other, by the leg, as of `shapetween.morph`.
    matching : mapping of int to int, optional
        Which of the distinct matchings of a leg's outlines to take, by the leg.
    fit : {"view", "geometry", "none"}
        How each drawing is brought into the frame of the first.
    observe : Observer, optional
        Told of every stage of every leg as it begins and ends.

    Raises
    ------
    ShapetweenError
        If a file cannot be read or an option does not fit; its text is one line.
    """
    if isinstance(drawings, str | bytes | PathLike | Drawing):
        alone = name_of(drawings, "one drawing")
        raise OptionError(f"chain: {alone}: expected a list of drawings")
    sources = list(drawings)
    if len(sources) < 2:
        raise OptionError(f"chain: {len(sources)} drawings; expected two or more")
    options = Options(
        method=method,
        quads=quads,
        fit="none",
        folds=folds,
        pairing=pairing,
        change=change,
        effort=effort,
    )
    for name, of_legs in (("pins", pins), ("matches", matches), ("matching", matching)):
        for leg in of_legs or {}:
            if leg not in range(1, len(sources)):
                last = len(sources) - 1
                raise OptionError(f"{name}: there is no leg {leg!r}; expected 1 to {last}")
    names = tuple(name_of(source, f"drawing {k}") for k, source in enumerate(sources, start=1))
    with observe("read"):
        different = {key_of(source): source for source in sources}
        drawn = {key: opened(source, pictures, font) for key, source in different.items()}
        read = [drawn[key_of(source)] for source in sources]
    with observe("fit"):
        frames = [_frame(drawing, read[0], fit) for drawing in read]
        framed = [_in_frame(drawing, read[0], m) for drawing, m in zip(read, frames, strict=True)]
    title = " to ".join(drawing.title for drawing in read if drawing.title)
    legs = []
    for k, (pair, both) in enumerate(zip(pairwise(framed), pairwise(names), strict=True)):
        own = replace(
            options,
            pins=_mapped_pins((pins or {}).get(k + 1, ()), *frames[k : k + 2]),
            matches=tuple((matches or {}).get(k + 1, ())),
            matching=(matching or {}).get(k + 1, 1),
        )
        prepared = prepare(*pair, own, names=both, observe=observe)
        titled = replace(prepared, movement=replace(prepared.movement, title=title))
        legs.append(Morph(titled, method))
    return Chain(tuple(legs), names, read[0] is read[-1], tuple(frames))


def _frame(drawing: Drawing, first: Drawing, fit: Fit) -> Affine:
    """From a drawing's own units to those of the first, whose own place is kept."""
    return np.eye(2, 3) if drawing is first else fit_matrix(first, drawing, fit)


def _in_frame(drawing: Drawing, first: Drawing, matrix: Affine) -> Drawing:
    """The drawing as it is to be seen in the frame of the first."""
    return drawing if drawing is first else replace(drawing.transformed(matrix), box=first.box)


def _mapped_pins(pins: Iterable[Pin], source: Affine, target: Affine) -> tuple[Pin, ...]:
    """Pins of a leg in the frame of the first drawing."""
    given = np.array([_pin(pin) for pin in pins]).reshape(-1, 4)
    both = np.concatenate([mapped(given[:, :2], source), mapped(given[:, 2:], target)], axis=1)
    return tuple(map(_pin, both.tolist()))


def _pin(given: Iterable[float]) -> Pin:
    try:
        ax, ay, bx, by = map(float, given)
    except (TypeError, ValueError) as error:
        raise OptionError(f"pin: {given!r} is not (ax, ay, bx, by)") from error
    return ax, ay, bx, by

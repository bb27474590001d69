"""Quads and triangles that move as one: where they are in every frame, and how they map.

.. [WKD07] K. H. Wong, P. Kovesi, A. Datta, "Projective Transformations for Image Transition
   Animations", ICIAP 2007.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Affine, Floats, Index, Mask, Points
from shapetween.geometry.affine import mapped
from shapetween.geometry.polygon import corner_sines, polygon_area
from shapetween.interpolate import Tween, tween
from shapetween.interpolate.quads import interpolate_quads
from shapetween.mesh.pair import MeshPair
from shapetween.photo.slip import bilinear_quads, greatest_slip
from shapetween.raster.faces import Bilinear, FaceMap, Footprint, Projection, projections

__all__ = ["Layer", "Piece", "ShownFace"]

#: Least sine of a quad's corner in a frame, below which it is drawn as two triangles throughout.
#: Larger gives up straight lines early; smaller lets the map's horizon come near the quad.
LEAST_SINE = 1e-3

#: Area in pixels below which a face is not drawn: what it would add to a pixel cannot be seen.
LEAST_AREA = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A mesh over both pictures, and how it moves if not by the method alone.

    Attributes
    ----------
    pair : MeshPair
        Source in A's own pixels, target in B's.
    path : Tween or None
        Vertices at any time in A's pixels; None for the method that is asked for.
    """

    pair: MeshPair
    path: Tween | None = None


@dataclass(frozen=True, slots=True, eq=False)
class ShownFace:
    """One face in one frame.

    Attributes
    ----------
    corners : (K, 2) float64
        In the frame's pixels.
    inverses : (FaceMap, FaceMap)
        From the frame to A and to B.
    footprints : (Footprint, Footprint)
    ends : ((K, 2) float64, (K, 2) float64)
        Corners in A and in B, in their own pixels.
    """

    corners: Points
    inverses: tuple[FaceMap, FaceMap]
    footprints: tuple[Footprint, Footprint]
    ends: tuple[Points, Points]


@dataclass(frozen=True, slots=True, eq=False)
class Layer:
    """A mesh, or one quad alone, with its places in all frames.

    Attributes
    ----------
    pair : MeshPair
        Vertices in A's and in B's own pixels; quads that fail in a frame are split in two.
    vertices : (F, V, 2) float64
        In the frame's pixels.
    bilinear : (Q,) bool
        Quads whose neighbours would part along their common side as homographies.
    slips : (float, float)
        Greatest distance, in the frame's pixels, by which neighbours part along their common side
        in any frame: if all quads were mapped by homographies, and as they are.
    split : tuple of int
        Quads of the mesh as it was given that are drawn as two triangles.
    """

    pair: MeshPair
    vertices: Points
    bilinear: Mask
    slips: tuple[float, float]
    split: tuple[int, ...]

    @classmethod
    def of(
        cls,
        piece: Piece,
        fits: tuple[Affine, Affine],
        times: Floats,
        method: str,
        tolerance: float,
    ) -> "Layer":
        """Move a mesh.

        Parameters
        ----------
        piece : Piece
        fits : ((2, 3), (2, 3)) float64
            From A's and B's pixels to the frame's.
        times : (F,) float64
        method : str
            One of `shapetween.interpolate.METHODS`.
        tolerance : float
            Slip, in the frame's pixels, past which quads are mapped bilinearly.

        Raises
        ------
        DegenerateQuadError
            If a quad has no projective in-between.
        """
        pair = piece.pair
        if piece.path is not None:
            vertices = mapped(piece.path.vertices(times), fits[0])
        else:
            source, target = mapped(pair.source, fits[0]), mapped(pair.target, fits[1])
            vertices = _moved(MeshPair(source, target, pair.quads, pair.triangles), times, method)
        failing = _failing(vertices, pair.quads)
        split = np.flatnonzero(failing)
        if len(split):
            halves = _halves(vertices, pair.quads[split])
            triangles = np.concatenate([pair.triangles, halves])
            pair = MeshPair(pair.source, pair.target, pair.quads[~failing], triangles)
        ends = (pair.source, pair.target)
        bilinear = bilinear_quads(pair, ends, vertices, tolerance)
        slips = (
            greatest_slip(pair, ends, vertices, np.zeros_like(bilinear)),
            greatest_slip(pair, ends, vertices, bilinear),
        )
        return cls(pair, vertices, bilinear, slips, tuple(split.tolist()))

    @classmethod
    def still(cls, corners: Points, fit: Affine) -> "Layer":
        """One quad, (4, 2) in a picture's pixels, that only stands in the frame."""
        pair = MeshPair(corners, corners, np.arange(4)[None])
        return cls(pair, mapped(corners, fit)[None], np.zeros(1, bool), (0.0, 0.0), ())

    def faces(self, frame: int) -> list[ShownFace]:
        """Every face as it is in one frame."""
        shown = []
        for faces, bilinear in (
            (self.pair.quads, self.bilinear),
            (self.pair.triangles, np.zeros(len(self.pair.triangles), bool)),
        ):
            corners = self.vertices[frame, faces]
            kept = np.abs(polygon_area(corners)) > LEAST_AREA
            if not kept.any():
                continue
            corners, bilinear = corners[kept], bilinear[kept]
            ends = (self.pair.source[faces[kept]], self.pair.target[faces[kept]])
            matrices = [projections(corners, end) for end in ends]
            for k, place in enumerate(corners):
                prints = [Footprint.of(matrix[k], place) for matrix in matrices]
                inverses: list[FaceMap] = [
                    Bilinear(place, end[k])
                    if bilinear[k]
                    else Projection(footprint.matrix, footprint.least)
                    for end, footprint in zip(ends, prints, strict=True)
                ]
                shown.append(
                    ShownFace(
                        place,
                        (inverses[0], inverses[1]),
                        (prints[0], prints[1]),
                        (ends[0][k], ends[1][k]),
                    )
                )
        return shown


def _moved(pair: MeshPair, times: Floats, method: str) -> Points:
    """Vertices at the times, (F, V, 2)."""
    if method != "projective" or len(pair.quads) != 1 or len(pair.triangles):
        return tween(pair, method).vertices(times)
    # A quad alone has no forces on it; its middle goes straight, as the paper's boards do.
    quad = pair.quads[0]
    corners = interpolate_quads(pair.source[quad][None], pair.target[quad][None], times)[:, 0]
    share = times[:, None]
    straight = (1 - share) * pair.source[quad].mean(axis=0) + share * pair.target[quad].mean(axis=0)
    corners += (straight - corners.mean(axis=1))[:, None]
    vertices = np.zeros((len(times), len(pair.source), 2))
    vertices[:, quad] = corners
    return vertices


def _failing(vertices: Points, quads: Index) -> Mask:
    """Quads that are not convex, or inverted, in some frame, (Q,)."""
    corners = vertices[:, quads]
    turning = np.sign(polygon_area(corners[0]))
    valid = corner_sines(corners) * turning[:, None] >= LEAST_SINE
    return np.asarray(~valid.all(axis=(0, 2)))


def _halves(vertices: Points, quads: Index) -> Index:
    """Two triangles for each quad, cut along the diagonal that keeps them largest, (2 N, 3)."""
    cuts = np.stack([quads[:, [[0, 1, 2], [0, 2, 3]]], quads[:, [[1, 2, 3], [1, 3, 0]]]])
    corners = vertices[:, cuts]  # (F, 2 cuts, N, 2 halves, 3, 2)
    areas = polygon_area(corners) * np.sign(polygon_area(vertices[0, quads]))[:, None]
    best = areas.min(axis=(0, 3)).argmax(axis=0)
    return np.asarray(cuts[best, np.arange(len(quads))].reshape(-1, 3))

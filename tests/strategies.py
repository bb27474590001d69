"""Random quads, meshes and maps for property tests."""

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from shapetween.base.arrays import Floats, Index, Points, Quads

__all__ = ["affine_maps", "convex_quads", "grid", "rotation", "times"]

times = st.floats(0.0, 1.0)


def rotation(angle: float) -> Floats:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


@st.composite
def convex_quads(draw: st.DrawFn, least_sine: float = 0.05) -> Quads:
    """One strictly convex quad, clockwise as drawn, (4, 2), of any size and place."""
    # A corner on each quarter of an ellipse-like ring, pulled in by up to a third: convex often.
    angles = [np.pi / 2 * (k + draw(st.floats(0.15, 0.85))) for k in range(4)]
    radii = [draw(st.floats(0.7, 1.0)) for _ in range(4)]
    quad = np.array([[r * np.cos(a), r * np.sin(a)] for a, r in zip(angles, radii, strict=True)])
    size = draw(st.floats(-2, 3).map(lambda e: 10.0**e))
    quad = quad @ np.diag([1.0, draw(st.floats(0.3, 1.0))])
    quad = quad @ rotation(draw(st.floats(-np.pi, np.pi))).T
    edges = np.roll(quad, -1, axis=0) - quad
    unit = edges / np.linalg.norm(edges, axis=1, keepdims=True)
    after = np.roll(unit, -1, axis=0)
    assume((unit[:, 0] * after[:, 1] - unit[:, 1] * after[:, 0] > least_sine).all())
    shift = np.array([draw(st.floats(-3, 3)), draw(st.floats(-3, 3))])
    return np.asarray(size * (quad + shift))


@st.composite
def affine_maps(draw: st.DrawFn) -> Floats:
    """Affine map that keeps orientation, (2, 3)."""
    first, second = draw(st.floats(-3.0, 3.0)), draw(st.floats(-np.pi, np.pi))
    stretch = np.diag([draw(st.floats(0.4, 2.5)), draw(st.floats(0.4, 2.5))])
    linear = rotation(first) @ stretch @ rotation(second)
    return np.column_stack([linear, [draw(st.floats(-50, 50)), draw(st.floats(-50, 50))]])


def grid(columns: int, rows: int) -> tuple[Points, Index]:
    """Unit squares: vertices (V, 2) and quads (Q, 4), clockwise as drawn."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    quads = np.stack([first, first + 1, first + columns + 2, first + columns + 1], axis=1)
    return np.stack([x.ravel(), y.ravel()], axis=1), quads

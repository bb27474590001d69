"""What matchings earn by salient vertices that meet their likes, and which of them are tips."""

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.match.costs import Prepared, likeness_of_vertices, sample_features
from shapetween.match.layout import Layout
from shapetween.match.scale import VERTEX_REWARD, rounded

__all__ = ["cell_rewards", "salient_tips", "vertex_rewards"]

#: Salient tips of each outline of which every pair is tried for alternatives. More offer matchings
#: that nobody means, and cost time with the square.
FORCED_TIPS = 5


def salient_tips(prepared: Prepared) -> Index:
    """The most salient tips among the vertices, at most `FORCED_TIPS`."""
    vertices = prepared.vertices
    order = np.argsort(-np.round(vertices.weight, 9), kind="stable")
    return order[vertices.convex[order]][:FORCED_TIPS]


def vertex_rewards(a: Prepared, b: Prepared, angle: float) -> Floats:
    """Reward of matching salient vertices in one frame, (K, K): weight times likeness."""
    count = len(a.samples.points)
    first, second = (sample_features(p, p.vertices.index / count) for p in (a, b))
    weight = (a.vertices.weight[:, None] + b.vertices.weight) / 2
    alike = a.vertices.convex[:, None] == b.vertices.convex
    return rounded(weight * alike * likeness_of_vertices(first.turned(angle), second))


def cell_rewards(rewards: Floats, layout: Layout) -> Floats:
    """What a path earns in each cell by matching salient vertices, (n, n)."""
    reward = np.zeros((len(layout.a), len(layout.b)))
    earned = VERTEX_REWARD * len(layout.a) * rewards
    np.maximum.at(reward, (layout.a_vertices[:, None], layout.b_vertices[None]), earned)
    return reward

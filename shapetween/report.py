"""What a movement is known to be worth, as plain values for JSON."""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from shapetween.base.notices import Notice
from shapetween.base.version import installed_version
from shapetween.geometry.homography import homogeneous_weights, quad_homographies
from shapetween.geometry.polygon import corner_sines
from shapetween.match import Matcher
from shapetween.mesh.pair import MeshPair
from shapetween.outline.body import Carried, RingMatch
from shapetween.pipeline import Prepared
from shapetween.scene.items import Item

if TYPE_CHECKING:
    from shapetween.scene.movement import SceneMovement

__all__ = ["build", "build_chain", "mesh_figures"]


def build(prepared: Prepared, method: str) -> dict[str, Any]:
    """Everything known of a movement.

    Parameters
    ----------
    prepared : Prepared
    method : str
    """
    outer = [
        ring
        for part in prepared.meshed
        for body in part.bodies
        for ring in body.nodes.rings
        if not ring.hole
    ]
    alone = prepared.scene is None and len(outer) == 1
    unmeshed = () if prepared.scene is None else prepared.scene.unmeshed
    return {
        "version": installed_version(),
        "method": method,
        "rings": [
            _ring(part.name, body, ring, alone=alone and not ring.hole)
            for part in prepared.meshed
            for body in part.bodies
            for ring in body.nodes.rings
        ],
        "parts": [] if prepared.scene is None else _parts(prepared.scene),
        "riding": [],  # empty: the key stays for one version
        "warnings": list(prepared.warnings),
        "notices": [notice.as_json() for notice in (*prepared.notices, *unmeshed)],
    }


def build_chain(
    legs: Sequence[dict[str, Any]],
    names: Sequence[str],
    warnings: Sequence[str],
    notices: Sequence[Notice],
) -> dict[str, Any]:
    """Everything known of movements that follow each other.

    Parameters
    ----------
    legs : sequence of dict
        What `build` says of each.
    names : sequence of str
        What the drawings are called, one more than legs.
    warnings : sequence of str
    notices : sequence of Notice
        Of all legs, as the warnings are.
    """
    return {
        "version": legs[0]["version"],
        "method": legs[0]["method"],
        "legs": [
            {"from": start, "to": end} | {key: leg[key] for key in ("rings", "parts", "riding")}
            for leg, (start, end) in zip(legs, pairwise(names), strict=True)
        ],
        "warnings": list(warnings),
        "notices": [notice.as_json() for notice in notices],
    }


def _ring(name: str, body: Carried, ring: RingMatch, *, alone: bool) -> dict[str, Any]:
    matching = ring.matching
    return {
        "name": name,
        "hole": ring.hole,
        **(mesh_figures(ring.pair) if ring.pair is not None else {}),
        "found": ring.found,
        "moved_by": body.setting,
        "quad_share": round(body.quad_share, 4),
        "led_by_quads": round(body.quad_share, 4),  # its name up to this version
        "self_crossing": {
            "times_checked": body.checked,
            "found": body.crossing,
            "repaired": body.repaired,
            "area": _number(body.seen.area),
            "width": _number(body.seen.width),
        },
        "matching": {
            "cost": _number(matching.cost),
            "runner_up": _number(matching.runner_up),
            "confidence": matching.confidence,
        },
        **({"alternatives": _alternatives(ring)} if alone else {}),
    }


def _alternatives(ring: RingMatch) -> list[dict[str, Any]]:
    """The distinct matchings there are, by the number that takes each."""
    return [
        {
            "matching": number,
            "cost": _number(found.cost),
            "turn": round(float(np.degrees(found.turn)), 1),
        }
        for number, found in enumerate(Matcher(*ring.ends).alternatives(), start=1)
    ]


def _parts(scene: "SceneMovement") -> list[dict[str, Any]]:
    """Who became whom, at what cost, and what stayed alone."""
    a, b = scene.scenes
    found: list[dict[str, Any]] = [
        {
            "from": _item(a.items[role.first], role.first),
            "to": _item(b.items[role.second], role.second),
            "cost": _number(role.cost),
            "reason": role.reason,
        }
        for role in scene.roles.pairs
    ]
    found += [
        {"from": _item(a.items[k], k), "to": None, "cost": _number(cost), "reason": "alone"}
        for k, cost in zip(scene.roles.disappearing, scene.roles.disappearing_costs, strict=True)
    ]
    found += [
        {"from": None, "to": _item(b.items[k], k), "cost": _number(cost), "reason": "alone"}
        for k, cost in zip(scene.roles.appearing, scene.roles.appearing_costs, strict=True)
    ]
    return found


def _item(item: Item, number: int) -> dict[str, Any]:
    """How a part is called: by its place in the paint order, its shape and that one's name."""
    return {"part": number + 1, "shape": item.shape + 1, "name": item.name}


def mesh_figures(pair: MeshPair) -> dict[str, Any]:
    """Counts and quality of a mesh: least corner sine of both ends, largest ratio of w."""
    faces = [f for f in (pair.quads, pair.triangles) if len(f)]
    sines = [corner_sines(points[f]).min() for f in faces for points in (pair.source, pair.target)]
    ratio = 1.0
    if len(pair.quads):
        source, target = pair.source[pair.quads], pair.target[pair.quads]
        weights = homogeneous_weights(quad_homographies(source, target), source)
        ratio = float((weights.max(axis=1) / weights.min(axis=1)).max())
    return {
        "quads": len(pair.quads),
        "triangles": len(pair.triangles),
        "least_corner_sine": round(float(np.min(sines)), 6),
        "largest_w_ratio": round(ratio, 6),
    }


def _number(value: float) -> float | None:
    """A number that JSON has; None for an infinite one."""
    return round(float(value), 6) if np.isfinite(value) else None

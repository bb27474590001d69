"""A comparison: every variant with its figures, and the texts it can be written as."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from shapetween import report
from shapetween.api import Morph, morph
from shapetween.base.errors import ShapetweenError
from shapetween.base.observe import Observer, unobserved
from shapetween.compare.measures import COLUMNS, TIMES, Figures, measure
from shapetween.compare.variants import Variant, bare_variants, first_variant
from shapetween.model.drawing import Drawing
from shapetween.outline.body import joined_meshes

__all__ = ["Comparison", "compare"]


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """Methods side by side on one pair.

    Attributes
    ----------
    names : (str, str)
        What the two drawings are called.
    morph : Morph
        The movement whose matching and mesh all variants share.
    variants : tuple of Variant
    figures : mapping of str to Figures
        By key of variant; those that failed have none.
    """

    names: tuple[str, str]
    morph: Morph
    variants: tuple[Variant, ...]
    figures: Mapping[str, Figures]

    def html(self) -> str:
        """A page that needs nothing else."""
        from shapetween.compare.page import page_html

        return page_html(self.names, self.variants, self.figures, self.morph)

    def svg(self, *, duration: float = 2.0) -> str:
        """The animations alone, side by side, back and forth."""
        from shapetween.compare.panels import side_by_side

        return side_by_side(self.variants, f"{self.names[0]} to {self.names[1]}", duration)

    def json(self) -> str:
        """The figures, with what is known of the matching and mesh."""
        return json.dumps(self.to_json(), indent=1) + "\n"

    def to_json(self) -> dict[str, Any]:
        """The figures as plain values."""
        return {
            "drawings": list(self.names),
            "times": TIMES.round(6).tolist(),
            "meanings": {column.key: column.meaning for column in COLUMNS},
            "variants": {
                variant.key: {
                    "method": variant.method,
                    "folds": variant.folds,
                    **(
                        {"failed": variant.failure}
                        if variant.failure
                        else self.figures[variant.key].to_json()
                    ),
                    **(
                        {"meshes": _mesh_figures(variant)}
                        if variant.folds == "allow" and not variant.failure
                        else {}
                    ),
                }
                for variant in self.variants
            },
            "matching": report.build(self.morph.prepared, self.morph.method),
        }


def compare(
    a: str | PathLike[str] | Drawing,
    b: str | PathLike[str] | Drawing,
    *,
    names: tuple[str, str] | None = None,
    observe: Observer = unobserved,
    **options: Any,
) -> Comparison:
    """Move one pair by every method.

    Parameters
    ----------
    a, b : path or Drawing
    names : (str, str), optional
        What to call them; by default the names of their files.
    observe : Observer, optional
        Told of every stage as it begins and ends.
    **options
        Those of `shapetween.morph`. Its method and way of treating folds are the first variant;
        every method by itself follows.

    Raises
    ------
    ShapetweenError
        If the pair cannot be matched or meshed, or holds no filled shapes that are matched.
    """
    method, folds = options.get("method", "projective"), options.get("folds", "prevent")
    # What moves with another's mesh has no mesh that a method could move alone.
    options = {"together": False, **options}
    try:
        found = morph(a, b, observe=observe, **options)
        failure = ""
    except ShapetweenError as error:
        # Where it is the method that fails, the mesh is still there to be moved by the others:
        # straight lines ask nothing of it. Where it is the pair, this fails in the same way.
        found = morph(a, b, observe=observe, **{**options, "method": "linear", "folds": "allow"})
        failure = str(error)
    with observe("compare"):
        bare = bare_variants(found.prepared)
        first = first_variant(found.prepared, method, folds, failure)
        variants = [*([first] if folds == "prevent" else []), *bare]
    with observe("measure"):
        figures = {v.key: measure(v) for v in variants if v.movement is not None}
    return Comparison(names or _names(a, b), found, tuple(variants), figures)


def _mesh_figures(variant: Variant) -> list[dict[str, Any]]:
    """All measures (`shapetween.compare.formulas`) on each body's mesh, moved alone."""
    from shapetween.compare.formulas import measure_mesh

    return [
        measure_mesh(joined_meshes(body.nodes.rings), variant.method).figures.as_dict()
        for body in variant.bodies
    ]


def _names(a: object, b: object) -> tuple[str, str]:
    first, second = (
        default if isinstance(item, Drawing) else Path(str(item)).stem
        for item, default in ((a, "A"), (b, "B"))
    )
    return first, second

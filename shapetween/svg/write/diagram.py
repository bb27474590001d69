"""A picture of how one drawing becomes another, for a person to see it and to change it.

Of several parts first who becomes whom, then the meshes of those that have one.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence

from shapetween.model.drawing import Box
from shapetween.svg.write.elements import document, text_of
from shapetween.svg.write.mesh_panels import MESH_STYLE, MeshView, draw_meshes, hatching
from shapetween.svg.write.part_panels import PART_STYLE, PartView, draw_parts

__all__ = ["diagram_svg"]

TEXT_STYLE = "text{font-family:system-ui,'Segoe UI','DejaVu Sans',sans-serif;fill:#1d2430}"


def diagram_svg(
    meshes: Sequence[MeshView], names: tuple[str, str], parts: Sequence[PartView] = ()
) -> str:
    """Draw parts and meshes of both drawings side by side.

    Parameters
    ----------
    meshes : sequence of MeshView
        At least one, unless there are parts.
    names : (str, str)
        What the two files are called.
    parts : sequence of PartView
        In paint order; none where one part becomes the other, which needs no telling.
    """
    root = document(Box(0, 0, 1, 1), f"{names[0]} to {names[1]}")
    style = TEXT_STYLE + MESH_STYLE + (PART_STYLE if parts else "")
    ET.SubElement(root, "style").text = style
    root.append(hatching())
    ET.SubElement(root, "rect", {"width": "100%", "height": "100%", "fill": "#fff"})
    width = height = 0.0
    if parts:
        width, height = draw_parts(root, parts, names, height)
    if meshes:
        right, height = draw_meshes(root, meshes, names, height)
        width = max(width, right)
    size = str(math.ceil(width)), str(math.ceil(height))
    root.set("viewBox", f"0 0 {size[0]} {size[1]}")
    root.set("width", size[0])
    root.set("height", size[1])
    return text_of(root)

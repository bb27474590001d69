"""The picture of the first steps that sets this extension beside Inkscape's own Interpolate.

Run it in a checkout: ``python gallery/inkscape_pictures.py``. It needs Inkscape, and a Python with
what its extensions need (lxml, cssselect, numpy, tinycss2), named as the first argument where the
system's has it not. It prints how many in-betweens cross themselves.
"""

import os
import re
import subprocess
import sys
import tempfile
from itertools import pairwise
from pathlib import Path

import shapely
from PIL import Image

from shapetween.geometry.bezier import flatten
from shapetween.inkscape import FILES, install
from shapetween.model.drawing import Drawing
from shapetween.raster.resvg import drawn
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg

GALLERY = Path(__file__).resolve().parent
INPUTS = GALLERY / "inputs"
SYSTEM = Path("/usr/share/inkscape/extensions")

#: Pairs of one outline each, without holes, which is all that Interpolate takes.
PAIRS = (
    "horse",
    "kangaroo",
    "camel",
    "elephant",
    "deer",
    "giraffe",
    "airplane",
    "jet",
    "palm-tree",
    "cactus",
    "hammer",
    "wrench",
    "maple-leaf",
    "monstera-leaf",
)

STEPS = 9

#: Of a frame in the picture, in pixels.
SIZE = 100


def data(name: str) -> str:
    """Path data of a drawing of one path."""
    found = re.search(r'\sd="([^"]+)"', (INPUTS / f"{name}.svg").read_text("utf-8"))
    assert found is not None
    return found[1]


def document(first: str, second: str) -> str:
    """Both silhouettes on one page, one over the other."""
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24" width="24" height="24">'
        f'<path id="a" d="{data(first)}"/><path id="b" d="{data(second)}"/></svg>'
    )


def made(python: str, script: Path, drawing: Path, *words: str) -> list[Drawing]:
    """The in-betweens that an extension puts into a document, each as a drawing."""
    done = subprocess.run(
        [python, str(script), "--id=a", "--id=b", f"--steps={STEPS}", *words, str(drawing)],
        env={**os.environ, "PYTHONPATH": str(SYSTEM), "SHAPETWEEN_QUIET": "1"},
        capture_output=True,
        check=True,
    )
    drawing_of = read_svg(done.stdout, script.name)
    shapes = drawing_of.shapes[-STEPS:]
    return [Drawing((shape,), drawing_of.box) for shape in shapes]


def crossing(drawings: list[Drawing]) -> int:
    """How many of them cross themselves."""
    rings = [drawing.shapes[0].rings[0] for drawing in drawings]
    return sum(not shapely.Polygon(flatten(ring.curves, 16)).is_valid for ring in rings)


def strip(drawings: list[Drawing]) -> Image.Image:
    """They side by side."""
    sheet = Image.new("RGB", (SIZE * len(drawings), SIZE), "white")
    for k, drawing in enumerate(drawings):
        rgba = Image.fromarray(drawn(frame_svg(drawing), SIZE, SIZE), "RGBA")
        sheet.paste(rgba, (k * SIZE, 0), rgba)
    return sheet


def compare(python: str) -> None:
    """Print the figures, and keep the picture of the first pair."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        install(folder)
        for first, second in list(pairwise(PAIRS))[::2]:
            drawing = folder / "drawing.svg"
            drawing.write_text(document(first, second), "utf-8")
            ways = [
                made(python, SYSTEM / "interp.py", drawing, "--dup=false", f"--method={way}")
                for way in ("equalSubsegments", "firstNodes")
            ]
            ours = made(python, folder / FILES[1], drawing)
            counts = [crossing(way) for way in (*ways, ours)]
            print(f"{first} to {second}: Interpolate {counts[0]} and {counts[1]}, here {counts[2]}")
            if first == PAIRS[0]:
                strips = [strip(way) for way in (*ways, ours)]
                sheet = Image.new("RGB", (strips[0].width, 3 * SIZE), "white")
                for k, row in enumerate(strips):
                    sheet.paste(row, (0, k * SIZE))
                sheet.save(GALLERY / "inkscape.webp", quality=88, method=6)


if __name__ == "__main__":
    compare(sys.argv[1] if len(sys.argv) > 1 else "/usr/bin/python3")

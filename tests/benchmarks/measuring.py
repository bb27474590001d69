"""What the benchmark report measures, in seconds of processor time: it counts work, not waiting."""

import json
import os
import platform
import resource
import shutil
import subprocess
import sys
import time
import tracemalloc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.geometry.bezier import signed_area
from shapetween.interpolate.projective import Projective
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Drawing
from shapetween.pipeline import prepare
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.numbers import path_data
from shapetween.svg.write.smil import smil_svg
from tests.strategies import grid

__all__ = [
    "FRAMES",
    "PAIRS",
    "ROOT",
    "SIZES",
    "RivalsMissingError",
    "Speeds",
    "bent_grid",
    "exponent",
    "machine",
    "peak_memory",
    "peaks",
    "read",
    "rivals",
    "scaling",
    "speeds",
    "startups",
]

ROOT = Path(__file__).resolve().parents[2]

#: Drawings of the gallery that are one filled shape each.
PAIRS = (
    ("horse", "kangaroo"),
    ("camel", "elephant"),
    ("deer", "giraffe"),
    ("airplane", "jet"),
    ("palm-tree", "cactus"),
    ("run", "walk"),
    ("hammer", "wrench"),
    ("maple-leaf", "monstera-leaf"),
)

#: What a process imports that does nothing else.
LIBRARIES = "import numpy, scipy.sparse.linalg, shapely"

#: Icons of the gallery that are morphed in a process of their own.
ICONS = {
    "icons of lines": ("icon-menu", "icon-x"),
    "icons that are areas": ("solid-play", "solid-pause"),
    "silhouettes": ("horse", "kangaroo"),
}

#: Times at which frames are asked for, all in one call.
FRAMES = np.linspace(0, 1, 60)

#: Sides of the square grids of quads; of the last one only some frames are asked for.
SIZES = (10, 32, 100, 316)
MOST_CORNERS = 2_000_000

#: Names the folder where rivals are installed ("npm install flubber gsap jsdom").
FOLDER = "SHAPETWEEN_RIVALS"

#: Size in pixels that rivals get their outlines in; their constants are made for it.
UNIT = 512.0


class RivalsMissingError(Exception):
    """No node, or no folder with rivals."""


@dataclass(frozen=True, slots=True)
class Speeds:
    """Seconds for one pair of drawings.

    Attributes
    ----------
    stages : dict of str to float
        Of the preparation.
    whole : float
        The preparation.
    frame, written : float
        The curves of one frame, and their path data.
    file : float
        Writing an animated SVG.
    """

    stages: dict[str, float]
    whole: float
    frame: float
    written: float
    file: float


class Stages:
    """An observer that adds up the seconds of every stage."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}

    @contextmanager
    def __call__(self, stage: str) -> Iterator[None]:
        start = time.process_time()
        yield
        self.seconds[stage] = self.seconds.get(stage, 0.0) + time.process_time() - start


def read(name: str) -> Drawing:
    """A drawing of the gallery."""
    file = ROOT / "gallery/inputs" / f"{name}.svg"
    return read_svg(file.read_bytes(), file.name)


def _least(work: Callable[[], object], rounds: int) -> float:
    """Seconds of the quickest of some rounds."""
    found = []
    for _ in range(rounds):
        start = time.process_time()
        work()
        found.append(time.process_time() - start)
    return min(found)


def speeds(source: Drawing, target: Drawing, rounds: int = 3) -> Speeds:
    """Prepare a pair, draw it and write it down; the quickest of some rounds of each."""
    best: tuple[float, dict[str, float]] | None = None
    for k in range(rounds):
        stages = Stages()
        # Of another size each time: what outlines have been found to be is remembered.
        size = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]) * (1 + 1e-9 * k)
        ends = source.transformed(size), target.transformed(size)
        start = time.process_time()
        prepared = prepare(*ends, observe=stages)
        whole = time.process_time() - start
        if best is None or whole < best[0]:
            best = whole, stages.seconds
    assert best is not None
    parts = prepared.movement.parts
    drawn = [part.curves(FRAMES) for part in parts]
    # Other times for each round: a part may know what it was asked for last.
    clocks = (FRAMES * (1 - 1e-9 * k) for k in range(1, rounds + 1))

    def draw() -> None:
        clock = next(clocks)
        for part in parts:
            part.curves(clock)

    written = [(c, list(p.rings), list(p.closed)) for c, p in zip(drawn, parts, strict=True)]
    return Speeds(
        best[1],
        best[0],
        _least(draw, rounds) / len(FRAMES),
        _least(lambda: [path_data(*w, 2) for w in written], rounds) / len(FRAMES),
        _least(lambda: smil_svg(prepared.movement), rounds),
    )


class Peaks:
    """An observer of the most memory that Python has allocated within each stage, in bytes."""

    def __init__(self) -> None:
        self.peaks: dict[str, int] = {}
        self._open: list[int] = []

    def _keep(self) -> None:
        """Raise the peaks of all stages that are open; a new count begins."""
        peak = tracemalloc.get_traced_memory()[1]
        self._open = [max(own, peak) for own in self._open]
        tracemalloc.reset_peak()

    @contextmanager
    def __call__(self, stage: str) -> Iterator[None]:
        self._keep()
        self._open.append(0)
        yield
        self._keep()
        self.peaks[stage] = max(self.peaks.get(stage, 0), self._open.pop())


def peaks(source: Drawing, target: Drawing) -> dict[str, float]:
    """Most MB that are allocated in each stage, and at all while a pair is prepared and written."""
    seen = Peaks()
    tracemalloc.start()
    try:
        with seen("whole"):
            prepared = prepare(source, target, observe=seen)
            with seen("write"):
                smil_svg(prepared.movement)
    finally:
        tracemalloc.stop()
    return {stage: peak / 1e6 for stage, peak in seen.peaks.items()}


def rivals(pairs: list[tuple[Drawing, Drawing]]) -> list[dict[str, tuple[float, float]]]:
    """Seconds that each rival takes to set up a pair, and for a frame; of those that can do it.

    Raises
    ------
    RivalsMissingError
        If they cannot be run here.
    """
    node, folder = shutil.which("node"), os.environ.get(FOLDER, "")
    if node is None:
        raise RivalsMissingError("there is no node")
    if not all((Path(folder) / "node_modules" / name).is_dir() for name in ("flubber", "gsap")):
        raise RivalsMissingError(f"{FOLDER} does not name a folder where they are installed")
    outlines = json.dumps([[_outlines(drawing) for drawing in pair] for pair in pairs])
    script = Path(__file__).with_name("rivals.mjs")
    done = subprocess.run(
        [node, str(script), folder], input=outlines, capture_output=True, text=True, check=True
    )
    return [{name: (a, b) for name, (a, b) in row.items()} for row in json.loads(done.stdout)]


def _outlines(drawing: Drawing) -> list[str]:
    """Path data of each ring, in pixels, the largest first."""
    rings = [ring for shape in drawing.shapes for ring in shape.rings]
    rings.sort(key=lambda ring: -abs(signed_area(ring.curves)))
    box = drawing.box
    size = UNIT / max(box.width, box.height)
    scaled = [((ring.curves - [box.x, box.y]) * size)[None] for ring in rings]
    return [
        path_data(curves, [len(ring.curves)], [ring.closed], 2)[0]
        for curves, ring in zip(scaled, rings, strict=True)
    ]


def bent_grid(side: int) -> MeshPair:
    """A square grid of quads that becomes an arch."""
    points, quads = grid(side, side)
    x, y = (points - points.min(axis=0)).T / np.ptp(points, axis=0).max()
    angle, radius = np.pi * (1 - x), 1.5 - y
    arch = np.stack([radius * np.cos(angle), -radius * np.sin(angle)], axis=1)
    return MeshPair(np.stack([x, y], axis=1), arch, quads)


def scaling(side: int) -> tuple[int, float, float]:
    """Quads of a grid, and the projective method's seconds to prepare it and for one frame."""
    pair = bent_grid(side)
    start = time.process_time()
    tween = Projective(pair)
    ready = time.process_time()
    times = FRAMES[: max(1, MOST_CORNERS // (4 * side * side))]
    tween.vertices(times)
    return side * side, ready - start, (time.process_time() - ready) / len(times)


def exponent(sizes: Floats, seconds: Floats) -> float:
    """Power of the size that seconds grow with, between the first and the last."""
    return float(np.log(seconds[-1] / seconds[0]) / np.log(sizes[-1] / sizes[0]))


def _alone(compiled: Path, *arguments: str) -> float:
    """Seconds of processor time of a Python process of its own, which keeps compiled modules."""
    environment = {**os.environ, "PYTHONPYCACHEPREFIX": str(compiled)}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, check=True, capture_output=True, env=environment
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def startups(folder: Path, rounds: int = 5) -> dict[str, tuple[float, float]]:
    """Seconds of whole commands, and of importing what they cannot do without, in turn.

    As of what is installed: its modules are compiled before the first round.
    """
    found = {}
    commands = {"shapetween --help": (["--help"], "import click")}
    for kind, names in ICONS.items():
        inputs = [str(ROOT / f"gallery/inputs/{name}.svg") for name in names]
        morph = ["morph", *inputs, "-o", str(folder / "out.svg")]
        commands[f"shapetween morph, {kind}"] = (
            morph,
            "import numpy, scipy.sparse.linalg, shapely",
        )
    for name, (command, floor) in commands.items():
        works = [("-m", "shapetween", *command), ("-c", floor)]
        rows = [[_alone(folder, *work) for work in works] for _ in range(1 + rounds)]
        found[name] = median(a for a, _ in rows[1:]), median(b for _, b in rows[1:])
    return found


def peak_memory(code: str) -> float:
    """Most memory, in MB, of a Python process of its own that runs some code.

    The system counts it as no less than this process's at that moment.
    """
    code += "\nimport resource; print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, check=True, capture_output=True, text=True
    )
    unit = 1e6 if sys.platform == "darwin" else 1e3
    return float(done.stdout.split()[-1]) / unit


def machine() -> str:
    """What is measured on."""
    name = platform.processor() or platform.machine()
    cpus = Path("/proc/cpuinfo")
    if cpus.exists():
        models = [x for x in cpus.read_text("utf-8").splitlines() if x.startswith("model name")]
        name = models[0].partition(":")[2].strip() if models else name
    return f"{name}, {os.cpu_count()} cores, Python {platform.python_version()}"

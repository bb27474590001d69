"""The benchmark report: ``python -m tests.benchmarks [--plot FILE.svg]``.

Rivals are measured along where node is installed and SHAPETWEEN_RIVALS names a folder in which
``npm install flubber`` was run.
"""

import argparse
import tempfile
from pathlib import Path
from statistics import median

import numpy as np

from shapetween.base.arrays import Floats
from tests.benchmarks.measuring import (
    PAIRS,
    SIZES,
    RivalsMissingError,
    Speeds,
    exponent,
    machine,
    peak_memory,
    read,
    rivals,
    scaling,
    speeds,
    startups,
)

#: Code of a process of its own whose memory is measured.
TEN_THOUSAND = """
import numpy as np
from shapetween.interpolate.projective import Projective
from tests.benchmarks.measuring import bent_grid
Projective(bent_grid(100)).vertices(np.linspace(0, 1, 60))
"""


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument("--plot", type=Path, help="draw seconds by mesh size to an SVG file")
    plot = parser.parse_args().plot
    print(f"Processor time on {machine()}.\n")
    whole_commands()  # while this process is small: what it starts is counted no smaller
    pairs()
    sizes(plot)


def pairs() -> None:
    drawings = [(read(a), read(b)) for a, b in PAIRS]
    speeds(*drawings[0], rounds=1)  # the first one imports
    found = [speeds(*pair) for pair in drawings]
    print(f"| {len(found)} pairs of the gallery, median | ms |\n|---|---:|")
    for stage in sorted({stage for each in found for stage in each.stages}):
        seconds = median(each.stages.get(stage, 0.0) for each in found)
        print(f"| preparation: {stage} | {1e3 * seconds:.1f} |")
    for name, seconds in _medians(found).items():
        print(f"| {name} | {1e3 * seconds:.3g} |")
    try:
        theirs = rivals(drawings)
    except RivalsMissingError as missing:
        print(f"\nflubber is not measured: {missing}.\n")
        return
    setups = median(ours.whole / setup for ours, (setup, _) in zip(found, theirs, strict=True))
    frames = median(ours.frame / frame for ours, (_, frame) in zip(found, theirs, strict=True))
    print(f"| flubber: set-up | {1e3 * median(setup for setup, _ in theirs):.1f} |")
    print(f"| flubber: a frame | {1e3 * median(frame for _, frame in theirs):.3g} |")
    print(f"\nTimes flubber's, median: set-up {setups:.1f}, frame {frames:.2f}.\n")


def _medians(found: list[Speeds]) -> dict[str, float]:
    return {
        "preparation, whole": median(each.whole for each in found),
        "a frame of 60": median(each.frame for each in found),
        "its path data": median(each.written for each in found),
    }


def sizes(plot: Path | None) -> None:
    rows = np.array([scaling(side) for side in SIZES])
    print("| quads, projective | preparation, s | a frame, ms |\n|---:|---:|---:|")
    for quads, prepared, frame in rows.tolist():
        print(f"| {quads:,.0f} | {prepared:.3f} | {1e3 * frame:.2f} |")
    grown = [exponent(rows[1:, 0], column) for column in rows[1:, 1:].T]
    print(f"\nFrom {rows[1, 0]:,.0f} quads on they grow with the power {grown[0]:.2f} of the")
    print(f"number of quads, and {grown[1]:.2f}.\n")
    if plot is not None:
        plot.write_text(plotted(rows), "utf-8")


def whole_commands() -> None:
    print("| command, cold | s | times the imports it needs |\n|---|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        for name, (seconds, floor) in startups(Path(folder)).items():
            print(f"| {name} | {seconds:.2f} | {seconds / floor:.2f} |")
    print(f"\n10,000 quads at 60 times: {peak_memory(TEN_THOUSAND):.0f} MB at most.\n")


def plotted(rows: Floats) -> str:
    """Seconds by number of quads, both logarithmic, as SVG text."""
    x = 60 + 100 * (np.log10(rows[:, 0]) - 2)
    marks = []
    for colour, column, name in (("#06c", 1, "preparation"), ("#c30", 2, "a frame")):
        y = 40 - 50 * np.log10(rows[:, column] / 10)
        path = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))
        marks.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        marks.append(f'<text x="{x[-1] + 6:.0f}" y="{y[-1]:.0f}" fill="{colour}">{name}</text>')
    for power in range(2, 6):
        place = 60 + 100 * (power - 2)
        marks.append(f'<text x="{place}" y="315" text-anchor="middle">{10**power:,}</text>')
        marks.append(f'<path d="M{place} 40V300" stroke="#ddd"/>')
    for power in range(-4, 2):
        place = 40 - 50 * (power - 1)
        marks.append(f'<text x="52" y="{place + 4}" text-anchor="end">{10.0**power:g} s</text>')
        marks.append(f'<path d="M60 {place}H360" stroke="#ddd"/>')
    body = "\n".join(sorted(marks, key=lambda mark: not mark.startswith("<path")))
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 450 330" font-family="sans-serif" '
        f'font-size="11">\n<rect width="450" height="330" fill="#fff"/>\n{body}\n'
        '<text x="210" y="20" text-anchor="middle">seconds by number of quads</text>\n</svg>\n'
    )


if __name__ == "__main__":
    main()

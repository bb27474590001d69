"""The benchmark report: ``python -m tests.benchmarks [--pairs FOLDER] [--plot FILE.svg]``.

Rivals are measured along, in the same run, where node is installed and SHAPETWEEN_RIVALS names a
folder in which ``npm install flubber gsap jsdom`` was run.
"""

import argparse
import tempfile
from collections.abc import Iterable
from pathlib import Path
from statistics import median

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.base.threads import one_thread
from shapetween.model.drawing import Drawing
from tests.benchmarks.categories import (
    PARTS,
    POINTS,
    categories,
    made_of_parts,
    made_of_points,
)
from tests.benchmarks.measuring import (
    SIZES,
    RivalsMissingError,
    exponent,
    machine,
    peak_memory,
    peaks,
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


#: Columns of the table of categories: a stage, and what it is called there.
STAGES = {"perceive": "see", "match": "match", "mesh": "mesh", "move": "move"}

#: Pairs of a category whose memory is measured, which takes three times as long.
WEIGHED = 4


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument("--plot", type=Path, help="draw seconds by size to an SVG file")
    parser.add_argument("--pairs", type=Path, help="a folder with pairs.json, by category")
    parser.add_argument("--most", type=int, default=12, help="pairs of each category")
    parser.add_argument("--only", default="", help="categories, with commas; no other figures")
    options = parser.parse_args()
    only = tuple(filter(None, options.only.split(",")))
    print(f"Processor time on {machine()}.\n")
    if not only:
        whole_commands()  # while this process is small: what it starts is counted no smaller
    with one_thread():
        by_category(categories(options.pairs, options.most, only))
        if not only:
            growth = sizes() | grown()
            if options.plot is not None:
                options.plot.write_text(plotted(growth), "utf-8")


def by_category(found: dict[str, list[tuple[Drawing, Drawing]]]) -> None:
    """Medians of each category, beside rivals where they are there."""
    stages = " | ".join(f"{name}, ms" for name in STAGES.values())
    print(f"| category | pairs | preparation, ms | {stages} | write, ms | peak, MB ", end="")
    print("| a frame, ms | set-up, flubber's | GSAP's | a frame, flubber's | GSAP's |")
    print("|---|" + "---:|" * (len(STAGES) + 9))
    for name, pairs in found.items():
        speeds(*pairs[0], rounds=1)  # the first one imports
        ours = [speeds(*pair) for pair in pairs]
        row = [f"{len(pairs)}", _ms(each.whole for each in ours)]
        row += [_ms(each.stages.get(stage, 0.0) for each in ours) for stage in STAGES]
        row += [_ms(each.file for each in ours)]
        row += [f"{max(peaks(*pair)['whole'] for pair in pairs[:WEIGHED]):.0f}"]
        row += [f"{1e3 * median(each.frame for each in ours):.2g}"]
        try:
            theirs = rivals(pairs)
        except RivalsMissingError:
            theirs = []
        for mine, k in (([each.whole for each in ours], 0), ([each.frame for each in ours], 1)):
            row += [_ratio(mine, theirs, rival, k) for rival in ("flubber", "GSAP")]
        print(f"| {name} | {' | '.join(row)} |", flush=True)
    print()


def _ms(seconds: Iterable[float]) -> str:
    return f"{1e3 * median(seconds):.0f}"


def _ratio(
    ours: list[float], theirs: list[dict[str, tuple[float, float]]], rival: str, k: int
) -> str:
    """How many times what a rival takes, median of the pairs it can do."""
    found = [mine / row[rival][k] for mine, row in zip(ours, theirs, strict=False) if rival in row]
    return f"{median(found):.2g}" if found else "-"


def grown() -> dict[str, Floats]:
    """Seconds by points of an outline, and by parts of a drawing."""
    found = {}
    small = made_of_points(12)
    pairs = {
        "points": [(n, made_of_points(n), small) for n in POINTS],
        "parts": [(n, made_of_parts(n, 1), made_of_parts(n, 2)) for n in PARTS],
    }
    for name, rows in pairs.items():
        found[name] = np.array([(n, *_prepared_and_written(a, b)) for n, a, b in rows])
        print(f"| {name} | preparation, s | writing, s |\n|---:|---:|---:|")
        for n, prepared, written in found[name].tolist():
            print(f"| {n:,.0f} | {prepared:.2f} | {written:.2f} |")
        power = exponent(found[name][:, 0], found[name][:, 1:].sum(axis=1))
        print(f"\nBoth together grow with the power {power:.2f} of the number of {name}.\n")
    return found


def _prepared_and_written(source: Drawing, target: Drawing) -> tuple[float, float]:
    found = speeds(source, target, rounds=1)
    return found.whole, found.file


def sizes() -> dict[str, Floats]:
    """Seconds by quads of a mesh."""
    rows = np.array([scaling(side) for side in SIZES])
    print("| quads, projective | preparation, s | a frame, ms |\n|---:|---:|---:|")
    for quads, prepared, frame in rows.tolist():
        print(f"| {quads:,.0f} | {prepared:.3f} | {1e3 * frame:.2f} |")
    grown = [exponent(rows[1:, 0], column) for column in rows[1:, 1:].T]
    print(f"\nFrom {rows[1, 0]:,.0f} quads on they grow with the power {grown[0]:.2f} of the")
    print(f"number of quads, and {grown[1]:.2f}.\n")
    return {"quads": rows}


def whole_commands() -> None:
    print("| command, cold | s | times the imports it needs |\n|---|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        for name, (seconds, floor) in startups(Path(folder)).items():
            print(f"| {name} | {seconds:.2f} | {seconds / floor:.2f} |")
    print(f"\n10,000 quads at 60 times: {peak_memory(TEN_THOUSAND):.0f} MB at most.\n")


#: Colours of what is plotted, and what its columns are called.
COLOURS = {"quads": "#06c", "points": "#c30", "parts": "#283"}


def plotted(growth: dict[str, Floats]) -> str:
    """Seconds by number of quads, points and parts, all logarithmic, as SVG text."""
    marks = []
    for name, rows in growth.items():
        x = 60 + 100 * (np.log10(rows[:, 0]) - 1)
        y = 40 - 50 * np.log10(rows[:, 1:].sum(axis=1) / 100)
        path = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))
        colour = COLOURS[name]
        marks.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        marks.append(f'<text x="{x[-1] + 6:.0f}" y="{y[-1]:.0f}" fill="{colour}">{name}</text>')
    for power in range(1, 6):
        place = 60 + 100 * (power - 1)
        marks.append(f'<text x="{place}" y="365" text-anchor="middle">{10**power:,}</text>')
        marks.append(f'<path d="M{place} 40V350" stroke="#ddd"/>')
    for power in range(-4, 3):
        place = 40 - 50 * (power - 2)
        marks.append(f'<text x="52" y="{place + 4}" text-anchor="end">{10.0**power:g} s</text>')
        marks.append(f'<path d="M60 {place}H460" stroke="#ddd"/>')
    body = "\n".join(sorted(marks, key=lambda mark: not mark.startswith("<path")))
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 540 380" font-family="sans-serif" '
        f'font-size="11">\n<rect width="540" height="380" fill="#fff"/>\n{body}\n'
        '<text x="260" y="20" text-anchor="middle">seconds by size</text>\n</svg>\n'
    )


if __name__ == "__main__":
    main()

"""How large the files are, beside the rivals': ``python -m tests.benchmarks.sizes [PACKAGES]``.

The median over the pairs of the gallery, raw and gzipped, as the README's table has it. PACKAGES
is a folder in which ``npm install gsap flubber`` was run; without it those rows are left out. What
is counted of a rival is its minified build as published, and a page's own share: both paths, and
the lines that its documentation has for moving the one to the other.
"""

import gzip
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from statistics import median

import shapetween as st
from shapetween.svg.write.sequence import frame_svg

GALLERY = Path(__file__).parents[2] / "gallery"

#: Rows of our own: what is written, and how.
OWN: dict[str, Callable[[st.Morph], str]] = {
    "animated SVG": lambda m: m.svg(),
    "animated SVG, `--loop alternate`": lambda m: m.svg(loop="alternate"),
    "animated SVG, `--keyframes 31`": lambda m: m.svg(keyframes=31),
    "JavaScript module (`.mjs`), player included": lambda m: m.module(),
}

#: Rivals: the builds that a page loads, and its own lines around two paths.
RIVALS: dict[str, tuple[tuple[str, ...], str]] = {
    "GSAP with MorphSVG, two paths": (
        ("gsap/dist/gsap.min.js", "gsap/dist/MorphSVGPlugin.min.js"),
        '<svg viewBox="0 0 24 24"><path id="a" d="{a}"/><path id="b" d="{b}" '
        'visibility="hidden"/></svg><script>gsap.to("#a",{{duration:2,morphSVG:"#b"}})</script>',
    ),
    "flubber, two paths": (
        ("flubber/build/flubber.min.js",),
        '<svg viewBox="0 0 24 24"><path id="a" d="{a}"/></svg><script>'
        'const at=flubber.interpolate("{a}","{b}"),path=document.querySelector("#a");'
        "let start;const step=now=>{{start??=now;const t=Math.min((now-start)/2000,1);"
        'path.setAttribute("d",at(t));t<1&&requestAnimationFrame(step)}};'
        "requestAnimationFrame(step)</script>",
    ),
}


def pairs() -> Iterator[tuple[Path, Path]]:
    """Both drawings of every pair that the gallery shows."""
    for shown in sorted(GALLERY.glob("*-to-*.svg")):
        ends = [GALLERY / "inputs" / f"{name}.svg" for name in shown.stem.split("-to-")]
        if all(end.is_file() for end in ends):
            yield ends[0], ends[1]


def size(text: str) -> tuple[int, int]:
    """Bytes raw and gzipped."""
    data = text.encode()
    return len(data), len(gzip.compress(data, 9, mtime=0))


def table(packages: Path | None = None) -> Iterator[tuple[str, int, int, str]]:
    """Rows: what, bytes raw and gzipped in the median, and what is needed besides."""
    morphs = [st.morph(a, b) for a, b in pairs()]
    for name, written in OWN.items():
        yield (name, *_medians([size(written(morph)) for morph in morphs]), "nothing")
    if packages is None:
        return
    paths = [[_paths(frame_svg(morph.at(t))) for t in (0.0, 1.0)] for morph in morphs]
    for name, (builds, page) in RIVALS.items():
        shares = [size(page.format(a=a, b=b)) for a, b in paths]
        library = [size((packages / build).read_text("utf-8")) for build in builds]
        raw, packed = (sum(column) for column in zip(*library, strict=True))
        yield (name, *_medians(shares), f"{raw:,} raw, {packed:,} gzipped")


def _paths(svg: str) -> str:
    """The data of all paths of a drawing as one."""
    return "".join(re.findall(r'<path[^>]*? d="([^"]*)"', svg))


def _medians(sizes: Sequence[tuple[int, int]]) -> tuple[int, int]:
    raw, packed = zip(*sizes, strict=True)
    return round(median(raw)), round(median(packed))


if __name__ == "__main__":
    folder = Path(sys.argv[1]) / "node_modules" if len(sys.argv) > 1 else None
    print(f"Median of {len(list(pairs()))} pairs of the gallery, 2 seconds, one way, in bytes:\n")
    print("| | raw | gzipped | needs besides |\n|---|--:|--:|---|")
    for what, raw, packed, besides in table(folder):
        print(f"| {what} | {raw:,} | {packed:,} | {besides} |")

"""Pairs that do not come out well, and why."""

from pathlib import Path

import shapetween as st
from shapetween.gallery import Exhibit, Picture

INPUTS = Path(__file__).parent / "inputs"

#: Fewer than each would have by itself: many small shapes make a large file.
KEYFRAMES = 16

PAIRS = (
    (
        "man-dancing",
        "woman-dancing",
        "Many small shapes of different colours: few find the partner that a person would give "
        "them, and the dress grows out of trousers. Ids that agree in both files would help.",
        "Twemoji (CC BY 4.0)",
    ),
    (
        "letter-e",
        "letter-k",
        "A stem with three arms becomes one with two, and the upper arm is made of two of them: "
        "the area between them fills and opens again.",
        "Font Awesome Free (CC BY 4.0)",
    ),
    (
        "palm-tree",
        "cactus",
        "Six leaves, three arms: some leaves have nowhere to go and are pulled in like rags.",
        "Game-icons.net (CC BY 3.0); Material Design Icons (Apache-2.0)",
    ),
)


def draw() -> list[Exhibit]:
    exhibits = []
    for a, b, text, credit in PAIRS:
        morph = st.morph(INPUTS / f"{a}.svg", INPUTS / f"{b}.svg")
        title = f"{a} to {b}".replace("-", " ")
        svg = morph.svg(loop="alternate", keyframes=KEYFRAMES)
        picture = Picture(f"{a}-to-{b}.svg", svg, f"The movement from {title}")
        exhibits.append(Exhibit(title.capitalize(), text, (picture,), wide=False, credit=credit))
    return exhibits

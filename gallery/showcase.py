"""A dozen pairs as they come out of ``shapetween morph``, without pins or hand-made meshes."""

from pathlib import Path

import shapetween as st
from shapetween.gallery import Exhibit, Picture
from shapetween.model.fit import Fit

INPUTS = Path(__file__).parent / "inputs"

MDI = "Material Design Icons (Apache-2.0)"
GAME = "Game-icons.net (CC BY 3.0)"
CLIP = "Open Clip Art Library (public domain)"

PAIRS: tuple[tuple[str, str, Fit, str, str], ...] = (
    ("horse", "kangaroo", "view", "Hind legs become legs, fore legs arms; the tail swells.", MDI),
    ("hand-closed", "hand-open", "view", "Five fingers open, each about its own joint.", GAME),
    ("hammer", "wrench", "view", "Handle to handle: the whole turns without getting shorter.", MDI),
    ("run", "walk", "view", "Two shapes; knees and elbows bend instead of melting.", MDI),
    ("airplane", "jet", "geometry", "Wings fold back while it turns.", f"{MDI}; jet: mo, {CLIP}"),
    ("camel", "elephant", "view", "The neck becomes a trunk.", f"Nicu Buculei, {CLIP}"),
    ("key", "lock", "view", "One hole goes along, the other opens where the shackle will be.", MDI),
    ("cog", "nut", "view", "Six teeth become six corners, and the hole stays round.", MDI),
    ("heart-key", "star-key", "view", "What is alike stands still.", GAME),
    ("umbrella", "tree", "view", "The canopy bulges and the handle straightens.", MDI),
    ("deer", "giraffe", "geometry", "Antlers shrink into ears, four legs find four legs.",
     f"deer: Matt Todd, {CLIP}; giraffe: Temaki (CC0)"),
    ("maple-leaf", "monstera-leaf", "view", "Lobes split into ribs.", f"{MDI}; {GAME}"),
)  # fmt: skip


def draw() -> list[Exhibit]:
    exhibits = []
    for a, b, fit, text, credit in PAIRS:
        morph = st.morph(INPUTS / f"{a}.svg", INPUTS / f"{b}.svg", fit=fit)
        title = f"{a} to {b}".replace("-", " ")
        svg = morph.svg(loop="alternate")
        picture = Picture(f"{a}-to-{b}.svg", svg, f"The movement from {title}")
        exhibits.append(Exhibit(title.capitalize(), text, (picture,), wide=False, credit=credit))
    return exhibits

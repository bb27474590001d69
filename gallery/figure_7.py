"""Figure 7: a man becomes a wolf, with as many quads as the paper's authors drew by hand."""

from pathlib import Path

import numpy as np

import shapetween as st
from shapetween.compare.panels import film_strip, seen_box
from shapetween.compare.variants import first_variant
from shapetween.gallery import Exhibit, Picture

INPUTS = Path(__file__).parent / "inputs"

#: As in the paper.
QUADS = 47

FRAMES = 8


def draw() -> list[Exhibit]:
    morph = st.morph(INPUTS / "man.svg", INPUTS / "werewolf.svg", quads=QUADS)
    variant = first_variant(morph.prepared, "projective", "prevent")
    times = np.linspace(0, 1, FRAMES)
    strip = film_strip(variant, seen_box([variant]), times, [False] * FRAMES)
    count = sum(len(pair.quads) for _, pair in morph.meshes)
    text = (
        f"The paper's authors drew their {QUADS} quads by hand; these {count} were found. Arms "
        "become arms and legs legs, the head turns aside, and the tail grows out of a thigh. "
        "Places that have no counterpart, as tail, claws and jaws, come out of whatever is nearest."
    )
    pictures = (
        Picture("figure-7.svg", strip, "A man becomes a werewolf, frame by frame"),
        Picture("figure-7-moving.svg", morph.svg(loop="alternate"), "The same in motion"),
        Picture("figure-7-mesh.svg", morph.mesh_svg(("man", "werewolf")), "The quads of both"),
    )
    return [
        Exhibit(
            "Figure 7: a man becomes a wolf",
            text,
            pictures,
            credit="Werewolf: Game-icons.net (CC BY 3.0). Man: drawn for this gallery (CC0).",
        )
    ]

"""A checked fish becomes a scaled one: patterns that go along with the mesh."""

from pathlib import Path

import numpy as np

from shapetween.api import morph
from shapetween.model.paint import Colour
from shapetween.raster.encode import Clock, writer_for
from shapetween.raster.film import Film
from shapetween.timing.easing import easing_function, even_times

HERE = Path(__file__).parent
INPUTS = HERE / "inputs"
OUT = HERE / "image_fills.webp"

FRAMES, FPS, SIZE = 20, 12.0, (360, 252)

#: Frames that both ends are held for.
HELD = 8

#: The page's own colour.
PAPER = Colour(*(np.array([0xFB, 0xFA, 0xF7]) / 255).tolist())


def main() -> None:
    found = morph(INPUTS / "fish-checked.svg", INPUTS / "fish-scaled.svg", pictures=True)
    times = easing_function("ease-in-out")(even_times(FRAMES))
    film = Film.of([found.prepared.movement], times, size=SIZE, background=PAPER)
    last = FRAMES - 1
    order = [*[0] * HELD, *range(FRAMES), *[last] * HELD]
    writer_for(OUT)(OUT, film.frames(order), Clock(len(order), FPS, repeats=True))


if __name__ == "__main__":
    main()

"""An apple becomes a pear: two pictures and an outline drawn over each.

Run ``image_fruit_scene.py`` first to draw the pictures anew.
"""

from pathlib import Path

from shapetween.photo.sources import read_moving
from shapetween.photo.transition import Transition
from shapetween.raster.encode import Clock, writer_for
from shapetween.raster.load import read_picture
from shapetween.timing.easing import easing_function, even_times

HERE = Path(__file__).parent
INPUTS = HERE / "inputs"
OUT = HERE / "image_fruit.webp"

FRAMES, FPS, SIZE = 28, 16.0, (320, 320)

#: Frames that both ends are held for.
HELD = 8


def main() -> None:
    a, b = (read_picture(INPUTS / f"fruit-{kind}.jpg") for kind in ("apple", "pear"))
    outlines = (INPUTS / "fruit-apple.svg", INPUTS / "fruit-pear.svg")
    transition = Transition.between(
        a,
        b,
        read_moving((a, b), outlines=outlines).pieces,
        easing_function("ease-in-out")(even_times(FRAMES)),
        size=SIZE,
        background=read_picture(INPUTS / "fruit-table.jpg"),
    )
    last = FRAMES - 1
    order = [*range(FRAMES), *[last] * HELD, *range(last - 1, 0, -1), *[0] * HELD]
    writer_for(OUT)(OUT, transition.frames(order), Clock(len(order), FPS, repeats=True))


if __name__ == "__main__":
    main()

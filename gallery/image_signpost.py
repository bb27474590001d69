"""The sign post of the paper's Figure 6, with a scene of our own: boards that change places.

Each board is one quad; its lettering turns into that of the other picture as a plane in space
does, without any knowledge of space. Run ``image_scene.py`` first to draw the pictures anew.
"""

from pathlib import Path

from shapetween.photo.sources import read_moving
from shapetween.photo.transition import Transition
from shapetween.raster.encode import Clock, writer_for
from shapetween.raster.load import read_picture
from shapetween.timing.easing import easing_function, even_times

HERE = Path(__file__).parent
INPUTS = HERE / "inputs"
OUT = HERE / "image_signpost.webp"

#: The file grows with the frames and with the area: at 480x360 and 32 frames it is 800 kB.
FRAMES, FPS, SIZE = 17, 10.0, (300, 225)

#: Frames that both ends are held for.
HELD = 5


def main() -> None:
    a, b = (read_picture(INPUTS / f"signpost-{side}.png") for side in "ab")
    transition = Transition.between(
        a,
        b,
        read_moving((a, b), quads=[INPUTS / "signpost.json"]).pieces,
        easing_function("ease-in-out")(even_times(FRAMES)),
        size=SIZE,
        background=read_picture(INPUTS / "signpost-bare.png"),
    )
    last = FRAMES - 1
    order = [*range(FRAMES), *[last] * HELD, *range(last - 1, 0, -1), *[0] * HELD]
    writer_for(OUT)(OUT, transition.frames(order), Clock(len(order), FPS, repeats=True))


if __name__ == "__main__":
    main()

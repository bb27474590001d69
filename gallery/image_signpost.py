"""The sign post of the paper's Figure 6, with a scene of our own: boards that change places.

Each board is one quad; its lettering turns into that of the other picture as a plane in space
does, without any knowledge of space. Run ``image_scene.py`` first to draw the pictures anew.
"""

from pathlib import Path

from shapetween.frames import easing_function, even_times
from shapetween.image.load import read_picture
from shapetween.image.sources import read_moving
from shapetween.image.transition import Transition
from shapetween.image.writers import Clock, write_webp

HERE = Path(__file__).parent
INPUTS = HERE / "inputs"

FRAMES, FPS, SIZE = 40, 20.0, (560, 420)


def main() -> None:
    pictures = tuple(read_picture(INPUTS / f"signpost-{side}.png") for side in "ab")
    moving = read_moving(pictures, quads=[INPUTS / "signpost.json"])
    transition = Transition.between(
        *pictures,
        moving.meshes,
        easing_function("ease-in-out")(even_times(FRAMES)),
        size=SIZE,
        background=read_picture(INPUTS / "signpost-bare.png"),
    )
    order = [*range(FRAMES), *[FRAMES - 1] * 10, *range(FRAMES - 2, -1, -1), *[0] * 10]
    write_webp(HERE / "image_signpost.webp", transition.frames(order), Clock(len(order), FPS, True))


if __name__ == "__main__":
    main()

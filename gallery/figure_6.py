"""Figure 6: boards that change places between two pictures, and what outlines make of pictures.

All are drawn by scripts of their own: ``image_signpost.py``, ``image_fruit.py`` and
``image_fills.py``.
"""

from pathlib import Path

from shapetween.gallery import Exhibit, Picture

HERE = Path(__file__).parent


def draw() -> list[Exhibit]:
    boards = (
        "Five boards of one sign post move to the places they have in another picture. Each is one "
        "quad; its lettering turns as on a plane in space, and nothing is known of space."
    )
    fruit = (
        "The same with outlines drawn over two pictures: what is inside goes along with the mesh, "
        "and one skin dissolves into the other."
    )
    fills = (
        "Two drawings whose shapes are filled with patterns, written as moving pictures: each tile "
        "goes along with the mesh of its shape, and one pattern dissolves into the other."
    )
    shown = (
        ("Figure 6: planes in a picture", boards, "image_signpost.webp", "Boards of a sign post"),
        ("Beyond the paper: outlines over pictures", fruit, "image_fruit.webp", "Apple and pear"),
        (
            "Beyond the paper: fills that move too",
            fills,
            "image_fills.webp",
            "Two patterned fish",
        ),
    )
    return [
        Exhibit(title, text, (Picture(name, HERE / name, shows),))
        for title, text, name, shows in shown
    ]

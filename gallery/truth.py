"""Every method against scenes whose in-betweens are known."""

from shapetween.gallery import Exhibit
from shapetween.truth import Row, table

#: Scenes of each kind. ``python -m shapetween.truth`` shows more of them, and how often who wins.
COUNT, SEED = 20, 0

#: Errors in percent that differ by less are as good as each other.
TIE = 0.005


def draw() -> list[Exhibit]:
    rows = table(SEED, COUNT)
    methods = list(rows[0].errors)
    text = (
        "Median error of the in-betweens at a quarter, half and three quarters of the way, in "
        f"percent of the scene's radius, over {COUNT} scenes of each kind; the best of each row "
        "stands out. Homographies win where there is something inside the quads to see, but for "
        "a board of many quads, where triangles are a little better. Where only corners count, "
        "fair triangles are as good or nearly; the published ones come apart past half a turn. "
        "Straight lines hold their own only where nothing turns."
    )
    shown = (("", *methods), *(cells(row, methods) for row in rows))
    return [Exhibit("Errors of each method", text, table=shown)]


def cells(row: Row, methods: list[str]) -> tuple[str, ...]:
    errors = [100 * row.median(method) for method in methods]
    best = min(errors) + TIE
    return (
        f"{row.family}: {row.what}",
        *(f"{'*' if error <= best else ''}{error:.2f}" for error in errors),
    )

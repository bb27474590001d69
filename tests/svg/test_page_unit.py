"""Pages without a view box: in the unit their size is written in."""

import numpy as np
import pytest

from shapetween.model.drawing import Box
from shapetween.svg.read.reader import read_svg

SVG = '<svg xmlns="http://www.w3.org/2000/svg" {}><path d="M0 0H96V96H0Z"/></svg>'


@pytest.mark.parametrize(
    ("size", "box", "side"),
    [
        ('width="210mm" height="297mm"', Box(0, 0, 210, 297), 25.4),
        ('width="540pt" height="460PT"', Box(0, 0, 540, 460), 72),
        ('width="200" height="100"', Box(0, 0, 200, 100), 96),
        ('width="2in" height="100px"', Box(0, 0, 192, 100), 96),
        ('width="2in" height="2in" viewBox="0 0 96 96"', Box(0, 0, 96, 96), 96),
    ],
)
def test_unit_of_the_page(size: str, box: Box, side: float) -> None:
    drawing = read_svg(SVG.format(size).encode(), "page.svg")
    got = [drawing.box.x, drawing.box.y, drawing.box.width, drawing.box.height]
    np.testing.assert_allclose(got, [box.x, box.y, box.width, box.height])
    np.testing.assert_allclose(np.ptp(drawing.shapes[0].rings[0].box, axis=0), side)

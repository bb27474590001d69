"""The shapes of two drawings becoming each other.

`fill` moves one filled shape: its `regions` paired and each moved by `shapetween.rings`. `together`
moves drawings of several shapes as one: their `silhouette` is moved as one body (`flow`), and the
shapes, paired by `pairing`, ride on it (`ridden`, `aboard`) in an order kept by `stacking`. Before
they are paired, areas that are one in the other drawing are made one (`gathering`) and lines are
cut where the other drawing's end (`sharing`); lines that end on others (`junctions`) stay on them
(`tying`).
"""

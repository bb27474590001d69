"""Drawings that move as one elastic body.

`fill` moves one filled shape: its `regions` paired and each moved by `shapetween.outline`.
`together` moves drawings of several shapes as one: their `silhouette` is moved as one body
(`flow`), and the shapes, paired by `pairing`, ride on it (`ridden`, `aboard`) in an order kept by
`stacking`. Before they are paired, areas that are one in the other drawing are made one
(`gathering`) and lines are cut where the other drawing's end (`sharing`); lines that end on others
(`junctions`) stay on them (`tying`).
"""

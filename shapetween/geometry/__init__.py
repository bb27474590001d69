"""Plane geometry on arrays: numpy in, numpy out, nothing of SVG, meshes or time."""

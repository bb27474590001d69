"""Splitting two matched outlines into one mesh of quads with two sets of vertices."""

"""A mesh of the whole plane, inside and outside, that keeps a movement from folding."""

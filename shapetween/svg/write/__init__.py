"""A movement to SVG: animated, one file a frame, or as a diagram."""

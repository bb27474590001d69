"""Areas that are outlined strokes: their centre lines, and their outlines while those move."""

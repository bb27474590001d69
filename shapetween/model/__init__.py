"""The values that travel: drawings, outlines, paint, and movements between them."""

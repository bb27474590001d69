"""An SVG file's bytes to a drawing, as browsers draw it."""

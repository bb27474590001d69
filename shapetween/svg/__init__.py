"""Reading and writing SVG: the only place that knows of XML."""

"""How a part moves in its own frame: outlines matched by form, blended, and turned if need be."""

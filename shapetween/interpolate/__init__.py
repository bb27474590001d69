"""Methods that move a mesh pair, behind one interface."""

"""What rings of curves show together: cut as polygons, which is robust, and given back as curves.

`chords` flattens rings, `area` finds what a fill rule shows of them, and `trace` replaces the
polygons' sides by the parts of the curves they stand for, so that what was cut has few curves and
all of them its own.
"""

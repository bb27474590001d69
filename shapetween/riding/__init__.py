"""What rides on something that moves: lines, small pieces, and what opens or closes on the way.

`planes` says where a moving plane takes points; `riders` become other outlines on it, matched by
where they lie (`nearby`); `passengers` have no partner, and `specks` are too small for meshes.
"""

"""What rides on something that moves: lines, small pieces, and what opens or closes on the way.

`planes` says where a moving plane takes points and `carriages` where it takes curves; `riders`
become other outlines on it, matched by where they lie (`nearby`), and `ties` hold lines together.
A line that lies on nothing becomes another by turning along its length (`unroll`). `passengers`
have no partner, and `specks` are too small for meshes.
"""

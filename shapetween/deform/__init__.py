"""An ambient mesh: triangles of the whole plane that keep a movement from folding.

Both drawings' outlines are edges of one triangulation (`mesh`, built by `layout`, `triangulate` and
`untangle`; such a mesh is called a scaffold too). `motion` moves it as rigidly as its stiffness
allows, `keyed` keeps a few solved times, `schedule` tries ever stiffer settings until the outlines
`check` out as simple, and `repair` pushes apart what still inverts.
"""

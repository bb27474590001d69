"""One ring becoming another: matched, meshed, and moved so that nothing folds.

`matching` finds what belongs together (`matched`, and for outlines of thousands of curves `coarse`
and `detail`), `unfold` moves the nodes of a `body` with the plane around it, led by its quads
(`guide`), and `carry` takes the outlines' own curves along.
"""

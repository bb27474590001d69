"""One ring becoming another: matched, meshed, and moved so that nothing folds.

`matching` finds what belongs together (`matched`, and for outlines of thousands of curves `coarse`
and `detail`), `unfold` moves the nodes of a `body` in an ambient mesh whose inside
follows the quads (`quad_target`), and `carry` takes the outlines' own curves along.
"""

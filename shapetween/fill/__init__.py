"""One filled shape becoming another: its regions and holes paired, matched, meshed and moved.

`regions` are the pieces of a fill, each with its holes, `pairing` says which becomes which, and
`splitting` cuts one that becomes several. `morph` moves each pair by `shapetween.outline`; a hole
or piece without counterpart is an `appearing` region, a `small` contour is only blended, and
`track` is what comes of all.
"""

"""Drawings as parts: what is seen in them, what becomes what, and how each part moves.

A drawing is taken apart into items, `Item`: one region of a fill or one line of a stroke. What they
look like and how they lie is a `Scene`; which become each other are `Roles`; each pair then moves
in its own frame, and what has no partner comes or goes.
"""

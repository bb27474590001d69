"""Drawings of several parts as they come: icons, letters, emoji, illustrations."""

from pathlib import Path

import shapetween as st
from shapetween.gallery import Exhibit, Picture

INPUTS = Path(__file__).parent / "inputs"

LUCIDE = "Lucide (ISC)"
HERO = "Heroicons (MIT)"
FLUENT = "Fluent Emoji (MIT)"
TWEMOJI = "Twemoji (CC BY 4.0)"
OURS = "drawn for this gallery (CC0 1.0)"
LETTERS = "Font Awesome Free (CC BY 4.0)"

PAIRS = (
    ("icon-menu", "icon-x", "Two bars swing into the cross, the third leaves.", LUCIDE),
    ("icon-play", "icon-pause", "A closed line becomes two.", LUCIDE),
    ("icon-bell", "icon-bell-off", "The bell stands still; the slash cuts it.", LUCIDE),
    ("icon-sun", "icon-moon", "All rays leave alike, the disc becomes the crescent.", LUCIDE),
    ("icon-lock", "icon-lock-open", "The body stands still, the shackle opens.", LUCIDE),
    ("icon-heart", "icon-star", "Even about the middle all the way.", LUCIDE),
    ("icon-smile", "icon-frown", "Only the mouth moves.", LUCIDE),
    ("icon-mail", "icon-mail-open", "The flap opens.", LUCIDE),
    ("solid-play", "solid-pause", "One area divides into two.", HERO),
    ("solid-speaker-wave", "solid-speaker-x-mark", "The speaker stands still.", HERO),
    ("solid-magnifying-glass", "solid-x-mark", "Areas that are strokes move as strokes.", HERO),
    ("solid-home", "solid-building-office", "Windows open round and in their places.", HERO),
    ("letter-o", "letter-c", "The ring opens where the mouth will be.", LETTERS),
    ("emoji-cat-face", "emoji-dog-face", "Eyes to eyes, ears to ears.", FLUENT),
    ("emoji-rabbit-face", "emoji-bear", "Ears change; what has no partner comes and goes.", FLUENT),
    ("emoji-automobile", "emoji-bus", "Wheels to wheels, body to body.", FLUENT),
    ("emoji-locked", "emoji-unlocked", "Body and keyhole stand still.", FLUENT),
    ("emoji-red-apple", "emoji-pear", "Fruit to fruit, leaf to leaf.", FLUENT),
    ("emoji-bug", "emoji-butterfly", "Hardly a part in common: one goes, one comes.", FLUENT),
    ("picture-dog", "picture-wolf", "A dog and a head: exchanged; --loose moves parts.", TWEMOJI),
    ("face-smile", "face-sad", "Shadows stay; the mouth turns.", "Tango (public domain)"),
    ("board-flat", "board-steep", "All of the board goes over by one quad's homographies.", OURS),
    ("die-one", "die-six", "Faces as one mesh of quads; dots that both have stay on them.", OURS),
    ("picture-rocket", "picture-airplane", "Too little in common: one goes, one comes.", TWEMOJI),
)  # fmt: skip


def draw() -> list[Exhibit]:
    exhibits = []
    for a, b, text, credit in PAIRS:
        morph = st.morph(INPUTS / f"{a}.svg", INPUTS / f"{b}.svg")
        words = [name.split("-", 1)[-1] if "-" in name else name for name in (a, b)]
        title = " to ".join(words).replace("-", " ")
        svg = morph.svg(loop="alternate", hold=0.4)
        picture = Picture(f"{a}-to-{b}.svg", svg, f"The movement from {title}")
        exhibits.append(Exhibit(title.capitalize(), text, (picture,), wide=False, credit=credit))
    return exhibits

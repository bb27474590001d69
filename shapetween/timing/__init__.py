"""When what is shown: easings, keyframes, loops and rests."""

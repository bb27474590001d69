"""A movement to pixels, frame by frame, and files of moving pictures."""

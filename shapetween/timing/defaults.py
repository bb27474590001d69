"""What time is where nobody says otherwise, and its bounds; known without numpy.

The command line shows these in its help, before anything else is imported.
"""

__all__ = ["DURATION", "EASING", "FPS", "MOST_FRAMES", "MOST_KEYFRAMES"]

#: Seconds of one way. Shorter and the eye cannot follow what becomes what; longer and it waits.
DURATION = 2.0

#: How evenly time goes by: each moment shows what the frame of that time shows.
EASING = "linear"

#: Frames a second of moving pictures. Fewer are seen as steps; more double the file.
FPS = 30.0

#: Most frames of a file. More are a slip of the hand, and take hours.
MOST_FRAMES = 100_000

#: Most keyframes that may be asked for: sixty a second for a quarter of a minute. Many more are a
#: slip of the hand, and fill the memory.
MOST_KEYFRAMES = 1000

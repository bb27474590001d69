"""Draws one SVG from its input as a PNG to its output: a program, started by `resvg`.

Some files make the renderer run for ever, fill the memory or abort. In a process of its own that
costs no more than that process.
"""

import sys
from contextlib import suppress

#: Bytes of memory, and seconds of a processor, that drawing may take.
MEMORY, SECONDS = 2 << 30, 30


def main() -> None:
    """Draw with the width and height given as arguments."""
    with suppress(ImportError, ValueError, OSError):  # other systems have no such limits
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    import resvg_py

    width, height = map(int, sys.argv[1:])
    text = sys.stdin.buffer.read().decode()
    png = resvg_py.svg_to_bytes(
        svg_string=text, dpi=96, width=width, height=height, skip_system_fonts=True
    )
    sys.stdout.buffer.write(bytes(png))


if __name__ == "__main__":
    main()

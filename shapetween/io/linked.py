"""Pictures that a drawing shows from files beside it."""

import base64
from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote, urlsplit

from shapetween.base.errors import InputError
from shapetween.io import files

__all__ = ["pictures_beside"]

#: What files of each kind begin with.
_KINDS = {
    b"\x89PNG": "image/png",
    b"\xff\xd8\xff": "image/jpeg",
    b"GIF8": "image/gif",
    b"RIFF": "image/webp",
}


def pictures_beside(drawing: Path) -> Callable[[str], str | None]:
    """Where pictures for a drawing are found: in its own folder and below, nowhere else.

    A drawing may come from a stranger, who must not choose which files go into its pictures.

    Returns
    -------
    callable
        From the address that a drawing names to one that holds the picture itself, or None.
    """
    folder = drawing.resolve().parent

    def found(address: str) -> str | None:
        try:
            parts = urlsplit(address)
            if parts.scheme or parts.netloc:
                return None
            place = (folder / unquote(parts.path)).resolve()
            if not place.is_relative_to(folder):
                return None
            data = files.read_bytes(place)
        except (InputError, ValueError, OSError):
            return None
        kind = next((kind for start, kind in _KINDS.items() if data.startswith(start)), None)
        return f"data:{kind};base64,{base64.b64encode(data).decode()}" if kind else None

    return found

"""The gallery: scripts that each draw one exhibit, and the page that shows them all."""

from shapetween.gallery.exhibits import (
    Exhibit,
    Picture,
    Room,
    draw_rooms,
    gallery_folder,
    write_pictures,
)
from shapetween.gallery.page import index_html

__all__ = [
    "Exhibit",
    "Picture",
    "Room",
    "draw_rooms",
    "gallery_folder",
    "index_html",
    "write_pictures",
]

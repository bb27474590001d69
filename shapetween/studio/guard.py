"""Who may talk to the studio: this machine's own page, and nobody else.

Every other page that is open in the same browser can send requests to a server on this machine,
and a name of its own can be made to lead here. What tells them apart is what a browser says of a
request and does not let a page forge, and a token that only the page knows that was opened here.
"""

from dataclasses import dataclass
from hmac import compare_digest
from typing import Protocol

__all__ = ["HEADERS", "MOST_BYTES", "Guard", "Refusal"]

#: Largest body. Drawings of a few megabytes are rare, and each takes many times its size to read.
MOST_BYTES = 8 * 1024 * 1024

#: What goes with every answer: the page may load what this server has and nothing else, may be
#: shown in no frame, and nothing of it is kept or told to others.
HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; "
    "img-src 'self' blob: data:; connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; "
    "form-action 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}


class Headers(Protocol):
    """Headers of a request, by their names in any case."""

    def get(self, name: str, /) -> str | None:
        """The value of a header, if there is one."""


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a request is not answered: the status of HTTP, and one line."""

    status: int
    line: str


@dataclass(frozen=True, slots=True)
class Guard:
    """The rules of one server.

    Attributes
    ----------
    port : int
        The server's own.
    token : str
        What requests that do anything must know.
    """

    port: int
    token: str

    @property
    def hosts(self) -> tuple[str, str]:
        """What the server may be called."""
        return f"127.0.0.1:{self.port}", f"localhost:{self.port}"

    def refusal(self, method: str, path: str, headers: Headers) -> Refusal | None:
        """Why a request is refused; None if it is not.

        Parameters
        ----------
        method, path : str
        headers : Headers
        """
        if headers.get("Host") not in self.hosts:
            # A name of a stranger's that leads to this machine: its page would count as ours.
            return Refusal(421, f"this server is {self.hosts[0]} only")
        origin = headers.get("Origin")
        if origin is not None and origin not in {f"http://{host}" for host in self.hosts}:
            return Refusal(403, "requests of other pages are refused")
        # Another server on this machine is of the same site, and as much of a stranger.
        if headers.get("Sec-Fetch-Site") not in ("same-origin", "none", None):
            return Refusal(403, "requests of other pages are refused")
        if path.startswith("/api/") and not self._knows_token(headers.get("Authorization") or ""):
            return Refusal(401, "open the studio by the address that it printed")
        return self._refused_body(headers) if method == "POST" else None

    def _knows_token(self, given: str) -> bool:
        return compare_digest(given.encode(), f"Bearer {self.token}".encode())

    def _refused_body(self, headers: Headers) -> Refusal | None:
        length = headers.get("Content-Length")
        if length is None or not (length.isascii() and length.isdecimal()):
            return Refusal(411, "the length of what is sent must be said")
        if int(length) > MOST_BYTES:
            return Refusal(413, f"larger than the {MOST_BYTES // 1024**2} MB that are taken")
        return None

"""What can be set of a whole movement: name, option of the command line, and what it may be.

The page draws its fields from this table and the command line is put together from it, so that
neither knows an option that the other does not.
"""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal

from shapetween.base.errors import OptionError

__all__ = ["ONLY_PAGES", "SETTINGS", "Setting", "as_json", "checked_settings"]


@dataclass(frozen=True, slots=True)
class Setting:
    """One option.

    Attributes
    ----------
    name : str
        What `shapetween.morph`, or `svg` of a movement, calls it.
    flag : str
        What the command line calls it.
    label : str
        What the page calls it.
    stage : {"prepare", "write"}
        Whether a movement is prepared with it, or written.
    kind : {"choice", "real", "whole", "easing"}
    default : str, float, int or None
    choices : tuple of str
        Of a choice; of an easing, those that the page offers.
    low, high, step : float
        Of a number.
    none : str
        What the page calls the default of a choice, where that is none of them.
    flags : tuple of str
        Values that are options of their own, such as ``--loose``.
    needs : str
        Another setting without which this one changes nothing, and is left out.
    """

    name: str
    flag: str
    label: str
    stage: Literal["prepare", "write"]
    kind: Literal["choice", "real", "whole", "easing"]
    default: str | float | int | None
    choices: tuple[str, ...] = ()
    low: float = 0.0
    high: float = 0.0
    step: float = 1.0
    none: str = ""
    flags: tuple[str, ...] = ()
    needs: str = ""

    def words(self, value: Any) -> list[str]:
        """What the command line says of a value that is not the default."""
        if value in self.flags:
            return [f"--{value}"]
        return [self.flag, f"{value:.10g}" if isinstance(value, float) else str(value)]

    def checked(self, value: object) -> Any:
        """The value, if it is one.

        Raises
        ------
        OptionError
            If it is not.
        """
        if value == self.default and type(value) is type(self.default):
            return value
        if self.kind in ("choice", "easing"):
            return self._checked_name(value)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise OptionError(f"{self.flag}: {value!r} is not a number")
        if not (math.isfinite(value) and self.low <= value <= self.high):
            raise OptionError(f"{self.flag}: {value!r} is not from {self.low:g} to {self.high:g}")
        if self.kind == "whole" and value != int(value):
            raise OptionError(f"{self.flag}: {value!r} is not a whole number")
        return int(value) if self.kind == "whole" else float(value)

    def _checked_name(self, value: object) -> str:
        if not isinstance(value, str):
            raise OptionError(f"{self.flag}: {value!r} is not a name")
        if self.kind == "choice" and value not in self.choices:
            raise OptionError(f"{self.flag}: {value!r} is none of {', '.join(self.choices)}")
        if self.kind == "easing":
            from shapetween.timing.easing import easing_function

            easing_function(value)
        return value


#: What needs more than an SVG to be set going by.
ONLY_PAGES = ("seen", "scroll", "drag")

SETTINGS = (
    Setting(
        "method", "--method", "Method", "prepare", "choice", "projective",
        ("projective", "projective-2007", "arap", "arap-2000", "linear"),
    ),
    Setting("quads", "--quads", "Quads", "prepare", "whole", None, low=1, high=10_000),
    Setting(
        "fit", "--fit", "Fit", "prepare", "choice", "view", ("view", "geometry", "none")
    ),
    Setting(
        "pairing", "--loose, --strict", "Pairing", "prepare", "choice", "normal",
        ("loose", "normal", "strict"), flags=("loose", "strict"),
    ),
    Setting(
        "change", "--change", "Come and go", "prepare", "choice", None,
        ("fade", "draw", "grow", "slide"), none="each as it lies",
    ),
    Setting(
        "duration", "--duration", "Duration", "write", "real", 2.0, low=0.1, high=86_400, step=0.1
    ),
    Setting("hold", "--hold", "Hold", "write", "real", 0.0, low=0, high=86_400, step=0.1),
    Setting(
        "easing", "--easing", "Easing", "write", "easing", "linear",
        ("linear", "ease", "ease-in", "ease-out", "ease-in-out"),
    ),
    Setting(
        "loop", "--loop", "Loop", "write", "choice", "once", ("once", "repeat", "alternate")
    ),
    Setting(
        "stagger", "--stagger", "Stagger", "write", "real", 0.0, low=0, high=3600, step=0.1
    ),
    Setting(
        "stagger_by", "--stagger-by", "Stagger by", "write", "choice", "order",
        ("order", "distance", "left"), needs="stagger",
    ),
    Setting(
        "start", "--start", "Starts on", "write", "choice", "load",
        ("load", "click", "hover", *ONLY_PAGES),
    ),
)  # fmt: skip
"""Every setting, in the order of the page and of the command line."""


def checked_settings(given: Mapping[str, object]) -> dict[str, Any]:
    """What differs from the defaults and changes something, in the order of `SETTINGS`.

    Raises
    ------
    OptionError
        If a name is unknown or a value is none.
    """
    known = {setting.name: setting for setting in SETTINGS}
    for name in given:
        if name not in known:
            raise OptionError(f"options: {name!r} is none of {', '.join(known)}")
    values = {name: known[name].checked(given[name]) for name in known if name in given}
    other = {name: value for name, value in values.items() if value != known[name].default}
    return {
        name: value
        for name, value in other.items()
        if not known[name].needs or known[name].needs in other
    }


def as_json() -> list[dict[str, Any]]:
    """The table, for the page."""
    return [asdict(setting) for setting in SETTINGS]

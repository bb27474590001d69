"""The extension for Inkscape: put where Inkscape finds it, and taken away again.

Its files lie in ``extension`` and are no part of the package: its script runs in Inkscape's own
Python, is under Inkscape's licence, and calls this program.
"""

import json
import os
import shutil
import subprocess
import sys
from importlib.resources import files
from pathlib import Path

from shapetween.base.errors import OptionError
from shapetween.io.files import write_text

__all__ = ["extensions_folder", "install", "uninstall"]

#: The files of the extension.
FILES = ("shapetween_tween.inx", "shapetween_tween.py")

#: Beside them: how this program is called, for the extension to call it.
CALL = "shapetween_program.json"

#: Seconds in which Inkscape says where its folder is; it starts slowly the first time.
PATIENCE = 60


def extensions_folder() -> Path:
    """Where Inkscape looks for the user's extensions.

    Inkscape itself is asked; where it is not on the path, the place that it has on such a system.
    """
    program = shutil.which("inkscape")
    if program is not None:
        try:
            done = subprocess.run(
                [program, "--user-data-directory"],
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                timeout=PATIENCE,
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired):
            done = None
        lines = done.stdout.split("\n") if done is not None and done.returncode == 0 else []
        line = next((line.strip() for line in lines if line.strip()), "")
        if line and Path(line).is_absolute():
            return Path(line) / "extensions"
    if profile := os.environ.get("INKSCAPE_PROFILE_DIR"):
        return Path(profile) / "extensions"
    if sys.platform == "win32":
        return Path(os.environ.get("APPDATA", Path.home())) / "inkscape" / "extensions"
    if sys.platform == "darwin":
        support = Path.home() / "Library" / "Application Support"
        return support / "org.inkscape.Inkscape" / "config" / "inkscape" / "extensions"
    config = Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config")
    return config / "inkscape" / "extensions"


def install(folder: Path) -> tuple[Path, ...]:
    """Write the extension's files; the folder is made if it is not there.

    Returns
    -------
    tuple of Path
        What was written.

    Raises
    ------
    OptionError
        If they cannot be.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = (error.strerror or "cannot be made").lower()
        raise OptionError(f"{folder}: the folder cannot be made: {reason}") from error
    source = files("shapetween.inkscape") / "extension"
    call = json.dumps([sys.executable, "-m", "shapetween"])
    texts = {name: (source / name).read_text("utf-8") for name in FILES} | {CALL: call + "\n"}
    for name, text in texts.items():
        write_text(folder / name, text)
    return tuple(folder / name for name in texts)


def uninstall(folder: Path) -> tuple[Path, ...]:
    """Remove the extension's files.

    Returns
    -------
    tuple of Path
        What was removed.

    Raises
    ------
    OptionError
        If one cannot be.
    """
    removed = []
    for path in (folder / name for name in (*FILES, CALL)):
        try:
            path.unlink()
        except FileNotFoundError:
            continue
        except OSError as error:
            reason = (error.strerror or "it is in use").lower()
            raise OptionError(f"{path}: cannot be removed: {reason}") from error
        removed.append(path)
    return tuple(removed)

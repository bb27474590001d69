#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
#
# This script runs inside Inkscape and uses its library inkex, so it is under the GNU General
# Public License, version 2 or (at your option) any later version. It calls the program shapetween,
# which is under the MIT licence, and shares no code with it.
"""In-betweens of two objects, groups or layers, made by the program shapetween."""

import copy
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import inkex
from lxml import etree

HERE = Path(__file__).resolve().parent

#: Written by "shapetween inkscape --install": how the program is called.
CALL = HERE / "shapetween_program.json"

#: What Inkscape sets for its own Python, which would mislead another one.
OURS = ("PYTHONPATH", "PYTHONHOME", "LD_LIBRARY_PATH", "PYTHONSTARTUP", "VIRTUAL_ENV")

#: Set where nobody looks on. Inkscape shows what an extension says in a window and waits until it
#: is closed, in batches too, which then hang.
QUIET = "SHAPETWEEN_QUIET"

#: Seconds after which the program is taken for stuck.
PATIENCE = 600

INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
SVG = "{http://www.w3.org/2000/svg}"
XLINK = "{http://www.w3.org/1999/xlink}"

MISSING = (
    "The program shapetween was not found.\n\n"
    "Install it with\n    pip install shapetween\nand then run\n    shapetween inkscape --install\n"
    "or write where it is on the page Program."
)
SHUT_IN = (
    "This Inkscape (a Flatpak or a Snap) may not run programs outside of it, so it cannot call "
    "shapetween.\n\nUse Inkscape's installer, AppImage or your system's package instead; or save "
    "both shapes as SVG and open them with\n    shapetween studio A.svg B.svg"
)


class Tween(inkex.EffectExtension):
    """The extension."""

    def add_arguments(self, pars):
        """Options of the dialog."""
        for name, kind, default in (
            ("tabs", str, ""),
            ("steps", int, 5),
            ("make", str, "groups"),
            ("first_layer", str, ""),
            ("second_layer", str, ""),
            ("method", str, "projective"),
            ("easing", str, "linear"),
            ("file", str, ""),
            ("duration", float, 2.0),
            ("loop", str, "once"),
            ("program", str, ""),
        ):
            pars.add_argument("--" + name, type=kind, default=default)

    def effect(self):
        """Make the in-betweens."""
        first, second = self.chosen()
        call = program(self.options.program.strip())
        with tempfile.TemporaryDirectory(prefix="shapetween-") as folder:
            place = Path(folder)
            ends = []
            for name, element in (("first", first), ("second", second)):
                path = place / (name + ".svg")
                path.write_bytes(etree.tostring(alone(self.document, element)))
                ends.append(str(path))
            common = ["--fit", "none", "--method", self.options.method]
            common += ["--easing", self.options.easing]
            if self.options.make == "file":
                out = self.options.file.strip()
                if not out or Path(out).is_dir():
                    raise inkex.AbortExtension("Say on the page How which file to write.")
                out = str(Path(out).expanduser().with_suffix(".svg"))
                timing = ["--duration", str(self.options.duration), "--loop", self.options.loop]
                run([*call, "morph", *ends, "-o", out, *common, *timing], place)
                return
            count = self.options.steps + 2
            frames = place / "frames"
            words = ["frames", *ends, "-o", str(frames), "--frames", str(count)]
            run([*call, *words, *common], place)
            self.insert(sorted(frames.glob("frame_*.svg"))[1:-1])

    def chosen(self):
        """The two elements: two layers if they are named, else what is selected."""
        names = [self.options.first_layer.strip(), self.options.second_layer.strip()]
        if all(names):
            return [self.layer(name) for name in names]
        selection = getattr(self.svg, "selection", None) or self.svg.selected
        found = list(selection.values())
        if len(found) != 2:
            raise inkex.AbortExtension(
                "Select two objects or groups, or write the names of two layers: "
                "{} {} selected.".format(len(found), "is" if len(found) == 1 else "are")
            )
        return found

    def layer(self, name):
        """The layer of a name."""
        for element in self.svg.iter(SVG + "g"):
            if element.get(INKSCAPE + "label") == name or element.get("id") == name:
                return element
        raise inkex.AbortExtension("There is no layer {!r}.".format(name))

    def insert(self, paths):
        """Put the frames into the document, in order, over all else."""
        layers = self.options.make == "layers"
        shelf = None if layers else self.new_group("In-betweens", layer=True)
        for number, path in enumerate(paths, start=1):
            root = inkex.load_svg(str(path)).getroot()
            renamed = self.take_definitions(root)
            label = "In-between {}".format(number)
            group = self.new_group(label, layer=layers, parent=shelf)
            for child in list(root):
                if child.tag in (SVG + "defs", SVG + "style", SVG + "title"):
                    continue
                for element in child.iter():
                    # An id stands once in a document; what only named a shape becomes its label.
                    name = element.attrib.pop("id", None)
                    if name:
                        element.set(INKSCAPE + "label", name)
                    point(element, renamed)
                group.append(child)

    def new_group(self, label, layer, parent=None):
        """A group, or a layer, at the end of the document or of another one."""
        group = inkex.Layer() if layer else inkex.Group()
        group.set(INKSCAPE + "label", label)
        (self.svg if parent is None else parent).append(group)
        group.set("id", self.svg.get_unique_id("tween"))
        return group

    def take_definitions(self, root):
        """Move a frame's definitions to the document's; their new names by their old ones."""
        renamed = {}
        found = [child for defs in root.iter(SVG + "defs") for child in list(defs)]
        for definition in found:
            old = definition.get("id")
            self.svg.defs.append(definition)
            if old:
                definition.set("id", "")
                renamed[old] = self.svg.get_unique_id("tween-paint")
                definition.set("id", renamed[old])
        for definition in found:
            for element in definition.iter():
                point(element, renamed)
        return renamed


def point(element, renamed):
    """Let references to renamed definitions lead to their new names."""
    for key, value in list(element.attrib.items()):
        if key in ("href", XLINK + "href") and value[:1] == "#" and value[1:] in renamed:
            element.set(key, "#" + renamed[value[1:]])
        elif "url(#" in value:
            for old, new in renamed.items():
                value = value.replace("url(#{})".format(old), "url(#{})".format(new))
            element.set(key, value)


def alone(document, element):
    """The document with nothing to be seen but one element, where and as it was."""
    made = copy.deepcopy(document)
    root = made.getroot()
    kept = root.xpath('//*[@id="{}"]'.format(element.get("id")))[0]
    line = {kept, *kept.iterancestors()}
    definitions = {SVG + name for name in ("defs", "style", "symbol", "linearGradient")}
    for place in line - {kept}:
        for child in list(place):
            if child not in line and child.tag not in definitions:
                place.remove(child)
    for place in line:
        # A hidden layer is meant too, if it is asked for.
        if place.get("style"):
            parts = [part for part in place.get("style").split(";") if part.strip()]
            shown = [part for part in parts if part.split(":")[0].strip() != "display"]
            place.set("style", ";".join(shown))
        if place.get("display") == "none":
            del place.attrib["display"]
    if not root.get("viewBox"):
        width, height = (root.unittouu(root.get(name, "100")) for name in ("width", "height"))
        root.set("viewBox", "0 0 {} {}".format(width, height))
    return made


def program(given):
    """How shapetween is called."""
    if given:
        return [given]
    if CALL.is_file():
        call = json.loads(CALL.read_text("utf-8"))
        if Path(call[0]).exists():
            return call
    name = "shapetween.exe" if sys.platform == "win32" else "shapetween"
    home = Path.home()
    folders = [Path(p) for p in os.environ.get("PATH", "").split(os.pathsep) if p]
    folders += [home / ".local" / "bin", Path("/opt/homebrew/bin"), Path("/usr/local/bin")]
    folders += [home / "bin", home / ".local" / "share" / "uv" / "tools" / "shapetween" / "bin"]
    folders += [home / ".local" / "pipx" / "venvs" / "shapetween" / "bin"]
    if os.environ.get("SHAPETWEEN"):
        return [os.environ["SHAPETWEEN"]]
    for folder in folders:
        if (folder / name).is_file():
            return [str(folder / name)]
    raise inkex.AbortExtension(SHUT_IN if shut_in() else MISSING)


def shut_in():
    """Whether this Inkscape runs where programs of the system cannot be called."""
    return bool(os.environ.get("FLATPAK_ID") or os.environ.get("SNAP"))


def run(words, folder):
    """Run the program, and say what it says."""
    environment = {key: value for key, value in os.environ.items() if key not in OURS}
    more = {"creationflags": 0x08000000} if sys.platform == "win32" else {}  # no window of its own
    try:
        done = subprocess.run(
            words,
            cwd=str(folder),
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            timeout=PATIENCE,
            check=False,
            **more,
        )
    except subprocess.TimeoutExpired:
        raise inkex.AbortExtension("shapetween took too long and was ended.") from None
    except OSError as error:
        reason = SHUT_IN if shut_in() else MISSING
        raise inkex.AbortExtension(
            "{}: {}\n\n{}".format(words[0], error.strerror, reason)
        ) from None
    lines = done.stderr.decode("utf-8", "replace").splitlines()
    messages = [line[len("shapetween: ") :] for line in lines if line.startswith("shapetween: ")]
    if done.returncode:
        raise inkex.AbortExtension("\n".join(messages or lines[-3:] or ["shapetween was cut off."]))
    if os.environ.get(QUIET):
        return
    for line in messages:
        inkex.errormsg(line.replace(str(folder) + os.sep, ""))


if __name__ == "__main__":
    Tween().run()

"""The package is built in layers: imports point one way, and each library has its place."""

import ast
import re
from collections import Counter
from graphlib import TopologicalSorter
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "shapetween"


def modules() -> dict[str, ast.Module]:
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = ("shapetween", *path.relative_to(PACKAGE).with_suffix("").parts)
        name = ".".join(parts).removesuffix(".__init__")
        found[name] = ast.parse(path.read_text("utf-8"))
    return found


MODULES = modules()


def imported(tree: ast.Module) -> set[str]:
    """Names of imported modules, also of those imported in functions or for types alone."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.add(node.module)
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def users(library: str) -> set[str]:
    """Top-level parts of the package that import a library, anywhere."""
    return {
        name.split(".")[1] if "." in name else name
        for name, tree in MODULES.items()
        if any(i == library or i.startswith(f"{library}.") for i in imported(tree))
    }


def test_modules_never_import_each_other_in_a_circle() -> None:
    """Nor inside functions or for types alone."""
    graph = {
        name: {i for i in imported(tree) if i in MODULES and i != name}
        for name, tree in MODULES.items()
    }
    # A package's face only hands names on; what it imports from inside itself is no circle.
    for name in graph:
        graph[name] = {i for i in graph[name] if not name.startswith(f"{i}.")}
    TopologicalSorter(graph).prepare()


#: The rooms from the ground up. A room imports rooms on lower floors only, none on its own.
#: Move a room up or down only with a reason that the page for contributors can tell.
FLOORS: tuple[tuple[str, ...], ...] = (
    ("base",),
    ("geometry", "io"),
    ("deform", "inkscape", "mesh", "timing"),
    ("interpolate", "model"),
    ("boolean", "match"),
    ("outline", "svg"),
    ("fill", "gallery"),
    ("raster", "scene"),
    ("formats", "pipeline"),
    ("report", "sources"),
    ("api",),
    ("batch", "interop", "compare", "notebook", "photo"),
    ("__init__", "studio", "truth"),
    ("cli",),
    ("__main__",),
)

#: The modules that stand in no room.
LOOSE = {"__init__", "__main__", "api", "pipeline", "report", "sources"}

#: Lines past which a module holds two ideas.
MOST_LINES = 400


#: Run by name, or imported by scripts of the gallery or by Inkscape.
RUN = {
    "shapetween.__main__",
    "shapetween.gallery.strips",
    "shapetween.inkscape.extension.shapetween_tween",
    "shapetween.truth.__main__",
}


def test_no_module_is_left_over() -> None:
    """Each is imported by another one, or named in a table of what is loaded when asked for."""
    used = {name for tree in MODULES.values() for name in imported(tree)}
    texts = {
        node.value.partition(":")[0]
        for tree in MODULES.values()
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    rooms = {name.rpartition(".")[0] for name in MODULES}  # their faces are imported along
    assert set(MODULES) - used - texts - rooms - RUN == set()


#: Definitions that only a test or a script of the gallery uses: the README's table, and figures.
ELSEWHERE = {"formats_table", "method_strips"}


def test_no_definition_is_left_over() -> None:
    """Each is named somewhere in the package besides where it is defined and handed on."""
    defined: Counter[str] = Counter()
    named: Counter[str] = Counter()
    for tree in MODULES.values():
        for node in tree.body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef):
                defined[node.name] += 1
            elif isinstance(node, ast.Assign | ast.AnnAssign):
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                names = {n.id for t in targets for n in ast.walk(t) if isinstance(n, ast.Name)}
                defined.update(names)
        for inner in ast.walk(tree):
            if isinstance(inner, ast.Name) and isinstance(inner.ctx, ast.Load):
                named[inner.id] += 1
            elif isinstance(inner, ast.Attribute):
                named[inner.attr] += 1
            elif isinstance(inner, ast.ImportFrom):
                named.update(alias.name for alias in inner.names)
            elif isinstance(inner, ast.Constant) and isinstance(inner.value, str):
                named.update(re.findall(r"\w+", inner.value) if ":" in inner.value else ())
    unnamed = {name for name in defined if not named[name] and not name.startswith("__")}
    assert unnamed <= ELSEWHERE


def room_of(name: str) -> str:
    parts = name.split(".")
    return parts[1] if len(parts) > 1 else "__init__"


def test_every_room_has_its_floor() -> None:
    listed = [room for floor in FLOORS for room in floor]
    assert len(listed) == len(set(listed))
    assert {room_of(name) for name in MODULES} == set(listed)
    modules = {path.stem for path in PACKAGE.glob("*.py")}
    assert modules == LOOSE


def test_rooms_import_lower_floors_only() -> None:
    floor = {room: k for k, rooms in enumerate(FLOORS) for room in rooms}
    wrong = {
        f"{name} imports {other}"
        for name, tree in MODULES.items()
        for other in imported(tree)
        if other in MODULES
        and other != "shapetween"
        and room_of(other) != room_of(name)
        and floor[room_of(other)] >= floor[room_of(name)]
    }
    assert not wrong


def test_no_module_holds_more_than_one_idea() -> None:
    long = {
        str(path.relative_to(PACKAGE)): count
        for path in PACKAGE.rglob("*.py")
        if (count := path.read_text("utf-8").count("\n")) > MOST_LINES
    }
    assert not long


def test_only_svg_reads_xml() -> None:
    assert users("defusedxml") == {"svg"}
    # Pages and figures are put together as trees too, but nothing else reads any.
    assert users("xml") <= {"svg", "compare", "gallery"}
    assert users("svgpathtools") == {"svg"}


def test_the_library_never_imports_the_command_line() -> None:
    assert users("click") <= {"cli", "truth"}  # "python -m shapetween.truth" is a command too
    assert users("shapetween.cli") <= {"cli", "__main__"}


def test_clocks_stay_at_the_command_line() -> None:
    assert users("time") <= {"io", "cli", "batch"}

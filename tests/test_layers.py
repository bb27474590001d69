"""The package is built in layers: imports point one way, and each library has its place."""

import ast
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


def imported(tree: ast.Module, *, everywhere: bool) -> set[str]:
    """Names of imported modules; of those at the top only, unless everywhere is asked for."""
    names = set()
    nodes = ast.walk(tree) if everywhere else iter(tree.body)
    for node in nodes:
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
        if any(i == library or i.startswith(f"{library}.") for i in imported(tree, everywhere=True))
    }


def test_modules_never_import_each_other_in_a_circle() -> None:
    graph = {
        name: {i for i in imported(tree, everywhere=False) if i in MODULES and i != name}
        for name, tree in MODULES.items()
    }
    # A package's face only hands names on; what it imports from inside itself is no circle.
    for name in graph:
        graph[name] = {i for i in graph[name] if not name.startswith(f"{i}.")}
    TopologicalSorter(graph).prepare()


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

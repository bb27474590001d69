"""What a batch is to make: tables and folders, and what is wrong with them."""

from pathlib import Path

import pytest

from shapetween.base.errors import InputError, OptionError
from shapetween.batch import Job, all_pairs_in, pairs_in, read_table
from shapetween.batch.jobs import check_jobs

HOME = Path("home")
COLUMNS = {"quads": ("quads", int), "loop": ("loop", str)}


def table(text: str) -> list[Job]:
    return read_table(text, "pairs.csv", HOME, COLUMNS, {"quads": 3})


def test_a_row_is_a_job() -> None:
    jobs = table("a,b,out,quads,mesh\nx.svg,in/y.svg,,,\n\n x.svg , z.svg ,o/n.svg,12,m.json\n")
    assert jobs == [
        Job(HOME / "x.svg", HOME / "in/y.svg", Path("x-to-y.svg"), None, {"quads": 3}),
        Job(HOME / "x.svg", HOME / "z.svg", Path("o/n.svg"), HOME / "m.json", {"quads": 12}),
    ]


def test_columns_stand_in_any_order_and_rows_may_be_short() -> None:
    (job,) = table('loop,b,a,quads\n"once",y.svg,x.svg\n')
    assert (job.a, job.b) == (HOME / "x.svg", HOME / "y.svg")
    assert job.options == {"quads": 3, "loop": "once"}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", r"^pairs\.csv: has no pairs; expected a header"),
        ("a,b\n", "has no pairs"),
        ("a,c\nx,y\n", "row 1, column c: not known; expected a, b, out, mesh, quads"),
        ("a,b,qads\nx,y,1\n", "row 1, column qads: not known; did you mean quads"),
        ("a,b,a\nx,y,z\n", "row 1, column a: stands twice"),
        ("a,out\nx,y\n", "row 1: no column b"),
        ("a,b\nx,y\nx,\n", "row 3, column b: empty; expected the name of a file"),
        ("a,b\n\nx,y,z\n", "row 3: 3 cells; the header has 2"),
        ("a,b,quads\nx,y,many\n", "row 2, column quads: invalid literal"),
        ("a,b,out\nx,y,o.png\n", r"row 2, column out: o\.png: expected a name that ends in \.svg"),
        ("a,b,out\nx,y,o.svg\nx,z,o.svg\n", r"row 3, column out: o\.svg is that of row 2"),
        ("a;b\nx;y\n", "row 1: has semicolons; expected commas"),
        ("a,b\nx\0,y\n", "null character"),
        ('a,b\nx,y\n"x,y\n', "row 3: not comma-separated values"),
    ],
)
def test_what_is_wrong_with_a_table_is_named(text: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        table(text)


def touched(folder: Path, *names: str) -> Path:
    for name in names:
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).touch()
    return folder


def test_pairs_by_name(tmp_path: Path) -> None:
    names = ["cat-a.svg", "cat-b.svg", "dog_a.svg", "dog_b.svgz", "e.a.svg", "e.b.svg"]
    folder = touched(tmp_path, *names, "fox/a.svg", "fox/b.svg", "notes.txt", "lone.svg")
    jobs = pairs_in(folder, {"quads": 5})
    assert [job.out.name for job in jobs] == ["cat.svg", "dog.svg", "e.svg", "fox.svg"]
    assert jobs[1].b == folder / "dog_b.svgz"
    assert jobs[3].a == folder / "fox/a.svg"
    assert all(job.options == {"quads": 5} for job in jobs)


def test_pairs_that_are_none(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="has no pairs; expected files such as"):
        pairs_in(touched(tmp_path, "x.svg"))
    with pytest.raises(OptionError, match=r"cat-a\.svg: has no partner b"):
        pairs_in(touched(tmp_path, "cat-a.svg"))
    with pytest.raises(OptionError, match=r"cat-a\.svgz: cat-a\.svg is a of this pair already"):
        pairs_in(touched(tmp_path, "cat-a.svgz", "cat-b.svg"))
    with pytest.raises(OptionError, match="not a folder"):
        pairs_in(tmp_path / "none")


def test_every_two_of_a_folder(tmp_path: Path) -> None:
    touched(tmp_path, "c.svg", "a.svg", "b.svg", "d.txt")
    outs = [job.out.name for job in all_pairs_in(tmp_path)]
    assert outs == ["a-to-b.svg", "a-to-c.svg", "b-to-c.svg"]
    with pytest.raises(OptionError, match="has 0 drawings"):
        all_pairs_in(touched(tmp_path / "in", "x.txt"))


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    a, b = tmp_path / "a.svg", tmp_path / "b.svg"
    own = [tmp_path / "summary.csv"]
    check_jobs([Job(a, b, Path("c.svg")), Job(a, b, Path("d.svg"))], tmp_path, own)
    with pytest.raises(OptionError, match="is an input"):
        check_jobs([Job(a, b, Path("in/../b.svg"))], tmp_path, own)
    for outside in (Path("../c.svg"), Path("in/../../c.svg"), tmp_path.parent / "c.svg"):
        with pytest.raises(OptionError, match=r"c\.svg: is not in .*; expected a name inside"):
            check_jobs([Job(a, b, outside)], tmp_path, own)
    with pytest.raises(OptionError, match="written twice"):
        check_jobs([Job(a, b, Path("c.svg")), Job(a, b, Path("./c.svg"))], tmp_path, own)
    with pytest.raises(OptionError, match=r"summary\.csv: is an input"):
        check_jobs([Job(own[0], b, Path("c.svg"))], tmp_path, own)

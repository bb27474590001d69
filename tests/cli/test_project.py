"""Work saved in the studio, on the command line."""

import json
from pathlib import Path

from shapetween.studio.command import shown
from shapetween.studio.job import job_of
from shapetween.studio.settings import SETTINGS
from tests.cli.commands import SQUARE, TRIANGLE, Command, svg


def project(**more: object) -> str:
    drawings = [{"name": "one.svg", "svg": svg(SQUARE)}, {"file": "b.svg"}]
    return json.dumps({"shapetween": "project", "version": 1, "drawings": drawings, **more})


def test_a_project_is_morphed_as_it_says(run: Command, tmp_path: Path) -> None:
    options = {"duration": 1.5, "fit": "geometry"}
    pins = [[1, 1, 2, 2]]
    (tmp_path / "p.json").write_text(project(options=options, legs=[{"pins": pins}]), "utf-8")
    assert run("morph --project p.json").code == 0
    run("morph a.svg b.svg -o same.svg --duration 1.5 --fit geometry --pin 1,1:2,2")
    made = (tmp_path / "one-to-b.svg").read_text("utf-8")
    assert made == (tmp_path / "same.svg").read_text("utf-8")


def test_what_the_line_says_goes_first(run: Command, tmp_path: Path) -> None:
    (tmp_path / "p.json").write_text(project(options={"duration": 1.5}), "utf-8")
    assert run("morph --project p.json -o x.svg --duration 3").code == 0
    assert 'dur="3s"' in (tmp_path / "x.svg").read_text("utf-8")


def test_a_chain_of_a_project(run: Command, tmp_path: Path) -> None:
    text = project(order=["one.svg", "b.svg", "one.svg"], legs=[{}, {"pins": [[2, 2, 1, 1]]}])
    (tmp_path / "p.json").write_text(text, "utf-8")
    assert run("morph --project p.json -o x.svg").code == 0
    run("morph a.svg b.svg a.svg -o same.svg --pin 2/2,2:1,1")
    made = (tmp_path / "x.svg").read_text("utf-8")
    assert made == (tmp_path / "same.svg").read_text("utf-8")


def test_every_setting_of_the_studio_is_heard(run: Command, tmp_path: Path) -> None:
    options = {
        "method": "arap", "quads": 4, "fit": "geometry", "pairing": "loose", "change": "fade",
        "duration": 1.5, "hold": 0.5, "easing": "ease", "loop": "alternate", "stagger": 0.2,
        "stagger_by": "left", "start": "click",
    }  # fmt: skip
    assert set(options) == {setting.name for setting in SETTINGS}
    (tmp_path / "p.json").write_text(project(options=options), "utf-8")
    assert run("morph --project p.json -o x.svg").code == 0
    line = (
        "morph a.svg b.svg -o same.svg --method arap --quads 4 --fit geometry --loose --change fade"
        " --duration 1.5 --hold 0.5 --easing ease --loop alternate --stagger 0.2 --stagger-by left"
        " --start click"
    )
    assert run(line).code == 0
    made = (tmp_path / "x.svg").read_text("utf-8")
    assert made == (tmp_path / "same.svg").read_text("utf-8")
    names = {"a.svg": "a.svg", "b.svg": "b.svg"}
    job = job_of({"drawings": list(names), "options": options}, names)
    assert shown(job, names) == (
        "shapetween " + line.replace(" -o same.svg", "") + " -o a-to-b.svg"
    )


def test_matches_and_matchings_of_a_projects_legs(run: Command, tmp_path: Path) -> None:
    legs = [{"matches": ["#1:#1"]}, {"matches": ["#1:#1"], "matching": 1}]
    text = project(order=["one.svg", "b.svg", "one.svg"], legs=legs)
    (tmp_path / "p.json").write_text(text, "utf-8")
    assert run("morph --project p.json -o x.svg").code == 0
    run("morph a.svg b.svg a.svg -o same.svg --match 1/#1:#1 --match 2/#1:#1")
    made = (tmp_path / "x.svg").read_text("utf-8")
    assert made == (tmp_path / "same.svg").read_text("utf-8")


def test_drawings_beside_a_project_are_refused(run: Command, tmp_path: Path) -> None:
    (tmp_path / "p.json").write_text(project(), "utf-8")
    done = run("morph a.svg b.svg --project p.json")
    assert done.code == 2
    assert "--project" in done.err
    assert not done.made


def test_names_in_a_project_are_no_paths(run: Command, tmp_path: Path) -> None:
    drawings = [{"name": "../x.svg", "svg": svg(SQUARE)}, {"name": "/x.svg", "svg": svg(TRIANGLE)}]
    text = json.dumps({"shapetween": "project", "version": 1, "drawings": drawings})
    (tmp_path / "p.json").write_text(text, "utf-8")
    done = run("morph --project p.json -o out.svg")
    assert done.code == 0
    assert done.made == {"out.svg"}


def test_pins_of_chains(run: Command) -> None:
    chain = "morph a.svg b.svg a.svg -o x.svg --pin "
    assert "of which of the 2 legs" in run(chain + "1,1:2,2").err
    assert "there are 2 legs" in run(chain + "3/1,1:2,2").err
    assert "--pin" in run(chain + "0/1,1:2,2").err
    assert run(chain + "2/2,2:1,1").code == 0
    assert "is but one leg" in run("morph a.svg b.svg -o y.svg --pin 2/1,1:2,2").err
    assert run("morph a.svg b.svg -o y.svg --pin 1/1,1:2,2").code == 0

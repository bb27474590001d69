"""The command line that makes what the page shows."""

import shlex
from collections.abc import Collection, Mapping
from pathlib import Path

from shapetween.studio.job import Job
from shapetween.studio.settings import ONLY_PAGES, SETTINGS

__all__ = ["arguments", "default_name", "shown"]


def arguments(
    job: Job, paths: Mapping[str, str], command: str = "morph", takes: Collection[str] | None = None
) -> list[str]:
    """What follows ``shapetween`` on the command line, but for where to write.

    Parameters
    ----------
    job : Job
    paths : Mapping
        From a drawing's name to what the command line calls it.
    command : {"morph", "frames", "mesh"}
    takes : collection of str, optional
        Names of the options of writing that the output has a use for; all if left out.
    """
    words = [command, *(paths[name] for name in job.drawings)]
    several = len(job.legs) > 1
    for k, leg in enumerate(job.legs, start=1):
        at = f"{k}/" if several else ""
        for ax, ay, bx, by in leg.pins:
            words += ["--pin", f"{at}{ax:.10g},{ay:.10g}:{bx:.10g},{by:.10g}"]
        for match in leg.matches:
            words += ["--match", f"{at}{match}"]
        if leg.matching != 1:
            words += ["--matching", f"{at}{leg.matching}"]
    for setting in SETTINGS:
        if setting.name not in job.options:
            continue
        if setting.stage == "prepare" or takes is None or setting.name in takes:
            words += setting.words(job.options[setting.name])
    return words


def default_name(job: Job, ending: str) -> str:
    """What a file is called that nobody has named."""
    return "-to-".join(Path(name).stem for name in job.drawings)[:120] + ending


def shown(job: Job, paths: Mapping[str, str]) -> str:
    """The whole line, to be copied into a terminal."""
    out = default_name(job, ".html" if job.options.get("start") in ONLY_PAGES else ".svg")
    return shlex.join(["shapetween", *arguments(job, paths), "-o", out])

"""The drawings of one run of the studio, and what the page may ask of them."""

import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from shapetween.base.errors import OptionError
from shapetween.io import files
from shapetween.studio import settings
from shapetween.studio.command import shown
from shapetween.studio.exports import OUTPUT, Export, Form, export, forms, output_words
from shapetween.studio.job import Job, job_of
from shapetween.studio.project import Project, plain_name, project_of, project_text
from shapetween.studio.workers import Workers

__all__ = ["Session"]

#: Most drawings of a session: more are a mistake, and fill the memory.
MOST_DRAWINGS = 200


class Session:
    """Everything between starting the studio and ending it.

    Drawings are kept in a folder of their own under names that are made here, so that nothing the
    page says is ever a path.

    Parameters
    ----------
    folder : Path
        Empty, and this session's alone.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._files: dict[str, bytes] = {}
        self._views: dict[str, Any] = {}
        self._given: dict[str, str] = {}
        self._lock = threading.Lock()
        self._last: dict[str, Any] = {}
        self.workers = Workers(folder)

    def open_paths(self, paths: list[Path]) -> None:
        """Take in drawings, or one project, that the command line names.

        Raises
        ------
        ShapetweenError
            If one cannot be read.
        """
        self._open_paths(paths)
        self.workers.warm()

    def _open_paths(self, paths: list[Path]) -> None:
        if len(paths) == 1 and paths[0].suffix.lower() == ".json":

            def beside(name: str) -> bytes:
                return files.read_bytes(paths[0].parent / name)

            text = files.read_text(paths[0])
            self._last = self._opened(project_of(text, str(paths[0]), beside))
            return
        names = dict.fromkeys(paths, "")
        for path in names:
            names[path] = self._kept(path.name, files.read_bytes(path), str(path))
        self._last = {"drawings": [names[path] for path in paths]}

    def state(self) -> dict[str, Any]:
        """What a page that has just been opened needs to know."""
        with self._lock:
            last = self._last
        return {
            "drawings": dict(self._views),
            "last": last,
            "settings": settings.as_json(),
            "forms": {key: _described(form) for key, form in forms().items()},
        }

    def add(self, name: str, data: bytes) -> dict[str, Any]:
        """Take in a drawing.

        Raises
        ------
        ShapetweenError
            If it cannot be read.
        """
        view: dict[str, Any] = self._view(self._kept(name, data, ""))
        return view

    def job(self, data: object) -> Job:
        """Check what the page asks for."""
        return job_of(data, self._files)

    def command(self, job: Job) -> dict[str, Any]:
        """The command line."""
        return {"line": shown(job, self._paths(job))}

    def live(self, job: Job) -> Any:
        """A preview."""
        return self.workers.quick("live", job)

    def alternatives(self, page: str, job: Job) -> Any:
        """The best matchings of one leg, each as it moves; previews do not wait for them."""
        return self.workers.run(f"{page} alternatives", "alternatives", job)

    def full(self, page: str, job: Job) -> Any:
        """The full result."""
        with self._lock:
            self._last = job.plain()
        return self.workers.run(page, "full", job)

    def export(self, job: Job, form: str, output: Mapping[str, Any]) -> Export:
        """A file.

        Raises
        ------
        OptionError
            If there is no such kind of file.
        """
        if form not in forms():
            raise OptionError(f"form: {form!r} is none of {', '.join(forms())}")
        return export(job, form, output_words(form, output), self._folder)

    def save(self, job: Job) -> str:
        """The project as text."""
        return project_text(job, self._files)

    def open(self, name: str, data: bytes) -> dict[str, Any]:
        """Open a project; what the page needs to show it."""
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            raise OptionError(f"{name}: byte {error.start} is not UTF-8 text") from error
        last = self._opened(project_of(text, name))
        views = {known: self._view(known) for known in dict.fromkeys(last["drawings"])}
        return {"drawings": views, "last": last}

    def close(self) -> None:
        """End everything."""
        self.workers.close()

    def _opened(self, project: Project) -> dict[str, Any]:
        names = {name: self._kept(name, data, "") for name, data in project.files.items()}
        plain: dict[str, Any] = project.job.plain()
        return {**plain, "drawings": [names[name] for name in plain["drawings"]]}

    def _kept(self, name: str, data: bytes, given: str) -> str:
        """Read a drawing and keep it; the name it has got."""
        with self._lock:
            for known, content in self._files.items():
                if content == data and plain_name(name) == plain_name(known):
                    return known
            if len(self._files) >= MOST_DRAWINGS:
                raise OptionError(f"{name}: the studio takes {MOST_DRAWINGS} drawings")
        shown_name = plain_name(name)
        view = self.workers.quick("read", shown_name, data)
        with self._lock:
            free, k = shown_name, 1
            while free in self._files:
                k += 1
                free = f"{Path(shown_name).stem}-{k}{Path(shown_name).suffix}"
            (self._folder / free).write_bytes(data)
            self._files[free] = data
            self._views[free] = {**view, "name": free}
            self._given[free] = given or free
        return free

    def _view(self, name: str) -> Any:
        return self._views[name]

    def _paths(self, job: Job) -> dict[str, str]:
        return {name: self._given.get(name, name) for name in job.drawings}


def _described(form: Form) -> dict[str, Any]:
    """What the page needs to know of a kind of file."""
    takes = [name for name in form.takes if name in OUTPUT]
    return {"ending": form.ending, "label": form.label, "takes": takes}

"""What all results have in common."""

from __future__ import annotations

import html
import io
import json
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple, Union

import pandas as pd

from ._exact_csv import read_csv
from ._problem import Problem

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Result:
    """What a command found.

    `json` is the command's own result file as a dict, `folder` the place of all files that it
    wrote, `notes` what it remarked, `config` the config's path, `answer` False where the command's
    answer is no (a fit that did not converge, an empty family). Printed, a result is the command's
    summary. A result can be the first argument of every function: the same problem, and what
    was found for it, go on from there.
    """

    main_file = ""
    json: Dict[str, Any]

    def __init__(self, problem: Problem, output: str, notes: List[str], answer: bool) -> None:
        self._problem = problem
        self.summary = _without_paths(output)
        self.notes = notes
        self.answer = answer
        self.folder: Path = problem.out
        self.json = {}
        if self.main_file.endswith(".json"):
            self.json = json.loads((self.folder / self.main_file).read_text(encoding="utf-8"))
        self._load()

    def _load(self) -> None:
        """Reads the files, which a later command in the same folder may replace."""

    def _csv(self, name: str) -> pd.DataFrame:
        """A table as the program wrote it, each number the same double."""
        return read_csv(self.folder / name, dtype=dict.fromkeys(("name", "experiment"), str),
                        keep_default_na=False, na_values=[""])

    @property
    def config(self) -> Path:
        return self._problem.config

    def problem(self) -> Problem:
        """What a function takes that gets this result as its problem."""
        return self._problem

    def save(self, folder: "Union[str, Path]") -> Path:
        """Copies all files of the result to a folder, beside others that are there; where the
        problem was given as arrays or as a dict, its config and records too, so that the program
        takes `folder/config.yaml`."""
        target = Path(folder)
        shutil.copytree(self.folder, target, dirs_exist_ok=True)
        if self._problem.is_temporary:
            for path in self._problem.config.parent.iterdir():
                if path.is_file():
                    shutil.copy2(path, target / path.name)
        return target

    def report(self, **options: Any) -> Path:
        """howl.report() of this result."""
        from . import report

        return report(self, **options)

    def plot(self) -> "Figure":
        """A matplotlib figure of the result."""
        raise NotImplementedError

    def _title(self) -> str:
        return type(self).__name__

    def _tables(self) -> List[Tuple[str, pd.DataFrame]]:
        """Captions and tables for a notebook."""
        return []

    def _facts(self) -> List[str]:
        """What a notebook shows beside the tables."""
        return []

    def __repr__(self) -> str:
        return "\n".join([f"howl.{self._title()}", self.summary, *self.notes]).rstrip()

    def _repr_html_(self) -> str:
        parts = [f"<div><b>howl.{html.escape(self._title())}</b>"]
        parts += [f"<div>{html.escape(fact)}</div>" for fact in self._facts()]
        for caption, table in self._tables():
            parts.append(f"<div><i>{html.escape(caption)}</i></div>")
            parts.append(table.to_html(max_rows=20, float_format=lambda x: f"{x:.5g}"))
        parts += [f"<div>{html.escape(note)}</div>" for note in self.notes]
        text = f"<pre>{html.escape(self.summary)}</pre>"
        parts.append(f"<details><summary>what howl printed</summary>{text}</details></div>")
        return "\n".join(parts)


def _without_paths(output: str) -> str:
    """Without the lines that say where files are: a folder that comes and goes."""
    kept: List[str] = []
    written = False
    for line in output.splitlines():
        written = line.startswith("written: ") or (written and line.startswith("  "))
        if not written:
            kept.append(line.rstrip())
    return "\n".join(kept)


def unwrapped(lines: List[str]) -> List[str]:
    """Lines that the program broke (the next begins with blanks) in one piece each."""
    notes: List[str] = []
    for line in lines:
        if line.startswith("  ") and notes:
            notes[-1] += " " + line.strip()
        else:
            notes.append(line)
    return notes


def need_matplotlib() -> Any:
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError("plot() needs matplotlib: pip install matplotlib") from error
    return Figure


def figure(rows: int, columns: int, width: float = 4.5, height: float = 3.0) -> "Tuple[Any, Any]":
    """A figure that no pyplot state knows, and its axes as a two-dimensional array."""
    kind = need_matplotlib()

    class Shown(kind):  # type: ignore[misc, valid-type]
        """Notebooks show a figure of matplotlib by themselves only after pyplot was imported."""

        def _repr_png_(self) -> bytes:
            page = io.BytesIO()
            self.savefig(page, format="png")
            return page.getvalue()

    made = Shown(figsize=(width * columns, height * rows), layout="constrained")
    return made, made.subplots(rows, columns, squeeze=False)


def frame_of(rows: List[Dict[str, Any]], index: Optional[str] = None) -> pd.DataFrame:
    """A table of the scalar entries of each dict."""
    flat = [{k: v for k, v in row.items() if not isinstance(v, (dict, list))} for row in rows]
    table = pd.DataFrame(flat)
    return table.set_index(index) if index and not table.empty else table

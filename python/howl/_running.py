"""From a function's arguments to the program's words, and back to a result."""

from __future__ import annotations

import hashlib
import os
import tempfile
from pathlib import Path
from typing import Any, Dict, Mapping, Optional, Sequence, Tuple, Type, TypeVar

from ._diagnosis import Check
from ._errors import Interrupted, NegativeAnswer, ProgramError
from ._experiment import experiments_of_arrays, is_signal
from ._problem import Problem, as_config, write_problem
from ._program import Completed, run_program
from ._progress import ProgressArgument, Shown
from ._result import Result, unwrapped

R = TypeVar("R", bound=Result)

# Problems whose computation Ctrl-C ended: the same call finds their folder again, and the program
# goes on from what it saved there.
_unfinished: Dict[str, Problem] = {}


def _open(problem: Any, q: Any, options: Dict[str, Any]) -> Problem:
    sampling_hz, phi = options.pop("sampling_hz", None), options.pop("phi", None)
    name, config, out = (options.pop(key, None) for key in ("name", "config", "out"))
    arrays = {"q": q, "sampling_hz": sampling_hz, "phi": phi, "name": name}
    if is_signal(problem):
        problem = experiments_of_arrays(problem, q, sampling_hz, phi, name)
    else:
        for key, value in arrays.items():
            if value is not None:
                raise TypeError(f"{key} goes with an array p as the first argument")
    if isinstance(problem, (Result, str, os.PathLike)) and config is not None:
        raise TypeError("config goes with arrays, tables and dicts; a config's file has its own")
    if isinstance(problem, Result):
        opened = problem.problem()
        if out is None:
            return opened
        return Problem(opened.config, opened._temporary, Path(out), opened.key, opened._arrays)
    temporary = tempfile.TemporaryDirectory(prefix="howl_")
    folder = Path(temporary.name)
    if isinstance(problem, (str, os.PathLike)):
        path = Path(problem)
        sources: Dict[str, str] = {}
        content = path.read_bytes() if path.is_file() else b""
        key = hashlib.sha256(content + os.fsencode(path.absolute())).hexdigest()
    else:
        path, sources, key = write_problem(as_config(problem, config), folder / "problem")
    if out is None and key in _unfinished:
        return _unfinished[key]
    return Problem(path, temporary, folder / "out" if out is None else Path(out), key, sources)


def _stamp(path: Path) -> Optional[Tuple[int, int]]:
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_ino, found.st_mtime_ns


def _run(problem: Problem, command: str, words: Sequence[str], threads: Optional[int],
         seed: Optional[int], progress: ProgressArgument) -> Completed:
    line = [command, str(problem.config), "--out", str(problem.out), *words]
    if threads is not None:
        line += ["--threads", str(int(threads))]
    if seed is not None:
        line += ["--seed", str(int(seed))]
    with Shown(progress) as shown:
        try:
            done = run_program(line, shown.observer)
        except Interrupted:
            _unfinished[problem.key] = problem
            raise
    _unfinished.pop(problem.key, None)
    return done


def result(kind: Type[R], command: str, words: Sequence[str], problem: Any, q: Any,
            options: Dict[str, Any]) -> R:
    opened = _open(problem, q, options)
    main = opened.out / kind.main_file
    before = _stamp(main)
    done = _run(opened, command, words, options.pop("threads"), options.pop("seed"),
                options.pop("progress"))
    written = _stamp(main) not in (None, before)
    text = "\n".join(done.messages)
    if done.status == 2 and not (written and kind is Check):
        raise opened.error(done.messages[-1] if done.messages else "bad input")
    if done.status not in (0, 1, 2):
        raise ProgramError(f"howl {command} ended with status {done.status}: {text}")
    if not written:
        if done.status == 1:
            raise NegativeAnswer(text or done.output.strip())
        raise ProgramError(f"howl {command} wrote no {kind.main_file}: {text}")
    return kind(opened, done.output, unwrapped(done.messages), done.status == 0)


def options_of(given: Mapping[str, Any]) -> Dict[str, Any]:
    names = ("sampling_hz", "phi", "name", "config", "out", "threads", "seed", "progress")
    return {name: given[name] for name in names}

"""The functions of the package: one for each command of the program howl."""

from __future__ import annotations

import hashlib
import os
import tempfile
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Type, TypeVar, Union

import numpy as np

from ._diagnosis import Check, Diagnosis
from ._errors import ConfigError, Interrupted, NegativeAnswer, ProgramError
from ._loops import Family, Fit, Prediction
from ._problem import Problem, as_config, experiments_of_arrays, is_signal, write_problem
from ._program import Completed, run_program
from ._progress import ProgressArgument, Shown
from ._records import Analysis, Simulation
from ._result import Result, unwrapped

PathLike = Union[str, "os.PathLike[str]"]
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


def _result(kind: Type[R], command: str, words: Sequence[str], problem: Any, q: Any,
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


_COMMON = """
    The problem is one of

    * an array of pressure samples p, or several of them (a list, or the rows of a matrix): with
      `q` (heat release, sampled together with p, or None), `sampling_hz` (samples a second),
      `phi` (operating parameter of each), and `name` where they are to have names;
    * a list of `howl.Experiment`;
    * a pandas table with a row for each experiment and the config's keys as columns
      (`phi`, `frequency_hz`, `phase_deg`, `gain`, `flame_slope`, ...);
    * a config, as the path of its file or as a dict (in which `record: {"pressure": p,
      "heat_release": q, "sampling_hz": 5000}` may hold arrays);
    * a result of another function: the same problem, with what was found for it.

    `config` has further sections (`{"model": {"modes": 2}}`) for all but a path. Files are
    written to the folder `out`; without it to a temporary folder that is removed with the result
    (see `Result.save`). The answer depends on `seed` and not on `threads` (default: all cores).
    `progress` is shown on a terminal and in a notebook; True shows it always, False never, and a
    function is called with a `howl.Progress`. Raises ConfigError for a mistake, Interrupted after
    Ctrl-C: the same call then goes on where it stopped.
    """


def _documented(function: Any) -> Any:
    function.__doc__ = (function.__doc__ or "").rstrip() + "\n" + _COMMON
    return function


@_documented
def analyse(problem: Any, q: Any = None, *, sampling_hz: Any = None, phi: Any = None,
            name: Any = None, config: Optional[Mapping[str, Any]] = None,
            out: Optional[PathLike] = None, threads: Optional[int] = None,
            seed: Optional[int] = None, progress: ProgressArgument = None) -> Analysis:
    """What do the records show, and how surely?"""
    return _result(Analysis, "analyse", [], problem, q, _options(locals()))


@_documented
def fit(problem: Any, q: Any = None, *, sampling_hz: Any = None, phi: Any = None, name: Any = None,
        config: Optional[Mapping[str, Any]] = None, out: Optional[PathLike] = None,
        threads: Optional[int] = None, seed: Optional[int] = None,
        progress: ProgressArgument = None) -> Fit:
    """Which loop fits all operating points together?"""
    return _result(Fit, "fit", [], problem, q, _options(locals()))


@_documented
def family(problem: Any, q: Any = None, *, sampling_hz: Any = None, phi: Any = None,
           name: Any = None, config: Optional[Mapping[str, Any]] = None,
           falsify: Optional[PathLike] = None, advise: bool = False, profile: Optional[str] = None,
           out: Optional[PathLike] = None, threads: Optional[int] = None,
           seed: Optional[int] = None, progress: ProgressArgument = None) -> Family:
    """Which loops can the data not reject?

    `falsify` is another config's path: which members survive its experiments. `advise` adds which
    further measurement would remove most of the family, `profile` the best fit along a quantity
    such as "exp1.tau_s"; both are in the result's `json` or files.
    """
    words = ["--falsify", os.fspath(falsify)] if falsify is not None else []
    words += ["--advise"] if advise else []
    words += ["--profile", profile] if profile is not None else []
    return _result(Family, "family", words, problem, q, _options(locals()))


@_documented
def predict(problem: Any, q: Any = None, *, at: Any, sampling_hz: Any = None, phi: Any = None,
            name: Any = None, config: Optional[Mapping[str, Any]] = None,
            out: Optional[PathLike] = None, threads: Optional[int] = None,
            seed: Optional[int] = None, progress: ProgressArgument = None) -> Prediction:
    """What would the loop do at operating points that nobody measured?

    `at` is a value of the operating parameter or several. Raises NegativeAnswer where the family is
    empty or none of the points can be predicted.
    """
    values = [repr(float(value)) for value in np.atleast_1d(np.asarray(at, dtype=float))]
    words: List[str] = []
    for start in range(0, len(values), 1000):  # one argument has no more than 128 KiB
        words += ["--at=" + ",".join(values[start:start + 1000])]
    return _result(Prediction, "predict", words, problem, q, _options(locals()))


@_documented
def simulate(problem: Any, q: Any = None, *, member: Optional[int] = None, sampling_hz: Any = None,
             phi: Any = None, name: Any = None, config: Optional[Mapping[str, Any]] = None,
             out: Optional[PathLike] = None, threads: Optional[int] = None,
             seed: Optional[int] = None, progress: ProgressArgument = None) -> Simulation:
    """What will such a loop do?

    Simulates the fitted loop, or `member` K (from 1) of a family, the first argument being the
    family's result. The config's `simulate` section has duration, sampling, noise and effects.
    """
    words = ["--member", str(int(member))] if member is not None else []
    return _result(Simulation, "simulate", words, problem, q, _options(locals()))


@_documented
def diagnose(problem: Any, q: Any = None, *, reference: Optional[PathLike] = None,
             bootstrap: Optional[int] = None, without: Sequence[str] = (), sampling_hz: Any = None,
             phi: Any = None, name: Any = None, config: Optional[Mapping[str, Any]] = None,
             out: Optional[PathLike] = None, threads: Optional[int] = None,
             seed: Optional[int] = None, progress: ProgressArgument = None) -> Diagnosis:
    """Where, why and by how much does the model fall short of the rig?

    `reference` is the config of another simulator's records, which then stand in the model's place.
    `bootstrap` rigs (19 or more) are simulated to tell what noise alone gains. Effects named in
    `without` are left out of the catalogue.
    """
    words = ["--reference", os.fspath(reference)] if reference is not None else []
    words += ["--bootstrap", str(int(bootstrap))] if bootstrap is not None else []
    words += ["--without", ",".join(without)] if without else []
    return _result(Diagnosis, "diagnose", words, problem, q, _options(locals()))


@_documented
def check(problem: Any, q: Any = None, *, sampling_hz: Any = None, phi: Any = None,
          name: Any = None, config: Optional[Mapping[str, Any]] = None,
          out: Optional[PathLike] = None, threads: Optional[int] = None,
          seed: Optional[int] = None, progress: ProgressArgument = None) -> Check:
    """What is wrong with a problem, all of it, and what does it allow? Mistakes are listed, and no
    exception is raised for them."""
    return _result(Check, "check", [], problem, q, _options(locals()))


def report(result: Result, *, threads: Optional[int] = None,
           progress: ProgressArgument = None) -> Path:
    """One page of figures of all that stands in the result's folder; returns its path."""
    with Shown(progress) as shown:
        words = ["report", str(result.folder)]
        words += ["--threads", str(int(threads))] if threads is not None else []
        done = run_program(words, shown.observer)
    page = result.folder / "report.html"
    if done.status != 0 or not page.exists():
        raise ProgramError("\n".join(done.messages) or "no report was written")
    return page


def save(problem: Any, folder: PathLike, *, config: Optional[Mapping[str, Any]] = None) -> Path:
    """Writes a problem that was given as experiments, a table or a dict to a folder, for the
    program: returns the path of its config."""
    if isinstance(problem, (str, os.PathLike, Result)):
        raise ConfigError("is in files already, expected experiments, a table or a dict",
                          key="problem")
    return write_problem(as_config(problem, config), Path(folder))[0]


def version() -> str:
    """The version of the program, such as "0.1.0"."""
    done = run_program(["--version"])
    return done.output.split()[-1]


def _options(given: Mapping[str, Any]) -> Dict[str, Any]:
    names = ("sampling_hz", "phi", "name", "config", "out", "threads", "seed", "progress")
    return {name: given[name] for name in names}

"""The functions of the package: one for each command of the program howl."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, List, Mapping, Optional, Sequence, Union

import numpy as np

from ._campaign import Campaign
from ._diagnosis import Check, Diagnosis
from ._errors import ConfigError, ProgramError
from ._loops import Family, Fit, Prediction
from ._problem import as_config, write_problem
from ._program import run_program
from ._progress import ProgressArgument, Shown
from ._records import Analysis, Simulation
from ._result import Result
from ._running import options_of, result

PathLike = Union[str, "os.PathLike[str]"]


def _config_of(other: Union[PathLike, Result]) -> str:
    return str(other.problem().config) if isinstance(other, Result) else os.fspath(other)


def _numbers(values: Any) -> List[str]:
    """As the command line has them, each the same double."""
    if values is None:
        return []
    return [repr(float(value)) for value in np.atleast_1d(np.asarray(values, dtype=float))]


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
    return result(Analysis, "analyse", [], problem, q, options_of(locals()))


@_documented
def fit(problem: Any, q: Any = None, *, sampling_hz: Any = None, phi: Any = None, name: Any = None,
        config: Optional[Mapping[str, Any]] = None, out: Optional[PathLike] = None,
        threads: Optional[int] = None, seed: Optional[int] = None,
        progress: ProgressArgument = None) -> Fit:
    """Which loop fits all operating points together?"""
    return result(Fit, "fit", [], problem, q, options_of(locals()))


@_documented
def family(problem: Any, q: Any = None, *, sampling_hz: Any = None, phi: Any = None,
           name: Any = None, config: Optional[Mapping[str, Any]] = None,
           falsify: Union[PathLike, Result, None] = None, advise: bool = False,
           profile: Optional[str] = None, without: Sequence[str] = (),
           out: Optional[PathLike] = None, threads: Optional[int] = None,
           seed: Optional[int] = None, progress: ProgressArgument = None) -> Family:
    """Which loops can the data not reject?

    `falsify` is another config's path, or a result: which members survive its experiments.
    `advise` adds which further measurement would remove most of the family, `profile` the best fit
    along a quantity such as "exp1.tau_s". Conditions of the test named in `without`, such as
    "loop_gain_min", are left out. All are in the result's `json` or files.
    """
    words = ["--falsify", _config_of(falsify)] if falsify is not None else []
    words += ["--advise"] if advise else []
    words += ["--profile", profile] if profile is not None else []
    words += ["--without", ",".join(without)] if without else []
    return result(Family, "family", words, problem, q, options_of(locals()))


@_documented
def predict(problem: Any, q: Any = None, *, at: Any = None, map: Optional[str] = None,
            map_x: Any = None, map_y: Any = None, without: Sequence[str] = (),
            sampling_hz: Any = None, phi: Any = None, name: Any = None,
            config: Optional[Mapping[str, Any]] = None, out: Optional[PathLike] = None,
            threads: Optional[int] = None, seed: Optional[int] = None,
            progress: ProgressArgument = None) -> Prediction:
    """What would the loop do at operating points that nobody measured?

    `at` is a value of the operating parameter or several; with a `map` alone it is the measured
    ones. `map`, such as "phi:tau_s", asks for a stability chart over two quantities, `map_x` and
    `map_y` being their values. Conditions of the family's test named in `without` are left out.
    Raises NegativeAnswer where the family is empty or none of the points can be predicted.
    """
    values = _numbers(at)
    words: List[str] = []
    for start in range(0, len(values), 1000):  # one argument has no more than 128 KiB
        words += ["--at=" + ",".join(values[start:start + 1000])]
    words += ["--map", map] if map is not None else []
    for option, axis in (("--map-x", map_x), ("--map-y", map_y)):
        words += [option + "=" + ",".join(_numbers(axis))] if axis is not None else []
    words += ["--without", ",".join(without)] if without else []
    return result(Prediction, "predict", words, problem, q, options_of(locals()))


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
    return result(Simulation, "simulate", words, problem, q, options_of(locals()))


@_documented
def diagnose(problem: Any, q: Any = None, *, reference: Union[PathLike, Result, None] = None,
             bootstrap: Optional[int] = None, without: Sequence[str] = (), one_cause: bool = False,
             sampling_hz: Any = None, phi: Any = None, name: Any = None,
             config: Optional[Mapping[str, Any]] = None, out: Optional[PathLike] = None,
             threads: Optional[int] = None, seed: Optional[int] = None,
             progress: ProgressArgument = None) -> Diagnosis:
    """Where, why and by how much does the model fall short of the rig?

    `reference` is the config of another simulator's records, or a simulation, which then stand in
    the model's place.
    `bootstrap` rigs (19 or more) are simulated to tell what noise alone gains. Effects and items of
    the budget that are named in `without` are left out. With `one_cause` the one effect of the
    catalogue is looked for that explains most, as with a reference or a bootstrap.
    """
    words = ["--reference", _config_of(reference)] if reference is not None else []
    words += ["--bootstrap", str(int(bootstrap))] if bootstrap is not None else []
    words += ["--without", ",".join(without)] if without else []
    words += ["--one-cause"] if one_cause else []
    return result(Diagnosis, "diagnose", words, problem, q, options_of(locals()))


@_documented
def check(problem: Any, q: Any = None, *, sampling_hz: Any = None, phi: Any = None,
          name: Any = None, config: Optional[Mapping[str, Any]] = None,
          out: Optional[PathLike] = None, threads: Optional[int] = None,
          seed: Optional[int] = None, progress: ProgressArgument = None) -> Check:
    """What is wrong with a problem, all of it, and what does it allow? Mistakes are listed, and no
    exception is raised for them."""
    return result(Check, "check", [], problem, q, options_of(locals()))


def campaign(path: PathLike, *, out: Optional[PathLike] = None, threads: Optional[int] = None,
             seed: Optional[int] = None, progress: ProgressArgument = None) -> Campaign:
    """What do the same commands say of many rigs?

    `path` is the campaign's file (docs/campaign.md). With `out`, what stands there and has not
    changed is not run again.
    """
    options = {"out": out, "threads": threads, "seed": seed, "progress": progress}
    return result(Campaign, "campaign", [], os.fspath(path), None, options)


def report(found: Result, *, threads: Optional[int] = None,
           progress: ProgressArgument = None) -> Path:
    """One page of figures of all that stands in the result's folder; returns its path."""
    with Shown(progress) as shown:
        words = ["report", str(found.folder)]
        words += ["--threads", str(int(threads))] if threads is not None else []
        done = run_program(words, shown.observer)
    page = found.folder / "report.html"
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

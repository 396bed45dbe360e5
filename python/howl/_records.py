"""Results of records: what they show, and records that were simulated."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Dict, List, Optional, Tuple

import numpy as np
import pandas as pd
import yaml

from ._experiment import Experiment
from ._problem import Problem
from ._result import Result, figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Analysis(Result):
    """What the records show, each by itself.

    `characteristics` has a row for each experiment: limit-cycle frequency, phase from q to p, gain,
    delay `tau_s`, the flame's slope at rest (q per p/s), loop gain, and their standard deviations.
    `lines` are the significant spectral lines, `oscillations` the cycle and those beside it,
    `transfer` the q-to-p transfer where both are coherent, `flame_curve` the flame's curve.
    """

    main_file = "analysis.json"
    characteristics: pd.DataFrame
    lines: pd.DataFrame
    oscillations: pd.DataFrame
    transfer: pd.DataFrame
    flame_curve: pd.DataFrame

    def _load(self) -> None:
        self.characteristics = self._csv("characteristics.csv").set_index("name")
        self.lines = self._csv("lines.csv")
        self.oscillations = self._csv("oscillations.csv")
        self.transfer = self._csv("transfer.csv")
        self.flame_curve = self._csv("flame_curve.csv")

    def _title(self) -> str:
        return f"Analysis of {len(self.characteristics)} experiments"

    def _tables(self) -> List[Tuple[str, pd.DataFrame]]:
        return [("characteristics (_std: standard deviations)", self.characteristics)]

    def plot(self) -> "Figure":
        """Gain and phase of the q-to-p transfer over frequency, measured and fitted, and the
        flame's curve."""
        made, ((gain, phase, flame),) = figure(1, 3)
        for i, (name, own) in enumerate(self.transfer.groupby("name", sort=False)):
            colour = f"C{i}"
            measured = own["re"] + 1j * own["im"]
            model = own["model_re"] + 1j * own["model_im"]
            hz = own["frequency_hz"]
            gain.semilogy(hz, measured.abs(), ".", color=colour, ms=3, label=name)
            gain.semilogy(hz, model.abs(), "-", color=colour, lw=1)
            phase.plot(hz, _degrees(measured), ".", color=colour, ms=3)
            phase.plot(hz, _degrees(model), "-", color=colour, lw=1)
        for i, (_, own) in enumerate(self.flame_curve.groupby("name", sort=False)):
            flame.plot(own["delayed_derivative"], own["q"], color=f"C{i}")
        gain.set(xlabel="frequency, Hz", ylabel="|p / q|")
        phase.set(xlabel="frequency, Hz", ylabel="phase from q to p, deg")
        flame.set(xlabel="dp/dt one delay before, p/s", ylabel="q")
        if not self.transfer.empty:
            gain.legend()
        return made  # type: ignore[no-any-return]


def _degrees(values: pd.Series) -> "pd.Series":
    return pd.Series(np.degrees(np.angle(values.to_numpy())), index=values.index)


class Simulation(Result):
    """Simulated records. As the problem of another function it is these records, not the loop
    that made them.

    `records` has a frame for each experiment, with the columns p and q over the time `t_s`;
    `json` says which model ran, with which flame, on which cycle it began.
    """

    main_file = "simulation.json"
    records: Dict[str, pd.DataFrame]
    sampling_hz: Dict[str, float]
    sweep: Optional[pd.DataFrame]

    def _load(self) -> None:
        self._phi: Dict[str, float] = {}
        self.records, self.sampling_hz = {}, {}
        for name, phi, file, sampling_hz in _listed(self.folder / "records.yaml"):
            table = self._csv(file)
            table.index = pd.Index(table.index / sampling_hz, name="t_s")
            table.attrs["sampling_hz"] = sampling_hz
            self.records[name], self.sampling_hz[name] = table, sampling_hz
            self._phi[name] = phi
        sweep = self.folder / "sweep.csv"
        self.sweep = self._csv("sweep.csv") if sweep.exists() else None

    @property
    def experiments(self) -> List[Experiment]:
        """The records as experiments."""
        return [
            Experiment(phi=self._phi[name], p=table["p"].to_numpy(),
                       q=table["q"].to_numpy() if "q" in table else None,
                       sampling_hz=self.sampling_hz[name], name=name)
            for name, table in self.records.items()
        ]

    def problem(self) -> Problem:
        """The records' own config. Its results go to a folder within the simulation's, so that
        those of the loop that made them stay."""
        own = Problem(self.folder / "records.yaml", self._problem._temporary,
                      self.folder / "of_records", self._problem.key + ".records", {})
        return own

    def _title(self) -> str:
        return f"Simulation of {len(self.records)} experiments"

    def _tables(self) -> List[Tuple[str, pd.DataFrame]]:
        rows = [
            {"experiment": name, "samples": len(own), "sampling_hz": self.sampling_hz[name],
             **{f"{column}_rms": float(own[column].std()) for column in own}}
            for name, own in self.records.items()
        ]
        return [("records", pd.DataFrame(rows).set_index("experiment"))]

    def plot(self, seconds: float = 0.05) -> "Figure":
        """The first seconds of p and q of each experiment."""
        made, axes = figure(len(self.records), 1, width=8.0, height=2.0)
        for (name, own), (axis,) in zip(self.records.items(), axes):
            start = own[own.index <= seconds]
            axis.plot(start.index, start["p"], label="p")
            axis.set(ylabel="p", title=name)
            if "q" in own:
                other = axis.twinx()
                other.plot(start.index, start["q"], "C1", label="q")
                other.set_ylabel("q")
        axes[-1, 0].set_xlabel("time, s")
        return made  # type: ignore[no-any-return]


def _listed(path: Path) -> List[Tuple[str, float, str, float]]:
    """Name, operating parameter, file and sampling rate of each record of a records.yaml."""
    config = yaml.safe_load(path.read_text(encoding="utf-8"))
    parameter = config.get("operating_parameter", "phi")
    return [
        (str(one["name"]), float(one[parameter]), str(one["record"]["file"]),
         float(one["record"]["sampling_hz"]))
        for one in config["experiments"]
    ]

"""An operating point, and how arrays of samples become some."""

from __future__ import annotations

import dataclasses
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

import numpy as np
import pandas as pd

from ._errors import ConfigError

Array = Union[np.ndarray, pd.Series, Sequence[float]]


@dataclasses.dataclass
class Experiment:
    """One operating point: a record of p and q, or the characteristics of a published table.

    `phi` is the operating parameter (the equivalence ratio, unless the config's
    `operating_parameter` names another). `p` and `q` are samples of pressure and heat release taken
    together at `sampling_hz` samples a second; without `q` the record is of pressure alone.
    `record` has further keys of the config's `record:` (`start_s`, `duration_s`, `pressure_scale`,
    `delay_s`, ...). `frequency_hz`, `phase_deg` (from q to p, negative where p lags q), `gain`
    (units of p per unit of q) and `flame_slope` (q per p/s) stand in the place of a record.
    An experiment that is not `reliable` weighs less.
    """

    phi: float
    p: Optional[Array] = None
    q: Optional[Array] = None
    sampling_hz: Optional[float] = None
    name: Optional[str] = None
    frequency_hz: Optional[float] = None
    phase_deg: Optional[float] = None
    gain: Optional[float] = None
    flame_slope: Optional[float] = None
    reliable: bool = True
    record: Mapping[str, Any] = dataclasses.field(default_factory=dict)

    def __repr__(self) -> str:
        what = f"{np.size(self.p)} samples" if self.p is not None else "characteristics"
        return f"Experiment({self.name or 'unnamed'}, phi={self.phi!r}, {what})"


def is_signal(value: Any) -> bool:
    """Samples, or several rows of samples, rather than a config or experiments."""
    if isinstance(value, (np.ndarray, pd.Series)):
        return True
    if isinstance(value, (list, tuple)) and value:
        return is_signal(value[0]) or isinstance(value[0], (int, float, np.number))
    return False


def _rows(signal: Any, what: str) -> List[np.ndarray]:
    if isinstance(signal, (list, tuple)) and signal and is_signal(signal[0]):
        return [samples(one, what) for one in signal]
    values = np.asarray(signal)
    if values.ndim == 2:
        return [samples(row, what) for row in values]
    return [samples(values, what)]


def samples(values: Any, what: str) -> np.ndarray:
    """One-dimensional doubles."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        raise ConfigError(f"is of type {array.dtype}, expected real numbers", key=what)
    if array.ndim != 1:
        raise ConfigError(f"has the shape {array.shape}, expected one row of samples", key=what)
    return np.ascontiguousarray(array, dtype=np.float64)


def experiments_of_arrays(
    p: Any, q: Any, sampling_hz: Any, phi: Any, name: Any
) -> List[Experiment]:
    """One experiment for each row of p."""
    all_p = _rows(p, "p")
    count = len(all_p)
    all_q: List[Optional[np.ndarray]] = [None] * count if q is None else list(_rows(q, "q"))
    if sampling_hz is None:
        raise ConfigError("is missing, expected the samples a second of p and q", key="sampling_hz")
    if phi is None:
        raise ConfigError("is missing, expected the operating parameter, one for each row of p",
                          key="phi")
    every_phi = np.atleast_1d(np.asarray(phi, dtype=float)).tolist()
    every_rate = np.broadcast_to(np.asarray(sampling_hz, dtype=float), (count,)).tolist()
    names = [None] * count if name is None else [name] if isinstance(name, str) else list(name)
    for what, got in (("q", len(all_q)), ("phi", len(every_phi)), ("name", len(names))):
        if got != count:
            raise ConfigError(f"{got} of them, expected {count}, as many as rows of p", key=what)
    return [
        Experiment(phi=every_phi[i], p=all_p[i], q=all_q[i], sampling_hz=every_rate[i],
                   name=names[i])
        for i in range(count)
    ]


def as_dict(experiment: Experiment, number: int, parameter: str) -> Dict[str, Any]:
    own: Dict[str, Any] = {"name": experiment.name or f"exp{number}", parameter: experiment.phi}
    for key in ("frequency_hz", "phase_deg", "gain", "flame_slope"):
        value = getattr(experiment, key)
        if value is not None:
            own[key] = value
    if not experiment.reliable:
        own["reliable"] = False
    if experiment.p is not None:
        record: Dict[str, Any] = {"pressure": np.asarray(experiment.p)}
        if experiment.q is not None:
            record["heat_release"] = np.asarray(experiment.q)
        if experiment.sampling_hz is not None:
            record["sampling_hz"] = experiment.sampling_hz
        own["record"] = {**record, **experiment.record}
    elif experiment.record:
        own["record"] = dict(experiment.record)
    return own

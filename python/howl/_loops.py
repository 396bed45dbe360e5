"""Results about the loop: the fit, the family of loops, and what it predicts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple

import pandas as pd

from ._result import Result, figure, frame_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_AXES = {
    "omega_hz": "natural frequency, Hz",
    "xi": "damping ratio",
    "N": "N, (p/q) rad/s",
    "tau_s": "delay, s",
    "loop_gain": "loop gain",
}


class Fit(Result):
    """The loop that fits all experiments together.

    `experiments` has a row for each: `omega_hz`, `xi`, `N` and `M` ((units of p per unit of q)
    rad/s), `tau_s`, `loop_gain`, and what the model misses (`gain_error`, `phase_error_deg`,
    `loop_phase_error_deg`). `parameters` has the value and relative standard deviation of each free
    parameter; `shared` what is common to all.
    """

    main_file = "solution.json"

    @property
    def experiments(self) -> pd.DataFrame:
        return frame_of(self.json["experiments"], "name")

    @property
    def parameters(self) -> pd.DataFrame:
        return frame_of(self.json["parameters"], "name")

    @property
    def shared(self) -> "pd.Series[float]":
        return pd.Series(self.json["shared"], dtype=float)

    @property
    def cost(self) -> float:
        return float(self.json["cost"])

    @property
    def converged(self) -> bool:
        return bool(self.json["converged"])

    @property
    def undetermined(self) -> List[Any]:
        """Directions in parameter space that the data leave free."""
        return list(self.json["identifiability"]["undetermined"])

    def _title(self) -> str:
        return f"Fit of {len(self.json['experiments'])} experiments"

    def _facts(self) -> List[str]:
        ending = "converged" if self.converged else "not converged"
        return [f"cost {self.cost:.5g}; {ending}"]

    def _tables(self) -> List[Tuple[str, pd.DataFrame]]:
        columns = ["phi", "frequency_hz", *_AXES]
        return [("the loop", self.experiments[[c for c in columns if c in self.experiments]])]

    def plot(self) -> "Figure":
        """The loop's parameters over the operating parameter."""
        made, axes = figure(1, len(_AXES), width=3.0)
        table = self.experiments.sort_values("phi")
        for axis, (key, label) in zip(axes[0], _AXES.items()):
            axis.plot(table["phi"], table[key].astype(float), "o-")
            axis.set(xlabel="phi", ylabel=label)
        return made  # type: ignore[no-any-return]


class Family(Result):
    """All loops that the data cannot reject.

    `members` has a row for each member and experiment. `bounds` has for each experiment and
    parameter the interval that no member leaves (`lo`, `hi`: guaranteed) and the one at whose ends
    members were found (`inner_lo`, `inner_hi`). `tradeoff` has the smallest largest xi at each
    spread of omega.
    """

    main_file = "family.json"
    members: pd.DataFrame
    tradeoff: pd.DataFrame

    def _load(self) -> None:
        self.members = self._csv("family.csv")
        self.tradeoff = self._csv("tradeoff.csv")

    @property
    def empty(self) -> bool:
        """No loop passes the test; `empty_because` then names the conditions that exclude each
        other."""
        return not self.answer

    @property
    def empty_because(self) -> List[str]:
        return list(self.json["empty_because"])

    @property
    def test(self) -> Dict[str, Any]:
        return dict(self.json["test"])

    @property
    def bounds(self) -> pd.DataFrame:
        rows = []
        for experiment, parameters in self.json["bounds"].items():
            for parameter, bound in parameters.items():
                inner = bound["inner"] or [None, None]
                rows.append((experiment, parameter, *bound["outer"], *inner, bound["closed"]))
        columns = ["experiment", "parameter", "lo", "hi", "inner_lo", "inner_hi", "closed"]
        return pd.DataFrame(rows, columns=columns).set_index(["experiment", "parameter"])

    @property
    def predictions(self) -> pd.DataFrame:
        """What the members predict, such as the growth rate of the loop at rest in 1/s."""
        rows = []
        for one in self.json.get("predictions", []):
            lo, hi = one["interval"] or (None, None)
            rows.append({**one, "lo": lo, "hi": hi})
        return frame_of(rows)

    def _title(self) -> str:
        return f"Family of {self.json['counts']['members']} members"

    def _facts(self) -> List[str]:
        if not self.empty:
            return []
        return ["empty: " + ", ".join(self.empty_because) + " exclude each other"]

    def _tables(self) -> List[Tuple[str, pd.DataFrame]]:
        if not self.json["bounds"]:
            return []
        table = self.bounds
        text = [f"{lo:.4g} .. {hi:.4g}" for lo, hi in zip(table["lo"], table["hi"])]
        wide = pd.Series(text, index=table.index).unstack()
        wide = wide.reindex(index=list(self.json["bounds"]),
                            columns=list(dict.fromkeys(table.index.get_level_values(1))))
        return [("no member lies outside (guaranteed)", wide)]

    def plot(self) -> "Figure":
        """Each parameter over the operating parameter: members as points, what is guaranteed as
        bars."""
        made, axes = figure(1, len(_AXES), width=3.0)
        bounds = self.bounds
        phi = {one["name"]: one["phi"] for one in self.json["experiments"]}
        for axis, (key, label) in zip(axes[0], _AXES.items()):
            if not self.members.empty:
                values = self.members[key].astype(float)
                axis.plot(self.members["phi"], values, ".", ms=2, alpha=0.3)
            for experiment, value in phi.items():
                if (experiment, key) in bounds.index:
                    bound = bounds.loc[(experiment, key)]
                    axis.plot([value, value], [bound["lo"], bound["hi"]], "k_-", lw=1)
            axis.set(xlabel="phi", ylabel=label)
        return made  # type: ignore[no-any-return]


class Prediction(Result):
    """What the family says of operating points.

    `table` has a row for each point and quantity (`frequency_hz`, `growth_rate_1_s`, `loop_gain`,
    `p_amplitude` or `q_amplitude_relative`, `share_unstable`): the members' median, the interval
    that holds 95 % of them, and at measured points what is guaranteed. `begins` and `ends` say
    where the cycle does. `map` is the stability chart, a row for each point, where one was asked
    for.
    """

    main_file = "prediction.json"
    table: pd.DataFrame
    map: Optional[pd.DataFrame]

    def _load(self) -> None:
        self.table = self._csv("prediction.csv")
        self.map = self._csv("prediction_map.csv") if self.json.get("map") else None

    @property
    def points(self) -> pd.DataFrame:
        """The medians, one row a point and one column a quantity."""
        order = list(dict.fromkeys(self.table["quantity"]))
        return self.table.pivot(index="phi", columns="quantity", values="value")[order]

    @property
    def begins(self) -> "Optional[Dict[str, Any]]":
        return self._cycle("begins")

    @property
    def ends(self) -> "Optional[Dict[str, Any]]":
        return self._cycle("ends")

    def _cycle(self, end: str) -> Optional[Dict[str, Any]]:
        cycle = self.json["cycle"]
        return dict(cycle[end]) if cycle and cycle[end] else None

    def _title(self) -> str:
        return f"Prediction at {len(self.json['points'])} points"

    def _tables(self) -> List[Tuple[str, pd.DataFrame]]:
        return [("95 % of the members (guaranteed_: no member lies outside)", self.table)]

    def plot(self) -> "Figure":
        """Each quantity over the operating parameter, with its interval."""
        own = {name: one for name, one in self.table.groupby("quantity", sort=False)}
        made, axes = figure(1, len(own), width=3.5)
        for axis, (name, one) in zip(axes[0], own.items()):
            axis.plot(one["phi"], one["value"], "o-", ms=3)
            axis.fill_between(one["phi"], one["lo"], one["hi"], alpha=0.25)
            axis.set(xlabel=str(self.json["operating_parameter"]), ylabel=name)
        return made  # type: ignore[no-any-return]

"""The result of a diagnosis, and the findings of a check."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple

import pandas as pd

from ._result import Result, figure, frame_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Diagnosis(Result):
    """Where, why and by how much the model falls short of the rig.

    `verdict` is "effect", "none" or "unknown", `effect` what is named, joined by "+", `probability`
    that of each candidate and of "none" and "unknown". `budget` has a row for each item that was
    added to the loop, `estimates` their parameters, `where` the places, `gap` how far predictions
    fall short before and after. Of a search for one cause `candidates` has a row for each effect
    that was tried, and `estimates` their parameters.
    """

    main_file = "diagnosis.json"

    @property
    def verdict(self) -> str:
        return str(self.json["verdict"]["kind"])

    @property
    def effect(self) -> Optional[str]:
        effect = self.json["verdict"]["effect"]
        return None if effect is None else str(effect)

    @property
    def indistinguishable(self) -> List[str]:
        """Effects that the data cannot tell from the one that is named."""
        return list(self.json["verdict"]["indistinguishable"])

    @property
    def probability(self) -> "pd.Series[float]":
        return pd.Series(self.json["verdict"]["probability"], dtype=float)

    @property
    def where(self) -> pd.DataFrame:
        rows = []
        for one in self.json["where"]:
            lo, hi = one["band_hz"]
            rows.append({"block": one["block"], "lo_hz": lo, "hi_hz": hi,
                         "experiments": ", ".join(one["experiments"]), "share": one["share"]})
        return pd.DataFrame(rows, columns=["block", "lo_hz", "hi_hz", "experiments", "share"])

    @property
    def gap(self) -> Dict[str, Any]:
        return dict(self.json["gap"])

    @property
    def candidates(self) -> pd.DataFrame:
        table = frame_of(self.json["candidates"], "effect")
        if not table.empty:
            table.insert(0, "probability", self.probability.reindex(table.index))
        return table

    @property
    def estimates(self) -> pd.DataFrame:
        key = "item" if self.json.get("budget") else "effect"
        found = self.json.get("budget") or self.json["candidates"]
        rows = [
            {"effect": one[key], "parameter": name, **value}
            for one in found for name, value in one["parameters"].items()
        ]
        columns = ["effect", "parameter", "value", "lo", "hi", "unit"]
        return pd.DataFrame(rows, columns=columns).set_index(["effect", "parameter"])

    @property
    def budget(self) -> pd.DataFrame:
        """What each item takes off the gap, in their order; empty of a search for one cause."""
        return frame_of(self.json.get("budget", []), "item")

    @property
    def advice(self) -> str:
        """What to measure next."""
        return str(self.json.get("advice") or "")

    def _title(self) -> str:
        return f"Diagnosis: {self.effect or self.verdict}"

    def _facts(self) -> List[str]:
        gap = self.gap
        facts = [f"gap, held out: {gap['before']:.3f} before, {gap['after']:.3f} after; "
                 f"floor {gap['floor']:.3f}"]
        if self.advice:
            facts.append("next: " + self.advice)
        return facts

    def _tables(self) -> List[Tuple[str, pd.DataFrame]]:
        tables = []
        if not self.where.empty:
            tables.append(("where", self.where))
        if not self.candidates.empty:
            columns = [c for c in ("probability", "log_likelihood_gain", "gap_after", "shrinkage")
                       if c in self.candidates]
            tables.append(("candidates", self.candidates[columns].head(5)))
        return tables

    def plot(self) -> "Figure":
        """The gap that each candidate leaves, beside the gap before and the floor."""
        made, axes = figure(1, 1, width=6.0, height=4.5)
        axis = axes[0, 0]
        table = self.candidates.head(10).iloc[::-1]
        axis.barh(table.index, table["gap_after"].astype(float))
        axis.axvline(self.gap["before"], color="k", label="before")
        axis.axvline(self.gap["floor"], color="k", ls=":", label="floor")
        axis.set_xlabel("gap on operating points left out")
        axis.legend()
        return made  # type: ignore[no-any-return]


class Check(Result):
    """All that is wrong with a config and its records, and what they allow."""

    main_file = "check.json"

    @property
    def ok(self) -> bool:
        return not self.json["errors"]

    @property
    def errors(self) -> pd.DataFrame:
        return pd.DataFrame(self.json["errors"], columns=["file", "line", "key", "text"])

    @property
    def warnings(self) -> List[str]:
        return [str(one.get("text", one)) for one in self.json["warnings"]]

    @property
    def possible(self) -> "pd.Series[bool]":
        """Whether each command can do anything with it."""
        commands = self.json["commands"]
        return pd.Series({name: bool(commands[name]["possible"]) for name in commands}, dtype=bool)

    def _tables(self) -> List[Tuple[str, pd.DataFrame]]:
        return [("errors", self.errors)] if not self.ok else []

"""The results of a campaign over many rigs."""

from __future__ import annotations

import os
from pathlib import Path
from typing import List, Tuple, Union

import pandas as pd

from ._errors import ConfigError
from ._result import Result


class Campaign(Result):
    """`rigs` has a row for each rig, `points` a row for each quantity of each of its experiments,
    with the family's bounds."""

    main_file = "campaign.json"
    rigs: pd.DataFrame
    points: pd.DataFrame

    def _load(self) -> None:
        self.rigs = self._csv("campaign.csv").set_index("rig")
        self.points = self._csv("campaign_points.csv")

    def to_parquet(self, folder: Union[str, "os.PathLike[str]"]) -> List[Path]:
        """Writes campaign.parquet and campaign_points.parquet; needs pyarrow."""
        target = Path(folder)
        target.mkdir(parents=True, exist_ok=True)
        written = [target / "campaign.parquet", target / "campaign_points.parquet"]
        try:
            self.rigs.to_parquet(written[0])
            self.points.to_parquet(written[1])
        except ImportError as error:
            raise ConfigError("needs the package pyarrow, expected it installed",
                              key="to_parquet") from error
        return written

    def _tables(self) -> List[Tuple[str, pd.DataFrame]]:
        return [("rigs", self.rigs), ("quantities", self.points)]

    def _facts(self) -> List[str]:
        return [f"{self.json['run']} of {self.json['rigs']} rigs, {self.json['failed']} with an error"]

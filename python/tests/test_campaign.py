"""A campaign from Python: the tables that the program wrote."""

import pandas as pd
import pytest

import howl

RIG = """experiments:
  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}
  - {name: exp2, phi: 0.60, frequency_hz: 214, phase_deg: -10, gain: 11}
"""


@pytest.fixture()
def campaign(tmp_path):
    (tmp_path / "rig.yaml").write_text(RIG)
    path = tmp_path / "all.yaml"
    path.write_text("commands: [fit]\nconfig: rig.yaml\ngrid: {model.modes: [1, 2]}\n")
    return path


def test_rows_are_those_of_the_fits(campaign, tmp_path):
    found = howl.campaign(campaign, out=tmp_path / "out")
    assert list(found.rigs.index) == ["rig-1", "rig-2"]
    alone = howl.fit(tmp_path / "rig.yaml", config=None)
    assert found.rigs.loc["rig-1", "fit_cost"] == alone.json["cost"]
    points = found.points.set_index(["rig", "experiment", "quantity"])
    assert points.loc[("rig-1", "exp2", "tau_s"), "value"] == alone.json["experiments"][1]["tau_s"]
    assert "2 of 2 rigs" in repr(found)


def test_parquet_has_the_same_numbers(campaign, tmp_path):
    pytest.importorskip("pyarrow")
    found = howl.campaign(campaign, out=tmp_path / "out")
    rigs, points = found.to_parquet(tmp_path / "tables")
    pd.testing.assert_frame_equal(pd.read_parquet(rigs), found.rigs)
    pd.testing.assert_frame_equal(pd.read_parquet(points), found.points)


def test_a_mistake_is_a_config_error(tmp_path):
    path = tmp_path / "all.yaml"
    path.write_text("configs: [none.yaml]\n")
    with pytest.raises(howl.ConfigError, match="there is no file"):
        howl.campaign(path, out=tmp_path / "out")

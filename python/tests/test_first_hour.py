"""From files to a report: seven commands, and the lines of docs/python.md, have the same bits."""

import json
import re

import pytest
from conftest import CONFIGS, PROJECT, run_howl, same_cells

import howl

# A diagnosis by three of the catalogue's effects is quick.
WITHOUT = ["flame_lowpass", "p_sensor_resonance", "mode_detuning", "delay_dispersion",
           "delay_varies_with_phi", "amplitude_dependent_delay", "nonlinear_damping",
           "parametric_noise", "slow_drift", "intermittency", "p_clipping", "q_clipping",
           "quantisation", "mains_hum", "crosstalk_p_to_q", "second_delay_path", "external_tone"]


@pytest.fixture(scope="module")
def commands(tmp_path_factory):
    """The folder of the seven commands' results."""
    folder = tmp_path_factory.mktemp("seven")
    config, out = folder / "rig.yaml", folder / "out"
    records = [CONFIGS / "first_rig" / f"exp{k}.csv.gz" for k in (1, 2, 3)]
    run_howl("init", *records, "--values", "0.56,0.53,0.51", "--sampling-hz", "5000", "--out", config)
    run_howl("check", config, "--out", out)
    run_howl("fit", config, "--out", out)
    run_howl("family", config, "--out", out)
    run_howl("predict", config, "--map", "phi:tau_s", "--out", out)
    run_howl("diagnose", config, "--without", ",".join(WITHOUT), "--out", out)
    run_howl("report", out)
    return out


@pytest.fixture(scope="module")
def lines(commands):
    """What the page's lines leave behind."""
    page = (PROJECT / "docs" / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    assert len(blocks) == 1
    code = [line for line in blocks[0].splitlines() if line]
    assert len(code) < 15
    whole, found = howl.diagnose, {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(PROJECT)
        patch.setattr(howl, "diagnose", lambda problem: whole(problem, without=WITHOUT))
        exec(blocks[0], found)  # noqa: S102: the page's own lines
    return found


def loaded(path):
    return json.loads(path.read_text(encoding="utf-8"))


def test_the_fit(commands, lines):
    assert lines["checked"].errors.empty
    assert lines["fit"].json == loaded(commands / "solution.json")


def test_the_family(commands, lines):
    assert same_cells(lines["family"].members, commands / "family.csv")
    assert same_cells(lines["family"].tradeoff, commands / "tradeoff.csv")
    assert lines["family"].json == loaded(commands / "family.json")


def test_the_prediction_and_its_map(commands, lines):
    prediction = lines["prediction"]
    assert prediction.json == loaded(commands / "prediction.json")
    assert same_cells(prediction.table, commands / "prediction.csv")
    assert same_cells(prediction.map, commands / "prediction_map.csv")
    assert list(prediction.map.columns[:2]) == ["phi", "tau_s"] and len(prediction.map) == 41 * 41


def test_the_diagnosis(commands, lines):
    assert lines["diagnosis"].json == loaded(commands / "diagnosis.json")


def test_the_report(commands, lines):
    """Figures' data are the same; the page is whole."""
    assert lines["page"].read_text(encoding="utf-8").rstrip().endswith("</html>")
    names = sorted(path.name for path in (commands / "figures").glob("*.csv"))
    own = lines["page"].parent / "figures"
    assert names == sorted(path.name for path in own.glob("*.csv"))
    assert "stability_map.csv" in names
    for name in names:
        assert (own / name).read_bytes() == (commands / "figures" / name).read_bytes(), name


def test_what_an_option_asks_for_reaches_the_program(lines, commands, tmp_path):
    config = commands.parent / "rig.yaml"
    at = {"map": "xi:tau_s", "at": 0.53, "map_x": [0.05, 0.1], "map_y": (0.003, 0.0035, 0.004)}
    found = howl.predict(lines["family"], without=["transfer_distance_max"], **at)
    run_howl("predict", config, "--map", "xi:tau_s", "--at", "0.53", "--map-x", "0.05,0.1", "--map-y",
             "0.003:0.004:0.0005", "--without", "transfer_distance_max", "--out", tmp_path)
    assert same_cells(found.map, tmp_path / "prediction_map.csv")
    assert howl.predict(lines["family"], at=0.53).map is None
    with pytest.raises(howl.ConfigError, match="without"):
        howl.family(lines["fit"], without=["gain"])

"""Arrays, dicts, tables and paths give the figures of the command line, to the bit."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from conftest import CONFIGS, run_howl, same_cells

import howl


@pytest.fixture(scope="module")
def command_line(tmp_path_factory):
    out = tmp_path_factory.mktemp("command_line")
    run_howl("analyse", CONFIGS / "first_rig.yaml", "--out", out)
    return out


def test_arrays_are_analysed_as_the_files_they_come_from(analysis, command_line):
    assert same_cells(analysis.characteristics, command_line / "characteristics.csv")
    assert same_cells(analysis.transfer, command_line / "transfer.csv")
    assert same_cells(analysis.flame_curve, command_line / "flame_curve.csv")
    assert analysis.json == json.loads((command_line / "analysis.json").read_text())


def test_a_path_is_analysed_as_by_the_command_line(command_line):
    found = howl.analyse(CONFIGS / "first_rig.yaml", threads=1)
    assert same_cells(found.lines, command_line / "lines.csv")
    assert same_cells(found.oscillations, command_line / "oscillations.csv")


def test_a_matrix_experiments_and_a_dict_are_the_same_problem(first_rig, analysis):
    length = min(map(len, first_rig["p"]))
    assert all(len(p) == length for p in first_rig["p"])
    rates = dict(sampling_hz=5000, phi=first_rig["phi"], name=first_rig["name"])
    by_matrix = howl.analyse(np.array(first_rig["p"]), np.array(first_rig["q"]), **rates)
    rows = list(zip(first_rig["name"], first_rig["phi"], first_rig["p"], first_rig["q"]))
    by_experiments = howl.analyse(
        [howl.Experiment(phi=phi, p=p, q=list(q), sampling_hz=5000.0, name=name)
         for name, phi, p, q in rows])
    by_dict = howl.analyse({"experiments": [
        {"name": name, "phi": np.float64(phi),
         "record": {"pressure": p, "heat_release": q, "sampling_hz": np.int64(5000)}}
        for name, phi, p, q in rows]})
    assert by_matrix.json == by_experiments.json == by_dict.json == analysis.json


def test_signals_that_are_not_contiguous_or_not_native(first_rig, analysis):
    both = np.stack([first_rig["p"][0], first_rig["q"][0]], axis=1)  # every other double is p
    one = howl.analyse(both[:, 0], both[:, 1].astype(">f8"), sampling_hz=5000, phi=0.51,
                       name="lean")
    assert one.characteristics.loc["lean"].equals(analysis.characteristics.loc["lean"])


def test_measured_records_read_here_and_there(tmp_path):
    if "HOWL_DATA" not in os.environ:
        pytest.skip("HOWL_DATA names no folder of measured records")
    folder = Path(os.environ["HOWL_DATA"]) / "turbulent_combustor"
    if not folder.is_dir():
        pytest.skip(f"{folder} is not there")
    names, flows = ["p12", "p17"], [552, 620]
    tables = [howl.read(folder / f"{name}.txt.gz") for name in names]
    found = howl.analyse([t["3"] for t in tables], [t["2"] for t in tables], sampling_hz=10000,
                         phi=flows, name=names, config={"operating_parameter": "air_slpm"})
    lines = [f"  - {{name: {name}, air_slpm: {flow}, record: {{file: {folder / name}.txt.gz, "
             "heat_release: 2, pressure: 3, sampling_hz: 10000}}" for name, flow in
             zip(names, flows)]
    config = "operating_parameter: air_slpm\nexperiments:\n" + "\n".join(lines) + "\n"
    (tmp_path / "rig.yaml").write_text(config)
    run_howl("analyse", tmp_path / "rig.yaml", "--out", tmp_path / "out")
    assert same_cells(found.characteristics, tmp_path / "out" / "characteristics.csv")
    assert same_cells(found.lines, tmp_path / "out" / "lines.csv")


def test_the_fit_of_a_table_is_the_command_lines(paper, fitted, tmp_path):
    lines = [f"  - {{name: {r.name_}, phi: {r.phi!r}, frequency_hz: {r.frequency_hz!r}, "
             f"phase_deg: {r.phase_deg!r}, gain: {r.gain!r}, flame_slope: {r.flame_slope!r}}}"
             for r in paper.rename(columns={"name": "name_"}).itertuples()]
    (tmp_path / "paper.yaml").write_text("experiments:\n" + "\n".join(lines) + "\n")
    run_howl("fit", tmp_path / "paper.yaml", "--out", tmp_path / "out")
    assert fitted.json == json.loads((tmp_path / "out" / "solution.json").read_text())
    assert fitted.converged and fitted.experiments.loc["exp1", "frequency_hz"] == 219.9


def test_family_and_prediction_are_the_command_lines(listed, paper, tmp_path):
    config = howl.save(paper, tmp_path / "problem", config={"family": {"members": 40}})
    run_howl("family", config, "--out", tmp_path / "out")
    assert same_cells(listed.members, tmp_path / "out" / "family.csv")
    assert same_cells(listed.tradeoff, tmp_path / "out" / "tradeoff.csv")
    predicted = howl.predict(listed, at=[0.52, 0.58])
    run_howl("predict", config, "--at", "0.52,0.58", "--out", tmp_path / "out")
    assert same_cells(predicted.table, tmp_path / "out" / "prediction.csv")


def test_simulated_records_are_the_command_lines(slow_sensor, tmp_path):
    slow_sensor.save(tmp_path)
    run_howl("simulate", tmp_path / "config.yaml", "--out", tmp_path / "again")
    for name, record in slow_sensor.records.items():
        assert same_cells(record.reset_index(drop=True), tmp_path / "again" / f"{name}.csv")


def test_simulated_records_and_their_arrays_are_one_problem(slow_sensor):
    by_files = howl.analyse(slow_sensor)
    by_arrays = howl.analyse(slow_sensor.experiments, config={
        "model": {"modes": 1}, "parameters": {"tau_s": {"scope": "shared"}}})
    assert by_files.characteristics.equals(by_arrays.characteristics)


def test_the_seed_reaches_the_program(paper):
    short = {"simulate": {"duration_s": 0.2}}
    first, again, other = (howl.simulate(paper[:1], config=short, seed=seed) for seed in (1, 1, 2))
    assert first.records["exp1"].equals(again.records["exp1"])
    assert not first.records["exp1"].equals(other.records["exp1"])


def test_the_operating_parameter_keeps_its_name(paper):
    table = paper.rename(columns={"phi": "air_slpm"})
    found = howl.fit(table, config={"operating_parameter": "air_slpm"})
    assert list(found.experiments["phi"]) == [0.56, 0.53, 0.51]


def test_matlab_files_hold_the_same_doubles(tmp_path):
    loadmat = pytest.importorskip("scipy.io").loadmat
    from howl._mat5 import write_mat5

    values = np.array([0.1, -np.pi, 5e-324, 1.7976931348623157e308, -0.0, np.nan])
    write_mat5(tmp_path / "a.mat", {"p": values, "longer_name": values[::-1]})
    read = loadmat(tmp_path / "a.mat")
    assert read["p"].ravel().tobytes() == values.tobytes()
    assert read["longer_name"].ravel().tobytes() == values[::-1].tobytes()

"""What all tests of the package use: the program, problems, and results that several look at."""

import csv
import subprocess
import tempfile
from pathlib import Path

import pytest

pytest.importorskip("numpy")
pytest.importorskip("pandas")
pytest.importorskip("yaml")

import numpy as np
import pandas as pd
import yaml

import howl

PROJECT = Path(__file__).resolve().parents[2]
CONFIGS = PROJECT / "configs"

# Six experiments with two modes, bounded ten times as closely as usual: the search takes seconds on any
# machine, and the first progress is shown after two.
FOLDER = tempfile.TemporaryDirectory()
LONG = Path(FOLDER.name) / "long.yaml"
problem = yaml.safe_load((CONFIGS / "r228_two_modes.yaml").read_text())
problem.setdefault("family", {})["width"] = 0.001
LONG.write_text(yaml.safe_dump(problem))


def pytest_collection_modifyitems(items):
    try:
        howl.find_program()
    except howl.ProgramError as error:
        for item in items:
            item.add_marker(pytest.mark.skip(reason=str(error)))


def run_howl(*words):
    """The program itself, by another way than the package's."""
    done = subprocess.run([str(howl.find_program()), *map(str, words)], capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def cells(path):
    """A CSV file by Python's own reader: a list of dicts of texts."""
    with open(path, newline="") as stream:
        return list(csv.DictReader(stream))


def same_cells(table, path):
    """True where the frame has the file's cells, each number the same double."""
    rows = cells(path)
    flat = table.reset_index() if table.index.name else table
    assert list(rows[0]) == [c for c in flat.columns] and len(rows) == len(flat)
    for row, (_, own) in zip(rows, flat.iterrows()):
        for key, text in row.items():
            value = own[key]
            if text == "":
                assert pd.isna(value)
            elif isinstance(value, (bool, np.bool_)):
                assert text == str(bool(value)).lower()
            elif isinstance(value, str):
                assert text == value
            else:
                assert float(text) == float(value), key
    return True


@pytest.fixture(scope="session")
def first_rig():
    """The records of configs/first_rig.yaml as arrays, read by NumPy's own reader of text."""
    names, phi, p, q = ["lean", "middle", "rich"], [0.51, 0.53, 0.56], [], []
    for number in (3, 2, 1):
        table = np.loadtxt(CONFIGS / "first_rig" / f"exp{number}.csv.gz", delimiter=",", skiprows=1)
        p.append(table[:, 0])
        q.append(table[:, 1])
    return {"p": p, "q": q, "phi": phi, "name": names, "sampling_hz": 5000}


# Tables 1 and 2 of the paper, experiments 1 to 3: phi, frequency, phase, gain, flame slope.
PAPER = pd.DataFrame(
    [("exp1", 0.56, 219.9, -5.74, 12.14, -0.703e-4), ("exp2", 0.53, 209.1, -9.44, 13.15, -0.707e-4),
     ("exp3", 0.51, 205.7, -14.35, 14.79, -0.670e-4)],
    columns=["name", "phi", "frequency_hz", "phase_deg", "gain", "flame_slope"])


@pytest.fixture()
def paper():
    return PAPER.copy()


@pytest.fixture(scope="session")
def analysis(first_rig):
    own = dict(first_rig)
    return howl.analyse(own.pop("p"), own.pop("q"), **own)


@pytest.fixture(scope="session")
def fitted():
    return howl.fit(PAPER)


@pytest.fixture(scope="session")
def listed():
    return howl.family(PAPER, config={"family": {"members": 40}})


@pytest.fixture(scope="session")
def slow_sensor():
    """Two simulated operating points whose q passed a low-pass at 245 Hz, 1 s each."""
    return howl.simulate(PAPER[:2], config={
        "model": {"modes": 1}, "parameters": {"tau_s": {"scope": "shared"}},
        "simulate": {"duration_s": 1.0, "sampling_hz": 5000,
                     "effects": [{"effect": "q_sensor_lowpass", "cutoff_hz": 245}]}})


@pytest.fixture(scope="session")
def diagnosis(slow_sensor):
    """By three of the catalogue's effects, which is quick."""
    others = ["flame_lowpass", "p_sensor_resonance", "mode_detuning", "delay_dispersion",
              "delay_varies_with_phi", "amplitude_dependent_delay", "nonlinear_damping",
              "parametric_noise", "slow_drift", "intermittency", "p_clipping", "q_clipping",
              "quantisation", "mains_hum", "crosstalk_p_to_q", "second_delay_path",
              "external_tone"]
    return howl.diagnose(slow_sensor, without=others)

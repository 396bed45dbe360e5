"""Where the program is found, and the package's own command line."""

import gzip
import os
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from conftest import CONFIGS

import howl


def python_m_howl(*words):
    return subprocess.run([sys.executable, "-m", "howl", *map(str, words)], capture_output=True,
                          text=True)


def test_howl_program_comes_before_path(tmp_path, monkeypatch):
    other = tmp_path / "howl"
    other.write_text("#!/bin/sh\n")
    other.chmod(0o755)
    own = howl.find_program()
    monkeypatch.setenv("HOWL_PROGRAM", str(other))
    assert howl.find_program() == other
    monkeypatch.delenv("HOWL_PROGRAM")
    monkeypatch.setenv("PATH", str(tmp_path))
    if own.parent.name != "bin" or own.parent.parent.name != "howl":  # none inside the package
        assert howl.find_program() == other
    monkeypatch.setenv("PATH", "")
    monkeypatch.setenv("HOWL_PROGRAM", str(tmp_path / "none"))
    with pytest.raises(howl.ProgramError, match="HOWL_PROGRAM"):
        howl.find_program()


def test_the_version_is_the_programs():
    assert howl.version().count(".") == 2


def test_other_commands_are_the_programs():
    assert "2 bad input" in python_m_howl("--help").stdout
    failed = python_m_howl("fit", "none.yaml")
    assert failed.returncode == 2 and failed.stderr.startswith("none.yaml: there is no such file")


@pytest.mark.parametrize("ending", [".csv", ".csv.gz"])
def test_convert_writes_csv_that_howl_reads_to_the_bit(ending, tmp_path, first_rig, analysis):
    p, q = first_rig["p"][0], first_rig["q"][0]
    np.savez(tmp_path / "in.npz", p=p, q=q, sampling_hz=5000)
    done = python_m_howl("convert", tmp_path / "in.npz", tmp_path / f"out{ending}")
    assert done.returncode == 0 and "10000 samples each; sampling_hz: 5000" in done.stdout
    found = howl.analyse({"experiments": [{"name": "lean", "phi": 0.51, "record": {
        "file": tmp_path / f"out{ending}", "heat_release": "q", "sampling_hz": 5000}}]})
    assert found.characteristics.loc["lean"].equals(analysis.characteristics.loc["lean"])


def test_convert_keeps_single_precision_values_as_doubles(tmp_path):
    values = np.array([0.1, 1 / 3, 1e-8, 2.5], dtype=np.float32)
    np.savez(tmp_path / "in.npz", p=values)
    howl.readers.convert(tmp_path / "in.npz", tmp_path / "out.csv.gz")
    with gzip.open(tmp_path / "out.csv.gz", "rt") as stream:
        texts = stream.read().split()[1:]
    assert [float(text) for text in texts] == [float(value) for value in values]


def test_convert_fails_in_one_line_and_leaves_nothing(tmp_path):
    (tmp_path / "a.npz").write_bytes(b"")
    for words in (("none.npz", tmp_path / "out.csv"), (tmp_path / "x.xyz", tmp_path / "out.csv")):
        done = python_m_howl("convert", *words)
        assert done.returncode == 2 and len(done.stderr.splitlines()) == 1, done.stderr
    assert python_m_howl("convert", tmp_path / "a.npz", tmp_path / "out.xlsx").returncode == 2
    assert sorted(os.listdir(tmp_path)) == ["a.npz"]


def test_a_missing_package_is_named(tmp_path, monkeypatch):
    pd.DataFrame({"p": [1.0, 2.0]}).to_csv(tmp_path / "a.parquet")
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    with pytest.raises(ImportError, match="pip install pyarrow"):
        howl.read(tmp_path / "a.parquet")


def test_the_package_is_typed():
    assert (CONFIGS.parent / "python" / "howl" / "py.typed").exists()

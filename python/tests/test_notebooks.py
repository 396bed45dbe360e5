"""The notebooks run from top to bottom, each within a minute on an idle machine."""

import os
from pathlib import Path

import pytest

NOTEBOOKS = Path(__file__).resolve().parents[1] / "notebooks"

pytestmark = pytest.mark.long


def run(name, folder):
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    pytest.importorskip("matplotlib")
    notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
    nbformat.validate(notebook)
    environment = {**os.environ, "PYTHONPATH": str(NOTEBOOKS.parent)}
    client = nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3",
                                     resources={"metadata": {"path": str(folder)}})
    client.execute(env=environment)
    outputs = [one for cell in notebook.cells for one in cell.get("outputs", [])]
    shown = [one["data"] for one in outputs if "data" in one]
    assert not [one for one in outputs if one["output_type"] == "error"]
    return shown


def test_the_paper_from_table_to_family(tmp_path):
    shown = run("paper", tmp_path)
    assert sum("image/png" in data for data in shown) == 3
    pages = "".join("".join(data.get("text/html", "")) for data in shown)
    assert "howl.Fit of 6 experiments" in pages and "no member lies outside" in pages
    assert "share_crossing" in shown[-1]["text/plain"]


def test_a_record_from_file_to_diagnosis(tmp_path):
    shown = run("record", tmp_path)
    assert sum("image/png" in data for data in shown) == 3
    pages = "".join("".join(data.get("text/html", "")) for data in shown)
    assert "howl.Diagnosis: q_sensor_lowpass" in pages

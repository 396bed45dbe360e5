"""What results look like: frames, text, HTML, figures, files."""

import json

import numpy as np
import pandas as pd
import pytest
from conftest import CONFIGS, run_howl

import howl


@pytest.fixture(params=["analysis", "fitted", "listed", "slow_sensor", "diagnosis"])
def result(request):
    return request.getfixturevalue(request.param)


def test_a_result_prints_its_summary_without_passing_paths(result):
    text = repr(result)
    assert text.startswith("howl." + type(result).__name__)
    assert len(text.splitlines()) > 3
    assert "written:" not in text and str(result.folder) not in text


def test_a_result_is_html_in_a_notebook(result):
    page = result._repr_html_()
    assert "<table" in page and "<details>" in page
    assert page.count("<div>") == page.count("</div>")
    assert str(result.folder) not in page


def test_html_escapes_what_a_user_wrote(paper):
    paper.loc[0, "name"] = "<b>"
    assert "<b>" not in howl.fit(paper)._repr_html_().replace("<b>howl.", "")


def test_a_result_draws_itself(result, tmp_path):
    pytest.importorskip("matplotlib")
    figure = result.plot()
    assert figure.axes and any(axis.has_data() for axis in figure.axes)
    figure.savefig(tmp_path / "figure.png")
    assert (tmp_path / "figure.png").read_bytes().startswith(b"\x89PNG")


def test_a_prediction_draws_itself_and_says_where_the_cycle_begins(listed):
    predicted = howl.predict(listed, at=[0.51, 0.53, 0.55, 0.57])
    assert list(predicted.points.index) == [0.51, 0.53, 0.55, 0.57]
    assert predicted.points.loc[0.53, "frequency_hz"] == pytest.approx(209.1, abs=1.0)
    assert set(predicted.json["cycle"]) >= {"begins", "ends"}
    assert predicted.begins is not None and predicted.ends is not None
    pytest.importorskip("matplotlib")
    assert len(predicted.plot().axes) == predicted.table["quantity"].nunique()


def test_members_lie_within_what_is_guaranteed(listed):
    bounds = listed.bounds
    assert not listed.empty and listed.members["member"].nunique() == 40
    for (experiment, parameter), bound in bounds.iterrows():
        own = listed.members.loc[listed.members["experiment"] == experiment, parameter]
        assert bound["lo"] <= own.min() and own.max() <= bound["hi"]
        assert bound["lo"] <= bound["inner_lo"] <= bound["inner_hi"] <= bound["hi"]
    assert {"growth_rate"} <= set(listed.predictions["name"])


def test_a_simulation_has_frames_over_time(slow_sensor):
    record = slow_sensor.records["exp1"]
    assert list(record.columns) == ["p", "q"] and len(record) == 5000
    assert record.index[1] == pytest.approx(1 / 5000) and record.attrs["sampling_hz"] == 5000
    spectrum = np.abs(np.fft.rfft(record["p"]))
    assert np.argmax(spectrum) == pytest.approx(219.9, abs=2)  # 1 s: a bin is 1 Hz


def test_a_member_of_a_family_is_simulated(listed):
    simulated = howl.simulate(listed, member=3)
    assert simulated.json["member"] == 3
    assert list(simulated.records) == ["exp1", "exp2", "exp3"]
    assert listed.members is not None and (listed.folder / "family.csv").exists()


def test_a_slow_sensor_is_found(diagnosis):
    assert (diagnosis.verdict, diagnosis.effect) == ("effect", "q_sensor_lowpass")
    assert diagnosis.probability.idxmax() == "q_sensor_lowpass"
    cutoff = diagnosis.estimates.loc[("q_sensor_lowpass", "cutoff_hz")]
    assert cutoff["lo"] - 5 < 245 < cutoff["hi"] + 5 and cutoff["unit"] == "Hz"
    assert diagnosis.where.loc[0, "block"] == "q_instrument"
    assert diagnosis.gap["after"] < 0.2 * diagnosis.gap["before"]
    assert diagnosis.candidates["probability"].iloc[0] > 0.5
    assert list(diagnosis.budget.index) == ["q_sensor_lowpass"]


def test_what_is_saved_is_a_problem_of_the_program(fitted, tmp_path):
    fitted.save(tmp_path)
    run_howl("fit", tmp_path / "config.yaml", "--out", tmp_path / "again")
    assert json.loads((tmp_path / "again" / "solution.json").read_text()) == fitted.json


def test_files_go_where_they_are_asked_for_and_else_vanish(paper, tmp_path):
    kept = howl.fit(paper, out=tmp_path / "kept")
    assert kept.folder == tmp_path / "kept" and (tmp_path / "kept" / "solution.json").exists()
    folder = howl.fit(paper).folder
    assert not folder.exists()


def test_members_are_tested_on_another_problems_experiments(listed, fitted):
    tested = howl.family(listed, falsify=fitted)
    assert tested.json["falsified"]["survive"] >= 40
    assert tested.json["falsified"]["rejected"] == 0  # the same experiments reject none


def test_a_report_is_a_page(fitted):
    page = fitted.report()
    assert "<html" in page.read_text(encoding="utf-8")[:500].lower()


def test_tables_of_a_fit(fitted):
    assert list(fitted.experiments.index) == ["exp1", "exp2", "exp3"]
    assert fitted.parameters.loc["exp1.xi", "std_relative"] > 0
    assert fitted.cost >= 0 and isinstance(fitted.shared, pd.Series)
    # The closed form (1a): the loop's phase is 180 degrees at the limit cycle's frequency.
    row = fitted.experiments.loc["exp1"]
    s, w = 2j * np.pi * row["frequency_hz"], 2 * np.pi * row["omega_hz"]
    loop = row["N"] * s**2 / (s**2 + 2 * w * row["xi"] * s + w**2) * np.exp(-row["tau_s"] * s)
    assert np.degrees(np.angle(-loop)) == pytest.approx(row["loop_phase_error_deg"], abs=0.1)


def test_a_check_says_what_is_possible(paper, first_rig):
    found = howl.check(paper)
    assert found.ok and found.possible["fit"] and not found.possible["analyse"]
    own = dict(first_rig, p=[np.clip(p, -100, 100) for p in first_rig["p"]])
    clipped = howl.check(own.pop("p"), own.pop("q"), **own)
    assert clipped.ok and any("clip" in text for text in clipped.warnings)


def test_a_table_without_record_has_no_analysis(paper):
    with pytest.raises(howl.ConfigError, match="record"):
        howl.analyse(paper)


def test_the_shipped_config_by_path_needs_no_temporary_config(paper):
    fitted = howl.fit(CONFIGS / "r228.yaml")
    assert fitted.config == CONFIGS / "r228.yaml" and len(fitted.experiments) == 6

"""A mistake is an exception that says where it is."""

import pickle

import numpy as np
import pandas as pd
import pytest

import howl
from howl._errors import parse_error


def test_a_configs_mistake_has_its_file_line_and_key(tmp_path):
    path = tmp_path / "a: b.yaml"  # a name that looks like the end of one
    path.write_text("experiments:\n  - {name: a, phi: 0.5,\n     frequency_khz: 3}\n")
    with pytest.raises(howl.ConfigError) as caught:
        howl.fit(path)
    error = caught.value
    assert (error.file, error.line, error.key) == (str(path), 3, "experiments[0].frequency_khz")
    assert "frequency_hz" in error.message and str(error).startswith(f"{path}:3: experiments[0]")


def test_a_dicts_mistake_has_its_key_and_no_file():
    with pytest.raises(howl.ConfigError) as caught:
        howl.fit({"experiments": [{"name": "a", "phi": 0.5, "frequency_khz": 3}]})
    error = caught.value
    assert (error.file, error.line, error.key) == (None, None, "experiments[0].frequency_khz")


def test_a_data_files_mistake_has_its_line_and_column(tmp_path):
    rows = [f"{k},{k % 7}" for k in range(100)]
    rows[41] = "41,nan"
    (tmp_path / "data.csv").write_text("p,q\n" + "\n".join(rows) + "\n")
    with pytest.raises(howl.ConfigError) as caught:
        howl.analyse({"experiments": [{"name": "a", "phi": 0.5, "record": {
            "file": tmp_path / "data.csv", "pressure": "p", "heat_release": "q",
            "sampling_hz": 5000}}]})
    assert (caught.value.file, caught.value.line, caught.value.key) == (
        str(tmp_path / "data.csv"), 43, "q")


def test_nan_in_an_array_is_named(first_rig):
    q = [values.copy() for values in first_rig["q"]]
    q[1][76] = np.nan
    with pytest.raises(howl.ConfigError) as caught:
        howl.analyse(first_rig["p"], q, sampling_hz=5000, phi=first_rig["phi"])
    assert caught.value.key == "experiments[1].record.q" and caught.value.file is None
    assert "sample 77" in caught.value.message and "nan" in caught.value.message


@pytest.mark.parametrize("arguments, key", [
    (dict(sampling_hz=5000), "phi"),
    (dict(phi=0.5), "sampling_hz"),
    (dict(phi=[0.5, 0.6], sampling_hz=5000), "phi"),
])
def test_what_is_missing_beside_an_array_is_named(arguments, key):
    with pytest.raises(howl.ConfigError) as caught:
        howl.analyse(np.zeros(100), np.zeros(100), **arguments)
    assert caught.value.key == key


def test_signals_of_different_length_or_kind_are_refused():
    with pytest.raises(howl.ConfigError, match="90 samples, expected 100"):
        howl.analyse(np.zeros(100), np.zeros(90), sampling_hz=5000, phi=0.5)
    with pytest.raises(howl.ConfigError, match="complex128"):
        howl.analyse(np.zeros(100), np.zeros(100, dtype=complex), sampling_hz=5000, phi=0.5)


def test_a_table_of_samples_is_not_taken_for_experiments(first_rig):
    table = pd.DataFrame({"p": first_rig["p"][0], "q": first_rig["q"][0]})
    with pytest.raises(howl.ConfigError, match="samples go in as arrays") as caught:
        howl.analyse(table)
    assert caught.value.key == "phi"


def test_a_wrong_type_says_what_was_expected(paper):
    with pytest.raises(TypeError, match="phi goes with an array"):
        howl.fit(paper, phi=0.5)
    with pytest.raises(TypeError, match="of type object"):
        howl.fit({"experiments": paper, "title": object()})


def test_a_missing_config_and_a_wrong_argument_have_no_line(paper):
    with pytest.raises(howl.ConfigError) as caught:
        howl.fit("there/is/none.yaml")
    assert (caught.value.file, caught.value.line) == ("there/is/none.yaml", None)
    with pytest.raises(howl.ConfigError) as caught:
        howl.predict(paper, at=np.nan)
    assert (caught.value.file, caught.value.key) == (None, "--at")


def test_an_empty_family_is_a_result_and_its_prediction_an_error(paper):
    test = {"omega_spread_max": 0.001, "xi_max": 0.05}
    empty = howl.family(paper, config={"family": {"test": test, "members": 10}})
    assert empty.empty and not empty.answer and empty.members.empty
    assert set(empty.empty_because) & {"omega_spread_max", "xi_max"}
    assert "empty" in empty._repr_html_() and len(empty.plot().axes) == 5
    with pytest.raises(howl.NegativeAnswer):
        howl.predict(empty, at=0.6)


def test_a_check_lists_mistakes_and_raises_none():
    found = howl.check({"experiments": [{"name": "a", "phi": 0.5, "frequency_khz": 3}],
                        "familly": {}})
    assert not found.ok and set(found.errors["key"]) >= {"experiments[0].frequency_khz", "familly"}


@pytest.mark.parametrize("text, file, line, key, message", [
    ("a.yaml:6: x[1].y: is wrong, expected 1: or 2", "a.yaml", 6, "x[1].y",
     "is wrong, expected 1: or 2"),
    ("a.yaml: there is no such file", "a.yaml", None, None, "there is no such file"),
    ("d.csv:9: p: nan, expected a number", "d.csv", 9, "p", "nan, expected a number"),
    ("C d.csv: q: too short", "C d.csv", None, "q", "too short"),
    ("howl: --at: x, expected a number", None, None, "--at", "x, expected a number"),
])
def test_the_line_of_a_mistake_is_taken_apart(text, file, line, key, message):
    error = parse_error(text, [])
    assert (error.file, error.line, error.key, error.message) == (file, line, key, message)


def test_an_error_survives_being_pickled():
    error = howl.ConfigError("is wrong", file="a.yaml", line=3, key="phi")
    copy = pickle.loads(pickle.dumps(error))
    assert str(copy) == "a.yaml:3: phi: is wrong"
    assert (copy.file, copy.line, copy.key) == ("a.yaml", 3, "phi")

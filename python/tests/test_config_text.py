"""A config that is given as a dict reaches the program as it is."""

import math
from pathlib import Path

import numpy as np
import pytest
import yaml

import howl
from howl._tree import config_text


def test_a_dict_reads_back_from_its_text():
    config = {
        "title": 'a "quoted": title, with # and µ, \n and \t',
        "empty": {}, "none": None, "list": [], "flags": [True, False],
        "numbers": [1e-5, 1e22, -0.1, 5e-324, 1.7976931348623157e308, 3, 2**60],
        "deep": [{"a": [{"b": 0.1 + 0.2}]}], "text like a number": "1e5", "off": "off",
    }
    assert yaml.safe_load(config_text(config)) == config


def test_numbers_of_numpy_and_paths_are_plain():
    text = config_text({"a": np.float64(0.1), "b": np.arange(3), "c": (np.int8(1), np.bool_(True)),
                        "d": Path("x/y"), "e": math.inf, "f": math.nan})
    read = yaml.safe_load(text)
    assert math.isnan(read.pop("f"))
    assert read == {"a": 0.1, "b": [0, 1, 2], "c": [1, True], "d": "x/y", "e": math.inf}


def test_a_number_that_is_none_is_named(paper):
    with pytest.raises(howl.ConfigError) as caught:
        howl.fit([howl.Experiment(phi=math.nan, frequency_hz=200.0, phase_deg=-5.0, gain=10.0)])
    assert caught.value.key == "experiments[0].phi"


def test_names_and_titles_survive(paper):
    name = "exp 1: µ #1"
    paper.loc[0, "name"] = name
    fitted = howl.fit(paper, config={"title": "a: b # c"})
    assert fitted.experiments.index[0] == name

"""Grey-box identification of self-excited feedback loops: arrays in, data frames out.

    import howl
    found = howl.analyse(p, q, sampling_hz=5000, phi=[0.51, 0.53, 0.56])
    found.characteristics

The functions run the program howl and have its answers to the bit.
"""

from ._commands import (
    analyse,
    campaign,
    check,
    diagnose,
    family,
    fit,
    predict,
    report,
    save,
    simulate,
    version,
)
from ._campaign import Campaign
from ._diagnosis import Check, Diagnosis
from ._errors import ConfigError, HowlError, Interrupted, NegativeAnswer, ProgramError
from ._experiment import Experiment
from ._loops import Family, Fit, Prediction
from ._program import Progress, find_program
from ._records import Analysis, Simulation
from ._result import Result
from .readers import read

__all__ = [
    "Analysis", "Campaign", "Check", "ConfigError", "Diagnosis", "Experiment", "Family", "Fit", "HowlError",
    "Interrupted", "NegativeAnswer", "Prediction", "ProgramError", "Progress", "Result",
    "Simulation", "analyse", "campaign", "check", "diagnose", "family", "find_program", "fit", "predict",
    "read", "report", "save", "simulate", "version",
]

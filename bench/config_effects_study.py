#!/usr/bin/env python3
"""Whether an effect put into a rig simulated from a config is named, and its value found.

    python3 bench/config_effects_study.py HOWL [CONFIG ...]

Each config (all that are shipped, state a table and simulate no effect, if none is named) is simulated without an effect
and with each of EFFECTS, at its own delays, and the records are diagnosed as they are. A row each:
the verdict, its probability, the estimate and whether its 95 % interval holds the truth, and the time.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

EFFECTS = {
    "none": {},
    "q_sensor_lowpass": {"cutoff_hz": 245.0},
    "second_delay_path": {"share": 0.2, "extra_s": 0.001},
}


def with_effect(text, effect, values):
    """The config with the effect in what it simulates."""
    if effect == "none":
        return text
    listed = ", ".join([f"effect: {effect}", *(f"{name}: {value}" for name, value in values.items())])
    added = f"  effects: [{{{listed}}}]\n"
    if re.search(r"^simulate:$", text, re.MULTILINE):
        return re.sub(r"^simulate:$\n", "simulate:\n" + added, text, flags=re.MULTILINE)
    return f"{text}\nsimulate:\n{added}"


def run(words):
    """Seconds; the program's own line where it fails."""
    start = time.perf_counter()
    done = subprocess.run(list(map(str, words)), text=True, capture_output=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return time.perf_counter() - start


def row(howl, config, effect, values, folder):
    rig = folder / "rig.yaml"
    rig.write_text(with_effect(config.read_text(), effect, values))
    run([howl, "simulate", rig, "--out", folder / "rig"])
    seconds = run([howl, "diagnose", folder / "rig" / "records.yaml", "--out", folder / "found"])
    found = json.loads((folder / "found" / "diagnosis.json").read_text())
    verdict = found["verdict"]
    named = verdict["effect"] or verdict["kind"]
    estimates = []
    candidate = next((c for c in found["candidates"] if c["effect"] == verdict["effect"]), None)
    for name, truth in values.items():
        stated = candidate and candidate["parameters"].get(name)
        if stated and stated["lo"] is not None:
            inside = stated["lo"] <= truth <= stated["hi"]
            estimates.append(f"{name} {stated['value']:.5g} ({stated['lo']:.5g} .. {stated['hi']:.5g})"
                             f"{'' if inside else ' misses ' + format(truth, 'g')}")
    named += "".join(f", {other}" for other in verdict["indistinguishable"] if other != named)
    probability = verdict["probability"].get(verdict["effect"] or verdict["kind"], float("nan"))
    print(f"| {config.stem} | {effect} | {named} | {probability:.2f} | {'; '.join(estimates)} | {seconds:.0f} |",
          flush=True)


def main():
    howl = pathlib.Path(sys.argv[1]).resolve()
    shipped = sorted((pathlib.Path(__file__).parent.parent / "configs").glob("*.yaml"))
    configs = [pathlib.Path(name) for name in sys.argv[2:]] or [
        config for config in shipped
        if "frequency_hz:" in config.read_text() and "effects:" not in config.read_text()]
    print("| config | effect | verdict | probability | estimate (95 %) | s |\n|---|---|---|---|---|---|")
    for config in configs:
        for effect, values in EFFECTS.items():
            with tempfile.TemporaryDirectory() as folder:
                try:
                    row(howl, config, effect, values, pathlib.Path(folder))
                except RuntimeError as error:
                    print(f"| {config.stem} | {effect} | {error} | | | |", flush=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Rigs of the second simulator over the whole range that rigs have, as cases with an open key.

    [EFFECTS=slow_drift,p_dropouts+mains_hum] python3 bench/draw_rigs.py HOWL_RIG FOLDER COUNT [SEED]

Cycles of 60 Hz to 1.5 kHz, 2 to 12 operating points, 12 to 40 samples a cycle (1 to 50 kHz), records
of 2 to 20 s, combustion noise of 2 to 10 % and sensors' of 0.1 to 1 %, all drawn evenly in the
logarithm; a quarter of the rigs has no effect, half one of the catalogue, an eighth one from outside
it, an eighth two. MOST_CYCLES bounds what one rig costs. Each case is FOLDER/cases/NAME with its
config.yaml; FOLDER/key/key.json says what each has. EFFECTS: one of these in each rig, a+b both.
"""
import itertools
import json
import math
import os
import pathlib
import random
import subprocess
import sys

MOST_CYCLES = 5000
GROUPS = ["none", "one", "one", "outside", "none", "one", "one", "pair"]
SIZES = ["small", "medium", "large"]


def log_uniform(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def effects_of(howl_rig):
    listed = subprocess.run([howl_rig, "--list"], text=True, capture_output=True, check=True).stdout
    rows = [line.split(",") for line in listed.splitlines()[1:]]
    inside = [row for row in rows if row[2] == "yes"]
    pairs = [(a[0], b[0]) for a, b in itertools.combinations(inside, 2) if a[1] != b[1]]
    return {"none": [()], "one": [(row[0],) for row in inside], "pair": pairs,
            "outside": [(row[0],) for row in rows if row[2] == "no"]}


def rig_of(draw, effects, size):
    cycle_hz = log_uniform(draw, 60.0, 1500.0)
    points = round(log_uniform(draw, 2.0, 12.0))
    sampling_hz = min(max(cycle_hz * log_uniform(draw, 12.0, 40.0), 1000.0), 50000.0)
    duration_s = min(log_uniform(draw, 2.0, 20.0), MOST_CYCLES / (points * cycle_hz))
    spread = draw.uniform(-0.06, 0.06)
    phase_deg = draw.uniform(-30.0, 30.0)
    experiments = [{"name": f"exp{k + 1}", "phi": 0.4 + 0.02 * k,
                    "frequency_hz": cycle_hz * (1.0 + spread * (k / (points - 1) - 0.5)),
                    "phase_deg": phase_deg, "gain": 10.0} for k in range(points)]
    return {"experiments": experiments, "seed": draw.getrandbits(63),
            "effects": [{"id": effect, "severity": size} for effect in effects],
            "duration_s": duration_s, "sampling_hz": sampling_hz, "settle_s": 200.0 / cycle_hz,
            "noise": {"combustion_relative": log_uniform(draw, 0.02, 0.1),
                      "sensor_relative": log_uniform(draw, 0.001, 0.01)}}


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    howl_rig, folder, count = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3])
    draw = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
    kinds = effects_of(howl_rig)
    asked = [effect for effect in os.environ.get("EFFECTS", "").split(",") if effect]
    kinds["asked"] = [tuple(effect.split("+")) for effect in asked]
    decks = {group: [] for group in kinds}
    key = {"cases": {}}
    (folder / "key").mkdir(parents=True, exist_ok=True)
    while len(key["cases"]) < count:
        group = "asked" if asked else GROUPS[len(key["cases"]) % len(GROUPS)]
        if not decks[group]:
            decks[group] = draw.sample(kinds[group], len(kinds[group]))
        rig = rig_of(draw, decks[group].pop(), draw.choice(SIZES))
        name = f"case{len(key['cases']) + 1:03d}"
        made = subprocess.run([howl_rig, "/dev/stdin", "--out", folder / "cases" / name],
                              input=json.dumps(rig), text=True, capture_output=True, check=False)
        # Some draws have no such duct, or no cycle: the next one takes their place.
        if made.returncode != 0:
            print(made.stderr.strip(), file=sys.stderr)
            continue
        key["cases"][name] = json.loads(made.stdout) | {"drawn": {
            "cycle_hz": rig["experiments"][0]["frequency_hz"], "points": len(rig["experiments"]),
            "sampling_hz": rig["sampling_hz"], "duration_s": rig["duration_s"],
            "combustion_noise": rig["noise"]["combustion_relative"]}}
        (folder / "key" / "key.json").write_text(json.dumps(key, indent=1))


if __name__ == "__main__":
    main()

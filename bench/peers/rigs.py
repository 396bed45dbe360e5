"""Rigs with known effects, made by howl_rig (which shares no code with howl's model), and howl's
diagnosis of each. What was made is kept in a folder, and made again only where it is missing."""
import json
import pathlib
import subprocess
import sys
import time

import numpy as np

import r228
from common import cpu_seconds

CHOSEN = [0, 2, 3, 5]  # four experiments of R228, spread as `howl trial --experiments 4` does
DURATION_S, SAMPLING_HZ = 2, 5000
SEVERITIES = {"small": 0.25, "medium": 0.55, "large": 0.85}


def effects(howl):
    """{effect: (block, whether it is in the catalogue)}, as howl_rig lists them."""
    program = pathlib.Path(howl.program).with_name("howl_rig")
    rows = subprocess.run([program, "--list"], check=True, capture_output=True, text=True).stdout
    cells = [line.split(",") for line in rows.splitlines()[1:]]
    return {row[0]: (row[1], row[2] == "yes") for row in cells}


def make(howl, folder, effect, severity, seed):
    """One rig; effect: None for none. The folder has data/ and config.yaml, which does not tell."""
    if (folder / "config.yaml").exists():
        return folder
    lines = ["experiments:"]
    for k in CHOSEN:
        lines.append("  - {name: %s, phi: %r, frequency_hz: %r, phase_deg: %r, gain: %r}" % (
            r228.NAMES[k], *(float(c[k]) for c in (r228.PHI, r228.FREQUENCY_HZ, r228.PHASE_DEG,
                                                   r228.GAIN))))
    lines.append(f"effects: [{{id: {effect}, severity: {severity}}}]" if effect else "effects: []")
    lines += [f"seed: {seed}", f"duration_s: {DURATION_S}", f"sampling_hz: {SAMPLING_HZ}",
              "settle_s: 1", ""]
    program = pathlib.Path(howl.program).with_name("howl_rig")
    subprocess.run([program, "/dev/stdin", "--out", folder, "--key", folder / "key.json"],
                   check=True, input="\n".join(lines), text=True, capture_output=True)
    return folder


def records(folder):
    """[(p, q), ...] of the experiments."""
    return [np.loadtxt(path, delimiter=",", skiprows=1).T
            for path in sorted((folder / "data").glob("*.csv"))]


def diagnosis(howl, folder):
    """howl's answer, and the CPU seconds that it took."""
    kept = folder / "diagnosed.json"
    if not kept.exists():
        cpu = cpu_seconds()
        howl.run("diagnose", folder / "config.yaml", folder / "out")
        answer = json.loads((folder / "out" / "diagnosis.json").read_text())
        kept.write_text(json.dumps({"answer": answer, "cpu_s": cpu_seconds() - cpu}))
    text = json.loads(kept.read_text())
    return text["answer"], text["cpu_s"]


def test_plan(known):
    """(name, effect or None, severity, seed): each effect of the catalogue once, with the sizes in
    turn, half as many from outside the catalogue, and as many without an effect, mixed."""
    catalogue = [e for e, (_, inside) in known.items() if inside]
    outside = [e for e, (_, inside) in known.items() if not inside]
    sizes = list(SEVERITIES.values())
    chosen = [(e, sizes[i % 3]) for i, e in enumerate(catalogue)]
    # From outside the larger sizes: what is small is near to no effect at all.
    chosen += [(e, sizes[1 + i % 2]) for i, e in enumerate(outside[:len(catalogue) // 2])]
    chosen += [(None, 0.0)] * (len(catalogue) // 2)
    order = np.random.default_rng(4).permutation(len(chosen))
    return [(f"rig{n:03d}", *chosen[k], 900000 + int(k)) for n, k in enumerate(order)]


def make_tests(howl, root):
    plan = test_plan(effects(howl))
    return [(make(howl, root / name, effect, severity, seed), effect, severity)
            for name, effect, severity, seed in plan]


if __name__ == "__main__":  # rigs.py HOWL FOLDER: makes and diagnoses them ahead of a run
    from common import Howl
    program = Howl(sys.argv[1])
    for place, effect, severity in make_tests(program, pathlib.Path(sys.argv[2])):
        begin = time.perf_counter()
        verdict = diagnosis(program, place)[0]["verdict"]
        print(place.name, effect, severity, verdict["kind"], verdict["effect"],
              f"{time.perf_counter() - begin:.0f} s", flush=True)

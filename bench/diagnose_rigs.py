#!/usr/bin/env python3
"""Diagnoses of the rigs that draw_rigs.py has drawn, and how many of them are right.

    python3 bench/diagnose_rigs.py HOWL FOLDER ANSWERS [OPTIONS OF DIAGNOSE]

Each case of FOLDER is diagnosed into ANSWERS/NAME, one on each core, unless it has an answer; then all
answers are scored against FOLDER's key. A single effect counts as named where the verdict names it
and nothing else, or has it in a class of at most three; two where it names both and nothing else; one from
outside the catalogue, where it says unknown. Shares are with Wilson's 95 % interval. One table splits
single effects of medium and large size at the median of what was drawn. One shows what the item of
a single effect leaves, in further items or in errors at the cycle's lines, over what it gains: the root is
by how much its form is off (kFormError of diagnosis/loop_budget/forms/odds.h). One shows what the flame errs
by at the cycle's lines beside a gain that fluctuates, over the bound of what that makes (kBoundOfGain
there). The last counts how often the 95 % interval of an effect that a rig has not, and that was not
found, holds zero (diagnosis/loop_budget/account/item_bounds.h).
"""
import concurrent.futures
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys

MOST_OF_CLASS = 3
SMALL = 0.25  # the severity that howl_rig calls so
DRAWN = {"cycle_hz": "cycle, Hz", "sampling_hz": "sampling, Hz", "duration_s": "length, s",
         "points": "operating points", "combustion_noise": "combustion noise"}


def diagnose(howl, case, answer, options):
    if (answer / "diagnosis.json").exists():
        return 0
    run = subprocess.run([howl, "diagnose", case / "config.yaml", "--out", answer, "--threads", "1",
                          *options], text=True, capture_output=True)
    if run.returncode != 0:
        print(f"{case.name}: exit status {run.returncode}: {run.stderr.strip()}", file=sys.stderr)
    return run.returncode


def share(right):
    n, z = len(right), 1.959964
    if n == 0:
        return "-"
    p = sum(right) / n
    middle = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return f"{100 * p:.0f} % ({100 * (middle - half):.0f} .. {100 * (middle + half):.0f}; {sum(right)} of {n})"


def named(verdict):
    return set((verdict["effect"] or "").split("+")) - {""}


def is_right(effects, verdict):
    if not effects:
        return verdict["kind"] == "none"
    if not effects[0]["in_catalogue"]:
        return verdict["kind"] == "unknown"
    if verdict["kind"] != "effect":
        return False
    held = {each["effect"] for each in effects}
    if named(verdict) == held:
        return True
    alike = verdict["indistinguishable"]
    return len(held) == 1 and len(alike) < MOST_OF_CLASS and held.pop() in alike


def group(effects):
    if not effects:
        return "nothing: none is said"
    if len(effects) == 2:
        return "two effects: both, and nothing else"
    if not effects[0]["in_catalogue"]:
        return "one from outside: unknown is said"
    return "one effect named, or in a class of three"


def answer_of(verdict):
    alike = [each for each in verdict["indistinguishable"]]
    text = verdict["effect"] if verdict["kind"] == "effect" else verdict["kind"]
    return text + (f" (or {', '.join(alike)})" if alike else "")


def form_errors(rows):
    """(effect, nats that it gained, nats that it left, the root of their ratio)."""
    out = []
    for _, k, answer in rows:
        held = [each["effect"] for each in k["effects"]]
        nats = {each["item"]: each["lost_without"]["nats"] for each in answer.get("budget", [])}
        if len(held) != 1 or held[0] not in nats:
            continue
        left = [nats[item] for item in nats if item != held[0]]
        left += [each["nats"] for each in answer["line_errors"].values()]
        most = max([0.0] + [each for each in left if each is not None])
        out.append((held[0], nats[held[0]], most, math.sqrt(most / nats[held[0]])))
    return sorted(out, key=lambda each: -each[3])


def lines_of_gain(rows):
    """(withheld, nats, over their bound) of the flame's errors at the lines, where a gain fluctuates."""
    out = []
    for _, k, answer in rows:
        lines = answer["line_errors"]["q_from_p"]
        bound = lines["of_gain"]["bound"]
        if bound and lines["nats"] > 0.0:
            held = "+".join(each["effect"] for each in k["effects"]) or "nothing"
            out.append((held, lines["nats"], lines["of_gain"]["missed"] / bound))
    return sorted(out, key=lambda each: each[2])


def intervals_with_zero(rows):
    """By effect, of those with two ends, where the answer is right."""
    out = {}
    for _, k, answer in rows:
        held = {each["effect"] for each in k["effects"]}
        if not is_right(k["effects"], answer["verdict"]):
            continue
        for each in answer.get("not_found", []):
            if each["item"] in held or each["lo"] is None or each["hi"] is None:
                continue
            out.setdefault(each["item"], []).append(each["lo"] <= 0.0 <= each["hi"])
    return out


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    howl, folder, answers = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    cases = sorted((folder / "cases").iterdir())
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda case: diagnose(howl, case, answers / case.name, sys.argv[4:]), cases))
    key = json.loads((folder / "key" / "key.json").read_text())["cases"]
    rows = []
    for case in cases:
        answer = answers / case.name / "diagnosis.json"
        if answer.exists():
            rows.append((case.name, key[case.name], json.loads(answer.read_text())))
    scored = [(group(k["effects"]), is_right(k["effects"], a["verdict"]), k, a["verdict"])
              for _, k, a in rows]

    print(f"{len(rows)} of {len(cases)} rigs have an answer.\n")
    print("| withheld | right |\n|---|---|")
    for name in sorted({each[0] for each in scored}):
        print(f"| {name} | {share([right for at, right, _, _ in scored if at == name])} |")
    single = [each for each in scored if each[0].startswith("one effect")]
    larger = [each for each in single if each[2]["effects"][0]["severity"] > SMALL]
    print(f"| the same, medium and large | {share([each[1] for each in larger])} |")
    beside = [each[2]["effects"][0]["effect"] in named(each[3]) and len(named(each[3])) > 1
              for each in single]
    print(f"| a second cause beside a single one | {share(beside)} |")

    print("\n| single effects, medium and large | below the median | above it |\n|---|---|---|")
    for field, label in DRAWN.items():
        if not larger:
            break
        middle = statistics.median(each[2]["drawn"][field] for each in larger)
        low = [each[1] for each in larger if each[2]["drawn"][field] <= middle]
        high = [each[1] for each in larger if each[2]["drawn"][field] > middle]
        print(f"| {label}, {middle:.3g} | {share(low)} | {share(high)} |")

    print("\n| not right | withheld | answer |\n|---|---|---|")
    for (name, k, _), (_, right, _, v) in zip(rows, scored):
        if not right:
            held = "+".join(f"{each['effect']} ({each['size_name']} {each['size']:.3g})"
                            for each in k["effects"]) or "nothing"
            print(f"| {name} | {held} | {answer_of(v)} |")

    print("\n| single effect | gains, nats | leaves, nats | its form is off by |\n|---|---|---|---|")
    for effect, gained, left, error in form_errors(rows):
        print(f"| {effect} | {gained:.0f} | {left:.1f} | {error:.3f} |")

    print("\n| withheld, where a gain fluctuates | lines, nats | over their bound |\n|---|---|---|")
    for held, nats, over in lines_of_gain(rows):
        print(f"| {held} | {nats:.1f} | {over:.2f} |")

    print("\n| effect that the rig has not | its 95 % interval holds zero |\n|---|---|")
    for effect, holds in sorted(intervals_with_zero(rows).items()):
        print(f"| {effect} | {share(holds)} |")


if __name__ == "__main__":
    main()

"""Loads results by matlab/howl_results.m in Octave and compares them with Python's own readers.

    check_octave.py HOWL SOURCE_DIR

Exit status 77, after saying why, where there is no Octave.
"""
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile

SKIP = 77
# Octave 7's jsondecode misses the last bit or two of some numbers; cells of CSV are exact.
JSON_TOLERANCE = 4 * sys.float_info.epsilon
SCRIPT = """
addpath('{source}/matlab');
r = howl_results('{out}');
printf('%.17g\\n', r.solution.cost, numel(r.solution.experiments), r.solution.experiments(2).xi);
printf('%.17g\\n', r.family_table.xi(5), r.family_table.member(end), r.tradeoff_table.xi_max(1));
printf('%d %s\\n', iscellstr(r.family_table.experiment), r.family_table.experiment{{2}});
printf('%.17g\\n', r.characteristics_table.loop_gain, r.family.bounds.lean.tau_s.outer);
printf('%d\\n', islogical(r.characteristics_table.stationary), r.characteristics_table.stationary(1));
printf('%d\\n', numel(r.transfer_table.re), sum(isnan(r.lines_table.phase_deg)));
printf('%d\\n', numel(fieldnames(r)));
try, howl_results('{out}/none'); catch e, disp(e.message); end
"""


def main():
    howl, source = sys.argv[1:3]
    octave = shutil.which("octave-cli")
    if octave is None:
        print("skipped: there is no octave-cli here")
        return SKIP
    with tempfile.TemporaryDirectory() as folder:
        config, out = os.path.join(folder, "rig.yaml"), os.path.join(folder, "out")
        with open(os.path.join(source, "configs", "first_rig.yaml")) as stream:
            text = stream.read().replace("first_rig/", os.path.join(source, "configs/first_rig/"))
        with open(config, "w") as stream:
            # Without the broadband transfer the family takes a second instead of a minute.
            stream.write(text + "family: {members: 20, test: {transfer_distance_max: null}}\n")
        for command in ("analyse", "fit", "family"):
            subprocess.run([howl, command, config, "--out", out, "--quiet"], check=True)
        shown = subprocess.run([octave, "--no-gui", "--eval", SCRIPT.format(source=source, out=out)],
                               capture_output=True, text=True, check=True).stdout.split("\n")

        def table(name):
            with open(os.path.join(out, name), newline="") as stream:
                return list(csv.DictReader(stream))

        with open(os.path.join(out, "solution.json")) as stream:
            solution = json.load(stream)
        with open(os.path.join(out, "family.json")) as stream:
            bounds = json.load(stream)["bounds"]
        members, lines = table("family.csv"), table("lines.csv")
        kept = [name for name in os.listdir(out) if name.endswith((".json", ".csv"))]
        expected = [
            solution["cost"], len(solution["experiments"]), solution["experiments"][1]["xi"],
            members[4]["xi"], members[-1]["member"], table("tradeoff.csv")[0]["xi_max"],
            "1 " + members[1]["experiment"],
            *[row["loop_gain"] for row in table("characteristics.csv")],
            *bounds["lean"]["tau_s"]["outer"], 1, 1, len(table("transfer.csv")),
            sum(row["phase_deg"] == "" for row in lines), len(kept),
            f"{out}/none: there is no such folder, expected one that howl wrote"]
    failed = 0
    for i, value in enumerate(expected):
        if isinstance(value, str) and not is_number(value):
            same = shown[i] == value
        elif isinstance(value, float):  # from a JSON file
            same = abs(float(shown[i]) - value) <= JSON_TOLERANCE * abs(value)
        else:
            same = float(shown[i]) == float(value)
        if not same:
            print(f"value {i + 1}: Octave has {shown[i]}, expected {value}")
            failed = 1
    return failed


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


if __name__ == "__main__":
    sys.exit(main())

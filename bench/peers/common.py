"""What every comparison shares: running howl, timing in turns, and the table.

Times are CPU seconds (user and system) of one process and its children, since the machine may be
shared; programs take turns, so that what slows one slows the others. Every figure is a median
with its quartiles.
"""
import dataclasses
import json
import os
import pathlib
import resource
import statistics
import subprocess
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]


@dataclasses.dataclass
class Timed:
    """One run: what it returned, and what it cost."""
    value: object
    cpu_s: float
    wall_s: float


def cpu_seconds():
    """Of this process and of the children that have ended."""
    total = 0.0
    for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN):
        usage = resource.getrusage(who)
        total += usage.ru_utime + usage.ru_stime
    return total


def timed(call):
    cpu, wall = cpu_seconds(), time.perf_counter()
    value = call()
    return Timed(value, cpu_seconds() - cpu, time.perf_counter() - wall)


def in_turns(repeats, calls):
    """{name: [Timed, ...]}: every call once in each round, beginning with another one each time."""
    runs = {name: [] for name in calls}
    names = list(calls)
    for round_number in range(repeats):
        turn = round_number % len(names)
        for name in names[turn:] + names[:turn]:
            runs[name].append(timed(calls[name]))
    return runs


class Howl:
    """The program; every run writes to a folder of its own."""

    def __init__(self, program):
        self.program = os.path.abspath(program)
        version = self.run_words(["--version"]).stdout.split()
        self.version = version[1] if len(version) > 1 else "?"

    def run_words(self, words, allowed=(0,)):
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True)
        if done.returncode not in allowed:
            raise RuntimeError(f"howl {' '.join(map(str, words))}: {done.stderr.strip()}")
        return done

    def run(self, command, config, folder, *options, allowed=(0,)):
        """One command on one thread, quietly; what it wrote is in the folder."""
        words = [command, config, "--out", folder, "--threads", "1", "--quiet", *options]
        return self.run_words(words, allowed)

    def answer(self, command, config, file, *options, allowed=(0,)):
        """The JSON that a command writes, for a config that is a path or its text."""
        with tempfile.TemporaryDirectory() as folder:
            if not os.path.exists(config):
                path = os.path.join(folder, "config.yaml")
                pathlib.Path(path).write_text(config)
                config = path
            out = os.path.join(folder, "out")
            self.run(command, config, out, *options, allowed=allowed)
            with open(os.path.join(out, file)) as stream:
                return json.load(stream)


def spread(values):
    """Median, quartiles and number of values."""
    values = sorted(float(v) for v in values)
    if len(values) == 1:
        return {"median": values[0], "q1": values[0], "q3": values[0], "n": 1}
    q1, median, q3 = statistics.quantiles(values, n=4, method="inclusive")
    return {"median": median, "q1": q1, "q3": q3, "n": len(values)}


def number(value):
    if value == 0 or 0.01 <= abs(value) < 1e5:
        return f"{value:.4g}"
    return f"{value:.2e}"


def text_of(value):
    """A spread as "median (q1 .. q3)", where it has one."""
    if value is None:
        return "-"
    if isinstance(value, str):
        return value
    if value["n"] == 1 or value["q1"] == value["q3"]:
        return number(value["median"])
    return f"{number(value['median'])} ({number(value['q1'])} .. {number(value['q3'])})"


class Table:
    """Rows of (comparison, quantity, peer): both values, their ratio, and who is better."""

    def __init__(self):
        self.rows = []
        self.notes = {}

    def note(self, comparison, text):
        self.notes.setdefault(comparison, []).append(text)

    def add(self, comparison, quantity, better, howl, peer, value, note=""):
        """Values are numbers, lists of repeats in turns, or text. better: "lower", "higher" or ""
        where neither is. The ratio is the peer's over howl's, repeat by repeat where both have as
        many of them."""
        lists = [v if isinstance(v, str) or v is None else list(v) if hasattr(v, "__len__") else [v]
                 for v in (howl, value)]
        ratio = verdict = None
        if all(isinstance(v, list) for v in lists):
            ours, theirs = lists
            pairs = zip(theirs, ours) if len(ours) == len(theirs) else [
                (b, statistics.median(ours)) for b in theirs]
            ratios = [b / a for b, a in pairs if a != 0]
            ratio = spread(ratios) if ratios else None
            a, b = statistics.median(ours), statistics.median(theirs)
            if better:
                ahead = (a < b) == (better == "lower")
                verdict = "same" if abs(a - b) <= 1e-9 * max(abs(a), abs(b)) else (
                    "howl" if ahead else "peer")
        cells = [spread(v) if isinstance(v, list) else v for v in lists]
        self.rows.append({"comparison": comparison, "quantity": quantity, "better": better,
                          "howl": cells[0], "peer": peer, "value": cells[1],
                          "peer_over_howl": ratio, "ahead": verdict, "note": note})
        print(f"  {quantity}: howl {text_of(cells[0])}; {peer} {text_of(cells[1])}"
              f"; ratio {text_of(ratio)} {note}", flush=True)

    def markdown(self, head):
        lines = [*head, ""]
        for comparison in dict.fromkeys([*(r["comparison"] for r in self.rows), *self.notes]):
            rows = [r for r in self.rows if r["comparison"] == comparison]
            lines += [f"## {comparison}", ""]
            if rows:
                lines += ["| quantity | howl | peer | its value | peer / howl | ahead | note |",
                          "|---|---|---|---|---|---|---|"]
                lines += ["| " + " | ".join([
                    r["quantity"], text_of(r["howl"]), r["peer"], text_of(r["value"]),
                    text_of(r["peer_over_howl"]), r["ahead"] or "-", r["note"]]) + " |"
                    for r in rows]
                lines.append("")
            lines += [f"* {text}" for text in self.notes.get(comparison, [])] + [""]
        return "\n".join(lines)

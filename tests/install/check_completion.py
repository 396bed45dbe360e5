#!/usr/bin/env python3
"""Completion in real shells: types words and a tab into a shell on a terminal, and looks at the line.

    check_completion.py HOWL bash|zsh|zsh_installed|fish

The shell has read what `howl help completion` prints; zsh_installed finds it as the file _howl in a folder of
completions, as the package has it. Exit status 77 (skipped) where it is not installed.
"""

import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
LONGEST_S = 60
PROMPT = "ready> "

# What is typed before a tab, and the line after it. The folder has these files alone.
FILES = {
    "rig.yaml": "experiments:\n"
                "  - {name: lean, phi: 0.5, frequency_hz: 205, phase_deg: -14, gain: 14}\n"
                "  - {name: rich, phi: 0.6, frequency_hz: 220, phase_deg: -6, gain: 12}\n",
    "rig.csv": "p,q\n0,0\n",
    "results/kept.txt": "",
}
CASES = [
    ("howl fam", "howl family "),
    ("howl family ri", "howl family rig.yaml "),  # rig.csv is no config
    ("howl family rig.yaml --fal", "howl family rig.yaml --falsify "),
    ("howl family rig.yaml --falsify r", "howl family rig.yaml --falsify r"),  # results/, rig.yaml
    ("howl family rig.yaml --out res", "howl family rig.yaml --out results/"),
    ("howl family rig.yaml --out=res", "howl family rig.yaml --out=results/"),
    ("howl init rig.c", "howl init rig.csv "),
    ("howl merge r", "howl merge results/"),  # folders alone
    ("howl list rig.yaml --experiment l", "howl list rig.yaml --experiment lean "),
    ("howl list rig.yaml --experiment=ri", "howl list rig.yaml --experiment=rich "),
    ("howl family rig.yaml --profile lean.ta", "howl family rig.yaml --profile lean.tau_s "),
    ("howl predict rig.yaml --at 0.5:0.6:0.1 --thr", "howl predict rig.yaml --at 0.5:0.6:0.1 --threads "),
    ("howl diagnose rig.yaml --without q_cl", "howl diagnose rig.yaml --without q_clipping "),
    ("howl help completion z", "howl help completion zsh "),
    ("howl fit rig.yaml --quiet --qu", "howl fit rig.yaml --quiet --qu"),  # given already
    ("howl fit --member", "howl fit --member"),  # an option of another command
]

ZSH_KEEPS = """
setopt no_beep no_list_ambiguous no_auto_menu; keep() { print -r -- "$BUFFER" >> lines.txt; BUFFER= }
zle -N keep; bindkey '^T' keep
"""
SETUP = {
    "bash": (["bash", "--norc", "--noprofile", "-i"], f"""
PS1='{PROMPT}'; source <(howl help completion bash)
bind 'set bell-style none'; bind 'set completion-query-items 0'
bind -x '"\\C-t": printf "%s\\n" "$READLINE_LINE" >> lines.txt; READLINE_LINE='
""".strip().replace("\n", "; ")),
    "zsh": (["zsh", "-f", "-i"], f"""
PS1='{PROMPT}'; autoload -U compinit; compinit -u -D; source <(howl help completion zsh)
{ZSH_KEEPS.strip()}
""".strip().replace("\n", "; ")),
    "zsh_installed": (["zsh", "-f", "-i"], f"""
PS1='{PROMPT}'; mkdir .zsh; howl help completion zsh > .zsh/_howl; fpath=(~/.zsh $fpath)
autoload -U compinit; compinit -u -D
{ZSH_KEEPS.strip()}
""".strip().replace("\n", "; ")),
}


class Terminal:
    """A shell on a terminal of its own."""

    def __init__(self, words, environment, folder):
        self.seen = ""
        self.child, self.end = pty.fork()
        if self.child == 0:
            os.chdir(folder)
            os.execvpe(words[0], words, environment)

    def wait_for(self, happened):
        until = time.monotonic() + LONGEST_S
        while not happened(self.seen):
            if time.monotonic() > until:
                raise SystemExit(f"the shell did not answer in {LONGEST_S} s; it wrote:\n{self.seen}")
            if select.select([self.end], [], [], 0.02)[0]:
                self.seen += os.read(self.end, 65536).decode(errors="replace")

    def type(self, text):
        os.write(self.end, text.encode())

    def close(self):
        os.close(self.end)  # which hangs up
        os.waitpid(self.child, 0)


def lines_on_terminal(shell, folder, environment):
    words, setup = SETUP[shell]
    kept = folder / "lines.txt"
    terminal = Terminal(words, environment, folder)
    try:
        terminal.type(setup + "\n")
        # The line that sets the prompt shows it as well, in quotes; the prompt follows a control code.
        terminal.wait_for(lambda seen: re.search(rf"(\x1b\[[^a-zA-Z]*[a-zA-Z]|[\r\n]){PROMPT}", seen))
        for i, (typed, _) in enumerate(CASES):
            terminal.type(typed + "\t\x14")
            terminal.wait_for(lambda _: kept.exists() and kept.read_text().count("\n") > i)
    finally:
        terminal.close()
    return kept.read_text().split("\n")[:-1]


def lines_of_fish(folder, environment):
    """fish says what it would offer; a single offer becomes the word, with a blank unless it is a folder."""
    lines = []
    for typed, _ in CASES:
        script = "howl help completion fish | source; complete -C $argv[1]"
        run = subprocess.run(["fish", "--no-config", "-c", script, typed], cwd=folder, env=environment,
                             capture_output=True, text=True, timeout=LONGEST_S)
        offers = [line.split("\t")[0] for line in run.stdout.splitlines()]
        before = typed.rpartition(" ")[0] + " "
        end = "" if offers and offers[0].endswith("/") else " "
        lines.append(before + offers[0] + end if len(offers) == 1 else typed)
    return lines


def main():
    howl, shell = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    program = shell.partition("_")[0]
    if shutil.which(program) is None:
        print(f"skipped: {program} is not installed")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for path, text in FILES.items():
            (folder / path).parent.mkdir(exist_ok=True)
            (folder / path).write_text(text)
        environment = dict(os.environ, PATH=f"{howl.parent}:{os.environ['PATH']}", HOME=name, TERM="xterm",
                           LC_ALL="C.UTF-8")
        lines = (lines_of_fish if shell == "fish" else
                 lambda *rest: lines_on_terminal(shell, *rest))(folder, environment)
    faults = 0
    for (typed, expected), line in zip(CASES, lines):
        if line != expected:
            faults += 1
            print(f"{typed!r}: {line!r}, expected {expected!r}")
    print(f"{shell}: {len(lines)} lines completed, {faults} not as expected")
    return 1 if faults or len(lines) != len(CASES) else 0


if __name__ == "__main__":
    sys.exit(main())

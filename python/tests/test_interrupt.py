"""Ctrl-C ends the program in order, and the same call goes on."""

import os
import signal
import subprocess
import sys
import time

import pytest
from conftest import LONG

import howl
from howl._program import Completed, run_program

FEWEST_BOUNDS = 20  # other stretches of the work have fewer units


def stop(state):
    # Before the bounds are counted nothing is saved, so that there is nothing to go on from.
    if state.done is not None and state.total >= FEWEST_BOUNDS:
        os.kill(os.getpid(), signal.SIGINT)  # as Ctrl-C does


def children():
    found = subprocess.run(["ps", "--ppid", str(os.getpid()), "-o", "args="], capture_output=True,
                           text=True)
    return [line for line in found.stdout.splitlines() if "howl" in line and "family" in line]


def test_the_same_call_goes_on_where_ctrl_c_stopped_it():
    with pytest.raises(KeyboardInterrupt) as first:
        howl.family(LONG, threads=1, progress=stop)
    assert isinstance(first.value, howl.Interrupted)
    assert "goes on from" in str(first.value) and not children()
    try:  # what is left may be over before it shows how far it is
        notes = howl.family(str(LONG), threads=1, progress=stop).notes
    except howl.Interrupted as second:
        notes = second.notes
    assert any("going on from" in note for note in notes)


def test_with_a_folder_the_program_itself_goes_on(tmp_path):
    with pytest.raises(howl.Interrupted):
        howl.family(LONG, threads=1, out=tmp_path, progress=stop)
    assert (tmp_path / "bounds.state").exists()
    assert not (tmp_path / "family.json").exists()


def test_a_program_that_does_not_watch_for_ctrl_c_is_ended(tmp_path, monkeypatch):
    sleeper = tmp_path / "howl"
    sleeper.write_text("#!/bin/sh\necho started >&2\nexec sleep 30\n")
    sleeper.chmod(0o755)
    monkeypatch.setenv("HOWL_PROGRAM", str(sleeper))
    signal.signal(signal.SIGALRM, lambda *_: os.kill(os.getpid(), signal.SIGINT))
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    begun = time.monotonic()
    with pytest.raises(howl.Interrupted):
        run_program(["fit"])
    assert time.monotonic() - begun < 20


def test_an_observers_exception_ends_the_program():
    def fail(state):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        howl.family(LONG, threads=1, progress=fail)
    assert not children()


def test_the_status_and_both_streams_of_the_program(tmp_path, monkeypatch):
    speaker = tmp_path / "howl"
    speaker.write_text("#!/bin/sh\necho out\necho one >&2\nprintf 'two' >&2\nexit 3\n")
    speaker.chmod(0o755)
    monkeypatch.setenv("HOWL_PROGRAM", str(speaker))
    for observer in (None, lambda state: None):
        assert run_program(["fit"], observer) == Completed(3, "out\n", ["one", "two"])


def test_ctrl_c_in_a_terminal_reaches_the_program_once(tmp_path):
    """Both get the terminal's signal where they share a process group; the program must not."""
    code = (f"import howl\ntry: howl.family({str(LONG)!r}, threads=1, progress=lambda s:"
            f" print('now', flush=True) if (s.total or 99) >= {FEWEST_BOUNDS} else None)\n"
            "except howl.Interrupted as e: print('caught', e)\n")
    python = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True,
                              start_new_session=True)
    assert python.stdout.readline() == "now\n"
    os.killpg(python.pid, signal.SIGINT)
    rest = python.stdout.read()
    assert "caught interrupted: nothing written; the same command goes on from" in rest
    assert python.wait() == 0

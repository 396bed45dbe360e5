"""How far a computation is, as the program tells it and as it is shown."""

import io
import sys

import pytest
from conftest import LONG

import howl
from howl._program import _Messages, parse_progress
from howl._progress import Shown, _Line


def test_lines_of_progress_are_told_from_messages():
    state = parse_progress("starts of the search: 3 of 40, 2 min left")
    assert (state.what, state.done, state.total, state.text) == (
        "starts of the search", 3, 40, "2 min left")
    state = parse_progress("bounds: 81 boxes left, 7 s ")
    assert (state.what, state.done, state.text) == ("bounds", None, "81 boxes left, 7 s")
    assert parse_progress("bounds: going on from /tmp/x/bounds.state") is None
    assert parse_progress("the data cannot tell: 3 of 40 experiments") is None


@pytest.mark.parametrize("size", [1, 3, 7, 1000])
def test_the_stream_may_be_cut_anywhere(size):
    text = ("\r\033[Kfit: 1 of 10, 12 s left\r\033[Kfit: 2 of 10, 9 s left\r\033[Ka note: ±5 µs\n"
            "  goes on\n\rbounds: 7 boxes left, 2 s " + "\r" + " " * 60 + "\r").encode()
    seen = []
    messages = _Messages(seen.append)
    for start in range(0, len(text), size):
        messages.feed(text[start:start + size])
    assert messages.finish() == ["a note: ±5 µs", "  goes on"]
    assert [(s.what, s.done) for s in seen] == [("fit", 1), ("fit", 2), ("bounds", None)]


def test_a_long_computation_tells_how_far_it_is(tmp_path):
    seen = []

    def look(state):
        seen.append(state)
        raise StopIteration

    # In a folder of its own, so that it is begun anew.
    with pytest.raises(StopIteration):
        howl.family(LONG, threads=1, out=tmp_path, progress=look)
    assert all(isinstance(state, howl.Progress) for state in seen)
    assert all(state.done is None or 0 < state.done < state.total for state in seen)


def test_the_line_is_taken_away(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    line = _Line()
    line(howl.Progress("fit", 3, 10, "5 s left"))
    line.close()
    assert stream.getvalue().split("\r") == ["", "fit: 3 of 10, 5 s left", " " * 22, ""]


def test_nothing_is_shown_where_nobody_looks(monkeypatch):
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with Shown(None) as shown:
        assert shown.observer is None
    with Shown(False) as shown:
        assert shown.observer is None
    with Shown(True) as shown:
        shown.observer(howl.Progress("fit", 3, 10, "5 s left"))
        shown.observer(howl.Progress("bounds", None, None, "7 boxes left, 2 s"))
    assert "fit" in sys.stderr.getvalue()

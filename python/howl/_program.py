"""Finds the program howl, runs it, passes Ctrl-C on, and tells how far it is."""

from __future__ import annotations

import codecs
import os
import re
import selectors
import shutil
import signal
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable, List, Optional, Sequence, Tuple

from ._errors import Interrupted, ProgramError


@dataclass(frozen=True)
class Progress:
    """How far a computation is. `done` of `total` units; both are None where the amount of work is
    not known, and `text` then says what is."""

    what: str
    done: Optional[int]
    total: Optional[int]
    text: str


Observer = Callable[[Progress], None]

INTERRUPTED = 130  # exit status, as a shell has it after Ctrl-C


@dataclass
class Completed:
    status: int
    output: str
    messages: List[str] = field(default_factory=list)


def find_program() -> Path:
    """The program: what HOWL_PROGRAM names, else the one in this package, else the one on PATH."""
    named = os.environ.get("HOWL_PROGRAM")
    if named:
        if not os.access(named, os.X_OK) or os.path.isdir(named):
            raise ProgramError(f"HOWL_PROGRAM: {named} is no program, expected the path of howl")
        return Path(named)
    own = Path(__file__).parent / "bin" / "howl"
    if own.exists():
        return own
    on_path = shutil.which("howl")
    if on_path:
        return Path(on_path)
    raise ProgramError(
        "there is no program howl in this package or on PATH, expected one: build it "
        "(./run.sh at the top of the repository) and set HOWL_PROGRAM=.../build/howl"
    )


_COUNT = re.compile(r"^(?P<what>.+): (?P<done>\d+) of (?P<total>\d+), (?P<left>.+ left)$")
_BOUNDS = re.compile(r"^(?P<what>bounds): (?P<text>\d+ boxes left, \d+ s)\s*$")


def parse_progress(line: str) -> Optional[Progress]:
    """The progress that a line of standard error tells, or None where it tells something else."""
    found = _COUNT.match(line)
    if found:
        return Progress(
            found["what"], int(found["done"]), int(found["total"]), found["left"]
        )
    found = _BOUNDS.match(line)
    if found:
        return Progress(found["what"], None, None, found["text"])
    return None


class _Messages:
    """Takes standard error apart: progress lines, which the next one overwrites, and messages."""

    def __init__(self, observer: Optional[Observer]) -> None:
        self._observer = observer
        self._decoder = codecs.getincrementaldecoder("utf-8")(errors="replace")
        self._rest = ""
        self.lines: List[str] = []

    def feed(self, data: bytes) -> None:
        self._rest = (self._rest + self._decoder.decode(data)).replace("\033[K", "")
        *whole, self._rest = re.split(r"[\r\n]", self._rest)
        for line in whole:
            self._take(line)
        # A progress line has no end before the next one comes.
        progress = parse_progress(self._rest)
        if progress is not None:
            self._rest = ""
            self._tell(progress)

    def finish(self) -> List[str]:
        self._take(self._rest)
        self._rest = ""
        return self.lines

    def _take(self, line: str) -> None:
        progress = parse_progress(line)
        if progress is not None:
            self._tell(progress)
        elif line.strip():
            self.lines.append(line.rstrip())

    def _tell(self, progress: Progress) -> None:
        if self._observer is not None:
            self._observer(progress)


def _error_channel(wants_progress: bool) -> Tuple[int, int]:
    """Ends to read and to write standard error. The program tells its progress on a terminal alone,
    so it is given one where the system has any."""
    if wants_progress and sys.platform != "win32":
        import pty
        import termios

        try:
            reading, writing = pty.openpty()
        except OSError:
            return os.pipe()
        modes = termios.tcgetattr(writing)
        modes[1] &= ~termios.OPOST  # no carriage return before each line's end
        termios.tcsetattr(writing, termios.TCSANOW, modes)
        return reading, writing
    return os.pipe()


def _read(descriptor: int) -> bytes:
    try:
        return os.read(descriptor, 65536)
    except OSError:  # so a terminal tells that nobody holds its other end any more
        return b""


def _without_name(line: str) -> str:
    return line[len("howl: "):] if line.startswith("howl: ") else line


def run_program(words: Sequence[str], observer: Optional[Observer] = None) -> Completed:
    """Runs the program with these words. Ctrl-C asks it for an end in order and waits for it; a
    second one, half a second later or more, ends it at once. Both raise Interrupted."""
    reading, writing = _error_channel(observer is not None)
    try:
        # A session of its own: Ctrl-C of the terminal, or of a notebook's server, reaches Python
        # alone, and the program hears of it once.
        child = subprocess.Popen(
            [str(find_program()), *words],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=writing,
            start_new_session=True,
        )
    except BaseException:
        os.close(reading)
        raise
    finally:
        os.close(writing)
    assert child.stdout is not None
    messages = _Messages(observer)
    output = bytearray()
    asked_to_stop = False
    selector = selectors.DefaultSelector()
    try:
        selector.register(child.stdout.fileno(), selectors.EVENT_READ)
        selector.register(reading, selectors.EVENT_READ)
        while selector.get_map():
            try:
                for key, _ in selector.select():
                    data = _read(key.fd)
                    if not data:
                        selector.unregister(key.fd)
                    elif key.fd == reading:
                        messages.feed(data)
                    else:
                        output += data
            except KeyboardInterrupt:
                asked_to_stop = True
                child.send_signal(signal.SIGINT)
        status = child.wait()
    finally:
        # Here with a live child after an observer's exception alone.
        if child.poll() is None:
            child.terminate()
            child.wait()
        selector.close()
        child.stdout.close()
        os.close(reading)
    lines = messages.finish()
    if status == INTERRUPTED or asked_to_stop:
        raise Interrupted(_without_name(lines[-1]) if lines else "interrupted", lines[:-1])
    return Completed(status, output.decode("utf-8", errors="replace"), lines)

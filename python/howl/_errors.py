"""What can go wrong, as exceptions."""

from __future__ import annotations

import re
from typing import List, Optional, Sequence


class HowlError(Exception):
    """Base of all errors of this package."""


class ConfigError(HowlError, ValueError):
    """A mistake in a config or in its data.

    `file` is the config's or the data's path (None where the problem was given as arrays or as a
    dict), `line` counts from 1 (None where there is none), `key` is the place within the config
    (`experiments[1].frequency_hz`) or the column, and `message` says what is wrong and what was
    expected.
    """

    def __init__(
        self, message: str, *, file: Optional[str] = None, line: Optional[int] = None,
        key: Optional[str] = None,
    ) -> None:
        self.file = file
        self.line = line
        self.key = key
        self.message = message
        place = file or ""
        if file and line is not None:
            place += f":{line}"
        super().__init__(": ".join(part for part in (place, key, message) if part))

    def __reduce__(self) -> "tuple[object, ...]":
        return _rebuilt, (self.message, self.file, self.line, self.key)


def _rebuilt(
    message: str, file: Optional[str], line: Optional[int], key: Optional[str]
) -> ConfigError:
    return ConfigError(message, file=file, line=line, key=key)


class NegativeAnswer(HowlError):
    """The answer is no, and there is nothing more to return: none of the points asked for can be
    predicted, for instance. An empty family is a result and no error."""


class ProgramError(HowlError, RuntimeError):
    """The program howl is not there, or it failed in a way that is no user's mistake."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a computation. `notes` is what the program remarked before. Where the text says
    so, the same call goes on from what was found so far."""

    def __init__(self, text: str = "interrupted", notes: Sequence[str] = ()) -> None:
        super().__init__(text)
        self.notes = list(notes)


# A key is a path such as experiments[1].record, residuals.tau_prior or the name of a column; the
# program writes no blank after a colon within it.
_PLACE = re.compile(r"^(?:(?P<file>.+?))(?::(?P<line>\d+))?: (?P<rest>.*)$", re.DOTALL)
_KEY = re.compile(r"^(?P<key>[^\s:,\"']+): (?P<message>.*)$", re.DOTALL)


def parse_error(text: str, known_files: List[str]) -> ConfigError:
    """The exception of the program's line `file:line: key: what is wrong`.

    `known_files` are paths that the line may begin with, blanks and colons in them included.
    """
    file: Optional[str] = None
    line: Optional[int] = None
    rest = text
    for known in sorted(known_files, key=len, reverse=True):
        found = re.match(re.escape(known) + r"(?::(\d+))?: ", text)
        if found:
            file, rest = known, text[found.end():]
            line = int(found.group(1)) if found.group(1) else None
            break
    else:
        place = _PLACE.match(text)
        if place:
            file, rest = place.group("file"), place.group("rest")
            line = int(place.group("line")) if place.group("line") else None
    if file == "howl":  # a mistake in an argument: no file has it
        file = None
    found_key = _KEY.match(rest)
    if not found_key:
        return ConfigError(rest, file=file, line=line)
    return ConfigError(found_key.group("message"), file=file, line=line, key=found_key.group("key"))

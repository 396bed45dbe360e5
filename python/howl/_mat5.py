"""MATLAB's .mat version 5, uncompressed: doubles as they are in memory, all 53 bits.

This is how arrays reach the program, which maps them in without parsing text.
"""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Mapping

import numpy as np

_MI_INT8, _MI_INT32, _MI_UINT32, _MI_DOUBLE, _MI_MATRIX = 1, 5, 6, 9, 14
_MX_DOUBLE = 6
_LARGEST = 2**31 - 1024  # bytes of one variable, by the format's 32-bit sizes


def _element(kind: int, data: bytes) -> bytes:
    return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)


def write_mat5(path: Path, columns: "Mapping[str, np.ndarray]") -> None:
    """Writes each one-dimensional array as a column vector of doubles under its name."""
    with open(path, "wb") as file:
        # The header ends with the version and with the two letters that tell the order of bytes.
        file.write(b"MATLAB 5.0 MAT-file, written by howl".ljust(124))
        file.write(struct.pack("<H", 0x0100) + b"IM")
        for name, column in columns.items():
            values = np.ascontiguousarray(column, dtype="<f8")
            if values.nbytes > _LARGEST:
                raise ValueError(f"{name}: {values.size} samples, expected at most {_LARGEST // 8}")
            head = (
                _element(_MI_UINT32, struct.pack("<II", _MX_DOUBLE, 0))
                + _element(_MI_INT32, struct.pack("<ii", values.size, 1))
                + _element(_MI_INT8, name.encode("ascii"))
                + struct.pack("<II", _MI_DOUBLE, values.nbytes)
            )
            file.write(struct.pack("<II", _MI_MATRIX, len(head) + values.nbytes) + head)
            file.write(values.data)

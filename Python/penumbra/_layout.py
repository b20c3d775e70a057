# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of the classes of the installed VTK with those that the libraries of this package were compiled for.

Compiled code calls virtual functions by their positions in the table of a class, and embeds objects of the size that its
base classes had. make_layout.py records both for the classes that Penumbra uses; the libraries of the installed VTK tell
their own: the size of the table of a class is that of a symbol, and the size of its objects is in the code of New().
"""
from __future__ import annotations

import json
import mmap
import pathlib
import struct
from collections.abc import Iterator
from typing import Any

LOAD, DYNAMIC = 1, 2  # types of segments
STRINGS, SYMBOLS, HASHES = 5, 6, 0x6FFFFEF5  # tags of the dynamic segment


class Library:
    """The symbols of a shared library of 64-bit Linux, read without loading it."""

    def __init__(self, path: pathlib.Path) -> None:
        with open(path, "rb") as file:
            self.data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        if self.data[:6] != b"\x7fELF\x02\x01":
            raise ValueError(f"{path} is no library for this system")
        start, = struct.unpack_from("<Q", self.data, 32)
        size, count = struct.unpack_from("<HH", self.data, 54)
        headers = [struct.unpack_from("<IIQQQQ", self.data, start + i * size) for i in range(count)]
        self.segments: list[tuple[int, int, int]] = [(address, offset, length) for kind, _, offset, address, _, length in headers if kind == LOAD]
        dynamic = next(offset for kind, _, offset, *_ in headers if kind == DYNAMIC)
        tags = dict(self._tags(dynamic))
        self.strings, self.symbols, self.hashes = (self.offset(tags[tag]) for tag in (STRINGS, SYMBOLS, HASHES))

    def _tags(self, offset: int) -> Iterator[tuple[int, int]]:
        while True:
            tag, value = struct.unpack_from("<qQ", self.data, offset)
            if tag == 0:
                return
            yield tag, value
            offset += 16

    def offset(self, address: int) -> int:
        """Return the position in the file of an address."""
        return next(offset + address - low for low, offset, length in self.segments if low <= address < low + length)

    def find(self, name: str) -> tuple[int, int] | None:
        """Return the address and the size of a symbol that the library defines, or None."""
        wanted = name.encode() + b"\0"
        value = 5381
        for byte in wanted[:-1]:
            value = (value * 33 + byte) & 0xFFFFFFFF
        buckets, first, words = struct.unpack_from("<III", self.data, self.hashes)
        table = self.hashes + 16 + 8 * words
        index, = struct.unpack_from("<I", self.data, table + 4 * (value % buckets))
        while index >= first:
            entry, = struct.unpack_from("<I", self.data, table + 4 * (buckets + index - first))
            text, _, _, _, address, size = struct.unpack_from("<IBBHQQ", self.data, self.symbols + 24 * index)
            position = self.strings + text
            if entry | 1 == value | 1 and self.data[position:position + len(wanted)] == wanted:
                return address, size
            if entry & 1:
                break
            index += 1
        return None

    def table_size(self, name: str) -> int | None:
        """Return the size in bytes of the table of virtual functions of a class, or None without such a class."""
        symbol = self.find(f"_ZTV{len(name)}{name}")
        return symbol[1] if symbol else None

    def allocates(self, name: str, size: int) -> bool | None:
        """Return True if the method New() of a class passes a size to operator new, None if there is no such method."""
        symbol = self.find(f"_ZN{len(name)}{name}3NewEv")
        if symbol is None:
            return None
        start = self.offset(symbol[0])
        # On x86-64, mov edi, size.
        return b"\xbf" + struct.pack("<I", size) in self.data[start:start + symbol[1]]


def differences(folder: pathlib.Path, layout: dict[str, Any]) -> Iterator[str]:
    """Yield how the classes of the libraries in a folder differ from a layout."""
    for name, classes in layout["libraries"].items():
        try:
            library = Library(folder / name)
        except (OSError, ValueError, KeyError, StopIteration, struct.error):
            yield f"{name} is missing or cannot be read"
            continue
        for vtk_class, (tables, size) in classes.items():
            table = library.table_size(vtk_class)
            if table not in tables:
                functions = "no" if table is None else f"{table // 8 - 2}"
                yield (f"{vtk_class} has {functions} virtual functions instead of "
                       f"{' or '.join(str(known // 8 - 2) for known in tables)}")
            elif size is not None and not library.allocates(vtk_class, size):
                yield f"an object of {vtk_class} has not {size} bytes"


def read_layout(path: pathlib.Path) -> dict[str, Any] | None:
    """Return the layout that make_layout.py wrote for the libraries of a folder, or None if there is none."""
    try:
        layout: dict[str, Any] = json.loads((path / "layout.json").read_text())
    except FileNotFoundError:
        return None
    return layout

# SPDX-License-Identifier: BSD-3-Clause
"""Reads the ParaView files of a result folder without VTK.

Understands what our own writer leaves: .pvd, .pvtu, and .vtu with inline base64 data, zlib and
64-bit headers.
"""

import base64
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

import numpy as np

TYPES = {"Float64": np.float64, "Float32": np.float32, "Int64": np.int64, "Int32": np.int32,
         "UInt8": np.uint8}


class ReadError(Exception):
    """A file is missing, damaged, or not of the form that we write."""


def parse(path):
    try:
        return ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise ReadError(f"cannot read {path}: {error}") from error


def encoded_length(size):
    """Letters that `size` bytes take in base64."""
    return (size + 2) // 3 * 4


def decode(text):
    """The bytes of one inline array: a header with the sizes of its blocks, then the blocks."""
    text = text.strip()
    if not text:
        return b""
    count = int(np.frombuffer(base64.b64decode(text[:12])[:8], np.uint64)[0])
    header_length = encoded_length(8 * (3 + count))
    sizes = np.frombuffer(base64.b64decode(text[:header_length]), np.uint64)[3:3 + count]
    packed = base64.b64decode(text[header_length:])
    ends = np.cumsum(sizes).astype(int)
    blocks = zip(ends - sizes.astype(int), ends)
    return b"".join(zlib.decompress(packed[start:end]) for start, end in blocks)


def read_array(element):
    kind = TYPES.get(element.get("type"))
    if kind is None or element.get("format") != "binary":
        raise ReadError(f"array {element.get('Name')} has a form that is not read here")
    values = np.frombuffer(decode(element.text or ""), kind)
    components = int(element.get("NumberOfComponents") or 1)
    return values.reshape(-1, components) if components > 1 else values


def read_piece(path):
    """The arrays of one .vtu by name; with "Points", "connectivity" and "offsets"."""
    root = parse(path)
    if root.get("header_type") != "UInt64" or root.get("compressor") != "vtkZLibDataCompressor":
        raise ReadError(f"{path} was not written by this program")
    arrays = {}
    for group in root.iter("Piece"):
        for element in group.iter("DataArray"):
            arrays[element.get("Name")] = read_array(element)
    return arrays


def join(pieces):
    """One set of arrays from those of all ranks; empty ranks add nothing."""
    pieces = [piece for piece in pieces if len(piece.get("offsets", ())) > 0]
    if not pieces:
        return {}
    joined = {name: [piece[name] for piece in pieces] for name in pieces[0]}
    points = np.cumsum([0] + [len(piece["Points"]) for piece in pieces])
    corners = np.cumsum([0] + [len(piece["connectivity"]) for piece in pieces])
    joined["connectivity"] = [c + start for c, start in zip(joined["connectivity"], points)]
    joined["offsets"] = [o + start for o, start in zip(joined["offsets"], corners)]
    return {name: np.concatenate(parts) for name, parts in joined.items()}


def listed_steps(pvd):
    """(time, path of the .pvtu) for every step that a .pvd lists."""
    return [(float(entry.get("timestep")), Path(pvd).parent / entry.get("file"))
            for entry in parse(pvd).iter("DataSet")]


def read_step(pvtu):
    """The arrays of one step, all ranks joined."""
    folder = Path(pvtu).parent
    return join([read_piece(folder / piece.get("Source")) for piece in parse(pvtu).iter("Piece")])


def read_newest(pvd):
    """The arrays of the last step of a series, or {} where there is none yet."""
    if not Path(pvd).is_file():
        return {}
    steps = listed_steps(pvd)
    return read_step(steps[-1][1]) if steps else {}

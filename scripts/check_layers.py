#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks every #include of the sources against the table in scripts/layers.txt.

usage: check_layers.py [ROOT]       prints file:line: message for each violation, exit status 1
       check_layers.py --self-test  proves on a temporary tree that violations are caught
"""

import re
import sys
import tempfile
from fnmatch import fnmatchcase
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
GENERATED = {"cdca_version.hpp"}
FOLDERS = ("core", "parallel", "io", "drivers")


class TableError(Exception):
    """The table itself is wrong."""


class Table:
    """scripts/layers.txt: layers, libraries, and the folders that may use no other library."""

    def __init__(self, text):
        self.layers = {}
        self.libraries = {}
        self.only = []
        self.single = []
        for number, line in enumerate(text.splitlines(), 1):
            line = line.split("#")[0].strip()
            if not line:
                continue
            kind, _, rest = line.partition(" ")
            name, _, values = (part.strip() for part in rest.partition(":"))
            if kind == "layer":
                self.layers[name] = values.split()
            elif kind == "library":
                self.libraries[name] = values.split()
            elif kind in ("only", "single"):
                getattr(self, kind).append(name)
            else:
                raise TableError(f"layers.txt:{number}: unknown line '{line}'")
        self.expand()

    def expand(self):
        """Lets 'core' stand for every layer below core/."""
        for layer, allowed in self.layers.items():
            full = []
            for name in allowed:
                below = [other for other in self.layers if within(other, name)]
                if not below:
                    raise TableError(f"layers.txt: layer {layer} allows '{name}', which is no layer")
                full += below
            self.layers[layer] = full

    def layer_of(self, path):
        """The layer that a file (path from the top) belongs to, or None."""
        return next((layer for layer in self.layers if within(path, layer)), None)


def within(path, folder):
    return path == folder or path.startswith(folder + "/")


def matches(path, patterns):
    return any(fnmatchcase(path, pattern) for pattern in patterns)


def find_cycle(graph):
    """One circle of a graph {node: followers} as a list of nodes, or None."""
    done = set()

    def visit(node, trail):
        if node in trail:
            return trail[trail.index(node):] + [node]
        if node in done:
            return None
        for follower in sorted(graph.get(node, ())):
            cycle = visit(follower, trail + [node])
            if cycle:
                return cycle
        done.add(node)
        return None

    return next(filter(None, (visit(node, []) for node in sorted(graph))), None)


def includes_of(file):
    """(line number, name, True if quoted) of every include of a file."""
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1] or match[2], match[1] is not None


def check_own(root, table, path, name):
    """Messages for #include "name" in the file at path; the layer that it reaches, or None."""
    if name in GENERATED:
        return [], None
    layer = table.layer_of(path)
    target = table.layer_of(name)
    if target is None or not (root / name).is_file():
        return [f'"{name}" is no file of a layer; write includes from the top of the project'], None
    if target != layer and target not in table.layers[layer]:
        return [f'{layer} may not include {target} ("{name}")'], target
    return [], target


def check_library(table, path, name):
    """Messages for #include <name> in the file at path."""
    known = [pattern for pattern in table.libraries if fnmatchcase(name, pattern)]
    if any(matches(path, table.libraries[pattern]) for pattern in known):
        return []
    if known:
        return [f"<{name}> may be included by {' '.join(table.libraries[known[0]])} only"]
    is_standard = re.fullmatch(r"[a-z_]+", name) is not None
    folder = next((folder for folder in table.only if within(path, folder)), None)
    if folder and not is_standard:
        return [f"<{name}> is neither standard nor a library that {folder} may use"]
    return []


def check(root, table):
    """All messages for the tree at root, sorted."""
    messages = []
    graph = {}
    users = {pattern: {} for pattern in table.single}
    files = [file for folder in FOLDERS for file in sorted((root / folder).rglob("*"))
             if file.suffix in (".hpp", ".cpp", ".h")]
    for file in files:
        path = file.relative_to(root).as_posix()
        layer = table.layer_of(path)
        if layer is None:
            messages.append(f"{path}:1: the file is in no layer of layers.txt")
            continue
        for number, name, quoted in includes_of(file):
            found, target = (check_own(root, table, path, name) if quoted
                             else (check_library(table, path, name), None))
            messages += [f"{path}:{number}: {text}" for text in found]
            if target and target != layer:
                graph.setdefault(layer, set()).add(target)
            for pattern in table.single:
                if fnmatchcase(name, pattern):
                    users[pattern].setdefault(path.rpartition(".")[0], f"{path}:{number}")
    for pattern, places in users.items():
        messages += [f"{place}: <{pattern}> is already included by {next(iter(places))}"
                     for place in list(places.values())[1:]]
    for what, edges in (("the sources include", graph), ("layers.txt allows", table.layers)):
        cycle = find_cycle(edges)
        if cycle:
            messages.append(f"scripts/layers.txt:1: {what} a circle: {' -> '.join(cycle)}")
    return files, messages


# A file, its text, and what must be said about it (None: nothing).
SELF_TEST = (
    ("core/base/types.hpp", "#include <vector>\n#include <Eigen/Dense>\n", None),
    ("core/mesh/grid.hpp", '#include "core/base/types.hpp"\n', None),
    ("core/solver/rule.hpp", '\n#include "core/mesh/grid.hpp"\n',
     "core/solver/rule.hpp:2: core/solver may not include core/mesh"),
    ("core/base/up.hpp", '#include "core/mesh/grid.hpp"\n',
     "core/base/up.hpp:1: core/base may not include core/mesh"),
    ("core/base/near.hpp", '#include "types.hpp"\n', 'core/base/near.hpp:1: "types.hpp" is no file'),
    ("core/cells/send.cpp", "#include <mpi.h>\n", "core/cells/send.cpp:1: <mpi.h> may be included by"),
    ("core/cells/text.cpp", "#  include <fmt/format.h>\n", "core/cells/text.cpp:1: <fmt/format.h>"),
    ("core/cells/other.cpp", "#include <boost/any.hpp>\n", "core/cells/other.cpp:1: <boost/any.hpp> is neither"),
    ("core/odd/lost.hpp", "", "core/odd/lost.hpp:1: the file is in no layer"),
    ("parallel/halo.cpp", '#include <mpi.h>\n#include <metis.h>\n#include "core/mesh/grid.hpp"\n', None),
    ("parallel/rule.cpp", '#include "core/solver/rule.hpp"\n', "parallel/rule.cpp:1: parallel may not include core/solver"),
    ("io/vtk_writer.cpp", '#include <vtkNew.h>\n#include "core/mesh/grid.hpp"\n', None),
    ("io/log.cpp", "#include <vtkNew.h>\n", "io/log.cpp:1: <vtkNew.h> may be included by"),
    ("io/hdf5_checkpoint.cpp", "#include <hdf5.h>\n#include <mpi.h>\n", None),
    ("io/hdf5_other.cpp", "#include <hdf5.h>\n", "io/hdf5_other.cpp:1: <hdf5*.h> is already included by"),
    ("io/graph.cpp", "#include <metis.h>\n", "io/graph.cpp:1: <metis.h> may be included by"),
    ("drivers/main.cpp", '#include "cdca_version.hpp"\n#include "io/vtk_writer.cpp"\n#include <CLI/CLI.hpp>\n', None),
)


def self_test(table):
    """Number of cases of SELF_TEST (and of circles) that are not judged as they should be."""
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for path, text, _ in SELF_TEST:
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text, encoding="utf-8")
        _, messages = check(root, table)
    for path, _, expected in SELF_TEST:
        found = [message for message in messages if message.startswith(path + ":")]
        if len(found) != (expected is not None) or not all(text.startswith(expected) for text in found):
            wrong.append(f"{path}: expected {expected}, got {found}")
    if not any("core/base -> core/mesh -> core/base" in message for message in messages):
        wrong.append("the circle core/base -> core/mesh -> core/base was not found")
    if find_cycle({"a": ["b"], "b": ["c"], "c": []}) or not find_cycle({"a": ["b"], "b": ["a"]}):
        wrong.append("find_cycle is wrong")
    print(*wrong, sep="\n", end="\n" if wrong else "")
    return len(wrong)


def main(arguments):
    home = Path(__file__).resolve().parent
    try:
        table = Table((home / "layers.txt").read_text(encoding="utf-8"))
    except TableError as error:
        print(error)
        return 1
    if arguments[:1] == ["--self-test"]:
        wrong = self_test(table)
        print(f"self-test: {len(SELF_TEST) + 2 - wrong} of {len(SELF_TEST) + 2} as expected")
        return 1 if wrong else 0
    if arguments[:1] in (["-h"], ["--help"]):
        print(__doc__.strip())
        return 0
    root = Path(arguments[0]).resolve() if arguments else home.parent
    files, messages = check(root, table)
    if not files:
        print(f"{root}: no sources found below {' '.join(FOLDERS)}")
        return 1
    print(*messages, sep="\n", end="\n" if messages else "")
    print(f"{len(files)} files, {len(messages)} violations")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

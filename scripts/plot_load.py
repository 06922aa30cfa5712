# SPDX-License-Identifier: BSD-3-Clause
"""The load-displacement picture of a result folder, and what all pictures share."""

import csv
import os
import tomllib

import matplotlib.pyplot as plt
import numpy as np

UNITS = {1e9: "G", 1e6: "M", 1e3: "k", 1.0: "", 1e-3: "m", 1e-6: "µ"}


def prefix(size):
    """The largest power of 1000 not above a size, with its letter."""
    return next(((power, letter) for power, letter in UNITS.items() if size >= power), (1.0, ""))


def save(figure, path):
    """Writes a picture at once: who looks at it sees the old one or the new one."""
    draft = path.with_suffix(".tmp")
    figure.savefig(draft, format="png", dpi=160, bbox_inches="tight")
    plt.close(figure)
    os.replace(draft, path)
    return path


def prescribed_moves(folder):
    """{name of a support: its largest prescribed displacement per component, in metres, or None}."""
    try:
        case = tomllib.loads((folder / "effective.toml").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    moves = {}
    for block in case.get("boundary", []):
        values = block.get("displacement", ())
        if "on" in block and len(values) == 2:
            moves[block["on"]] = [v if isinstance(v, (int, float)) and v != 0 else None for v in values]
    return moves


def read_history(folder):
    with open(folder / "history.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in (rows[0] if rows else {})}


def label_of(reaction):
    """'top, y' from 'reaction_y_top'."""
    axis, support = reaction.removeprefix("reaction_").split("_", 1)
    return f"{support}, {axis}"


def driven_supports(folder, reactions):
    """{reaction: prescribed displacement in m at load factor 1} of the supports that are moved."""
    moves = prescribed_moves(folder)
    found = {}
    for name in reactions:
        support, axis = label_of(name).rsplit(", ", 1)
        move = moves.get(support, [None, None])["xy".index(axis)]
        if move is not None:
            found[name] = move
    return found


def largest_of(values):
    return np.nanmax(np.abs(values), initial=0.0)


def carries_load(history, reactions, largest_move):
    """False when the supports only hold a loaded body in place, so that reactions are rounding noise."""
    work = largest_of(history["strain_energy"])
    force = 2.0 * work / largest_move if largest_move > 0 else 0.0
    return max(map(largest_of, reactions.values()), default=0.0) > 1e-6 * force


def plot_reactions(axes, folder, history, reactions):
    driven = driven_supports(folder, reactions)
    largest = max(map(largest_of, reactions.values()))
    power, letter = prefix(largest)
    for name, values in reactions.items():
        if (driven and name not in driven) or largest_of(values) < 1e-6 * largest:
            continue
        x = history["load_factor"] * (driven[name] * 1e3 if driven else 1.0)
        axes.plot(np.append(0.0, x), np.append(0.0, values / power), "o-", ms=3, lw=1.2,
                  label=label_of(name))
    axes.set_xlabel("prescribed displacement (mm)" if driven else "load factor")
    axes.set_ylabel(f"reaction ({letter}N)")
    if axes.lines:
        axes.legend(frameon=False, fontsize=8, title="support, direction", title_fontsize=8)


def plot_energy(axes, history):
    power, letter = prefix(largest_of(history["strain_energy"]))
    axes.plot(np.append(0.0, history["load_factor"]), np.append(0.0, history["strain_energy"] / power),
              "o-", ms=3, lw=1.2)
    axes.set_xlabel("load factor")
    axes.set_ylabel(f"strain energy ({letter}J)")


def draw_load(folder, summary, path, largest_move):
    """Reactions against the displacement of moved supports, or against the load factor. Where loads act
    and supports carry nothing, the strain energy instead. None where there are not two steps yet."""
    history = read_history(folder)
    if len(history.get("step", ())) < 2:
        return None
    reactions = {name: values for name, values in history.items() if name.startswith("reaction_")}
    figure, axes = plt.subplots(figsize=(6.4, 4.6), layout="constrained")
    if carries_load(history, reactions, largest_move):
        plot_reactions(axes, folder, history, reactions)
    else:
        plot_energy(axes, history)
    axes.set_title(summary.get("title", ""), fontsize=10)
    axes.grid(alpha=0.3)
    return save(figure, path)

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Puts the result of examples/partly_closed_crack.toml beside its reference: a table, and a picture.

usage: compare_closure.py [DIR] [--docs]

DIR      its result folder; default results/partly_closed_crack
--docs   the table and the picture go into docs/partly-closed-crack.md; otherwise the table is
         printed, and the picture goes into DIR

The reference is the entry PARTIAL_H2 of tests/verification/reference/cases.json.
"""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from compare_reference import REFERENCES, TOP, Result, fill, intensities, place, save_figure  # noqa: E402
from read_vtu import ReadError, read_newest  # noqa: E402

HALF = 0.25    # m, half the crack
STRESS = 1e6   # Pa, of the load at x = HALF
TOUCHING = "#b2182b"


def reference():
    cases = json.loads((REFERENCES / "cases.json").read_text(encoding="utf-8"))["cases"]
    return next(case for case in cases if case["id"] == "PARTIAL_H2")["reference"]


def faces(folder):
    """Of every line of the crack, by x: middle (m), opening (m), traction (Pa), touching or not."""
    lines = read_newest(folder / "cracks.pvd")
    x = lines["Points"][:, 0].reshape(-1, 2)
    order = x.mean(axis=1).argsort()
    opening = lines["opening"].reshape(-1, 2)
    return x[order], opening[order], lines["normal_traction"][order], lines["contact_state"][order] != 0


def table(result, found):
    exact = reference()
    tips = {bool(place(row)[0] > 0): intensities(row) / (STRESS * np.sqrt(np.pi * HALF)) for row in result.first_tips()}
    x, opening, traction, touching = found
    closes = x[~touching].min() / HALF
    side = result.case["domain"]["size"][0] / result.case["domain"]["cells"][0] / HALF
    rows = [("$K_I$ on the right / (σ sqrt(πa))", tips[True][0], exact["FI_right"], "2 %"),
            ("$K_I$ on the left / (σ sqrt(πa))", tips[False][0], exact["FI_left"], ""),
            ("faces touch up to x/a", closes, exact["closure_point_x_over_a"], f"{1.5 * side:.3f}, 1.5 elements"),
            ("without contact: $K_I$ on the right", None, exact["FI_without_contact"], "")]
    cells = result.case["domain"]["cells"]
    lines = [f"{cells[0]} × {cells[1]} elements, {result.history[0]['contact_iterations']} contact turns, "
             f"{result.history[0]['solver_iterations']} iterations at most.", "",
             "| quantity | computed | reference | difference | allowed |", "| --- | --- | --- | --- | --- |"]
    for name, value, expected, allowed in rows:
        computed, off = ("-", "-") if value is None else (f"{value:.4f}", f"{value - expected:+.4f}")
        if value is not None and allowed.endswith("%"):
            off = f"{100 * (value / expected - 1):+.2f} %"
        lines.append(f"| {name} | {computed} | {expected:.4f} | {off} | {allowed} |")
    middle = x.mean(axis=1)
    inner = touching & (np.abs(middle) < HALF - 4 * side * HALF)
    lines += ["", f"Open faces bear {np.abs(traction[~touching]).max():.1g} Pa; touching ones {traction[inner].min() / 1e6:.3f} "
              f"to {traction[inner].max() / 1e6:.3f} MPa away from the tip; they overlap by at most "
              f"{-opening.min() / opening.max():.1g} of the largest opening."]
    return "\n".join(lines)


def draw(found, path):
    x, opening, traction, touching = found
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(7.6, 5.6), layout="constrained", sharex=True)
    upper.plot(x.ravel() / HALF, 1e6 * opening.ravel(), color="black", lw=1.2)
    upper.set_ylabel("opening (µm)")
    lower.plot(x[touching].mean(axis=1) / HALF, -traction[touching] / 1e6, ".-", color=TOUCHING, lw=0.8, label="touching faces")
    lower.set(xlabel="x / a", ylabel="pressure (MPa)")
    for axes in (upper, lower):
        axes.axvline(reference()["closure_point_x_over_a"], color="#2166ac", ls="--", lw=1.0, label="reference: faces part")
        axes.grid(alpha=0.3)
    lower.legend(fontsize=8)
    save_figure(figure, path)


def main(arguments):
    names = [a for a in arguments if not a.startswith("-")]
    options = [a for a in arguments if a.startswith("-")]
    if len(names) > 1 or options not in ([], ["--docs"]):
        print(__doc__.strip())
        return 0 if options in (["-h"], ["--help"]) else 2
    folder = Path(names[0]) if names else TOP / "results/partly_closed_crack"
    page = TOP / "docs/partly-closed-crack.md"
    try:
        found = faces(folder)
        text = table(Result(folder), found)
        if options:
            fill(page, text)
            draw(found, page.with_suffix(".png"))
        else:
            print(text)
            draw(found, folder / "comparison.png")
    except (OSError, ValueError, ReadError) as error:
        print(f"compare_closure.py: {error}", file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

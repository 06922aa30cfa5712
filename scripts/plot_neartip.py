#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/edge-crack.png and fills the tables of docs/edge-crack.md: stresses ahead of the tip of
the edge crack of the paper's section 5.1 (its Fig. 13).

usage: plot_neartip.py

Reads docs/edge-crack-*.csv, which verification_tests writes (docs/edge-crack.md says how), and the case
NEARTIP_W_20_H_52_a_12 of tests/verification/reference/cases.json.
"""

import csv
import json
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

TOP = Path(__file__).resolve().parent.parent
LOAD = 200.0  # MPa
TOLERANCE = 3.0  # % of the length of the stress, of the reference case
STYLES = [  # in the order of the runs
    dict(color="#d95f02", marker="s", markersize=5.5, linestyle="none", markerfacecolor="none"),
    dict(color="#1b7837", marker="D", markersize=4.5, linestyle="none"),
    dict(color="#2166ac", marker="none", linewidth=1.6),
]


class Run:
    """The numbers of one grid; lengths in mm, stresses relative to the load."""

    def __init__(self, path):
        lines = path.read_text().splitlines()
        notes = dict(line[2:].split(" ", 1) for line in lines if line.startswith("#"))
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        self.elements = notes["elements"].replace("x", "×")
        self.radius = float(notes["tip_radius_mm"])
        self.size = float(notes["element_mm"])
        self.k = float(notes["K_I_over_sigma"])
        self.profile = self.pick(rows, "element")
        self.points = self.pick(rows, "reference")

    @staticmethod
    def pick(rows, kind):
        """r, sigma_x, sigma_y"""
        return np.array([[float(row[c]) for c in ("r_mm", "sigma_x", "sigma_y")] for row in rows if row["kind"] == kind])

    def at(self, r):
        """(sigma_x, sigma_y) at a place of the reference, or None: nearer than two elements."""
        found = self.points[np.isclose(self.points[:, 0], r)]
        return found[0, 1:] if len(found) else None

    def name(self):
        zone = f"tip radius {self.radius:g} mm" if self.radius else "tip element only"
        return f"{self.elements}, {zone}"


def read_reference():
    cases = json.loads((TOP / "tests/verification/reference/cases.json").read_text())["cases"]
    values = next(c for c in cases if c["id"] == "NEARTIP_W_20_H_52_a_12")["reference"]
    stress = np.array([values["r_mm"], values["sx_over_sigma"], values["sy_over_sigma"]]).T
    return stress, values["K_over_sigma"]


def errors(run, reference):
    """r and the errors of both stresses in % of the length of (sigma_x, sigma_y)."""
    rows = []
    for r, *exact in reference:
        found = run.at(r)
        if found is not None:
            rows.append([r, *(100 * (found - exact) / np.hypot(*exact))])
    return np.array(rows)


def draw(runs, reference, k):
    plt.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = plt.subplots(2, 2, figsize=(10.5, 6.6), sharex=True, height_ratios=[3, 1.15])
    for side, name in enumerate(("$\\sigma_x$", "$\\sigma_y$")):
        draw_stress(axes[0, side], runs, reference, k, side, f"({'ab'[side]})  {name} ahead of the tip, MPa")
        draw_errors(axes[1, side], runs, reference, side)
    axes[1, 0].set_ylabel("error, %")
    axes[0, 0].legend(frameon=False, loc="upper right")
    figure.tight_layout(h_pad=1.2, w_pad=2.5)
    figure.savefig(TOP / "docs/edge-crack.png", dpi=150)


def draw_stress(axis, runs, reference, k, side, title):
    r = np.linspace(0.1, 8, 400)
    axis.plot(r, LOAD * k / np.sqrt(2 * np.pi * r), "--", color="0.6", linewidth=1.1, label="$K_I$ field alone")
    for run, style in sorted(zip(runs, STYLES), key=lambda pair: pair[0].size):
        axis.plot(run.profile[:, 0], LOAD * run.profile[:, 1 + side], label=run.name(), **style)
    axis.plot(reference[:, 0], LOAD * reference[:, 1 + side], "o", color="black", markersize=8,
              markerfacecolor="none", label="reference")
    axis.axhline(0, color="0.8", linewidth=0.8, zorder=0)
    axis.set_xlim(0, 8)
    low = LOAD * reference[:, 1 + side].min()
    axis.set_ylim(min(low * 1.15, -0.04 * 4200), 4200)
    axis.set_title(title, loc="left", fontsize=11)


def draw_errors(axis, runs, reference, side):
    axis.axhspan(-TOLERANCE, TOLERANCE, color="0.93", zorder=0)
    axis.axhline(0, color="0.7", linewidth=0.8, zorder=0)
    for run, style in zip(runs, STYLES):
        e = errors(run, reference)
        marker = dict(style, linestyle="-", linewidth=0.9, marker=style["marker"].replace("none", "."))
        axis.plot(e[:, 0], e[:, 1 + side], **marker)
    axis.set_ylim(-5, 5)
    axis.set_xlabel("distance from the tip, mm")


def tables(runs, reference, k):
    lines = ["| elements | element, mm | $K_I/\\sigma$, mm$^{1/2}$ | error | largest error of $\\sigma_x$, $\\sigma_y$ |",
             "| --- | --- | --- | --- | --- |",
             f"| reference | | {k:.4f} | | |"]
    for run in runs:
        e = np.abs(errors(run, reference)[:, 1:]).max()
        lines.append(f"| {run.name()} | {run.size:.3f} | {run.k:.4f} | {100 * (run.k / k - 1):+.3f} % | {e:.1f} % |")
    names = [run.name() for run in runs]
    for side, name in enumerate(("$\\sigma_x$", "$\\sigma_y$")):
        lines += ["", f"| r, mm | {name} reference | " + " | ".join(names) + " |",
                  "| --- | --- |" + " --- |" * len(runs)]
        for r, *exact in reference:
            found = [run.at(r) for run in runs]
            cells = ["" if f is None else f"{LOAD * f[side]:.1f}" for f in found]
            lines.append(f"| {r:g} | {LOAD * exact[side]:.1f} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def fill(page, text):
    """Replaces what stands between the marks."""
    old = page.read_text()
    new = re.sub(r"(<!-- numbers -->\n).*(<!-- end of numbers -->)", lambda m: f"{m[1]}\n{text}\n\n{m[2]}", old, flags=re.S)
    if "<!-- end of numbers -->" not in new:
        sys.exit(f"{page}: no marks for the tables")
    page.write_text(new)


def main():
    if len(sys.argv) > 1:
        print(__doc__.strip())
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    runs = sorted((Run(p) for p in (TOP / "docs").glob("edge-crack-*.csv")), key=lambda run: (-run.size, run.radius))
    if len(runs) != len(STYLES):
        sys.exit(f"docs/: {len(STYLES)} files edge-crack-*.csv are wanted, {len(runs)} are there")
    reference, k = read_reference()
    draw(runs, reference, k)
    fill(TOP / "docs/edge-crack.md", tables(runs, reference, k))


if __name__ == "__main__":
    main()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Puts wings of closed cracks beside their reference: tables, and pictures.

usage: compare_wings.py PAGE [RESULTS] [--docs]

PAGE     two_cracks, single_flaw or three_flaws: all cases of that page in docs/ that have results
RESULTS  folder of the result folders; default results
--docs   the tables and the pictures go into the page; otherwise the tables are printed, and the
         pictures go into RESULTS

References are entries of tests/verification/reference/cases.json and paths.json.
"""

import json
import sys
from collections import Counter
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402

from compare_reference import (GROWN, REFERENCES, TOP, Result, draw_opened, fill, intensities, nearest,  # noqa: E402
                               reference_path, save_figure)
from plot import draw_polygons, finish_axes  # noqa: E402
from read_vtu import ReadError  # noqa: E402

# case: (name on the page, and where there is one, the reference of its path and of its K_II before growth)
PAGES = {
    "two_cracks": {
        "two_cracks": ("105°", "TWO al=45 bb=105 mu=.45 ext", "TWOFLAW_a45_b105_mu0.45"),
        "two_cracks_90": ("90°", "TWO al=45 bb=90 mu=.45 ext", "TWOFLAW_a45_b90_mu0.45"),
        "two_cracks_75": ("75°", "TWO al=45 bb=75 mu=.45", "TWOFLAW_a45_b75_mu0.45"),
        "two_cracks_45": ("45°", None, "TWOFLAW_a45_b45_mu0.45"),
    },
    "single_flaw": {
        "single_flaw": ("friction 0.45", "SINGLE beta=45 mu=.45 plate60x120", "FRIC_b45_mu0.45_s30"),
        "single_flaw_unconfined": ("friction 0.3", None, "FRIC_b45_mu0.3_s30"),
        "single_flaw_confined": ("friction 0.3, confined", None, None),
    },
    "three_flaws": {
        "three_flaws": ("in a row", "THREE 3C-own-1 closed mu=.5", "THREE_3C-own-1_closed"),
        "three_flaws_echelon": ("in echelon", None, None),
    },
}


def distance(path, at):
    return np.linalg.norm(nearest(path, at) - at)


def lengths_along(path):
    return np.concatenate([[0.0], np.linalg.norm(np.diff(path, axis=0), axis=1).cumsum()])


def initial_flaws(result):
    """The straight cracks of the case, m."""
    flaws = []
    for crack in result.case["crack"]:
        if "points" in crack:
            flaws.append(np.array(crack["points"]))
            continue
        turn = np.deg2rad(crack["angle"])
        half = 0.5 * crack["length"] * np.array([np.cos(turn), np.sin(turn)])
        flaws.append(np.array([crack["center"] - half, crack["center"] + half]))
    return flaws


def wing(flaw, path, end):
    """What an end of a flaw has grown, from the old tip on; one point if nothing."""
    seen = path if end == 0 else path[::-1]
    tip = flaw[0 if end == 0 else -1]
    at = int(np.linalg.norm(seen - tip, axis=1).argmin())
    return seen[: at + 1][::-1]


def first_kink(flaw, grown, end):
    before = (flaw[1] - flaw[0]) * (1 if end else -1)
    after = grown[1] - grown[0]
    return np.rad2deg(np.arctan2(before[0] * after[1] - before[1] * after[0], before @ after))


def expected_shear(name):
    """K_II over the stress of all tips before growth, mm^1/2."""
    cases = json.loads((REFERENCES / "cases.json").read_text(encoding="utf-8"))["cases"]
    found = next(case for case in cases if case["id"] == name)["reference"]
    if "KII_plate60x120" in found:  # of one flaw, both tips
        return [found["KII_plate60x120"]] * 2
    return [pair[1] for pair in found.values()]


class Case:
    """A result with its wings, in mm from the middle of the plate."""

    def __init__(self, folder, label, reference, shear):
        self.result = Result(folder)
        self.label = label
        domain = self.result.case["domain"]
        self.middle = np.array(domain.get("origin", [0, 0])) + 0.5 * np.array(domain["size"])
        self.flaws = [1e3 * (flaw - self.middle) for flaw in initial_flaws(self.result)]
        self.paths = [1e3 * (path - self.middle) for path in self.result.cracks]
        self.wings = {(k, end): wing(flaw, self.paths[k], end)
                      for k, flaw in enumerate(self.flaws) for end in (0, 1)}
        self.entry = reference_path(reference) if reference else None
        self.shear = expected_shear(shear) if shear else None
        self.reference = [np.array(c, float) for c in self.entry["cracks"]] if reference else []

    def off_reference(self, tip, low, high):
        """Largest distance, mm, between the wing and its reference, of the points of either between
        two lengths along the wing; and up to which length there are points of both."""
        own = self.wings[tip]
        other = wing(self.flaws[tip[0]], self.reference[tip[0]], tip[1])
        ends = [lengths_along(w)[-1] for w in (own, other)]
        most = 0.0
        for points, path in ((own, other), (other, own)):
            along = lengths_along(points)
            chosen = (along >= low - 1e-9) & (along <= min(high, *ends) + 1e-9)
            most = max([most, *(distance(path, at) for at in points[chosen])])
        return most, min(high, *ends)

    def stress_at(self, step):
        return abs(self.result.tension(step)) / 1e6

    def first_growth(self):
        grown = [row for row in self.result.tips if float(row["growth"]) > 0]
        return int(grown[0]["step"]) if grown else None


# ---- tables ----


def shear_table(cases):
    """Before anything has grown."""
    lines = ["| case | crack, end | $K_{II}/\\sigma$, mm$^{1/2}$ | reference | difference | $K_I/K_{II}$ |", "| --- |" + " --- |" * 5]
    for case in cases:
        for k, row in enumerate(case.result.first_tips()):
            k1, k2 = intensities(row) / abs(case.result.tension(1)) * np.sqrt(1e3)
            exact = case.shear[k] if case.shear else None
            known = f"{exact:.4f} | {100 * (k2 / exact - 1):+.2f} %" if case.shear else "- | -"
            lines.append(f"| {case.label} | {row['crack']}, {row['end']} | {k2:.4f} | {known} | {k1 / k2:.3f} |")
    return [*lines, ""]


def wing_table(cases):
    lines = ["| case | crack, end | length, mm | first kink | reference strict to, mm | largest distance, mm | allowed, mm "
             "| beyond it, to mm | largest distance, mm |", "| --- |" + " --- |" * 8]
    for case in cases:
        for tip, grown in case.wings.items():
            cells = [case.label, f"{tip[0]}, {tip[1]}", f"{lengths_along(grown)[-1]:.2f}",
                     f"{first_kink(case.flaws[tip[0]], grown, tip[1]):.1f}°" if len(grown) > 1 else "-"]
            if case.entry and len(grown) > 1:
                strict = case.entry["valid_wing_length"]
                near, far = case.off_reference(tip, 0, strict), case.off_reference(tip, strict, 1e9)
                cells += [f"{near[1]:.4g}", f"{near[0]:.2f}", f"{case.entry['path_tolerance']:g}"]
                cells += [f"{far[1]:.1f}", f"{far[0]:.2f}"] if far[1] > strict else ["-", "-"]
            else:
                cells += ["-"] * 5
            lines.append("| " + " | ".join(cells) + " |")
    return lines


def run_table(cases):
    """How the runs went; loads are stresses on the top."""
    lines = ["", "| case | first growth at, MPa | load steps | stress at the end, MPa | end | joins "
             "| contact turns in a step, typical and most | most iterations of a solve | off half a turn, mm | time, s |",
             "| --- |" + " --- |" * 9]
    for case in cases:
        history, summary = case.result.history, case.result.summary
        kinds = Counter(event["kind"] for event in summary["events"] if event["step"] > 0)
        solves = [int(row["contact_iterations"]) for row in history]
        first = case.first_growth()
        points = np.concatenate(case.paths)
        turned = np.linalg.norm(points[:, None] + points[None], axis=2).min(axis=1).max()
        lines.append(" | ".join([
            f"| {case.label}", f"{case.stress_at(first):.4f}" if first else "-", str(len(history)),
            f"{case.stress_at(len(history)):.3f}", summary["status"],
            ", ".join(f"{n} {kind}" for kind, n in sorted(kinds.items())) or "none",
            f"{np.median(solves):.0f}, {max(solves)}", str(max(int(row["solver_iterations"]) for row in history)),
            f"{turned:.1g}", f"{summary['performance']['wall_s']:.0f} |"]))
    return lines


def approach_table(cases):
    """How near the wings come to the other cracks."""
    lines = ["", "| case | crack, end | nearest it comes to another crack, mm | to its | at, mm from the middle |", "| --- |" + " --- |" * 4]
    for case in cases:
        for tip, grown in case.wings.items():
            if len(grown) < 2 or len(case.paths) < 2:
                continue
            others = [k for k in range(len(case.paths)) if k != tip[0]]
            gap, k, at = min((distance(case.paths[k], at), k, tuple(at)) for k in others for at in grown)
            if at == tuple(grown[0]):  # it only goes away
                continue
            foot = nearest(case.paths[k], np.array(at))
            on_flaw = distance(case.flaws[k], foot) < 1e-3
            lines.append(f"| {case.label} | {tip[0]}, {tip[1]} | {gap:.2f} | {'face' if on_flaw else 'wing'} "
                         f"| ({at[0]:.2f}, {at[1]:.2f}) |")
    return lines if len(lines) > 3 else []


def length_table(cases):
    """Length of a wing, mm, over the stress on the top, where the load steps are given."""
    given = [case for case in cases if case.result.case["loading"].get("mode") != "critical"]
    if not given:
        return []
    lines = ["", "| stress, MPa | " + " | ".join(f"wing, mm: {case.label}" for case in given) + " |", "| --- |" + " --- |" * len(given)]
    last = min(len(case.result.history) for case in given)
    for step in sorted({*range(1, last + 1, 4), last}):
        cells = []
        for case in given:
            old = sum(lengths_along(flaw)[-1] for flaw in case.flaws)
            grown = 1e3 * float(case.result.history[step - 1]["crack_length"]) - old
            cells.append(f"{round(grown / len(case.wings), 2) + 0.0:.2f}")
        lines.append(f"| {given[0].stress_at(step):.1f} | " + " | ".join(cells) + " |")
    return lines


def tables(cases):
    size = cases[0].result.case["domain"]["cells"]
    lines = [f"{size[0]} × {size[1]} elements.", "", *shear_table(cases), *wing_table(cases), *run_table(cases),
             *length_table(cases), *approach_table(cases)]
    return "\n".join(lines)


# ---- picture ----


def draw_case(axes, case, window):
    body = case.result.body
    draw_polygons(axes, body, body.points)
    old = body.ages <= 0
    axes.add_collection(LineCollection(body.lines[old], colors="black", linewidths=1.8, label="at the start"))
    axes.add_collection(LineCollection(body.lines[~old], colors=GROWN, linewidths=1.4, label="grown"))
    move = case.middle * body.scale
    if case.reference:
        points = np.concatenate(case.reference) * body.scale / 1e3 + move
        axes.plot(*points.T, "o", ms=2.4, mfc="none", mec="#d62728", mew=0.7, label="reference")
    finish_axes(axes, body, body.low, body.high, case.label)
    low, high = window * body.scale / 1e3 + move
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))


def draw(cases, path):
    """One panel per case, all with the same part of the plate."""
    reach = np.concatenate([p for case in cases for p in [*case.paths, *case.reference]])
    window = np.array([reach.min(axis=0), reach.max(axis=0)])
    margin = 0.08 * (window[1] - window[0]).max()
    window += margin * np.array([[-1, -1], [1, 1]])
    wide, high = window[1] - window[0]
    height = min(8.0, 12.0 / len(cases) * high / wide)  # of a panel, inches
    figure, panels = plt.subplots(1, len(cases), figsize=(len(cases) * (height * wide / high + 0.5), height + 0.8),
                                  layout="constrained", squeeze=False, sharey=True)
    for axes, case in zip(panels[0], cases):
        draw_case(axes, case, window)
        axes.label_outer()
    panels[0][0].legend(loc="upper left", fontsize=7)
    save_figure(figure, path)


def draw_shape(case, path):
    """The loaded plate at the end of a run."""
    shape = case.result.opened.high - case.result.opened.low
    figure, axes = plt.subplots(figsize=(7.0 * shape[0] / shape[1] + 2.8, 7.2), layout="constrained")
    draw_opened(figure, axes, case.result.opened)
    save_figure(figure, path)


def main(arguments):
    names = [a for a in arguments if not a.startswith("-")]
    options = [a for a in arguments if a.startswith("-")]
    if not 1 <= len(names) <= 2 or names[0] not in PAGES or options not in ([], ["--docs"]):
        print(__doc__.strip())
        return 0 if options in (["-h"], ["--help"]) else 2
    folder = Path(names[1]) if len(names) == 2 else TOP / "results"
    page = TOP / "docs" / (names[0].replace("_", "-") + ".md")
    try:
        cases = [Case(folder / name, *about) for name, about in PAGES[names[0]].items() if (folder / name / "summary.json").exists()]
        if not cases:
            raise ValueError(f"{folder}: no results of {', '.join(PAGES[names[0]])}")
        text = tables(cases)
        if options:
            fill(page, text)
            draw(cases, page.with_suffix(".png"))
            draw_shape(cases[0], page.with_name(page.stem + "-opened.png"))
        else:
            print(text)
            draw(cases, folder / f"{names[0]}.png")
            draw_shape(cases[0], folder / f"{names[0]}-opened.png")
    except (OSError, ValueError, ReadError) as error:
        print(f"compare_wings.py: {error}", file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

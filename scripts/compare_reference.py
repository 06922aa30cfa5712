#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Puts the result of an example beside its reference: tables, and a picture.

usage: compare_reference.py EXAMPLE [DIR] [--docs]

EXAMPLE  slanted_crack, offset_cracks, t_crack, y_crack, ten_cracks, hundred_cracks,
         percolation_tension or percolation_compression
DIR      its result folder; default results/EXAMPLE
--docs   the tables and the picture go into the page of the example in docs/; otherwise the tables
         are printed, and the picture goes into DIR

References are entries of tests/verification/reference/cases.json and paths.json.
"""

import csv
import io
import json
import re
import sys
import tomllib
from collections import Counter
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.colors import Normalize  # noqa: E402
from PIL import Image  # noqa: E402

from plot import Body, draw_growth, draw_polygons, face_edges, finish_axes, magnification, stress_scale  # noqa: E402
from plot_load import prefix  # noqa: E402
from read_vtu import ReadError, listed_steps, read_step  # noqa: E402

TOP = Path(__file__).resolve().parent.parent
REFERENCES = TOP / "tests/verification/reference"
GROWN = "#2166ac"
MIRROR_X, MIRROR_Y, HALF_TURN = (-1, 1), (1, -1), (-1, -1)

# tips, path: names of the references; unit: m of one length unit of the reference; every: so many points
# of a path make a row; symmetry: signs of x and y; ages: colours tell when a crack grew
EXAMPLES = {
    "slanted_crack": dict(path="SLANT W=1 H=2 a=.15 beta=45", unit=1.0, every=2, symmetry=HALF_TURN),
    "offset_cracks": dict(path="EDGES 40x40 a=8 e=1 (Sumi-Wang)", unit=1e-3, every=2, symmetry=HALF_TURN),
    "t_crack": dict(tips="T_junction_plate_4x4_horizontal_-1..1_vertical_.8_biaxial", unit=0.01, symmetry=MIRROR_X),
    "y_crack": dict(tips="Y_plate_8x8_main_2_branches_1_at_-45_uniaxial_y", unit=0.01, symmetry=MIRROR_Y),
    "ten_cracks": dict(tips="BUDYN10_uniaxial", unit=0.1, ages=True),
    "hundred_cracks": dict(ages=True, totals=True),
    "percolation_tension": dict(ages=True, totals=True),
    "percolation_compression": dict(ages=True, totals=True),
}


class Result:
    """What a run has left in its folder."""

    def __init__(self, folder):
        self.summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        self.case = tomllib.loads((folder / "effective.toml").read_text(encoding="utf-8"))
        self.tips = read_rows(folder / "tips.csv")
        self.history = read_rows(folder / "history.csv")
        self.cracks = [np.array(crack["points"]) for crack in self.summary["cracks"]]
        fields, cracks = (listed_steps(folder / f"{name}.pvd") for name in ("fields", "cracks"))
        self.body = Body(read_step(fields[-1][1]), read_step(cracks[-1][1]))
        self.opened = self.body
        if self.summary["status"] == "separated" and len(fields) > 1:  # nothing is loaded any more
            self.opened = Body(read_step(fields[-2][1]), read_step(cracks[-2][1]))

    def tension(self, step):
        """The traction in y on the top in a load step, Pa."""
        top = next(block for block in self.case["boundary"] if block.get("on") == "top")
        factor = float(self.history[step - 1]["load_factor"])
        value = top["traction"][1]
        return float(eval(value, {}, {"s": factor})) if isinstance(value, str) else factor * value

    def first_tips(self):
        """The rows of tips.csv before anything has grown."""
        return [row for row in self.tips if row["step"] == "1" and row["cycle"] == "0"]


def read_rows(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def place(row):
    return np.array([float(row["x"]), float(row["y"])])


def intensities(row):
    return np.array([float(row["K_I"]), float(row["K_II"])])


# ---- tables ----


def expected_tips(name, unit):
    """[(place in m, (K_I, K_II) per stress in mm^1/2)] of a case of cases.json."""
    cases = json.loads((REFERENCES / "cases.json").read_text(encoding="utf-8"))["cases"]
    tips = []
    for key, value in next(case for case in cases if case["id"] == name)["reference"].items():
        at = np.array(re.search(r"\[(.*)\]", key)[1].split(","), float)
        pair = (value["KI"], value["KII"]) if isinstance(value, dict) else value
        tips.append((at * unit, np.array(pair) * np.sqrt(1e3 * unit)))
    return tips


def k_equal(k):
    """The K_I that has the same greatest hoop stress alone: which tip grows first."""
    half = np.arctan2(-2 * k[1], k[0] + np.hypot(k[0], np.sqrt(8) * k[1]))  # of the direction of growth
    return np.cos(half) ** 2 * (k[0] * np.cos(half) - 3 * k[1] * np.sin(half))


def tip_table(result, expected):
    names = ["$K_I/\\sigma$", "$K_{II}/\\sigma$", "$K_{eq}/\\sigma$"]
    lines = ["| crack, tip at, mm | " + " | ".join(f"{name} | reference | difference" for name in names) + " |",
             "| --- |" + " --- |" * 9]
    worst = 0.0
    for row in result.first_tips():
        at, k = place(row), intensities(row) / result.tension(1) * np.sqrt(1e3)
        exact = min(expected, key=lambda tip: np.linalg.norm(tip[0] - at))[1]
        off = 100 * (k - exact) / np.linalg.norm(exact)
        worst = max(worst, np.abs(off).max())
        cells = [f"{number(k[i])} | {number(exact[i])} | {round(off[i], 2) + 0.0:+.2f} %" for i in (0, 1)]
        equal, exact_equal = k_equal(k), k_equal(exact)
        cells.append(f"{number(equal)} | {number(exact_equal)} | {100 * (equal / exact_equal - 1):+.2f} %")
        lines.append(f"| {row['crack']}, ({1e3 * at[0]:.5g}, {1e3 * at[1]:.5g}) | " + " | ".join(cells) + " |")
    return [*lines, "", f"Largest difference of $K_I$ and $K_{{II}}$: {worst:.2f} %."]


def number(value):
    return f"{round(value, 3) + 0.0:.3f}"


def reference_path(name):
    return json.loads((REFERENCES / "paths.json").read_text(encoding="utf-8"))["paths"][name]


def nearest(path, at):
    """The point of a polyline nearest to a place."""
    a, d = path[:-1], np.diff(path, axis=0)
    t = np.clip(((at - a) * d).sum(axis=1) / (d * d).sum(axis=1), 0, 1)
    feet = a + t[:, None] * d
    return feet[np.linalg.norm(feet - at, axis=1).argmin()]


def kink_rows(result, entry, unit):
    """Intensities before growth, and directions of the first growth."""
    lines = ["| tip | quantity | computed | reference | difference |", "| --- | --- | --- | --- | --- |"]
    for key, exact in entry["K0"].items():
        crack, end = re.findall(r"\d+", key)
        row = next(r for r in result.first_tips() if (r["crack"], r["end"]) == (crack, end))
        exact = np.array(exact) * np.sqrt(1e3 * unit)
        found = intensities(row) / result.tension(1) * np.sqrt(1e3)
        at = "({:.5g}, {:.5g}) mm".format(*1e3 * place(row))
        for name, k, e in zip(("$K_I/\\sigma$, mm$^{1/2}$", "$K_{II}/\\sigma$, mm$^{1/2}$"), found, exact):
            lines.append(f"| {at} | {name} | {k:.4f} | {e:.4f} | {100 * (k - e) / np.linalg.norm(exact):+.2f} % |")
        angle = float(row["angle_deg"])
        lines.append(f"| {at} | first turn | {angle:.2f}° | {entry['mts0'][key]:.2f}° | {angle - entry['mts0'][key]:+.2f}° |")
    return lines


def path_table(result, entry, unit, every):
    lines = ["", "| crack | reference, mm | computed, mm | distance, mm |", "| --- | --- | --- | --- |"]
    distances = []
    for index, (path, points) in enumerate(zip(result.cracks, np.array(entry["cracks"]) * unit)):
        shown = set(range(1, len(points), every)) | {len(points) - 1}
        for k, at in enumerate(points):
            foot = nearest(path, at)
            distances.append(1e3 * np.linalg.norm(foot - at))
            if k in shown:
                lines.append(f"| {index} | ({1e3 * at[0]:.2f}, {1e3 * at[1]:.2f}) | ({1e3 * foot[0]:.2f}, {1e3 * foot[1]:.2f}) "
                             f"| {distances[-1]:.3f} |")
    tolerance = 1e3 * unit * entry["path_tolerance"]
    return [*lines, "", f"Largest distance of all {len(distances)} points of the reference from the computed path: "
            f"{max(distances):.3f} mm; allowed are {tolerance:g} mm."]


def symmetry_line(result, signs):
    points = np.concatenate(result.cracks)
    image = points * signs
    off = np.linalg.norm(points[:, None] - image[None], axis=2).min(axis=1).max()
    name = {MIRROR_X: "x → -x", MIRROR_Y: "y → -y", HALF_TURN: "(x, y) → (-x, -y)"}[signs]
    return ["", f"Corners of the grown cracks and their images under {name} differ by at most {1e3 * off:.1g} mm."]


def growth_lines(result):
    """Which tips grew first, and how far all came."""
    grown = [row for row in result.tips if float(row["growth"]) > 0]
    if not grown:
        return []
    first = grown[0]
    same = [r for r in grown if (r["step"], r["cycle"]) == (first["step"], first["cycle"])]
    names = "; ".join("crack {} at ({:.5g}, {:.5g}) mm".format(r["crack"], *1e3 * place(r)) for r in same)
    step = int(first["step"])
    old = result.body.lines[result.body.ages <= 0]
    at_start = np.linalg.norm(old[:, 1] - old[:, 0], axis=1).sum() / result.body.scale
    lengths = 1e3 * at_start, 1e3 * float(result.history[-1]["crack_length"])
    lines = ["", "| growth | |", "| --- | --- |", f"| first | {names} |"]
    if "traction" in str(result.case["boundary"]):
        k = 1 / max(float(r["U_tension"]) for r in result.first_tips())
        lines.append(f"| possible from | {k * result.tension(1) / 1e6:.3f} MPa |")
    lines += [f"| first growth in step | {step} |", f"| steps | {len(result.history)} |",
              f"| length of all cracks | {lengths[0]:.1f} mm, at the end {lengths[1]:.1f} mm |",
              f"| end | {result.summary['status']} |"]
    return lines


def friction_lines(result):
    """Where faces may touch: work of friction, linear solves."""
    if "contact" not in result.case:
        return []
    solves = [int(row["contact_iterations"]) for row in result.history]
    return [f"| of it, on friction | {float(result.history[-1]['friction_work']):.4g} J |",
            f"| contact turns in a step: typical, most | {np.median(solves):.0f}, {max(solves)} |",
            f"| most iterations of a solve | {max(int(row['solver_iterations']) for row in result.history)} |"]


def total_lines(result):
    """What became of many cracks; energies step by step."""
    count = Counter(event["kind"] for event in result.summary["events"] if event["step"] > 0)
    spent = np.array([float(row["dissipated"]) for row in result.history])
    work = np.array([float(row["external_work"]) for row in result.history])
    forces = np.array([float(row["reaction_y_top"]) for row in result.history])
    numbers = [float(row[name]) for row in result.tips for name in ("x", "y", "K_I", "K_II")]
    k = int(np.abs(forces).argmax())
    network = result.summary["network"]
    lines = ["", "| over the whole run | |", "| --- | --- |"]
    lines += [f"| events: {kind} | {times} |" for kind, times in sorted(count.items())]
    lines += [f"| largest force on the top | {forces[k] / 1e3:.1f} kN in step {k + 1} |",
              f"| work of the top | {work[-1]:.4g} J |",
              f"| spent on {'friction and ' * ('contact' in result.case)}new cracks | {spent[-1]:.4g} J |",
              *friction_lines(result),
              f"| least spent in one step | {np.diff(spent, prepend=0.0).min():.2g} J |",
              f"| numbers in tips.csv that are not finite | {int((~np.isfinite(numbers)).sum())} of {len(numbers)} |",
              f"| groups of connected cracks | {network['clusters']} |",
              f"| largest group | {1e3 * network['largest']:.1f} mm, from side to side: {'yes' if network['spans_x'] else 'no'} |",
              f"| time | {result.summary['performance']['wall_s']:.0f} s |"]
    return lines


def tables(result, example):
    lines = [f"{result.case['domain']['cells'][0]} × {result.case['domain']['cells'][1]} elements, "
             f"{result.summary['ranks']} rank{'s' * (result.summary['ranks'] > 1)}.", ""]
    if "tips" in example:
        lines += tip_table(result, expected_tips(example["tips"], example["unit"]))
    if "path" in example:
        entry = reference_path(example["path"])
        lines += kink_rows(result, entry, example["unit"])
        lines += path_table(result, entry, example["unit"], example["every"])
    lines += growth_lines(result)
    if "symmetry" in example:
        lines += symmetry_line(result, example["symmetry"])
    if "totals" in example:
        lines += total_lines(result)
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines))


# ---- picture ----


def draw_cracks(figure, axes, result, example):
    body = result.body
    draw_polygons(axes, body, body.points)
    old = body.ages <= 0
    axes.add_collection(LineCollection(body.lines[old], colors="black", linewidths=1.6, label="at the start"))
    if "ages" in example:
        if not old.all():
            draw_growth(figure, axes, body, ~old)
    else:
        axes.add_collection(LineCollection(body.lines[~old], colors=GROWN, linewidths=1.6, label="grown"))
    if "path" in example:
        points = np.concatenate([np.array(c) for c in reference_path(example["path"])["cracks"]]) * example["unit"]
        axes.plot(*(points * body.scale).T, "o", ms=4, mfc="none", mec="#d62728", mew=0.9, label="reference")
    if len(result.cracks) <= 10 and "ages" in example:
        for index, crack in enumerate(result.case["crack"]):
            ends = np.array(crack["points"]) * body.scale
            across = np.array([ends[0, 1] - ends[-1, 1], ends[-1, 0] - ends[0, 0]])
            axes.annotate(str(index), ends.mean(axis=0), xytext=10 * across / np.linalg.norm(across),
                          textcoords="offset points", ha="center", va="center", fontsize=9)
    finish_axes(axes, body, body.low, body.high, "cracks")
    axes.legend(loc="upper left", fontsize=8)


def draw_opened(figure, axes, body):
    factor = magnification(body)
    points = body.points + factor * body.moves
    power, letter = prefix(stress_scale(body.stress))
    top = stress_scale(body.stress) / power
    drawn = draw_polygons(axes, body, points, body.stress / power, cmap="coolwarm", norm=Normalize(-top, top))
    axes.add_collection(LineCollection(face_edges(body, points), colors="black", linewidths=0.6))
    finish_axes(axes, body, points.min(axis=0), points.max(axis=0), f"opened, displacements × {factor:g}")
    figure.colorbar(drawn, ax=axes, extend="both", label=f"larger principal stress ({letter}Pa)", shrink=0.8)


def draw(result, example, path):
    """Two panels; the first one looks closely at a path where there is a reference for it."""
    shape = result.body.high - result.body.low
    closer = "path" in example
    stacked = closer and shape[1] < 1.5 * shape[0]
    figure, (first, second) = plt.subplots(
        *((2, 1) if stacked else (1, 2)), figsize=(7.6, 9.4) if stacked else (11.0, 5.4), layout="constrained",
        height_ratios=[1, 2] if stacked else None)
    draw_cracks(figure, first, result, example)
    if closer:
        points = np.concatenate(result.cracks) * result.body.scale
        low, high = points.min(axis=0), points.max(axis=0)
        margin = 0.06 * (high - low)
        first.set(aspect="auto", xlim=(low[0] - margin[0], high[0] + margin[0]),
                  ylim=(low[1] - margin[1], high[1] + margin[1]))
        first.set_title("cracks (part of the plate, y stretched)", fontsize=10)
    draw_opened(figure, second, result.opened)
    save_figure(figure, path)


def save_figure(figure, path):
    """With 256 colours: less than half of the bytes."""
    picture = io.BytesIO()
    figure.savefig(picture, dpi=100)
    plt.close(figure)
    image = Image.open(picture).convert("RGB")
    palette = image.quantize(256, Image.Quantize.MAXCOVERAGE)
    image.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG).save(path, format="png", optimize=True)


def fill(page, text):
    """Replaces what stands between the marks."""
    old = page.read_text(encoding="utf-8")
    new = re.sub(r"(<!-- numbers -->\n).*(<!-- end of numbers -->)", lambda m: f"{m[1]}\n{text}\n\n{m[2]}", old, flags=re.S)
    if "<!-- end of numbers -->" not in new:
        raise ValueError(f"{page}: no marks for the tables")
    page.write_text(new, encoding="utf-8")


def main(arguments):
    names = [a for a in arguments if not a.startswith("-")]
    options = [a for a in arguments if a.startswith("-")]
    if not 1 <= len(names) <= 2 or names[0] not in EXAMPLES or options not in ([], ["--docs"]):
        print(__doc__.strip())
        return 0 if options in (["-h"], ["--help"]) else 2
    example = EXAMPLES[names[0]]
    folder = Path(names[1]) if len(names) == 2 else TOP / "results" / names[0]
    page = TOP / "docs" / (names[0].replace("_", "-") + ".md")
    try:
        result = Result(folder)
        text = tables(result, example)
        if options:
            fill(page, text)
            draw(result, example, page.with_suffix(".png"))
        else:
            print(text)
            draw(result, example, folder / "comparison.png")
    except (OSError, ValueError, ReadError) as error:
        print(f"compare_reference.py: {error}", file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of a result folder, also while the run is still going.

usage: plot.py DIR

opened.png             specimen and cracks; beside them the opened shape with its stress
crack_paths.png        the cracks over the specimen, coloured by the load step in which they grew
load_displacement.png  reactions of the supports (or the strain energy, where loads act and supports
                       carry nothing), when there are at least two load steps
"""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize  # noqa: E402

from plot_load import draw_load, prefix, save  # noqa: E402
from read_vtu import ReadError, read_newest  # noqa: E402

MANY_POLYGONS = 300_000  # beyond this they are smaller than the picture's points: drawn as an image
SPECIMEN = "#dfe3e8"
TIP = "#d62728"


class Body:
    """Polygons and crack lines of one step, lengths in a unit that suits the specimen."""

    def __init__(self, fields, cracks):
        points = fields["Points"][:, :2]
        self.low = points.min(axis=0)
        self.high = points.max(axis=0)
        self.scale, self.unit = length_unit((self.high - self.low).max())
        self.points = points * self.scale
        self.moves = fields["displacement"][:, :2] * self.scale
        # splinters that nothing holds may be anywhere: they are drawn where they were
        self.moves[~ordinary(np.linalg.norm(self.moves - self.moves.mean(axis=0), axis=1))] = 0.0
        self.low, self.high = self.low * self.scale, self.high * self.scale
        self.size = (self.high - self.low).max()
        self.corners = fields["connectivity"]
        self.ends = fields["offsets"]
        self.counts = np.diff(self.ends, prepend=0)
        self.stress = fields["principal_stress"][:, 0]
        self.cut = fields["kind"] != 0
        self.lines = cracks["Points"][:, :2].reshape(-1, 2, 2) * self.scale if cracks else np.empty((0, 2, 2))
        self.ages = cracks["age"] if cracks else np.empty(0, int)
        openings = np.abs(cracks["opening"]) * self.scale if cracks else np.empty(0)
        self.opening = openings[ordinary(openings)].max(initial=0.0)

    def groups(self):
        """(polygon numbers, their corners) for all polygons of the same number of corners."""
        starts = self.ends - self.counts
        for count in np.unique(self.counts):
            chosen = np.flatnonzero(self.counts == count)
            yield chosen, self.corners[starts[chosen][:, None] + np.arange(count)]


def ordinary(values):
    """Which values are not far beyond nearly all of them."""
    top = np.percentile(values, 98) if len(values) else 0.0
    return values <= 5 * top if top > 0 else np.ones(len(values), bool)


def length_unit(size):
    """(factor from metres, name) that makes numbers between about 1 and 1000."""
    return (1e3, "mm") if size < 1.0 else (1.0, "m")


def nice_below(value):
    """The largest of 1, 2, 5, 10, 20, ... that is not above a value."""
    power = 10.0 ** np.floor(np.log10(value))
    return max(step * power for step in (1, 2, 5) if step * power <= value * (1 + 1e-9))


def magnification(body):
    """A round factor that shows the opening and keeps the shape recognisable."""
    moves = np.linalg.norm(body.moves - body.moves.mean(axis=0), axis=1).max(initial=0.0)
    limits = [0.08 * body.size / moves] if moves > 0 else []
    if body.opening > 0:
        limits.append(0.05 * body.size / body.opening)
    return nice_below(min(limits)) if limits else 1.0


def stress_scale(stress):
    """Limits symmetric about zero that leave out the few largest values, next to the tips."""
    finite = np.abs(stress[np.isfinite(stress)])
    top = np.percentile(finite, 98) if len(finite) else 0.0
    return top if top > 0 else 1.0


def draw_polygons(axes, body, points, values=None, **style):
    """Fills the polygons; returns what a colour bar needs."""
    if len(body.counts) > MANY_POLYGONS:
        return draw_image(axes, body, points, values, **style)
    drawn = None
    for chosen, corners in body.groups():
        drawn = PolyCollection(points[corners], array=None if values is None else values[chosen],
                               linewidths=0.3, **style)
        if values is None:
            drawn.set_facecolor(SPECIMEN)
            drawn.set_edgecolor(SPECIMEN)
        else:
            drawn.set_edgecolor("face")
        drawn.set_rasterized(True)
        axes.add_collection(drawn)
    return drawn


def draw_image(axes, body, points, values, cmap=None, norm=None):
    """As draw_polygons for very many: the mean of the polygons whose middle lies in each picture point."""
    middles = np.empty((len(body.counts), 2))
    for chosen, corners in body.groups():
        middles[chosen] = points[corners].mean(axis=1)
    low, high = points.min(axis=0), points.max(axis=0)
    # Half as many picture points as polygons, so that hardly any lies between the middles.
    width = np.sqrt(2.0 * np.prod(body.high - body.low) / len(body.counts))
    bins = np.maximum(((high - low) / width).astype(int), 1)
    box = [[low[0], high[0]], [low[1], high[1]]]
    counts = np.histogram2d(*middles.T, bins=bins, range=box)[0]
    sums = np.histogram2d(*middles.T, bins=bins, range=box, weights=values)[0]
    picture = np.ma.masked_invalid(np.where(counts > 0, sums / np.maximum(counts, 1), np.nan))
    return axes.imshow(picture.T, origin="lower", extent=np.ravel(box), norm=norm,
                       cmap=cmap or ListedColormap([SPECIMEN]), interpolation="nearest")


def place_keys(body, xy):
    """One whole number for every place, the same for points that differ by rounding only."""
    columns = np.floor((xy - body.low) / (1e-6 * body.size) + 0.317).astype(np.int64)
    return columns[..., 0] * 2_000_003 + columns[..., 1]


def face_edges(body, points):
    """The edges of polygons that lie on crack lines: both faces of every crack, where they are now."""
    line_keys = place_keys(body, body.lines)
    on_crack = {tuple(sorted(pair)) for pair in line_keys.tolist()}
    keys = place_keys(body, body.points)
    touching = np.isin(keys, line_keys)
    edges, found = [], set()
    for _, corners in body.groups():
        for polygon in corners[touching[corners].sum(axis=1) > 1]:
            for a, b in zip(polygon, np.roll(polygon, -1)):
                pair = tuple(sorted((int(keys[a]), int(keys[b]))))
                if pair in on_crack:
                    edges.append(points[[a, b]])
                    found.add(pair)
    lost = [tuple(sorted(pair)) not in found for pair in line_keys.tolist()]
    return edges + middle_lines(body, points, body.lines[lost])


def middle_lines(body, points, lines):
    """Lines moved with the points of cut polygons nearest to their ends, averaged over the faces."""
    near = np.unique(np.concatenate([corners[body.cut[chosen]].ravel() for chosen, corners in body.groups()]))
    if len(near) * len(lines) > 1e8 or not len(near):
        return list(lines)  # too many to search, or none cut
    moved = []
    for line in lines:
        ends = []
        for end in line:
            distance = np.linalg.norm(body.points[near] - end, axis=1)
            close = near[distance <= distance.min() + 1e-9 * body.size]
            ends.append(end + (points[close] - body.points[close]).mean(axis=0))
        moved.append(np.array(ends))
    return moved


def finish_axes(axes, body, low, high, title):
    margin = 0.03 * body.size
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_aspect("equal")
    axes.set_xlabel(f"x ({body.unit})")
    axes.set_ylabel(f"y ({body.unit})")
    axes.set_title(title, fontsize=10)


def is_wide(extent):
    return extent[0] > 1.3 * extent[1]


def panels(extent, count):
    """A figure with panels of the body's shape: side by side for tall bodies, else one below the other."""
    wide = is_wide(extent)
    height = 7.0 if not wide else max(2.8, 7.0 * extent[1] / extent[0] + 1.2)
    width = 9.0 if wide else 5.4 * extent[0] / extent[1] + 1.6
    rows, columns = (count, 1) if wide else (1, count)
    return plt.subplots(rows, columns, figsize=(max(columns * width, 5.0), rows * height), layout="constrained")


def draw_tips(axes, body, tips):
    active = np.array([[tip["x"], tip["y"]] for tip in tips if tip["state"] == "active"])
    if len(active):
        axes.plot(*(active * body.scale).T, "o", ms=3.5, mfc="none", mec=TIP, label="active tip")


def state_of(summary):
    """'load factor 0.3, step 3' of what the pictures show."""
    steps = summary.get("steps", [])
    text = f"load factor {summary.get('load_factor', 0.0):.4g}"
    return text + (f", step {steps[-1]['step']}" if steps else "")


def draw_opened(body, summary, path):
    factor = magnification(body)
    points = body.points + factor * body.moves
    low = np.minimum(points.min(axis=0), body.low)
    high = np.maximum(points.max(axis=0), body.high)
    figure, (first, second) = panels(high - low, 2)
    draw_polygons(first, body, body.points)
    first.add_collection(LineCollection(body.lines, colors="black", linewidths=1.0))
    draw_tips(first, body, summary.get("tips", []))
    finish_axes(first, body, low, high, "specimen, cracks and active tips")

    power, letter = prefix(stress_scale(body.stress))
    top = stress_scale(body.stress) / power
    drawn = draw_polygons(second, body, points, body.stress / power, cmap="coolwarm", norm=Normalize(-top, top))
    second.add_collection(LineCollection(face_edges(body, points), colors="black", linewidths=0.6))
    finish_axes(second, body, low, high, f"opened shape, displacements × {factor:g}")
    shape = {"location": "bottom", "shrink": 0.7, "aspect": 40} if is_wide(high - low) else {}
    figure.colorbar(drawn, ax=second, extend="both", **shape, label=f"larger principal stress ({letter}Pa)")
    figure.suptitle(f"{summary.get('title', '')}\n{state_of(summary)}", fontsize=11)
    return save(figure, path)


def draw_paths(body, summary, path):
    figure, axes = panels(body.high - body.low, 1)
    draw_polygons(axes, body, body.points)
    old = body.ages <= 0
    axes.add_collection(LineCollection(body.lines[old], colors="black", linewidths=1.6, label="at the start"))
    if not old.all():
        draw_growth(figure, axes, body, ~old)
    draw_tips(axes, body, summary.get("tips", []))
    finish_axes(axes, body, body.low, body.high, f"{summary.get('title', '')}\ncrack paths, {state_of(summary)}")
    if len(body.lines):
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=2, frameon=False, fontsize=8)
    return save(figure, path)


def draw_growth(figure, axes, body, grown):
    last = int(body.ages.max())
    bounds = np.arange(0.5, last + 1) if last <= 12 else np.linspace(0.5, last + 0.5, 256)
    lines = LineCollection(body.lines[grown], array=body.ages[grown], cmap="plasma",
                           norm=BoundaryNorm(bounds, 256), linewidths=1.6)
    axes.add_collection(lines)
    bar = figure.colorbar(lines, ax=axes, label="grown in load step")
    bar.set_ticks(np.unique(np.linspace(1, last, min(last, 12)).round().astype(int)))
    bar.minorticks_off()


def main(arguments):
    if len(arguments) != 1 or arguments[0] in ("-h", "--help"):
        print(__doc__)
        return 0 if arguments and arguments[0] in ("-h", "--help") else 2
    folder = Path(arguments[0])
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        fields = read_newest(folder / "fields.pvd")
        pictures = []
        if fields:
            body = Body(fields, read_newest(folder / "cracks.pvd"))
            pictures = [draw_opened(body, summary, folder / "opened.png"),
                        draw_paths(body, summary, folder / "crack_paths.png")]
        largest_move = float(np.abs(fields["displacement"]).max()) if fields else 0.0
        pictures.append(draw_load(folder, summary, folder / "load_displacement.png", largest_move))
    except (OSError, ValueError, ReadError) as error:
        print(f"plot.py: {error}", file=sys.stderr)
        return 4
    for picture in filter(None, pictures):
        print(picture)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

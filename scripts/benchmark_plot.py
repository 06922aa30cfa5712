# SPDX-License-Identifier: BSD-3-Clause
"""The picture of docs/performance.md, drawn from the tables of the page."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from plot_load import save  # noqa: E402


def table_of(page, group):
    """The first table between the markers of a group: [{column: text}]. Columns of the same name: the first."""
    part = page.split(f"<!-- {group} -->")[1].split(f"<!-- /{group} -->")[0]
    lines = []
    for line in part.splitlines():
        if line.startswith("|"):
            lines.append([cell.strip() for cell in line.strip("|").split("|")])
        elif lines:
            break
    return [dict(reversed(list(zip(lines[0], line)))) for line in lines[2:]]


def plot_times(axes, page):
    race = [row for row in table_of(page, "race") if row["cracks"] == "3"]
    unknowns = [1e6 * float(row["million unknowns"]) for row in race]
    axes.loglog(unknowns, [float(row["CHOLMOD, s"]) for row in race], "s-", label="CHOLMOD, 1 core")
    axes.loglog(unknowns, [float(row["multilevel, s"]) for row in race], "o-", label="multilevel, 1 core")
    two = [row for row in table_of(page, "scaling") if row["ranks"] == "2"]
    if two:
        axes.loglog([1e6 * float(row["million unknowns"]) for row in two], [1e-3 * float(row["all, ms"]) for row in two],
                    "^--", label="multilevel, 2 ranks")
    axes.set_xlabel("unknowns")
    axes.set_ylabel("set-up and solve (s)")
    axes.set_title("3 cracks", fontsize=10)
    axes.legend(frameon=False, fontsize=8)


def plot_kernels(axes, page):
    rows = [row for row in table_of(page, "kernels") if row["cracks"] == "3"][::-1]
    axes.barh([row["kernel"].split(" (")[0] for row in rows], [float(row["time in triads"]) for row in rows], color="C0")
    axes.set_xlabel("time over that of a triad on as many unknowns")
    axes.set_title("kernels, 640 x 1280 elements, 3 cracks", fontsize=10)


def draw(page, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.2), layout="constrained")
    if table_of(page, "race"):
        plot_times(left, page)
    if table_of(page, "kernels"):
        plot_kernels(right, page)
    for axes in (left, right):
        axes.grid(alpha=0.3)
    save(figure, path)

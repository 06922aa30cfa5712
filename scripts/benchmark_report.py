#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tables and picture of docs/performance.md from what scripts/benchmark.sh has measured.

usage: benchmark_report.py FOLDER PAGE GROUP...: FOLDER/GROUP.csv and .facts -> between
<!-- GROUP --> and <!-- /GROUP --> of PAGE; the picture goes beside PAGE, from its tables.
"""

import csv
import re
import sys
from pathlib import Path
from statistics import median

import benchmark_plot


def rows_of(folder, group):
    """[{column: number or text}] of a group's CSV file."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with open(folder / f"{group}.csv", encoding="utf-8", newline="") as file:
        return [{name: value(text) for name, text in row.items()} for row in csv.DictReader(file)]


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def bars(*checks):
    """(what, bar, measured as text, is it met?) of each."""
    return table(["check", "bar", "measured", "met"],
                 [[what, bar, text, "yes" if met else "**no**"] for what, bar, text, met in checks])


def spread(values):
    """Median, and the range of all."""
    middle = f"{median(values):.2f}"
    return middle if len(values) == 1 else f"{middle} ({min(values):.2f} to {max(values):.2f})"


def elements(nx):
    return f"{nx:.0f} x {2 * nx:.0f}"


def scaling(rows):
    def of(nx, ranks, name):
        return [row[name] for row in rows if row["nx"] == nx and row["ranks"] == ranks]

    def mid(nx, ranks, name, factor, digits):
        return f"{factor * median(of(nx, ranks, name)):.{digits}f}"

    sizes = sorted({row["nx"] for row in rows})
    pairs = sorted({(row["nx"], row["ranks"]) for row in rows})
    def columns(*wanted):
        """A table of (head, column of the file, factor, digits) by size and ranks."""
        return table(["elements", "ranks", *(head for head, *_ in wanted)],
                     [[elements(nx), f"{ranks:.0f}", *(mid(nx, ranks, *what) for _, *what in wanted)]
                      for nx, ranks in pairs])

    text = columns(("million unknowns", "unknowns", 1e-6, 2), ("cells, ms", "cells_s", 1e3, 0),
                   ("stiffness and scales, ms", "stiffness_s", 1e3, 0), ("solve, ms", "solve_s", 1e3, 0),
                   ("all, ms", "all_s", 1e3, 0), ("iterations", "iterations", 1, 0),
                   ("ms per iteration", "iteration_ms", 1, 2))
    text += "\n\n" + columns(
        ("messages per iteration", "messages_per_iteration", 1, 1), ("kB in them", "bytes_per_iteration", 1e-3, 1),
        ("sums per iteration", "reductions_per_iteration", 1, 1),
        ("memory of the largest rank, MB", "largest_memory_mb", 1, 0),
        ("bytes per unknown, all ranks", "bytes_per_unknown", 1, 0), ("triad, GB/s", "triad_gb_s", 1, 1))
    checks = []
    for nx in sizes:
        gains = [one / two for one, two in zip(of(nx, 1, "all_s"), of(nx, 2, "all_s"))]
        triads = [two / one for one, two in zip(of(nx, 1, "triad_gb_s"), of(nx, 2, "triad_gb_s"))]
        if nx != sizes[-1]:
            text += f"\n\n{elements(nx)}: 2 ranks are {spread(gains)} times as fast as 1; a triad gains {spread(triads)}."
            continue
        met = median(gains) >= min(1.6, 0.85 * median(triads))
        checks.append((f"2 ranks against 1, {elements(nx)}", "at least 1.6, or 0.85 of what a triad gains",
                       f"{spread(gains)}; triad {spread(triads)}", met))
        memory = median(of(nx, 1, "bytes_per_unknown"))
        checks.append((f"peak memory over that of an empty run, {elements(nx)}", "at most 200 bytes per unknown", f"{memory:.0f}",
                       memory <= 200))
        share = median(of(nx, 4, "largest_memory_mb")) / median(of(nx, 1, "largest_memory_mb"))
        checks.append((f"memory of the largest of 4 ranks over that of 1 rank, {elements(nx)}", "at most 0.35", f"{share:.3f}",
                       share <= 0.35))
    return text + "\n\n" + bars(*checks)


def kernels(rows):
    times = {}
    for row in rows:
        found = re.fullmatch(r"(\w+)/(\d+)/repeats:\d+", row["name"])
        if found:
            times.setdefault((int(found[2]), found[1]), []).append((row["real_time"], row["items_per_second"]))
    body = []
    for (cracks, name), values in sorted(times.items(), key=lambda item: item[0][0]):
        ms, rate = median(v[0] for v in values), median(v[1] for v in values)
        triads = median(v[0] for v in times[cracks, "triad"])
        extra = f" ({24e-9 * rate:.1f} GB/s)" if name == "triad" else ""
        body.append([name.replace("_", " ") + extra, cracks, f"{ms:.2f}", f"{1e-6 * rate:.0f}", f"{ms / triads:.2f}"])
    return table(["kernel", "cracks", "ms", "million unknowns per s", "time in triads"], body)


def growth(rows):
    body = [[elements(r["nx"]), f"{r['cracks']:.0f}", f"{r['tips']:.0f}", f"{1e3 * r['first_s']:.0f}",
             f"{1e3 * r['cold_s']:.0f}", f"{r['cold_iterations']:.0f}", f"{1e3 * r['set_up_s']:.0f}", f"{1e3 * r['cycle_s']:.0f}",
             f"{r['cycle_iterations']:.0f}", f"{r['windows_factored']:.0f} of {r['windows']:.0f}", f"{r['ratio']:.3f}",
             f"{r['cold_bytes']:.0f}", f"{r['bytes']:.0f}"] for r in rows]
    text = table(["elements", "cracks", "tips that grow", "first of the process, ms", "cold, ms", "iterations", "set-up of the cycle, ms", "cycle, ms",
                  "iterations", "windows factored anew", "ratio", "peak memory per unknown, cold, bytes", "with growth, bytes"], body)
    return text + "\n\n" + bars(*((f"growth cycle against cold, {r['cracks']:.0f} cracks, {r['tips']:.0f} tips",
                                   "at most 0.6", f"{r['ratio']:.3f}", r["ratio"] <= 0.6) for r in rows))


def race(rows):
    body = [[elements(r["nx"]), f"{r['cracks']:.0f}", f"{1e-6 * r['unknowns']:.2f}", f"{r['iterations']:.0f}",
             f"{r['multilevel_s']:.2f}", f"{r['cholmod_s']:.2f}", f"{r['ratio']:.1f}",
             f"{r['cholmod_bytes_per_unknown']:.0f}", f"{r['energy_difference']:.0e}"] for r in rows]
    text = table(["elements", "cracks", "million unknowns", "iterations", "multilevel, s", "CHOLMOD, s", "ratio",
                  "CHOLMOD, bytes per unknown", "difference of energies"], body)
    largest = max((r for r in rows if r["cracks"] == 3), key=lambda r: r["nx"])
    return text + "\n\n" + bars((f"whole solve, {elements(largest['nx'])}, 3 cracks", "at least 15 times as fast",
                                 f"{largest['ratio']:.1f}", largest["ratio"] >= 15))


def windows(rows):
    names = ("added", "shared", "in_turn", "one_order")
    body = [[elements(r["nx"]), f"{r['cracks']:.0f}", r["coarsest_windows_on"], f"{r['radius']:.0f}",
             f"{r['windows_over_a_cell']:.0f}", f"{r['largest_added']:.1f}",
             *(f"{r[n]:.0f}" if r[n] else "none in 100" for n in names)] for r in rows]
    return table(["elements", "cracks", "coarsest scale with windows", "radius", "windows over a cell", "largest eigenvalue",
                  "added up", "shared", "in turn", "in one order"], body)


def facts_line(group, facts):
    cache = f", {facts['cache']} of shared cache" if facts["cache"] else ""
    machine = f"{facts['processor']}, {facts['cores']} cores{cache}; {facts['compiler']}"
    if group == "race" and facts["blas"]:
        machine += f", {facts['blas']}"
    if group == "windows":
        return machine + "."
    rounds = f"{facts['rounds']} rounds of " if group == "scaling" else ""
    others = float(facts["others"])
    quiet = "quiet enough" if others <= 0.05 else "**numbers are disturbed**"
    return (f"{machine}; medians of {rounds}{facts['runs']} runs. Other programs took {others:.2f} cores meanwhile: "
            f"{quiet}.")


def put(page, group, text):
    """Replaces what is between the markers of a group."""
    pattern = re.compile(rf"(<!-- {group} -->).*(<!-- /{group} -->)", re.DOTALL)
    if not pattern.search(page):
        sys.exit(f"benchmark_report.py: the page has no markers '<!-- {group} -->' and '<!-- /{group} -->'")
    return pattern.sub(lambda found: f"{found[1]}\n{text}\n{found[2]}", page)


def main(folder, path, groups):
    reports = {"scaling": scaling, "kernels": kernels, "growth": growth, "race": race, "windows": windows}
    page = path.read_text(encoding="utf-8")
    for group in groups:
        facts = dict(line.split("=", 1) for line in (folder / f"{group}.facts").read_text(encoding="utf-8").splitlines())
        page = put(page, group, facts_line(group, facts) + "\n\n" + reports[group](rows_of(folder, group)))
    path.write_text(page, encoding="utf-8")
    benchmark_plot.draw(page, path.with_suffix(".png"))
    print(f"wrote {path} and {path.with_suffix('.png')}")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:])

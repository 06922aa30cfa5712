#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs random case files, a seed each, and tells which runs do not end well.

Plates, materials, cracks (straight, bent, on the rim, random), laws of touching faces, loads and
growth all differ. A run ends well if it is completed or separated, all numbers are finite, nothing but
new cracks and friction takes energy, and nothing gives energy back.
"""

import argparse
import json
import math
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
GAIN = 1e-3  # of the work: docs/method.md, Limits
SAME_K, TOLERANCE = 1e-6, 1e-11  # of the largest, and of the solver: docs/method.md, Parallel
INPUT_IS_WRONG = 2  # exit status of cdca


class Plate:
    """What the other tables need to know of a random plate."""

    def __init__(self, draw):
        scale = 10 ** draw.uniform(-2, 1)
        self.width = scale * draw.uniform(0.5, 1.5)
        self.height = scale * draw.uniform(0.5, 1.5)
        across = draw.randint(14, 32)
        self.element = self.width / across
        self.cells = [across, max(8, round(self.height / self.element * draw.uniform(0.8, 1.25)))]
        self.young = 10 ** draw.uniform(9, 11)
        self.stress = self.young * 10 ** draw.uniform(-4.5, -3)
        self.poisson = draw.choice([0.0, 0.2, 0.3, 0.4])
        self.compressed = draw.random() < 0.6

    def place(self, draw):
        return [draw.uniform(0.1, 0.9) * self.width, draw.uniform(0.1, 0.9) * self.height]


def cracks(draw, plate):
    """Straight, bent and edge cracks of 2 to 12 elements."""
    blocks = []
    for _ in range(draw.randint(1, 12)):
        length = draw.uniform(2, 12) * plate.element
        kind = draw.choice(["straight", "straight", "bent", "edge"])
        if kind == "straight":
            center = plate.place(draw)
            room = min(center[0], plate.width - center[0], center[1], plate.height - center[1])
            blocks.append(dict(center=center, length=min(length, 1.9 * room), angle=draw.uniform(0, 180)))
            continue
        point, angle = plate.place(draw), draw.uniform(0, 2 * math.pi)
        if kind == "edge":
            angle = draw.choice([0, math.pi])
            point[0] = 0.0 if angle == 0 else plate.width
            angle += draw.uniform(-0.7, 0.7)
        points = [point]
        for _ in range(draw.randint(1, 3)):
            part = length * draw.uniform(0.3, 0.7)
            inside = (plate.width, plate.height)
            end = [points[-1][0] + part * math.cos(angle), points[-1][1] + part * math.sin(angle)]
            points.append([min(max(c, 0.02 * side), 0.98 * side) for c, side in zip(end, inside)])
            angle += draw.uniform(-1, 1)
        blocks.append(dict(points=points))
    return blocks


def contact(draw, plate):
    law = draw.choice(["none", "frictionless", "coulomb", "coulomb"] if plate.compressed else ["none", "coulomb"])
    if law == "none":
        return None
    stiffness = 10 ** draw.uniform(1, 4) * plate.young / plate.element
    table = dict(law=law, normal_stiffness=stiffness)
    if law == "coulomb":
        table.update(tangential_stiffness=stiffness * draw.choice([0.01, 0.1, 1]), friction=draw.uniform(0, 0.9))
    return table


def boundaries(draw, plate):
    """The plate is pulled or pressed upright by its ends; some are pressed from the sides, too."""
    sign = -1 if plate.compressed else 1
    strain = sign * plate.stress / plate.young
    blocks = [
        dict(on="bottom", displacement=[draw.choice(["free", 0.0]), 0.0]),
        dict(at=[0.0, 0.0], displacement=[0.0, "free"]),
    ]
    if draw.random() < 0.6:
        blocks.append(dict(on="top", displacement=[draw.choice(["free", 0.0]), strain * plate.height]))
    else:
        blocks.append(dict(on="top", traction=[draw.choice([0.0, 0.0, 0.3 * plate.stress]), sign * plate.stress]))
    if plate.compressed and draw.random() < 0.3:
        pressed = draw.uniform(0.02, 0.4) * plate.stress
        blocks.append(dict(on="left", traction=[pressed, 0.0]))
        blocks.append(dict(on="right", traction=[-pressed, 0.0]))
    return blocks


def growth(draw, plate, material):
    criterion = draw.choice(["hoop", "hoop", "mixed"])
    toughness = plate.stress * math.sqrt(math.pi * 3 * plate.element) * draw.uniform(0.1, 0.8)
    material["toughness"] = toughness
    if criterion == "mixed":
        radius = draw.uniform(0.3, 3) * plate.element
        material["tensile_strength"] = toughness / math.sqrt(2 * math.pi * radius)
    table = dict(criterion=criterion, direction=draw.choice(["corrected", "explicit"]))
    if draw.random() < 0.5:
        table.update(step="fixed", step_length=draw.uniform(1.2, 3))
    return table


def case_of(seed):
    """Tables of the case file with this seed."""
    draw = random.Random(seed)
    plate = Plate(draw)
    case = {"title": f"random case {seed}"}
    case["domain"] = dict(size=[plate.width, plate.height], cells=plate.cells, plane=draw.choice(["stress", "strain"]))
    case["material"] = dict(young=plate.young, poisson=plate.poisson)
    laws = contact(draw, plate)
    if laws:
        case["contact"] = laws
    if draw.random() < 0.2:
        case["enrichment"] = dict(tip_radius=draw.uniform(2, 3) * plate.element)
    case["crack"] = cracks(draw, plate)
    if draw.random() < 0.4:
        case["crack_field"] = dict(
            count=draw.randint(3, 20), length=[3 * plate.element, 9 * plate.element], seed=draw.randint(0, 999)
        )
    case["boundary"] = boundaries(draw, plate)
    case["growth"] = growth(draw, plate, case["material"])
    if draw.random() < 0.4:
        case["loading"] = dict(mode="critical", max_events=60)
    else:
        case["loading"] = dict(steps=draw.randint(2, 8))
    case["output"] = dict(pictures=False, every=1000, checkpoint_every=0)
    return case


def add_more(seed, case):
    """What most cases do not have: shear strength, cohesion, cohesive faces, thickness, loads inside the plate."""
    draw = random.Random(f"{seed} more")
    size, material = case["domain"]["size"], case["material"]
    element = size[0] / case["domain"]["cells"][0]
    top = case["boundary"][2]
    stress = abs(top["traction"][1] if "traction" in top else top["displacement"][1] / size[1] * material["young"])
    case["domain"]["thickness"] = draw.choice([1.0, 0.01, 3.0])
    if draw.random() < 0.5:
        case["growth"]["criterion"] = "mixed"
        material.update(cohesion=stress * draw.uniform(0.1, 1), friction_angle=draw.uniform(0, 45))
        material["tensile_strength"] = material["toughness"] / math.sqrt(2 * math.pi * draw.uniform(0.3, 3) * element)
        material["toughness"] *= draw.choice([1, 3])
        case["growth"].update(field=draw.choice(["singular", "full"]), literal=draw.random() < 0.3)
    laws = case.get("contact", {})
    if laws.get("law") == "coulomb" and draw.random() < 0.5:
        laws["cohesion"] = stress * draw.uniform(0.01, 0.5)
    elif draw.random() < 0.5:
        strength, gap = stress * draw.uniform(0.1, 2), stress / material["young"] * element * draw.uniform(0.3, 3)
        soft = dict(law="cohesive", normal_stiffness=draw.uniform(10, 100) * strength / gap)
        soft.update(cohesive_stiffness=strength / gap, critical_gap=gap)
        if draw.random() < 0.5:
            soft.update(tangential_stiffness=0.1 * soft["normal_stiffness"], friction=draw.uniform(0, 0.9))
        case["crack"][0].update(soft)
    if draw.random() < 0.3 and case["crack"][0].get("law") != "cohesive":
        case["crack"][0]["name"] = "loaded"
        case["boundary"].append(dict(on="crack:loaded", pressure=stress * draw.uniform(0, 0.5)))
    if draw.random() < 0.3:
        case["domain"]["body_force"] = [0.0, draw.choice([-1, 1]) * stress / size[1] * draw.uniform(0, 0.5)]


def as_toml(case):
    """Values of a case file read the same in TOML as in JSON."""
    lines = []
    for name, value in case.items():
        if isinstance(value, str):
            lines.append(f"{name} = {json.dumps(value)}")
            continue
        head = f"\n[[{name}]]" if isinstance(value, list) else f"\n[{name}]"
        for table in value if isinstance(value, list) else [value]:
            lines.append(head)
            lines += [f"{key} = {json.dumps(entry)}" for key, entry in table.items()]
    return "\n".join(lines) + "\n"


def numbers_of(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for entry in value:
            yield from numbers_of(entry)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield value


def most_work(case, factor):
    """J that moving the top takes at most: that of the plate without cracks. None where forces act."""
    forces = ("traction", "pressure")
    if "body_force" in case["domain"] or any(name in block for block in case["boundary"] for name in forces):
        return None
    move = case["boundary"][2]["displacement"][1] * factor
    width, height = case["domain"]["size"]
    # both ends may be held in x, which is no stiffer than a plate that is held in x everywhere
    poisson = case["material"]["poisson"]
    stiffer = (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))
    volume = width * height * case["domain"].get("thickness", 1.0)
    return 0.5 * case["material"]["young"] * stiffer * (move / height) ** 2 * volume


def faults_of(case, summary):
    """What is wrong with a result, and what it has gained in energy, as a part of the work."""
    faults = []
    if summary["status"] not in ("completed", "separated"):
        faults.append(f"{summary['status']}: {summary['message']}")
    steps = summary["steps"]
    values = [row[name] for row in steps for name in ("external_work", "strain_energy", "friction_work")]
    if None in values or not all(math.isfinite(x) for x in numbers_of(summary)):
        faults.append("numbers that are not finite")
        return faults, 0.0
    most = max((abs(row["external_work"]) for row in steps), default=0.0)
    spent = [row["external_work"] - row["strain_energy"] - row["friction_work"] for row in steps]
    gain = max((-s / most for s in spent), default=0.0) if most > 0 else 0.0
    if gain > GAIN:
        faults.append(f"energy gained: {gain:.1e} of the work")
    for row in steps:
        bound = most_work(case, max(r["load_factor"] for r in steps))
        if bound is not None and row["external_work"] > bound * (1 + 1e-9):
            faults.append(f"step {row['step']}: work {row['external_work']:.3g} J, without cracks {bound:.3g} J")
            break
    return faults, max(gain, 0.0)


def differences(first, other):
    """Between results on different numbers of ranks: text of what differs, and difference of K, of the largest."""
    what = [(e["kind"], e["crack"], e["end"], e["partner"]) for e in first["events"]]
    if what != [(e["kind"], e["crack"], e["end"], e["partner"]) for e in other["events"]]:
        return "other events", 0.0
    tips = list(zip(first["tips"], other["tips"]))
    pairs = [(a[k], b[k]) for a, b in tips for k in ("K_I", "K_II") if a[k] is not None and b[k] is not None]
    largest = max((abs(a) for a, _ in pairs), default=0.0)
    worst = max((abs(a - b) for a, b in pairs), default=0.0) / (largest or 1.0)
    return (f"K differs by {worst:.1e} of the largest" if worst > SAME_K else ""), worst


class Trial:
    """The case of one seed, on every number of ranks that is asked for."""

    def __init__(self, options, folder, seed):
        self.options, self.folder, self.seed = options, folder, seed
        self.case = case_of(seed)
        if options.more:
            add_more(seed, self.case)
        if len(options.ranks) > 1:
            self.case["solver"] = dict(tolerance=TOLERANCE)
        self.file = folder / f"{seed}.toml"
        self.file.write_text(as_toml(self.case), encoding="utf-8")

    def run(self):
        """('well', 'refused', 'slow' or 'BAD', a line about it)."""
        results, line = [], ""
        for ranks in self.options.ranks:
            start = time.monotonic()
            status, message, results_of_run = self.run_on(ranks)
            if status is None:
                return "slow", f"not over after {self.options.seconds} s on {ranks} ranks"
            if status == INPUT_IS_WRONG:
                return "refused", message
            if results_of_run is None:
                return "BAD", f"exit status {status} on {ranks} ranks, no summary: {message}"
            faults, gain = faults_of(self.case, results_of_run)
            if status != 0 and not faults:
                faults = [f"exit status {status}: {message}"]
            if faults:
                return "BAD", f"on {ranks} ranks: " + "; ".join(faults)
            results.append(results_of_run)
            line += f"{results_of_run['status']}, {len(results_of_run['events'])} events, {time.monotonic() - start:.1f} s; "
            line += f"gain {gain:.0e}; " if gain > 0 else ""
        for other in results[1:]:
            text, worst = differences(results[0], other)
            if text:
                return "BAD", line + text
            line += f"K the same to {worst:.0e}; "
        return "well", line.rstrip("; ")

    def run_on(self, ranks):
        """(exit status or None, last line on standard error, summary or None)."""
        folder = self.folder / f"{self.seed}_on_{ranks}"
        command = [self.options.cdca, "run", str(self.file), "-o", str(folder), "--quiet"]
        if ranks > 1:
            command = [self.options.mpiexec, "--oversubscribe", "-n", str(ranks), *command]
        with open(self.folder / f"{self.seed}_on_{ranks}.log", "w+", encoding="utf-8") as log:
            process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True
            )
            try:
                status = process.wait(self.options.seconds)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                return None, "", None
            log.seek(0)
            said = [line for line in log.read().splitlines() if line.strip()]
        try:
            summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            summary = None
        return status, said[-1] if said else "", summary


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", type=int, help="seed of the first case")
    parser.add_argument("last", type=int, help="and of the last one")
    parser.add_argument(
        "-n", "--ranks", default="1", help="numbers of ranks, such as 1,2,4: the results must be the same (default 1)"
    )
    parser.add_argument(
        "--more", action="store_true", help="also cohesion, cohesive faces, growth in shear, body forces and the like"
    )
    parser.add_argument("-j", "--jobs", type=int, default=1, help="cases at a time (default 1)")
    parser.add_argument("-s", "--seconds", type=float, default=120, help="for a run; one that takes longer is slow (default 120)")
    parser.add_argument("-o", "--output", type=Path, help="keeps case files and results in this folder")
    parser.add_argument("--cdca", default=os.environ.get("CDCA", str(TOP / "build/bin/cdca")), help="the program")
    parser.add_argument("--mpiexec", default=os.environ.get("MPIEXEC", "mpirun"), help="what starts it on several ranks")
    chosen = parser.parse_args()
    try:
        chosen.ranks = [int(n) for n in chosen.ranks.split(",")]
    except ValueError:
        parser.error(f"--ranks: numbers with commas between them, not '{chosen.ranks}'")
    return chosen


def main():
    chosen = options()
    with tempfile.TemporaryDirectory() as scratch:
        folder = chosen.output or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        trials = [Trial(chosen, folder, seed) for seed in range(chosen.first, chosen.last + 1)]
        ends = []
        with ThreadPoolExecutor(chosen.jobs) as pool:
            for trial, (end, line) in zip(trials, pool.map(Trial.run, trials)):
                print(f"{trial.seed}: {end}: {line}", flush=True)
                ends.append(end)
    print(", ".join(f"{ends.count(end)} {end}" for end in ("well", "refused", "slow", "BAD")))
    return 1 if "BAD" in ends else 0


if __name__ == "__main__":
    sys.exit(main())

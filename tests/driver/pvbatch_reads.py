# SPDX-License-Identifier: BSD-3-Clause
"""ParaView itself opens what a run wrote: the series is complete, every element is there once, and the
crack opens. Exit status 77 (skipped) where pvbatch or a virtual display is missing.

CDCA: the program; CDCA_SOURCE_DIR: the project; MPIEXEC: mpirun
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
CASE = Path(os.environ["CDCA_SOURCE_DIR"]) / "examples" / "edge_crack.toml"
WIDTH, HEIGHT, COLUMNS, ROWS = 0.020, 0.052, 39, 103
MOUTH = ("0.0", "0.026")
STEPS = 3


def run(command, limit):
    """Runs a program to its end; its output only matters when it fails."""
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=limit, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with status {done.returncode}:\n{done.stdout}")
    return done.stdout


def solve(ranks, folder):
    start = [os.environ.get("MPIEXEC", "mpirun"), "-n", str(ranks)] if ranks > 1 else []
    run([*start, os.environ["CDCA"], "run", str(CASE), "-o", str(folder), "--quiet",
         "--set", f"loading.steps={STEPS}", "--set", "output.pictures=false"], 120)


def look(folder):
    """What pvbatch sees in the folder."""
    answer = folder / "seen.json"
    output = run(["xvfb-run", "-a", "pvbatch", "--force-offscreen-rendering",
                  str(HERE / "_pvbatch_probe.py"), str(folder), *MOUTH, str(answer)], 120)
    if not answer.is_file():
        raise AssertionError(f"pvbatch left no answer:\n{output}")
    return json.loads(answer.read_text(encoding="utf-8"))


class ParaViewReads:
    """The checks, for the number of ranks that the classes below name."""

    ranks = 0

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="cdca_pvbatch_")
        folder = Path(cls.scratch.name)
        solve(cls.ranks, folder)
        cls.summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        cls.pieces = len(list((folder / "fields").glob("step_0001_*.vtu")))
        cls.seen = look(folder)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_series_is_complete(self):
        factors = [step["load_factor"] for step in self.summary["steps"]]
        self.assertEqual(len(factors), STEPS)
        self.assertEqual(self.pieces, self.ranks)
        for times in (self.seen["times"], self.seen["crack_times"]):
            self.assertEqual(len(times), STEPS)
            for time, factor in zip(times, factors):
                self.assertAlmostEqual(time, factor, delta=1e-12)

    def test_every_element_is_there_once(self):
        whole = WIDTH * HEIGHT
        part = whole / (COLUMNS * ROWS)
        for step in self.seen["steps"]:
            areas = {}
            for element, area in zip(step["element"], step["area"]):
                self.assertGreater(area, 0.0)
                areas[element] = areas.get(element, 0.0) + area
            self.assertEqual(sorted(areas), list(range(COLUMNS * ROWS)))
            for element, area in areas.items():
                self.assertAlmostEqual(area / part, 1.0, delta=1e-9, msg=f"element {element}")
            self.assertAlmostEqual(sum(areas.values()) / whole, 1.0, delta=1e-10)

    def test_cut_elements_are_split(self):
        step = self.seen["steps"][-1]
        split = {element for element, parts in Counter(step["element"]).items() if parts > 1}
        row = ROWS // 2 * COLUMNS
        behind_tip = {row + i for i in range(int(0.012 / (WIDTH / COLUMNS)))}
        self.assertTrue(behind_tip <= split, f"not split: {sorted(behind_tip - split)}")
        self.assertLessEqual(len(split - behind_tip), 4, "only elements on the crack are split")

    def test_jump_at_the_mouth_is_the_opening(self):
        for step in self.seen["steps"]:
            mouth = step["mouth"]
            self.assertGreaterEqual(len(mouth["displacement_y"]), 2)
            self.assertEqual(len(mouth["opening"]), 1)
            for axis, jump in (("displacement_y", mouth["opening"][0]), ("displacement_x", mouth["slip"][0])):
                apart = max(mouth[axis]) - min(mouth[axis])
                self.assertAlmostEqual(apart, abs(jump), delta=1e-9 * mouth["opening"][0], msg=axis)
        # Linear: the mouth opens in proportion to the load.
        openings = [step["mouth"]["opening"][0] for step in self.seen["steps"]]
        self.assertGreater(openings[0], 0.0)
        for k, opening in enumerate(openings, 1):
            self.assertAlmostEqual(opening / openings[-1], k / STEPS, delta=1e-6)

    def test_crack_opens_under_warp_by_vector(self):
        mouth = self.seen["steps"][-1]["mouth"]
        gap = max(mouth["warped_y"]) - min(mouth["warped_y"])
        self.assertAlmostEqual(gap / (mouth["warp"] * mouth["opening"][0]), 1.0, delta=1e-5)


class OneRank(ParaViewReads, unittest.TestCase):
    ranks = 1


class TwoRanks(ParaViewReads, unittest.TestCase):
    ranks = 2


if __name__ == "__main__":
    missing = [name for name in ("pvbatch", "xvfb-run") if shutil.which(name) is None]
    if missing:
        print(f"skipped: {' and '.join(missing)} not installed")
        sys.exit(77)
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""A run that is stopped or killed, and taken up again, gives the results of one that is not.

CDCA: the program; MPIEXEC: mpirun
"""

import csv
import json
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = os.environ["CDCA"]
MPIEXEC = os.environ.get("MPIEXEC", "mpirun")
PATIENCE = 60  # s

# Two edge cracks that grow past each other, a few increments in every load step.
STEPS = 15
H = 0.04 / 41
CASE = f"""\
title = "Two edge cracks"
[domain]
size = [0.04, 0.04]
cells = [41, 41]
[material]
young = 3.2e9
poisson = 0.35
toughness = 1.0e6
[[crack]]
name = "left"
points = [[0.0, 0.019], [0.008, 0.019]]
[[crack]]
name = "right"
points = [[0.04, 0.021], [0.032, 0.021]]
[[boundary]]
on = "top"
displacement = [0.0, "1.2e-4*(1 + 0.8*s)"]
[[boundary]]
on = "bottom"
displacement = [0.0, 0.0]
[loading]
steps = {STEPS}
[growth]
criterion = "hoop"
step = "fixed"
step_length = 0.5
cycles = 2
[solver]
tolerance = 1e-11
[output]
pictures = false
every = 4
checkpoint_every = 2
"""


def rows(folder, name):
    with open(folder / name, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


class RestartTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls._folder.cleanup)
        cls.folder = Path(cls._folder.name)
        (cls.folder / "case.toml").write_text(CASE, encoding="utf-8")
        done = cls.run_case("whole", ranks=2)
        assert done.returncode == 0, done.stdout + done.stderr

    @classmethod
    def command(cls, directory, *arguments, ranks=None):
        command = [PROGRAM, "run", "case.toml", "-o", directory, *arguments]
        return [MPIEXEC, "--quiet", "-n", str(ranks), *command] if ranks else command

    @classmethod
    def run_case(cls, directory, *arguments, ranks=None):
        return subprocess.run(cls.command(directory, *arguments, ranks=ranks), cwd=cls.folder,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE, check=False)

    def start_until(self, directory, steps, *arguments, ranks=None):
        """Starts a run, and returns it when its history has that many rows."""
        run = subprocess.Popen(self.command(directory, *arguments, ranks=ranks), cwd=self.folder,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        end = time.monotonic() + PATIENCE
        history = self.folder / directory / "history.csv"
        while not history.exists() or len(rows(self.folder / directory, "history.csv")) < steps:
            self.assertIsNone(run.poll(), "the run is over before it could be stopped")
            self.assertLess(time.monotonic(), end, "the run does not get on")
            time.sleep(0.002)
        return run

    def finish(self, run):
        out, errors = run.communicate(timeout=PATIENCE)
        return subprocess.CompletedProcess(run.args, run.returncode, out, errors)

    def expect_stopped(self, directory, done):
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        summary = summary_of(self.folder / directory)
        self.assertEqual(summary["status"], "running")
        self.assertRegex(summary["message"], r"stopped (in|after) step \d+ as asked; --restart goes on")
        self.assertIn("running: stopped", done.stdout)
        self.assertLess(len(summary["steps"]), STEPS)

    def expect_same_as_whole(self, directory):
        """Every row once, the same events and paths, K to 1e-6, paths to 1e-4 h."""
        whole, other = self.folder / "whole", self.folder / directory
        self.compare(rows(whole, "history.csv"), rows(other, "history.csv"),
                     exact=("step", "active_tips", "growth_cycles"), near={"load_factor": 1e-12, "crack_length": 1e-4 * H})
        self.compare(rows(whole, "tips.csv"), rows(other, "tips.csv"),
                     exact=("step", "cycle", "crack", "end", "mode", "K_from"),
                     near={"x": 1e-4 * H, "y": 1e-4 * H, "K_I": 1.0, "K_II": 1.0, "growth": 1e-4 * H})
        expected, found = summary_of(whole), summary_of(other)
        for key in ("status", "message", "elements", "unknowns", "load_factor"):
            self.assertEqual(expected[key], found[key], key)
        kinds = [[(e["step"], e["cycle"], e["kind"], e["crack"], e["end"], e["partner"]) for e in s["events"]]
                 for s in (expected, found)]
        self.assertEqual(*kinds)
        for a, b in zip(expected["cracks"], found["cracks"]):
            self.assertEqual(len(a["points"]), len(b["points"]))
            for p, q in zip(a["points"], b["points"]):
                self.assertLess(abs(p[0] - q[0]) + abs(p[1] - q[1]), 1e-4 * H)
        for name in ("fields", "cracks"):
            listed = [re.findall(r'timestep="(.*?)".*file="(.*?)"', (folder / f"{name}.pvd").read_text())
                      for folder in (whole, other)]
            self.assertEqual(*listed)
            for _, file in listed[1]:
                pieces = re.findall(r'Source="(.*?)"', (other / file).read_text())
                self.assertTrue(all((other / name / piece).exists() for piece in pieces), file)

    def compare(self, expected, found, exact, near):
        self.assertEqual([[row[key] for key in exact] for row in expected], [[row[key] for key in exact] for row in found])
        for a, b in zip(expected, found):
            for key, tolerance in near.items():
                self.assertAlmostEqual(float(a[key]), float(b[key]), delta=tolerance, msg=f"{key} in {b}")

    def test_the_cracks_grow_all_the_time(self):
        history = rows(self.folder / "whole", "history.csv")
        self.assertEqual(len(history), STEPS)
        self.assertGreaterEqual(sum(int(row["growth_cycles"]) > 1 for row in history), STEPS - 3)

    def test_stopped_on_two_ranks_and_taken_up_by_three(self):
        run = self.start_until("stopped", 7, ranks=2)
        # one rank learns of it, all stop
        children = Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        self.assertEqual(len(children), 2)
        os.kill(int(children[1]), signal.SIGTERM)
        self.expect_stopped("stopped", self.finish(run))
        done = self.run_case("stopped", "--restart", ranks=3)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("going on from stopped/checkpoint-", done.stdout)
        self.expect_same_as_whole("stopped")
        self.assertEqual(summary_of(self.folder / "stopped")["ranks"], 3)
        kept = sorted(file.name for file in (self.folder / "stopped").glob("checkpoint-*"))
        self.assertEqual(kept, ["checkpoint-12.h5", "checkpoint-14.h5"])

    def test_mpirun_passes_sigusr1_on(self):
        run = self.start_until("usr1", 3, "--set", "output.checkpoint_every=0", ranks=2)
        run.send_signal(signal.SIGUSR1)
        self.expect_stopped("usr1", self.finish(run))
        self.assertEqual(len(list((self.folder / "usr1").glob("checkpoint-*.h5"))), 1)

    def test_stopped_twice_without_mpirun(self):
        for number, steps in ((signal.SIGINT, 4), (signal.SIGTERM, 11)):
            arguments = ["--restart"] if steps > 4 else []
            run = self.start_until("twice", steps, *arguments, "--set", "output.checkpoint_every=0")
            run.send_signal(number)
            self.expect_stopped("twice", self.finish(run))
        self.assertEqual(self.run_case("twice", "--restart", "--set", "output.checkpoint_every=0").returncode, 0)
        self.expect_same_as_whole("twice")

    def test_killed_and_the_newest_checkpoint_damaged(self):
        run = self.start_until("killed", 9)
        run.kill()
        self.finish(run)
        files = sorted((self.folder / "killed").glob("checkpoint-*.h5"), key=lambda file: int(file.stem.split("-")[1]))
        self.assertGreaterEqual(len(files), 2)
        newest, before = files[-1], files[-2]
        data = bytearray(newest.read_bytes())
        middle = len(data) // 2
        data[middle:middle + 64] = bytes(64 * [0x55])
        newest.write_bytes(data)
        with open(self.folder / "killed" / "tips.csv", "a", encoding="utf-8") as table:
            table.write("10,0,0,1,0.01")  # as a write that was cut off leaves it
        done = self.run_case("killed", "--restart")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn(f"Cannot read killed/{newest.name}: ", done.stderr)
        self.assertIn(f"going on from killed/{before.name}", done.stdout)
        self.expect_same_as_whole("killed")

    def test_what_cannot_be_taken_up(self):
        for ranks in (None, 2):
            for arguments, status, message in (
                (["--set", "material.young=3e9"], 2, "material.young: Found 3000000000.0, but whole/checkpoint-14.h5"),
                (["--set", 'contact.law="frictionless"', "contact.normal_stiffness=1e14"], 2, "contact.law: Found"),
                (["whole/none.h5"], 2, 'There is no file "whole/none.h5"'),
            ):
                done = self.run_case("whole", "--restart", *arguments, ranks=ranks)
                self.assertEqual(done.returncode, status, done.stdout + done.stderr)
                self.assertEqual(done.stderr.count(message), 1, done.stderr)
        done = self.run_case("beside", "--restart", "whole/checkpoint-14.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(rows(self.folder / "beside", "tips.csv")[0], rows(self.folder / "whole", "tips.csv")[0])
        # fields of earlier steps lie where the run was; those of another run in this folder are not taken for them
        (self.folder / "beside" / "fields.pvd").unlink()
        for file in (self.folder / "whole" / "fields").iterdir():
            (self.folder / "beside" / "fields" / file.name).write_bytes(file.read_bytes())
        done = self.run_case("beside", "--restart", "whole/checkpoint-14.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        listed = re.findall(r'file="([^"]*)"', (self.folder / "beside" / "fields.pvd").read_text(encoding="utf-8"))
        self.assertEqual(len(listed), 1, listed)
        done = self.run_case("nothing", "--restart")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn('There is no checkpoint in the folder "nothing"', done.stderr)
        (self.folder / "broken.h5").write_text("no checkpoint")
        done = self.run_case("elsewhere", "--restart", "broken.h5")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()

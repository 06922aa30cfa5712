# SPDX-License-Identifier: BSD-3-Clause
"""scripts/plot.py reads what a run wrote and draws pictures with something on them.

CDCA: the program; CDCA_SOURCE_DIR: the project; MPIEXEC: mpirun
"""

import contextlib
import io
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["CDCA_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "scripts"))

import numpy as np  # noqa: E402
import plot  # noqa: E402
import read_vtu  # noqa: E402
from matplotlib.image import imread  # noqa: E402

WIDTH, HEIGHT, COLUMNS, ROWS = 0.020, 0.052, 39, 103
PICTURES = ("opened.png", "crack_paths.png", "load_displacement.png")


def polygon_areas(step):
    """Area of every polygon, by the shoelace formula."""
    x, y = step["Points"][:, 0], step["Points"][:, 1]
    areas = []
    for start, end in zip(np.append(0, step["offsets"][:-1]), step["offsets"]):
        corners = step["connectivity"][start:end]
        following = np.roll(corners, -1)
        areas.append(0.5 * np.sum(x[corners] * y[following] - x[following] * y[corners]))
    return np.array(areas)


def draw(folder):
    """Exit status of the plot command, silently."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return plot.main([str(folder)])


class PlotDraws(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="cdca_plot_")
        cls.folder = Path(cls.scratch.name)
        subprocess.run([os.environ.get("MPIEXEC", "mpirun"), "-n", "2", os.environ["CDCA"], "run",
                        str(SOURCE / "examples" / "edge_crack.toml"), "-o", str(cls.folder), "--quiet",
                        "--set", "loading.steps=2", "--set", "output.pictures=false"],
                       stdin=subprocess.DEVNULL, timeout=120, check=True)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def check_pictures(self):
        for name in PICTURES:
            picture = imread(self.folder / name)
            self.assertGreater(min(picture.shape[:2]), 400, name)
            colours = len(np.unique((picture[..., :3] * 15).astype(int).reshape(-1, 3), axis=0))
            self.assertGreater(colours, 12, f"{name} is nearly blank")
            (self.folder / name).unlink()

    def test_reader_finds_all_ranks(self):
        steps = read_vtu.listed_steps(self.folder / "fields.pvd")
        self.assertEqual([time for time, _ in steps], [0.5, 1.0])
        step = read_vtu.read_step(steps[-1][1])
        self.assertEqual(set(step["owner"]), {0, 1})
        self.assertEqual(len(np.unique(step["element"])), COLUMNS * ROWS)
        areas = polygon_areas(step)
        self.assertGreater(areas.min(), 0.0)
        self.assertAlmostEqual(areas.sum() / (WIDTH * HEIGHT), 1.0, delta=1e-10)
        self.assertEqual(step["displacement"].shape, (len(step["Points"]), 3))
        self.assertEqual(step["stress"].shape, (len(areas), 4))

    def test_faces_of_the_crack_are_found(self):
        body = plot.Body(read_vtu.read_newest(self.folder / "fields.pvd"),
                         read_vtu.read_newest(self.folder / "cracks.pvd"))
        faces = plot.face_edges(body, body.points)
        length = sum(np.linalg.norm(b - a) for a, b in faces)
        self.assertGreater(length, 2 * 11.5, "both faces of the 12 mm crack, in mm")
        self.assertLess(length, 2 * 12.0 + 1e-6)

    def test_draws_polygons(self):
        self.assertEqual(draw(self.folder), 0)
        self.check_pictures()

    def test_draws_an_image_when_there_are_very_many(self):
        usual = plot.MANY_POLYGONS
        try:
            plot.MANY_POLYGONS = 10
            self.assertEqual(draw(self.folder), 0)
        finally:
            plot.MANY_POLYGONS = usual
        self.check_pictures()

    def test_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as empty:
            self.assertEqual(draw(empty), 4)
            (Path(empty) / "summary.json").write_text("{}", encoding="utf-8")
            (Path(empty) / "history.csv").write_text("step,load_factor\n", encoding="utf-8")
            self.assertEqual(draw(empty), 0, "a run that has just begun has nothing to draw yet")
            self.assertEqual(os.listdir(empty).count("opened.png"), 0)


if __name__ == "__main__":
    unittest.main()

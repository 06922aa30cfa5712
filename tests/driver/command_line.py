# SPDX-License-Identifier: BSD-3-Clause
"""The program from outside: exit statuses and messages, alone and under mpirun.

CDCA: the program; CDCA_SOURCE_DIR: the project; MPIEXEC: mpirun
"""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["CDCA_SOURCE_DIR"])
PROGRAM = os.environ["CDCA"]
MPIEXEC = os.environ.get("MPIEXEC", "mpirun")
EXAMPLE = str(SOURCE / "examples" / "edge_crack.toml")
# Few cells and no pictures: these tests are about what is said, not about results.
SMALL = ["--set", "domain.cells=[13, 33]", "--set", "output.pictures=false"]
# The multilevel solver needs one iteration on so few cells.
STUBBORN = ["--set", 'solver.method="krylov"', "--set", "solver.max_iterations=2"]

PLATE = """\
[domain]
size = [1.0, 1.0]
cells = [10, 10]
[material]
young = 1e9
poisson = 0.3
[[boundary]]
on = "bottom"
displacement = [0.0, 0.0]
[[boundary]]
on = "top"
traction = [0.0, 1e6]
[output]
pictures = false
"""


class ProgramTest(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = Path(self._folder.name)

    def cdca(self, *arguments, ranks=None):
        """Runs the program in a folder of its own, on a number of ranks or without mpirun."""
        command = [PROGRAM, *map(str, arguments)]
        if ranks:
            command = [MPIEXEC, "--quiet", "--timeout", "50", "-n", str(ranks), *command]
        return subprocess.run(command, cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=60, check=False)

    def plate(self, *replacements):
        """Path of the sample case after (old, new) replacements, each of which must apply."""
        text = PLATE
        for old, new in replacements:
            self.assertIn(old, text)
            text = text.replace(old, new)
        path = self.folder / "plate.toml"
        path.write_text(text, encoding="utf-8")
        return "plate.toml"

    def hole_in_the_load(self, bound):
        """The sample case with a traction that has no value right of x = bound."""
        return self.plate(("[10, 10]", "[40, 40]"), ("[0.0, 1e6]", f'[0.0, "x > {bound} ? log(-1) : 1e6*s"]'))

    def expect(self, done, status, *messages):
        """The exit status, and messages on standard error, each exactly once."""
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        for message in messages:
            self.assertEqual(done.stderr.count(message), 1, f"{message!r} in:\n{done.stderr}")
        if status:
            self.assertTrue(all(line.startswith("cdca: ") for line in done.stderr.splitlines()), done.stderr)


class CommandLineTest(ProgramTest):
    def test_help_everywhere(self):
        for arguments in (["--help"], ["-h"], ["run", "--help"], ["check", "--help"], ["options", "--help"]):
            done = self.cdca(*arguments)
            self.expect(done, 0)
            self.assertIn("Usage: cdca", done.stdout)
            self.assertIn("Exit status: 0 done; 2 the input is wrong", done.stdout)
            self.assertEqual(done.stderr, "")
        self.assertIn("--set KEY.PATH=VALUE", self.cdca("run", "--help").stdout)

    def test_version_everywhere(self):
        for arguments in (["--version"], ["run", "--version"], ["check", "--version"]):
            done = self.cdca(*arguments)
            self.expect(done, 0)
            self.assertRegex(done.stdout, r"\Acdca \d+\.\d+\.\d+\n\Z")

    def test_wrong_usage(self):
        self.expect(self.cdca(), 2, 'No command is given; the commands are "run", "check" and "options".')
        self.expect(self.cdca("chekc", EXAMPLE), 2, 'There is no command "chekc"; did you mean "check"?')
        self.expect(self.cdca("frobnicate"), 2, 'There is no command "frobnicate"; the commands are')
        self.expect(self.cdca("plot", "results"), 2, "this version does not have it yet")
        self.expect(self.cdca("check"), 2, 'The command "check" needs a case file')
        self.expect(self.cdca("run", EXAMPLE, "--nonsense"), 2, "--nonsense")
        self.expect(self.cdca("check", EXAMPLE, "another.toml"), 2, "another.toml")

    def test_manual_is_the_one_in_the_documentation(self):
        done = self.cdca("options")
        self.expect(done, 0)
        self.assertEqual(done.stdout, (SOURCE / "docs" / "case-file.md").read_text(encoding="utf-8"))


class InputTest(ProgramTest):
    def test_missing_file(self):
        for command in ("check", "run"):
            self.expect(self.cdca(command, "none.toml"), 2,
                        'cdca: none.toml: The case file "none.toml" cannot be read: No such file or directory')
        self.assertFalse((self.folder / "results").exists())

    def test_syntax_error(self):
        case = self.plate(("young = 1e9", "young = "))
        self.expect(self.cdca("check", case), 2, "cdca: plate.toml:5: The file is not valid TOML at column")

    def test_one_error_of_each_class(self):
        for old, new, message in (
            ("young", "yung", 'plate.toml:5: material.yung: The key "yung" is unknown in [material]; did you mean "young"?'),
            ("young = 1e9", 'young = "1e9"', 'plate.toml:5: material.young: Found the text "1e9"; allowed is a number'),
            ("poisson = 0.3", "poisson = 0.5", "plate.toml:6: material.poisson: Found 0.5; allowed is"),
            ("poisson = 0.3", "poisson = nan", "plate.toml:6: material.poisson: Found nan; allowed are finite numbers"),
            ("poisson = 0.3\n", "", 'plate.toml:4: material.poisson: The required key "poisson" is missing'),
            ("[output]", "[contact]\nlaw = \"coulomb\"\n[output]", 
             'plate.toml:14: contact.law: The law "coulomb" needs normal_stiffness, which is not given'),
            ("[output]", "[[crack]]\npoints = [[0, 0.5], [1.5, 0.5]]\n[output]",
             'plate.toml:14: crack[0].points[1]: The crack "crack1" reaches [1.5, 0.5]'),
            ("displacement = [0.0, 0.0]", 'displacement = ["free", 0.0]', "plate.toml:7: boundary: The supports leave"),
        ):
            with self.subTest(new):
                self.expect(self.cdca("check", self.plate((old, new))), 2, message)

    def test_several_errors_at_once(self):
        case = self.plate(("poisson = 0.3", "poisson = 0.7"), ("young = 1e9", "young = -1"), ('"top"', '"tpo"'))
        done = self.cdca("check", case, "--set", "foo=1")
        self.expect(done, 2, ":5: material.young: ", ":6: material.poisson: ", ":11: boundary[1].on: ", "plate.toml: foo: ")
        self.assertEqual(len(done.stderr.splitlines()), 4)

    def test_settings_of_the_command_line(self):
        case = self.plate()
        done = self.cdca("check", case, "--set", "domain.cells=[4, 6]", "title=Other")
        self.expect(done, 0)
        self.assertIn("4 x 6 elements", done.stdout)
        self.assertIn("Other", done.stdout)
        done = self.cdca("check", "--set", "material.young=2e9", "material.poisson=0.1", case)
        self.assertIn("E = 2e+09 Pa, nu = 0.1", done.stdout)
        self.expect(self.cdca("check", case, "--set", "material.poisson=0.7"), 2,
                    "material.poisson: Found 0.7; allowed is a number, greater than -1 and less than 0.5 "
                    "(this was set on the command line).")

    def test_what_only_the_model_finds(self):
        short = self.plate(("[output]", "[[crack]]\npoints = [[0.52, 0.52], [0.58, 0.58]]\n[output]"))
        self.expect(self.cdca("check", short), 2, "plate.toml:13: crack[0]: ")
        loose = self.plate(("[output]", "[[crack]]\npoints = [[0, 0.55], [1, 0.55]]\n[output]"))
        self.expect(self.cdca("check", loose), 2, "boundary: ")

    def test_check_says_what_it_understood(self):
        done = self.cdca("check", EXAMPLE)
        self.expect(done, 0)
        for text in ("0.02 x 0.052 m", "39 x 103 elements", "E = 7.6e+10 Pa", "edge: 2 points", "active tips: 1",
                     "4017 elements, 4160 nodes", "unknowns", "memory"):
            self.assertIn(text, done.stdout)
        self.assertFalse((self.folder / "results").exists())


class RunTest(ProgramTest):
    def test_results_go_where_they_are_wanted(self):
        done = self.cdca("run", EXAMPLE, *SMALL)
        self.expect(done, 0)
        self.assertIn("step 1/1", done.stdout)
        summary = json.loads((self.folder / "results" / "edge_crack" / "summary.json").read_text())
        self.assertEqual(summary["status"], "completed")
        self.expect(self.cdca("run", EXAMPLE, *SMALL, "-o", "there"), 0)
        self.assertTrue((self.folder / "there" / "history.csv").exists())

    def test_the_effective_input_gives_the_same_results(self):
        self.expect(self.cdca("run", EXAMPLE, *SMALL, "-o", "first"), 0)
        self.expect(self.cdca("run", "first/effective.toml", "-o", "second"), 0)
        for name in ("effective.toml", "tips.csv"):
            self.assertEqual((self.folder / "first" / name).read_text(), (self.folder / "second" / name).read_text())

    def test_quiet_says_nothing(self):
        done = self.cdca("run", EXAMPLE, *SMALL, "--quiet")
        self.expect(done, 0)
        self.assertEqual(done.stdout + done.stderr, "")

    def test_pictures_are_drawn(self):
        self.expect(self.cdca("run", EXAMPLE, *SMALL[:2], "-o", "out"), 0)
        self.assertGreater(len(list((self.folder / "out").glob("*.png"))), 0)

    def test_plain_lines_when_no_terminal_is_there(self):
        done = self.cdca("run", EXAMPLE, *SMALL, "--set", "loading.steps=3")
        self.expect(done, 0)
        self.assertEqual(sum(line.startswith("step ") for line in done.stdout.splitlines()), 3)
        self.assertNotIn("\r", done.stdout)
        self.assertNotIn("\x1b", done.stdout)

    def test_no_convergence(self):
        done = self.cdca("run", EXAMPLE, *SMALL, *STUBBORN, "-o", "out")
        self.expect(done, 3)
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertEqual(summary["status"], "failed")

    def test_results_that_cannot_be_written(self):
        (self.folder / "taken").write_text("a file")
        for directory in ("/proc/none", "taken"):
            self.expect(self.cdca("run", EXAMPLE, *SMALL, "-o", directory), 4, f"result folder {directory}")

    def test_an_expression_without_a_value(self):
        for bound in ("0.98", "0.992"):  # seen when the file is read; met at a quadrature point only
            case = self.hole_in_the_load(bound)
            self.expect(self.cdca("run", case), 2, "plate.toml:12: boundary[1].traction[1]: The expression")


class RanksTest(ProgramTest):
    """One rank speaks, all end with the same status, nothing hangs."""

    def test_help_and_version(self):
        self.assertEqual(self.cdca("--help", ranks=2).stdout.count("Usage: cdca"), 1)
        self.assertEqual(self.cdca("--version", ranks=2).stdout.count("cdca "), 1)

    def test_wrong_usage(self):
        self.expect(self.cdca("chekc", ranks=2), 2, "There is no command")

    def test_wrong_input(self):
        self.expect(self.cdca("run", "none.toml", ranks=2), 2, "cannot be read")
        self.expect(self.cdca("run", self.plate(("poisson = 0.3", "poisson = 0.7")), ranks=2), 2, "Found 0.7")
        self.expect(self.cdca("check", self.plate(("young = 1e9", "young = ")), ranks=2), 2, "not valid TOML")

    def test_check(self):
        done = self.cdca("check", EXAMPLE, ranks=2)
        self.expect(done, 0)
        self.assertEqual(done.stdout, self.cdca("check", EXAMPLE).stdout)

    def test_run(self):
        done = self.cdca("run", EXAMPLE, *SMALL, ranks=2)
        self.expect(done, 0)
        self.assertEqual(done.stdout.count("step 1/1"), 1)
        summary = json.loads((self.folder / "results" / "edge_crack" / "summary.json").read_text())
        self.assertEqual(summary["ranks"], 2)

    def test_no_convergence(self):
        done = self.cdca("run", EXAMPLE, *SMALL, *STUBBORN, ranks=2)
        self.expect(done, 3)
        self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_results_that_cannot_be_written(self):
        self.expect(self.cdca("run", EXAMPLE, *SMALL, "-o", "/proc/none", ranks=2), 4, "result folder /proc/none")

    def test_an_error_on_one_rank_only(self):
        # The corner where the load has no value belongs to one of the ranks.
        case = self.hole_in_the_load("0.992")
        self.expect(self.cdca("run", case, ranks=2), 2, "boundary[1].traction[1]: The expression")


if __name__ == "__main__":
    unittest.main()

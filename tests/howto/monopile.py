#!/usr/bin/env python3
"""Follows docs/howto/monopile.md: its commands run, its request and its numbers are those of the program, and these are near
those of tests/verification/data/monopile.py, which shares no code with the solver, and near the figure of the paper.

usage: monopile.py BINARY
"""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/howto/monopile.md").read_text(encoding="utf-8")
REQUEST = ROOT / "examples/monopile.json"
BINARY = ""

# Printed by tests/verification/data/monopile.py: force at the flange in MN to displacement in m and rotation of the mudline,
# for small displacements; stiffness at rest in kN/m, kN, kN m; first frequency in Hz without and with the weight's force.
HEADS = {5: (0.019540443, -0.001962717), 10: (0.105586161, -0.008175966), 12: (0.211982086, -0.015224731)}
STIFFNESS = (5485259.0221, 26762054.1542, 337361792.1954)
FREQUENCIES = (0.29647241, 0.29104616)
# The page's "How exact it is": displacements follow the `accuracy` of 0.002. The first line of a curve has the curve's initial
# slope, so that stiffness and frequencies at rest lack what straight lines between depths leave.
HEAD_DIFFERENCE, REST_DIFFERENCE = 0.002, 0.0005
# The 1D model of Byrne et al. (2020), figure for pile D1: 14.5 MN at D/10, read to 0.1 MN.
DISPLACEMENT_AT_TENTH, FORCE_AT_TENTH, READING = 0.75, 14.5, 0.1


def table(heading):
    """Rows of the table whose first column has this heading, without the head."""
    rows = PAGE.partition(f"\n| {heading} |")[2].splitlines()[2:]
    end = next(i for i, row in enumerate(rows) if not row.startswith("|"))
    return [[cell.strip() for cell in row.strip("|").split("|")] for row in rows[:end]]


def labels(svg):
    """Texts of a figure's labels."""
    return ["".join(one.itertext()) for one in ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")]


def hertz(frequencies):
    return math.sqrt(frequencies["omega_squared"][0]) / (2 * math.pi)


def solved(**changes):
    request = json.loads(REQUEST.read_text(encoding="utf-8"))
    request["analysis"].update(changes)
    run = subprocess.run([BINARY, "solve", "-"], input=json.dumps(request), capture_output=True, text=True, check=True,
                         timeout=300)
    return json.loads(run.stdout)


def stiffness(result, n):
    """(x by x, x by rotation, moment by rotation, y by y) of the mudline in a state"""
    tangent = result["states"][n]["stiffness_at"][0]["tangent"]
    return tangent[0][0], tangent[0][2], tangent[2][2], tangent[1][1]


class Monopile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        place = pathlib.Path(cls.folder.name)
        (place / "build/release").mkdir(parents=True)
        (place / "build/release/snapthrough").symlink_to(BINARY)
        (place / "examples").symlink_to(ROOT / "examples")
        block = re.search(r"^```\n(.*?)^```", PAGE, re.M | re.S)[1]
        cls.commands = block.splitlines()
        subprocess.run(["bash", "-e", "-c", block], cwd=place, check=True, timeout=600, env=dict(os.environ))
        cls.result = json.loads((place / "monopile.json").read_text(encoding="utf-8"))
        cls.picture = (place / "monopile_moment.svg").read_bytes()
        cls.diameters = (place / "diameters.csv").read_text(encoding="utf-8").splitlines()
        cls.small = solved(geometry="linear")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def expect_printed(self, printed, value):
        """The number, rounded as it is printed."""
        places = len(printed.partition(".")[2])
        self.assertLessEqual(abs(float(printed) - value), 0.501 * 10.0**-places, printed)

    def test_the_page_quotes_the_request(self):
        self.assertIn(f"```json\n{REQUEST.read_text(encoding='utf-8')}```", PAGE)

    def test_the_page_shows_the_picture_that_its_command_draws(self):
        shown = (ROOT / "docs/howto/monopile_moment.svg").read_bytes()
        self.assertEqual(len(self.commands), 4)
        self.assertEqual(labels(self.picture), labels(shown))

    def test_displacements_and_moments_are_those_of_the_program(self):
        rows = table("force at the flange, MN | displacement at the mudline, m")
        self.assertEqual(len(rows), 3)
        for n, (load, displacement, rotation, moment, depth) in enumerate(rows, 1):
            least = self.result["states"][n]["members"]["pile"]["extremes"]["bending_moment"]["min"]
            monitors = self.result["static"]["monitors"]
            self.assertEqual(float(load), self.result["static"]["load_factor"][n])
            self.expect_printed(displacement, monitors["head"][n])
            self.expect_printed(rotation, math.degrees(monitors["head rotation"][n]))
            self.expect_printed(moment, -least["value"] / 1e3)
            self.expect_printed(depth, 22.5 - least["s"])

    def test_stiffness_is_that_of_the_program(self):
        rows = table("force at the flange, MN | x by x")
        self.assertEqual(len(rows), 4)
        for n, (_, *printed) in enumerate(rows):
            for text, value in zip(printed, stiffness(self.result, n)):
                self.expect_printed(text, value / 1e3)

    def test_frequencies_are_those_of_the_program(self):
        printed = re.search(r"over 2 pi:\s+([\d.]+) Hz at rest, ([\d.]+), ([\d.]+) and ([\d.]+) Hz under", PAGE).groups()
        for text, found in zip(printed, self.result["static"]["frequencies"]):
            self.expect_printed(text, hertz(found))

    def test_the_sweep_gives_the_table(self):
        rows = table("diameter, m")
        self.assertEqual(len(rows), len(self.diameters) - 1)
        for printed, line in zip(rows, self.diameters[1:]):
            diameter, displacement, rotation, squared, error = line.split(",")
            self.assertEqual((float(printed[0]), error), (float(diameter), ""))
            self.expect_printed(printed[1], float(displacement))
            self.expect_printed(printed[2], math.degrees(float(rotation)))
            self.expect_printed(printed[3], math.sqrt(float(squared)) / (2 * math.pi))

    def test_heads_are_near_those_of_another_program(self):
        monitors = self.small["static"]["monitors"]
        for n, load in enumerate(self.small["static"]["load_factor"]):
            for name, expected in zip(("head", "head rotation"), HEADS.get(load, ())):
                self.assertLess(abs(monitors[name][n] / expected - 1), HEAD_DIFFERENCE, f"{name} at {load} MN")

    def test_stiffness_and_frequencies_are_near_those_of_another_program(self):
        for found, expected in zip(stiffness(self.small, 0), STIFFNESS):
            self.assertLess(abs(found / expected - 1), REST_DIFFERENCE)
        for result, expected in zip((self.small, self.result), FREQUENCIES):
            self.assertLess(abs(hertz(result["static"]["frequencies"][0]) / expected - 1), REST_DIFFERENCE)

    def test_the_load_at_a_tenth_of_the_diameter_is_the_published_one(self):
        least, most = solved(geometry="linear", load_factors=[FORCE_AT_TENTH - READING, FORCE_AT_TENTH + READING],
                             output={"states": "none"})["static"]["monitors"]["head"]
        self.assertLess(least, DISPLACEMENT_AT_TENTH)
        self.assertGreater(most, DISPLACEMENT_AT_TENTH)


if __name__ == "__main__":
    BINARY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()

#!/usr/bin/env python3
"""Drawings of paths by the Python package, with rates between few rows of known curves; needs matplotlib and generate.py.

  test_plot.py [TEST...]
"""
import json
import math
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "clients" / "python"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")

from matplotlib import pyplot  # noqa: E402
from snapthrough import Result, _plot  # noqa: E402


def branch(rows, **fields):
    """A branch with rows of arc length, monitor, load factor, and the rates of the latter two."""
    arcs, crown, load, crown_rates, load_rates = (list(values) for values in zip(*rows))
    return {"id": 0, "parent": None, "load_factor": load, "arc_length": arcs, "monitors": {"crown": crown},
            "negative_eigenvalues": [0] * len(arcs), "stiffness_ratio": [None] * len(arcs), "contact_fraction": {},
            "rates": {"load_factor": load_rates, "monitors": {"crown": crown_rates}}, "termination": "steps", **fields}


def half_circle(**fields):
    """A half circle of radius 1 around (1, 0) by five rows."""
    angles = [part * math.pi / 4 for part in range(5)]
    return branch([(s, 1 - math.cos(s), math.sin(s), math.sin(s), math.cos(s)) for s in angles], **fields)


def lines_of(*branches, **options):
    """Points of each line that is drawn of a result with these branches, and its style."""
    document = {"summary": {}, "model": {"title": "", "units": {}}, "branches": list(branches), "critical_points": []}
    axes = _plot.draw(Result.from_json(json.dumps(document).encode()), "path", None, **options)
    pyplot.close(axes.figure)
    return [(list(zip(line.get_xdata(), line.get_ydata())), line.get_linestyle()) for line in axes.lines]


class Paths(unittest.TestCase):
    def test_the_line_through_five_rows_of_a_half_circle_is_round(self):
        (points, _), = lines_of(half_circle())
        self.assertEqual(len(points), 4 * 8 + 1)
        self.assertLess(max(abs(math.hypot(1 - x, y) - 1) for x, y in points), 2e-3)

    def test_without_a_monitor_it_is_round_over_the_arc_length(self):
        (points, _), = lines_of({**half_circle(monitors={}), "rates": {**half_circle()["rates"], "monitors": {}}})
        self.assertLess(max(abs(y - math.sin(x)) for x, y in points), 2e-3)

    def test_without_rates_the_rows_are_joined_by_straight_lines(self):
        plain = half_circle()
        del plain["rates"]
        (points, _), = lines_of(plain)
        self.assertEqual(points, list(zip(plain["monitors"]["crown"], plain["load_factor"])))

    def test_a_kink_between_rows_next_to_one_another_stays_sharp(self):
        near = 1 + 1e-7
        kinked = branch([(0, 0, 0, 1, 0), (1, 1, 1, 1, 2), (near, near, 1, 1, -2), (2, 2, 0, 1, 0)])
        (points, _), = lines_of(kinked)
        self.assertLess(max(abs(y - min(x, 2 - x) ** 2) for x, y in points), 1e-6)

    def test_stability_changes_at_the_row_that_begins_the_unstable_piece(self):
        (stable, solid), (unstable, dashed) = lines_of(half_circle(negative_eigenvalues=[0, 0, 1, 1, 1]))
        self.assertEqual((solid, dashed), ("-", "--"))
        for end in (stable[-1], unstable[0]):
            self.assertAlmostEqual(math.dist(end, (1, 1)), 0, places=12)
        (alone, style), = lines_of(half_circle(negative_eigenvalues=[0, 0, 0, 0, 1]))
        self.assertEqual((len(alone), style), (4 * 8 + 1, "-"))

    def test_dots_on_request_are_the_computed_rows(self):
        rows = list(zip(half_circle()["monitors"]["crown"], half_circle()["load_factor"]))
        _, (dots, style) = lines_of(half_circle(computed=[0, 2, 4]), points=True)
        self.assertEqual((dots, style), (rows[::2], "None"))
        _, (dots, _) = lines_of(half_circle(), points=True)
        self.assertEqual(dots, rows)


if __name__ == "__main__":
    unittest.main()

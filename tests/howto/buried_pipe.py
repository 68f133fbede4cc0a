#!/usr/bin/env python3
"""Pipes in soil: the foundations of a request's `pipe` are those of the formulas of docs/howto/buried-pipe.md, which this file
has of its own, and pipes on them move as closed forms say.

usage: buried_pipe.py BINARY

The figures of N_qh, N_ch and the other factors are those of the American Lifelines Alliance, Guidelines for the Design of
Buried Steel Pipe (2001, addenda to 2005), appendix B.
"""
import itertools
import json
import math
import pathlib
import subprocess
import sys
import unittest

BINARY = ""
NEAR = 1e-6  # answers of a static analysis with the accuracy of ACCURACY
ACCURACY = 1e-7
D, H, E, THICKNESS = 0.61, 1.5, 2.1e8, 0.0127
LENGTH = 40
SAND = {"type": "sand", "unit_weight": 18, "phi": 37, "coating_factor": 0.7, "density": "loose"}
CLAY = {"type": "clay", "unit_weight": 9, "total_unit_weight": 19, "Su": 40, "adhesion": 0.9, "consistency": "soft"}
N_QH = {35: (6.816, 2.019, -0.146, 7.651e-3, -1.683e-4), 40: (10.959, 1.783, 0.045, -5.425e-3, -1.153e-4)}


def reactions(soil):
    """{reaction: (displacement, force per length)}"""
    weight, x = soil["unit_weight"] * H * D, H / D
    total = soil.get("total_unit_weight", soil["unit_weight"])
    if soil["type"] == "clay":
        c = soil["Su"]
        lateral = min(6.752 + 0.065 * x - 11.063 / (1 + x) ** 2 + 7.119 / (1 + x) ** 3, 9)
        return {"axial": (0.01, math.pi * D * soil["adhesion"] * c),
                "lateral": (min(0.04 * (H + D / 2), 0.1 * D), lateral * c * D),
                "uplift": (min(0.2 * H, 0.2 * D), min(2 * x, 10) * c * D),
                "bearing": (0.2 * D, (2 + math.pi) * c * D + weight + math.exp(-2.5) * total * D * D / 2)}
    phi = math.radians(soil["phi"])
    at = {angle: sum(c * x ** i for i, c in enumerate(row)) for angle, row in N_QH.items()}
    lateral = at[35] + (soil["phi"] - 35) / 5 * (at[40] - at[35])
    n_q = math.exp(math.pi * math.tan(phi)) * (1 + math.sin(phi)) / (1 - math.sin(phi))  # tan^2(45 + phi/2)
    n_gamma = math.exp(0.18 * soil["phi"] - 2.5)
    friction = math.tan(soil["coating_factor"] * phi)
    return {"axial": (0.005, math.pi * weight * (2 - math.sin(phi)) / 2 * friction),
            "lateral": (min(0.04 * (H + D / 2), 0.1 * D), lateral * weight),
            "uplift": (min(0.02 * H, 0.1 * D), min(soil["phi"] * x / 44, n_q) * weight),
            "bearing": (0.1 * D, n_q * weight + n_gamma * total * D * D / 2)}


def model(soil, plane, forward=True, **fields):
    """A straight pipe along x, from left to right or back."""
    ends = [{"id": "left", "x": 0, "y": 0}, {"id": "right", "x": LENGTH, "y": 0}]
    start, end = ("left", "right") if forward else ("right", "left")
    axial = reactions(soil)["axial"][0]
    return {"nodes": ends, "members": [{"id": "pipe", "start": start, "end": end, "section": "steel"}],
            "sections": [{"id": "steel", "E": E, "shape": {"type": "tube", "diameter": D, "thickness": THICKNESS}}],
            "foundations": [{"id": "soil", "member": "pipe",
                             "pipe": {"plane": plane, "depth": H, "soil": soil, "displacements": {"axial": axial}}}],
            "monitors": [{"id": axis, "at": {"node": "right"}, "component": axis} for axis in "xy"], **fields}


def by_hand(given, plane):
    """The model with laws in place of its pipe."""
    values = reactions(given["foundations"][0]["pipe"]["soil"])
    left_is_up = given["members"][0]["start"] == "left"
    own = {"axial": {"component": "tangent"}, "lateral": {},
           "uplift": {"reaction": "compression_only", "side": "left" if left_is_up else "right"},
           "bearing": {"reaction": "compression_only", "side": "right" if left_is_up else "left"}}
    names = ("axial", "lateral") if plane == "horizontal" else ("axial", "uplift", "bearing")
    laws = [{"id": f"soil {name}", "member": "pipe", **own[name],
             "law": {"type": "table", "interpolation": "linear", "points": [[0, 0], list(values[name])]}} for name in names]
    return {**given, "foundations": laws}


def run(command, document):
    done = subprocess.run([BINARY, *command], input=json.dumps(document), capture_output=True, text=True, timeout=300)
    if done.returncode:
        raise AssertionError(done.stdout[:2000] + done.stderr[:2000])
    return json.loads(done.stdout)


def solved(given):
    return run(["solve", "-"], {"model": given, "analysis": {"type": "static", "geometry": "linear",
                                                             "discretization": {"accuracy": ACCURACY}}})


def laws_of(given):
    """The foundations that the program makes of a model."""
    return run(["convert", "soil", "-"], {"model": given, "analysis": {"type": "static"}})["foundations"]


def moved(given):
    """Displacements of the right end."""
    monitors = solved(given)["static"]["monitors"]
    return monitors["x"][0], monitors["y"][0]


class BuriedPipe(unittest.TestCase):
    def expect_near(self, found, expected, what):
        self.assertLess(abs(found - expected), NEAR * abs(expected), f"{what}: {found}, {expected}")

    def expect_laws(self, made, expected):
        self.assertEqual([one["id"] for one in made], [one["id"] for one in expected])
        for one, other in zip(made, expected):
            for found, value in zip(one["law"]["points"][1], other["law"]["points"][1]):
                self.assertLess(abs(found - value), 1e-13 * value, one["id"])
            one["law"]["points"] = other["law"]["points"]
            self.assertEqual(one, other)

    def test_foundations_are_those_of_the_formulas(self):
        for soil, plane, forward in itertools.product((SAND, CLAY), ("vertical", "horizontal"), (True, False)):
            given = model(soil, plane, forward)
            self.expect_laws(laws_of(given), by_hand(given, plane)["foundations"])

    def test_answers_are_those_of_the_same_laws(self):
        for plane in ("vertical", "horizontal"):
            load = {"type": "point", "at": {"member": "pipe", "fraction": 0.3}, "force": [5, 8]}
            given = model(SAND, plane, loads=[load])
            one, other = solved(given), solved({**given, "foundations": laws_of(given)})
            self.assertEqual(one["states"], other["states"])
            self.assertEqual(one["static"], other["static"])

    def test_half_of_a_capacity_moves_by_half_of_its_displacement(self):
        for soil in (SAND, CLAY):
            values = reactions(soil)
            for plane, name, axis, sign in (("vertical", "uplift", 1, 1), ("vertical", "bearing", 1, -1),
                                            ("horizontal", "lateral", 1, 1), ("horizontal", "lateral", 1, -1),
                                            ("vertical", "axial", 0, 1), ("horizontal", "axial", 0, -1)):
                displacement, force = values[name]
                load = [0.0, 0.0]
                load[axis] = 0.5 * sign * force
                for forward in (True, False):
                    given = model(soil, plane, forward, loads=[{"type": "distributed", "member": "pipe", "force": load}])
                    self.expect_near(moved(given)[axis], 0.5 * sign * displacement, f"{soil['type']} {name} {forward}")

    def test_a_pipe_that_is_pulled_slips_from_its_end(self):
        """A long pipe: its end force is sqrt(EA t d) where it begins to slip, and t a further on by each length a."""
        displacement, t = reactions(CLAY)["axial"]
        EA = E * math.pi * (D - THICKNESS) * THICKNESS
        elastic = math.sqrt(EA * t * displacement)
        for slipped in (0.0, 30.0):
            given = model(CLAY, "vertical")
            given["nodes"][0]["x"] = -1500
            given["loads"] = [{"type": "point", "at": {"node": "right"}, "force": [elastic + t * slipped, 0]}]
            end = displacement + elastic * slipped / EA + t * slipped ** 2 / (2 * EA)
            self.expect_near(moved(given)[0], end, f"{slipped} slipped")


if __name__ == "__main__":
    BINARY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()

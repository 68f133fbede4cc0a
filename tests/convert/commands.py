#!/usr/bin/env python3
"""Checks `snapthrough convert` as a user runs it: streams, exit statuses, the commands of its page, and that a request takes
what it writes.

usage: commands.py BINARY
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs/howto/convert.md"
EXAMPLES = ROOT / "examples/convert"
BINARY = ""


class Commands(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.place = pathlib.Path(self.folder.name)
        (self.place / "examples").symlink_to(ROOT / "examples")

    def tearDown(self):
        self.folder.cleanup()

    def run_it(self, *arguments, text=None):
        return subprocess.run([BINARY, *arguments], cwd=self.place, input=text, capture_output=True, text=True, check=False,
                              timeout=120)

    def converted(self, *arguments, text=None):
        run = self.run_it("convert", *arguments, text=text)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return json.loads(run.stdout)

    def expect_valid(self, parts, fixed, loaded):
        """The parts, with supports at nodes and a load, are a request without mistakes."""
        model = {**parts, "supports": [{"node": node, "fixed": ["x", "y", "rotation"]} for node in fixed],
                 "loads": [{"type": "point", "at": {"node": loaded}, "force": [0, -1]}]}
        run = self.run_it("check", "-", text=json.dumps({"model": model, "analysis": {"type": "static"}}))
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def commands_of_the_page(self):
        return [line for block in re.findall(r"^```\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.M | re.S)
                for line in block.splitlines()]

    def test_commands_of_the_page_write_what_it_says(self):
        commands = self.commands_of_the_page()
        self.assertEqual(len(commands), 3)
        for command in commands:
            run = subprocess.run(["sh", "-c", command.replace("snapthrough", BINARY, 1)], cwd=self.place, check=False,
                                 capture_output=True, timeout=120)
            self.assertEqual((run.returncode, run.stderr), (0, b""), command)
        read = {name: json.loads((self.place / f"{name}.json").read_text()) for name in ("soil", "frame", "portal")}
        self.assertEqual(set(read["soil"]), {"units", "foundations"})
        self.assertEqual(set(read["frame"]), {"nodes", "members", "sections"})
        self.assertEqual(set(read["portal"]), {"nodes", "members", "sections"})

    def test_the_page_quotes_the_example(self):
        text = (EXAMPLES / "pile_soil.json").read_text(encoding="utf-8")
        self.assertIn(f"```json\n{text}```", PAGE.read_text(encoding="utf-8"))

    def test_tables_are_a_valid_model(self):
        parts = self.converted("csv", "--nodes", "examples/convert/nodes.csv", "--members", "examples/convert/members.csv",
                               "--sections", "examples/convert/sections.csv")
        self.expect_valid(parts, ["left foot", "right foot"], "left corner")

    def test_a_drawing_is_a_valid_model_once_its_sections_have_stiffness(self):
        parts = self.converted("dxf", "examples/convert/portal.dxf", "--layer", "column", "--layer", "rafter", "--layer", "tie")
        self.assertEqual(parts["sections"], [{"id": "column"}, {"id": "rafter"}, {"id": "tie"}])
        self.assertEqual(len(parts["nodes"]), 5, "the tie's ends are the columns' feet")
        for section in parts["sections"]:
            section.update(EA=1e6, EI=1e3)
        self.expect_valid(parts, ["1", "5"], "3")

    def test_a_pile_has_its_curves_by_depth(self):
        parts = self.converted("soil", "-", text=(EXAMPLES / "pile_soil.json").read_text(encoding="utf-8"))
        clay, sand = parts["foundations"]
        # head at fraction 1 and 1 above ground, length 12: depth X is at 1 - (X + 1)/12
        self.assertEqual((clay["id"], clay["member"]), ("shaft layer 1", "shaft"))
        self.assertAlmostEqual(clay["range"][0], 7 / 12, delta=1e-15)
        self.assertAlmostEqual(clay["range"][1], 11 / 12, delta=1e-15)
        self.assertEqual(clay["law"]["type"], "power")
        self.assertAlmostEqual(clay["law"]["reference"], 8 * 2.5 * 0.02 * 0.6, delta=1e-15)
        self.assertAlmostEqual(clay["law"]["capacity"]["along"][-1][1], 3 * 15 * 0.6, delta=1e-12)
        self.assertEqual((sand["law"]["type"], sand["range"]), ("tanh", [0, clay["range"][0]]))
        self.assertEqual(sand["law"]["stiffness"]["along"], [[0, 14000 * 11], [clay["range"][0], 14000 * 4]])
        # at the tip X = 11: s = 4 x 8 + 7 x 10 = 102, A = 0.9, deep by C3
        b, phi = math.radians(61), math.radians(32)
        active = math.tan(math.radians(29)) ** 2
        deep = (active * (math.tan(b) ** 8 - 1) + 0.4 * math.tan(phi) * math.tan(b) ** 4) * 0.6 * 102
        self.assertAlmostEqual(sand["law"]["capacity"]["along"][0][1] / (0.9 * deep), 1, delta=1e-12)

    def test_a_pile_is_a_valid_model(self):
        soil = json.loads((EXAMPLES / "pile_soil.json").read_text(encoding="utf-8"))
        for loading in ("static", "cyclic"):
            parts = self.converted("soil", "-", text=json.dumps({**soil, "loading": loading}))
            model = {"nodes": [{"id": "t", "x": 0, "y": -12}, {"id": "h", "x": 0, "y": 0}],
                     "members": [{"id": "shaft", "start": "t", "end": "h", "section": "s"}],
                     "sections": [{"id": "s", "EA": 1e6, "EI": 1e5}], **parts}
            self.expect_valid(model, ["t"], "h")

    def drawing(self, *lines):
        """Returns a drawing with lines x0, y0, x1, y1."""
        entities = "".join(f"0\nLINE\n8\nwall\n10\n{a}\n20\n{b}\n11\n{c}\n21\n{d}\n" for a, b, c, d in lines)
        return f"0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"

    def test_what_only_looks_joined_is_told_on_standard_error(self):
        tee = self.drawing((0, 0, 6, 0), (3, 0, 3, 4), (3, 4, 3, 0))
        run = self.run_it("convert", "dxf", "-", text=tee)
        self.assertEqual(run.returncode, 0)
        self.assertEqual(len(json.loads(run.stdout)["members"]), 2)
        self.assertRegex(run.stderr, r"(?m)^Warning: 1 end lies on a segment .*\(3, 0\) on the segment of line 6; "
                                     r"--join-tees .* \[tee_unjoined\]$")
        self.assertRegex(run.stderr, r"(?m)^Warning: 1 segment is drawn twice .* \[duplicates_dropped\]$")
        joined = self.run_it("convert", "dxf", "-", "--join-tees", text=tee)
        self.assertEqual(len(json.loads(joined.stdout)["members"]), 3)
        self.assertNotIn("tee_unjoined", joined.stderr)

    def test_a_wrong_tolerance_is_told_by_its_name_and_rule(self):
        for wrong in ("0", "-1", "nan", "inf", "1e151"):
            run = self.run_it("convert", "dxf", "-", "--tolerance=" + wrong, text=self.drawing((0, 0, 1, 0)))
            self.assertEqual((run.returncode, run.stdout), (1, ""), wrong)
            self.assertIn("--tolerance must be a number above 0", run.stderr)

    def test_mistakes_have_status_2_and_their_place(self):
        soil = json.loads((EXAMPLES / "pile_soil.json").read_text(encoding="utf-8"))
        soil["layers"][1]["phi"] = 60
        (self.place / "nodes.csv").write_text("id,x,y\na,0,0\nb,1,one\n")
        (self.place / "members.csv").write_text("id,start,end,section\nab,a,b,s\n")
        for arguments, text, words in (
                (["soil"], json.dumps(soil), "/layers/1/phi: phi must be from 20 to 45 degrees"),
                (["soil"], "{", "[malformed]"),
                (["csv", "--nodes", "nodes.csv", "--members", "members.csv"], None, 'nodes.csv:3:y: expected a number'),
                (["dxf", "examples/convert/portal.dxf"], None, "line 76: TEXT is not supported"),
                (["dxf", "-"], "0\nSECTION\n", "the drawing has no section ENTITIES")):
            run = self.run_it("convert", *arguments, text=text)
            self.assertEqual((run.returncode, run.stdout), (2, ""), run.stderr)
            self.assertIn(words, run.stderr)

    def test_wrong_arguments_have_status_1(self):
        for arguments in ([], ["pdf"], ["soil", "nowhere.json"], ["csv"], ["csv", "--nodes", "a.csv"],
                          ["csv", "--nodes", "-", "--members", "-"], ["soil", "--layer", "a"], ["dxf", "--nodes", "a.csv"], ["soil", "--join-tees"],
                          ["dxf", "examples/convert/portal.dxf", "--tolerance", "0"],
                          ["csv", "--nodes", "nowhere.csv", "--members", "nowhere.csv"]):
            run = self.run_it("convert", *arguments, text="")
            self.assertEqual((run.returncode, run.stdout), (1, ""), arguments)
            self.assertTrue(run.stderr, arguments)


if __name__ == "__main__":
    BINARY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()

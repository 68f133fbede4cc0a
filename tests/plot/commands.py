#!/usr/bin/env python3
"""Checks `snapthrough plot` as a user runs it: files, streams, exit statuses, and the commands of its page.

usage: commands.py BINARY
"""
import json
import os
import pathlib
import re
import stat
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs/howto/plot-results.md"
PICTURES = ROOT / "docs/howto/plots"
BINARY = ""
PNG = b"\x89PNG\r\n\x1a\n"


def labels(svg):
    """Texts of a figure's labels."""
    root = ElementTree.fromstring(svg)
    return ["".join(element.itertext()) for element in root.iter("{http://www.w3.org/2000/svg}text")]


class Commands(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.place = pathlib.Path(self.folder.name)
        (self.place / "examples").symlink_to(ROOT / "examples")
        self.environment = dict(os.environ)

    def tearDown(self):
        self.folder.cleanup()

    def run_it(self, *arguments, text=None):
        return subprocess.run([BINARY, *arguments], cwd=self.place, input=text, capture_output=True, check=False,
                              env=self.environment, timeout=120)

    def solved(self, name="buried_pipe"):
        run = self.run_it("solve", f"examples/{name}.json")
        self.assertEqual(run.returncode, 0, run.stderr)
        (self.place / "result.json").write_bytes(run.stdout)
        return run.stdout

    def own_program(self, name, script):
        """A program of this name is found before all others."""
        folder = self.place / "bin"
        folder.mkdir(exist_ok=True)
        (folder / name).write_text(script, encoding="utf-8")
        (folder / name).chmod(0o755)
        self.environment["PATH"] = f"{folder}:{self.environment['PATH']}"

    def names(self):
        return sorted(path.name for path in self.place.iterdir())

    def test_commands_of_the_page_run_and_make_its_pictures(self):
        bin_folder = self.place / "bin"
        bin_folder.mkdir()
        (bin_folder / "snapthrough").symlink_to(BINARY)
        self.environment["PATH"] = f"{bin_folder}:{self.environment['PATH']}"
        commands = [line for block in re.findall(r"^```\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.M | re.S)
                    for line in block.splitlines()]
        self.assertGreater(len(commands), 8)
        for command in commands:
            run = subprocess.run(["sh", "-c", command], cwd=self.place, capture_output=True, check=False,
                                 env=self.environment, timeout=120)
            self.assertEqual(run.returncode, 0, f"{command}: {run.stderr.decode()}")
        pictures = sorted(PICTURES.glob("*.svg"))
        self.assertTrue(pictures)
        for picture in pictures:
            made = (self.place / picture.name).read_bytes()
            self.assertEqual(labels(made), labels(picture.read_bytes()), f"{picture.name} is of another version")
        self.assertTrue((self.place / "pipe_forces.png").read_bytes().startswith(PNG))

    def test_file_and_standard_output_have_the_same_bytes(self):
        result = self.solved()
        shown = self.run_it("plot", "result.json")
        self.assertEqual((shown.returncode, shown.stderr), (0, b""))
        read = self.run_it("plot", "-", "-o", "path.svg", text=result)
        self.assertEqual((read.returncode, read.stdout, read.stderr), (0, b"", b""))
        self.assertEqual((self.place / "path.svg").read_bytes(), shown.stdout)
        ElementTree.fromstring(shown.stdout)
        mask = os.umask(0)
        os.umask(mask)
        self.assertEqual(stat.S_IMODE((self.place / "path.svg").stat().st_mode), 0o666 & ~mask)

    def test_png_has_the_size_times_the_scale(self):
        self.solved()
        for arguments, size in (([], (1440, 960)), (["--scale", "1", "--width", "300"], (300, 480))):
            run = self.run_it("plot", "result.json", "-o", "path.png", *arguments)
            self.assertEqual(run.returncode, 0, run.stderr)
            data = (self.place / "path.png").read_bytes()
            self.assertTrue(data.startswith(PNG))
            self.assertEqual((int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")), size)

    def test_without_the_converter_its_package_is_named(self):
        self.solved()
        (self.place / "path.png").write_bytes(b"before")
        names = self.names()
        self.environment["PATH"] = "/nowhere"
        run = self.run_it("plot", "result.json", "-o", "path.png")
        self.assertEqual(run.returncode, 1)
        self.assertIn(b"librsvg2-bin", run.stderr)
        self.assertEqual((self.place / "path.png").read_bytes(), b"before")
        self.assertEqual(self.names(), names)

    def test_a_converter_that_fails_leaves_what_was_there(self):
        self.solved()
        self.own_program("rsvg-convert", "#!/bin/sh\nprintf half\necho 'out of ink' >&2\nexit 7\n")
        names = self.names()
        run = self.run_it("plot", "result.json", "-o", "path.png")
        self.assertEqual(run.returncode, 1)
        self.assertIn(b"rsvg-convert failed: out of ink", run.stderr)
        self.assertEqual(self.names(), names)

    def test_names_are_words_for_no_shell(self):
        self.solved()
        name = "a; touch hurt $(touch hurt) 'b.png"
        run = self.run_it("plot", "result.json", "-o", name, "--scale", "1")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(name, self.names())
        self.assertNotIn("hurt", self.names())

    def test_a_place_that_cannot_be_written_is_told(self):
        self.solved()
        for name in ("nowhere/path.svg", "nowhere/path.png"):
            run = self.run_it("plot", "result.json", "-o", name)
            self.assertEqual(run.returncode, 1)
            self.assertIn(b"cannot write nowhere/", run.stderr)

    def test_wrong_documents_have_status_2_and_a_pointer(self):
        request = (ROOT / "examples/buried_pipe.json").read_bytes()
        for text, words in ((request, b"/analysis: the document is a request, not a result: solve it first"),
                            (b"[]", b"must be a result"), (b"{", b"[malformed]"),
                            (b'{"summary": {}, "branches": [{}]}', b"/branches/0/load_factor: is missing")):
            run = self.run_it("plot", "-", "-o", "path.svg", text=text)
            self.assertEqual((run.returncode, run.stdout), (2, b""), run.stderr)
            self.assertIn(words, run.stderr)
            self.assertNotIn("path.svg", self.names())
        self.solved()
        run = self.run_it("plot", "result.json", "--kind", "shape", "--request", "examples/frame_portal.json")
        self.assertEqual(run.returncode, 2)
        self.assertIn(b"request:/model/members", run.stderr)

    def test_wrong_arguments_have_status_1(self):
        self.solved()
        for arguments in (["-o", "path.pdf"], ["--scale", "2"], ["--kind", "pie"], ["--width", "3"], ["--where", "k"],
                          ["--magnify", "0"], ["--arc-length", "--monitor", "crown"]):
            run = self.run_it("plot", "result.json", *arguments)
            self.assertEqual(run.returncode, 1, arguments)
            self.assertTrue(run.stderr, arguments)
        self.assertEqual(self.run_it("plot", "nowhere.json").returncode, 1)
        self.assertEqual(self.run_it("plot", "-", "--request", "-", text=b"{}").returncode, 1)

    def test_an_analysis_that_failed_is_drawn_as_far_as_it_came(self):
        request = json.loads((ROOT / "examples/buried_pipe.json").read_text(encoding="utf-8"))
        request["analysis"] = {"type": "static", "load_factors": [2, 4, 6, 20]}
        run = self.run_it("solve", "-", text=json.dumps(request).encode())
        self.assertEqual(run.returncode, 3, run.stderr)
        for kind in ("path", "shape", "sections"):
            drawn = self.run_it("plot", "-", "--kind", kind, text=run.stdout)
            self.assertEqual((drawn.returncode, drawn.stderr), (0, b""), kind)


if __name__ == "__main__":
    BINARY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()

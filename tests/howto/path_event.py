#!/usr/bin/env python3
"""Follows docs/howto/add-a-path-event.md literally.

  path_event.py BUILD_DIRECTORY    inserts each block of the page after the line that it names, in copies of the files,
                                   compiles what depends on them and runs path_event.cpp with it
"""
import pathlib
import subprocess
import sys
import tempfile

from blocks import ROOT, apply_blocks, build_program

REBUILT = ["solver/trace/trace.cpp", "solver/trace/bounds.cpp", "solver/trace/imperfect_bifurcations.cpp"]


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder)
        apply_blocks(ROOT / "docs/howto/add-a-path-event.md", copy, 7)
        sources = [copy / name if (copy / name).exists() else ROOT / name for name in REBUILT]
        build_program(build, copy, sources + [ROOT / "tests/howto/path_event.cpp"],
                      [str(build / "solver/libsnapthrough_solver.a")], copy / "path_event")
        sys.exit(subprocess.run([str(copy / "path_event")]).returncode)


main()

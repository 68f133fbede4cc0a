#!/usr/bin/env python3
"""Follows docs/howto/add-an-analysis.md literally.

  analysis.py BUILD_DIRECTORY    inserts each block of the page at the line that it names, in copies of the files, and makes
                                 the new file; compiles these, what makes or copies an Analysis (it has other fields now), and
                                 analysis.cpp, and runs it
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from blocks import ROOT, apply_blocks, build_program

COPIES = re.compile(r"\bAnalysis \w+(?: =|;)")


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder)
        changed = [name for name in apply_blocks(ROOT / "docs/howto/add-an-analysis.md", copy, 6) if name.endswith(".cpp")]
        copying = [str(path.relative_to(ROOT)) for path in sorted((ROOT / "solver").rglob("*.cpp"))
                   if COPIES.search(path.read_text())]
        sources = [copy / name if name in changed else ROOT / name for name in sorted({*changed, *copying})]
        build_program(build, copy, sources + [ROOT / "tests/howto/analysis.cpp"],
                      [str(build / "solver/libsnapthrough_solver.a")], copy / "analysis")
        sys.exit(subprocess.run([str(copy / "analysis")]).returncode)


main()

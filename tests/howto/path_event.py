#!/usr/bin/env python3
"""Follows docs/howto/add-a-path-event.md literally.

  path_event.py BUILD_DIRECTORY    inserts each block of the page after the line that it names, in a copy of solver/,
                                   compiles what depends on it and runs path_event.cpp with it
"""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/howto/add-a-path-event.md"
STEP = re.compile(r"^In `([^`]+)`, after `([^`]+)`:\n\n```cpp\n(.*?)```", re.M | re.S)
PROGRAM = ROOT / "tests/howto/path_event.cpp"
REBUILT = ["trace/trace.cpp", "trace/bounds.cpp", "trace/imperfect_bifurcations.cpp"]


def insert(source, anchor, block):
    """The source with the block after the first line that has the anchor."""
    lines = source.splitlines(keepends=True)
    for i, line in enumerate(lines):
        if anchor in line:
            return "".join(lines[:i + 1]) + block + "".join(lines[i + 1:])
    sys.exit(f"no line has {anchor!r}")


def compile_command(build):
    """Compiler and options of the solver's files, without source, output, dependencies and precompiled header."""
    entries = json.loads((build / "compile_commands.json").read_text())
    entry = next(e for e in entries if e["file"].endswith("solver/trace/trace.cpp"))
    words, out, skip = shlex.split(entry["command"]), [], False
    for word in words:
        if skip or word in ("-c", "-MD", "-Winvalid-pch") or word == entry["file"]:
            skip = False
        elif word in ("-o", "-MT", "-MF", "-include"):
            skip = True
        else:
            out.append(word)
    return out, entry["directory"]


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder)
        shutil.copytree(ROOT / "solver", copy / "solver")
        steps = STEP.findall(PAGE.read_text())
        if len(steps) != 7:
            sys.exit(f"{PAGE.name} has {len(steps)} blocks, not 7")
        for name, anchor, block in steps:
            file = copy / name
            file.write_text(insert(file.read_text(), anchor, block))
        command, where = compile_command(build)
        command.insert(1 if "ccache" not in command[0] else 2, f"-I{copy}")
        objects = []
        for source in [copy / "solver" / name for name in REBUILT] + [PROGRAM]:
            objects.append(copy / (source.stem + ".o"))
            subprocess.run(command + ["-c", str(source), "-o", str(objects[-1])], cwd=where, check=True)
        program = copy / "path_event"
        compiler = [w for w in command if "ccache" not in w][:1]
        subprocess.run(compiler + [str(o) for o in objects] + [str(build / "solver/libsnapthrough_solver.a"),
                                                               "-o", str(program)], check=True)
        sys.exit(subprocess.run([str(program)]).returncode)


main()

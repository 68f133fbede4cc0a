"""Blocks of code in a page of docs/howto, inserted into copies of the files that the page names, and compiled."""
import json
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEP = re.compile(r"^In `(?P<file>[^`]+)`,(?: below `(?P<below>[^`]+)`,)? "
                  r"(?:(?P<where>after|before) `(?P<anchor>[^`]+)`|as a new file):\n\n"
                  r"```\w+\n(?P<block>.*?)```", re.M | re.S)


def line_with(lines, text, start):
    """Index of the first line from `start` on that has the text."""
    for i in range(start, len(lines)):
        if text in lines[i]:
            return i
    sys.exit(f"no line has {text!r}")


def insert(source, step):
    """The source with the block of a step after or before its anchor's line."""
    lines = source.splitlines(keepends=True)
    start = line_with(lines, step["below"], 0) if step["below"] else 0
    at = line_with(lines, step["anchor"], start) + (step["where"] == "after")
    return "".join(lines[:at]) + step["block"] + "".join(lines[at:])


def apply_blocks(page, copy, count):
    """Inserts the blocks of a page into copies of the files that they name. Returns the names of the files."""
    text = page.read_text()
    steps = list(STEP.finditer(text))
    fences = len(re.findall(r"^```\w+$", text, re.M))
    if len(steps) != count or fences != count:
        sys.exit(f"{page.name} has {fences} blocks, {len(steps)} of them with a place, not {count}")
    for step in steps:
        file = copy / step["file"]
        if not file.exists():
            file.parent.mkdir(parents=True, exist_ok=True)
            if step["anchor"]:
                file.write_text((ROOT / step["file"]).read_text())
        file.write_text(insert(file.read_text(), step) if step["anchor"] else step["block"])
    return sorted({step["file"] for step in steps})


def compile_command(build, copy):
    """Compiler and options of the solver's files, with headers of the copy first, and the folder to call it in; without
    source, output, dependencies and precompiled header."""
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
    out.insert(1 if "ccache" not in out[0] else 2, f"-I{copy}")
    return out, entry["directory"]


def build_program(build, copy, sources, libraries, program):
    """Compiles the sources and links them before the libraries, so that they take the place of what is there."""
    command, where = compile_command(build, copy)
    objects = []
    for number, source in enumerate(sources):
        objects.append(str(copy / f"{number}.o"))
        subprocess.run(command + ["-c", str(source), "-o", objects[-1]], cwd=where, check=True)
    compiler = [word for word in command if "ccache" not in word][:1]
    subprocess.run(compiler + objects + libraries + ["-o", str(program)], check=True)

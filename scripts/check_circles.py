#!/usr/bin/env python3
"""Checks that no files depend on each other in a circle: headers with their sources in solver, api, server and clients, modules
of the Python package, and modules of the page (imports of types alone do not count).

  check_circles.py              exit status 1 names a circle of each language that has one
  check_circles.py --self-test  checks the checker
"""
import ast
import graphlib
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib.cpp_text import strip_comments  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)
IMPORT = re.compile(r'^(?:import|export)(?! type\b)[^"\';]*["\'](\.[^"\']+)["\']', re.MULTILINE)
ENDINGS = {".h", ".cpp", ".ts", ".tsx", ".js", ".py"}


def stem(path):
    """A path without the ending of a source: a header and its source have one stem."""
    return path.with_suffix("") if path.suffix in ENDINGS else path


def cpp_uses(path, text):
    return {stem(pathlib.PurePosixPath(name)) for name in INCLUDE.findall(strip_comments(text))}


def page_uses(path, text):
    names = (pathlib.PurePosixPath(path.parent, name) for name in IMPORT.findall(text))
    return {stem(pathlib.PurePosixPath(*resolved(name.parts))) for name in names}


def resolved(parts):
    """Parts of a path without "." and ".."."""
    out = []
    for part in parts:
        if part == "..":
            out.pop()
        elif part != ".":
            out.append(part)
    return out


def python_uses(path, text):
    """Modules of the package that a module imports, at its top or in a function."""
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            names = [node.module.split(".")[0]] if node.module else [name.name for name in node.names]
            found |= {path.parent / name for name in names}
    return found


# what a language's files are, and what each of them uses
LANGUAGES = {
    "C++": (("solver", "api", "server", "clients"), (".h", ".cpp"), cpp_uses),
    "Python": (("clients/python/snapthrough",), (".py",), python_uses),
    "TypeScript": (("web/src",), (".ts", ".tsx"), page_uses),
}


def graph_of(files, uses):
    """What each stem uses besides itself. @param files pairs of path and text"""
    graph = {}
    for path, text in files:
        graph.setdefault(stem(path), set()).update(uses(path, text) - {stem(path)})
    return graph


def circle_in(graph):
    """Files of a circle, the first also last; empty: there is none."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return [str(name) for name in error.args[1]]
    return []


def files_of(folders, endings):
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in endings and "node_modules" not in path.parts:
                yield pathlib.PurePosixPath(path.relative_to(ROOT).as_posix()), path.read_text(encoding="utf-8")


def self_test():
    def circle(uses, *files):
        return circle_in(graph_of([(pathlib.PurePosixPath(name), text) for name, text in files], uses))

    cases = [
        (True, circle(cpp_uses, ("a/x.h", '#include "a/y.h"\n'), ("a/y.cpp", '#include "a/y.h"\n#include "a/x.h"\n'))),
        (False, circle(cpp_uses, ("a/x.cpp", '#include "a/x.h"\n'), ("a/x.h", '// #include "a/x.h"\n#include <x>\n'))),
        (True, circle(python_uses, ("p/_a.py", "from ._b import f\n"), ("p/_b.py", "def g():\n    from . import _a\n"))),
        (False, circle(python_uses, ("p/_a.py", "from ._b import f\nimport json\n"), ("p/_b.py", "import os\n"))),
        (True, circle(page_uses, ("w/a.ts", 'import { b } from "./c/b";\n'), ("w/c/b.ts", 'export * from "../a.js";\n'))),
        (False, circle(page_uses, ("w/a.ts", 'import { b } from "./b";\n'), ("w/b.ts", 'import type { A } from "./a";\n'))),
    ]
    wrong = [number for number, (expected, found) in enumerate(cases) if expected != bool(found)]
    print(f"check_circles: cases {wrong} are wrong" if wrong else f"check_circles: self-test of {len(cases)} cases passed")
    return 1 if wrong else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    circles = 0
    count = 0
    for language, (folders, endings, uses) in LANGUAGES.items():
        graph = graph_of(files_of(folders, endings), uses)
        count += len(graph)
        if circle := circle_in(graph):
            circles += 1
            print(f"{language}: {' -> '.join(circle)}")
    print(f"check_circles: {count} headers with sources and modules, {circles} languages with a circle")
    return 1 if circles else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

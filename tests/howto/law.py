#!/usr/bin/env python3
"""Follows docs/howto/add-a-foundation-law.md literally.

  law.py BUILD_DIRECTORY    inserts each block of the page at the line that it names, in copies of the files; compiles the
                            sources that name types of laws, the tests that the page changes, and law.cpp, and runs them
"""
import json
import pathlib
import subprocess
import sys
import tempfile

from blocks import ROOT, apply_blocks, build_program

LIBRARIES = ["api/libsnapthrough_api.a", "solver/libsnapthrough_solver.a"]


def check_document(path):
    """Both laws of the OpenAPI document have the new type, with the fields that the reader requires."""
    schemas = json.loads(path.read_text())["components"]["schemas"]
    for name in ("SpringLaw", "FoundationLaw"):
        forms = {form["properties"]["type"]["const"]: form for form in schemas[name]["oneOf"]}
        if set(forms["algebraic"]["properties"]) != set(forms["tanh"]["properties"]):
            sys.exit(f"{name}: fields of the new law")


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder)
        changed = apply_blocks(ROOT / "docs/howto/add-a-foundation-law.md", copy, 17)
        check_document(copy / "api/openapi/openapi.json")
        naming = [path.relative_to(ROOT) for layer in ("solver", "api") for path in sorted((ROOT / layer).rglob("*.cpp"))
                  if "ReactionLaw::Type" in path.read_text()]
        tests = [pathlib.Path(name) for name in changed if name.endswith("_test.cpp")]
        sources = [copy / path if (copy / path).exists() else ROOT / path for path in naming + tests]
        build_program(build, copy, sources + [ROOT / "tests/howto/law.cpp"],
                      [str(build / library) for library in LIBRARIES] + ["-lgtest_main", "-lgtest"], copy / "law")
        sys.exit(subprocess.run([str(copy / "law"), "--gtest_brief=1"]).returncode)


main()

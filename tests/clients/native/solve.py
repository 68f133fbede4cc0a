"""Solves requests and sweeps by the Python package that is installed, for compare.py.

  solve.py FOLDER FILE...    writes the document of each file to FOLDER, and "NAME STATUS SECONDS" for each to standard output

A file whose name begins with sweep is a sweep. An analysis whose name begins with cancelled is stopped at its fifth step.
"""
import pathlib
import sys
import time

from snapthrough._library import Library


def main():
    library = Library()
    print(library.path, file=sys.stderr)
    for file in map(pathlib.Path, sys.argv[2:]):
        steps = []
        begin = time.process_time()
        if file.name.startswith("sweep"):
            answer = library.sweep(file.read_bytes(), 0, 2**64 - 1)
        elif file.name.startswith("cancelled"):
            answer = library.solve(file.read_bytes(), None, lambda now: steps.append(now) or len(steps) < 5)
        else:
            answer = library.solve(file.read_bytes())
        seconds = time.process_time() - begin
        pathlib.Path(sys.argv[1], file.name).write_bytes(answer.text)
        print(file.name, answer.status, f"{seconds:.6f}")


main()

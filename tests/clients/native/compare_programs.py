#!/usr/bin/env python3
"""Compares what another build of the executable makes of tests/clients with what the executable makes of it.

  compare_programs.py EXECUTABLE FOLDER COMMAND...

COMMAND starts the other build, for which FOLDER holds the files of tests/clients. Asked: the same exit statuses, the same words on
standard error, loads within 1e-10; exit status 1 names what differs. The request that is cancelled is left out: no command
cancels after a number of steps. The last line has the ratio of the processor times of the sweep.
"""
import json
import sys

from compare import HERE, different_rows, differences, run, same_words


def main():
    executable, folder, other = sys.argv[1], sys.argv[2], sys.argv[3:]

    def both(command, file):
        return run(executable, *command, HERE.parent / file), run(*other, *command, f"{folder}/{file}")

    wrong, largest, count = [], 0.0, 0
    for name in json.loads((HERE.parent / "expected.json").read_text(encoding="utf-8")):
        if name == "cancelled":
            continue
        count += 1
        (status, wanted, words, _), (ended, found, said, _) = both(["solve"], f"requests/{name}.json")
        if ended != status or not same_words(said, words):
            wrong.append(f"{name}: exit status {ended}, not {status}; {said!r}, not {words!r}")
        elif wanted:
            differing, difference = differences(found, wanted)
            wrong += [f"{name}: {one}" for one in differing]
            largest = max(largest, difference)
    (_, wanted, _, base), (_, found, _, seconds) = both(["sweep", "--threads", "1"], "sweep_500.json")
    rows = found.get("rows", [])
    wrong += different_rows(rows, wanted["rows"])
    print("\n".join(wrong) or f"{count} requests and {len(rows)} rows: as those of {executable}; largest difference of a load {largest:.1e}")
    print(f"sweep: {seconds:.2f} s, the executable {base:.2f} s, ratio {seconds / base:.2f}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

"""Computes the results beside the requests in tests/web/figures/cases again, and the table beside the sweep.

  make_cases.py SNAPTHROUGH
"""
import json
import pathlib
import subprocess
import sys

COMMANDS = {"request": ("solve", "result", (0,)), "sweep": ("sweep", "table", (0, 3))}  # 3: some points of the sweep fail


def compact(document):
    return json.dumps(document, ensure_ascii=False, separators=(",", ":"))


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    for path in sorted((pathlib.Path(__file__).parent / "cases").glob("*.json")):
        asked, document = next(iter(json.loads(path.read_text(encoding="utf-8")).items()))
        command, answered, statuses = COMMANDS[asked]
        done = subprocess.run([sys.argv[1], command, "-"], input=compact(document), stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode not in statuses:
            raise SystemExit(f"{path.name}: status {done.returncode}")
        answer = compact(json.loads(done.stdout))
        path.write_text(f'{{\n"{asked}": {compact(document)},\n"{answered}": {answer}\n}}\n', encoding="utf-8")


if __name__ == "__main__":
    main()

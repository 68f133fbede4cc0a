"""Prints what tests recorded: recorded.py REPORT, a file that a test program wrote for --gtest_output=json:REPORT."""
import json
import pathlib
import sys

OF_EVERY_TEST = {"name", "file", "line", "status", "result", "timestamp", "time", "classname", "value_param", "type_param", "failures",
                 "skipped"}


def recorded(report):
    """(test, name, value) of each figure, in the order of the report."""
    for suite in report["testsuites"]:
        for test in suite["testsuite"]:
            for name, value in test.items():
                if name not in OF_EVERY_TEST:
                    yield f"{suite['name']}.{test['name']}", name, value


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    for test, name, value in recorded(json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))):
        print(f"{test}  {name}  {value}")


if __name__ == "__main__":
    main()

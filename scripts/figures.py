#!/usr/bin/env python3
"""Makes the pictures under docs/, lists them, or shows all of them for somebody to look at; scripts/figures.sh runs it.

  scripts/figures.py --program SNAPTHROUGH [GROUP...]   makes the pictures of all groups, or of some
  scripts/figures.py --list                             each picture with what makes it; exit status 1 when nothing makes one,
                                                        or one is missing
  scripts/figures.py --sheet DIR                        DIR/index.html and DIR/sheet_N.png
  scripts/figures.py --self-test                        checks the lister and the charts' axes
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib import chart, figure_groups, svg_figure  # noqa: E402
from lib.figure_sheet import write_sheet  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent


def make(program, names):
    """Runs the commands of the groups; stops at the first that fails."""
    for group in figure_groups.groups(ROOT):
        if names and group.name not in names:
            continue
        print(f"== {group.name}: {len(group.pictures)} pictures", flush=True)
        for command in group.commands:
            subprocess.run([program if word == "SNAPTHROUGH" else word for word in command], cwd=ROOT, check=True)


def show_list():
    """Exit status: 1 when a picture is made by nothing or is missing."""
    groups = figure_groups.groups(ROOT)
    for group in groups:
        print(f"{group.name}: {'; '.join(' '.join(command) for command in group.commands)}")
        for picture in group.pictures:
            print(f"  {picture}")
    wrong = figure_groups.mistakes(ROOT, groups)
    print(f"figures: {sum(len(group.pictures) for group in groups)} pictures, {len(wrong)} mistakes")
    print("".join(f"{mistake}\n" for mistake in wrong), end="", file=sys.stderr)
    return 1 if wrong else 0


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "docs").mkdir()
        for name in ("a.svg", "b.png"):
            (root / "docs" / name).write_text("", encoding="utf-8")
        groups = [figure_groups.Group("one", [["true"]], ["docs/a.svg", "docs/c.svg"])]
        assert figure_groups.mistakes(root, groups) == ["docs/b.png: nothing makes it", "docs/c.svg: it is missing"]
    axis = chart.Scale(0, 1, 0, 400, False)
    assert [text for _, text in chart.ticks(axis, 80)] == ["0", "0.2", "0.4", "0.6", "0.8", "1"]
    assert [text for _, text in chart.ticks(chart.Scale(1e-7, 1e-1, 0, 160, True), 80)] == ["10⁻⁶", "0.001"]
    assert [chart.number_text(x) for x in (0, -1000, 20000, 3e6)] == ["0", "−1000", "20\u202f000", "3\u202f×\u202f10⁶"]
    parts = chart.clipped([(-1, 0.5), (0.5, 0.5), (2, 0.5), (0.5, 0.5)], axis, chart.Scale(0, 1, 400, 0, False))
    assert parts == [[(0, 200), (200, 200), (400, 200)], [(400, 200), (200, 200)]], parts
    assert svg_figure.plain("P_{cr}/P_e, bending_moment, L^3/EI") == "Pcr/Pe, bending_moment, L3/EI"
    print("figures: self-test passed")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("groups", nargs="*", metavar="GROUP")
    parser.add_argument("--program")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--sheet", type=pathlib.Path)
    given = parser.parse_args()
    if given.list:
        return show_list()
    if given.sheet:
        return write_sheet(ROOT, figure_groups.pictures_under(ROOT), given.sheet)
    unknown = set(given.groups) - {group.name for group in figure_groups.groups(ROOT)}
    if unknown or not given.program:
        parser.error(f"there is no group {', '.join(sorted(unknown))}" if unknown else "--program is missing")
    return make(str(pathlib.Path(given.program).resolve()), given.groups)


if __name__ == "__main__":
    sys.exit(main())

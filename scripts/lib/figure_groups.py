"""Which command makes which pictures under docs/.

The names of the pictures come from where their makers have them, so that a picture that nothing makes any longer is found.
"""
import dataclasses
import json
import re
import tomllib

from lib.thesis_figures import PICTURES

SUFFIXES = (".svg", ".png", ".jpg", ".gif", ".webp", ".pdf")
PERFORMANCE_COSTS = ("--claim-cpu", "0.9", "--put-cpu", "1.7")  # ms, measured: docs/howto/run-on-many-hosts.md


@dataclasses.dataclass
class Group:
    """Pictures and the commands that make them; the word SNAPTHROUGH stands for the program."""
    name: str
    commands: list
    pictures: list


def pictures_under(root):
    """Every picture under docs, as names from the root."""
    return sorted(str(path.relative_to(root)) for path in (root / "docs").rglob("*") if path.suffix in SUFFIXES)


def gallery_pictures(root):
    """Names of the figures and charts of the gallery's pages, and of the results that its index shows."""
    pages = root / "examples/gallery/pages"
    names = set(re.findall(r"\((page_\w+)\.svg\)|\"(page_\w+)\.svg\"", (pages / "README.md").read_text(encoding="utf-8")))
    names = {first or second for first, second in names}
    for path in pages.glob("*.toml"):
        page = tomllib.loads(path.read_text(encoding="utf-8"))
        names |= {one["file"] for kind in ("figure", "chart") for one in page.get(kind, [])}
    return [f"docs/gallery/{name}.svg" for name in sorted(names)]


def page_pictures(root):
    """Names of the stored pictures of the page, as nameOf() of tests/web/support/views.mjs makes them."""
    views = (root / "tests/web/support/views.mjs").read_text(encoding="utf-8")
    views = views.partition("export const kStored = [")[2].partition("];")[0]
    for view, size, scheme in re.findall(r"\['([\w-]+)', '(\w+)', '(\w+)'\]", views):
        yield f"docs/page/{'-'.join([view] + [size] * (size != 'wide') + [scheme] * (scheme != 'light'))}.png"


def groups(root):
    """All groups, in the order in which they are made."""
    performance = json.loads((root / "docs/performance/figures.json").read_text(encoding="utf-8"))
    theory = (root / "docs/theory/figures.py").read_text(encoding="utf-8")
    drawn = re.findall(r'\.write\("(\w+)"', theory) + re.findall(r'"theory_(\w+)\.svg"', theory)
    many_hosts = "docs/performance/many_hosts.svg"
    return [
        Group("report", [["python3", "scripts/report.py", "SNAPTHROUGH"]], [f"docs/thesis/{name}.svg" for name in PICTURES] + gallery_pictures(root)),
        Group("results", [["python3", "scripts/results_figure.py", "SNAPTHROUGH"]], ["docs/results.svg"]),
        Group("theory", [["/usr/bin/python3", "docs/theory/figures.py"]], [f"docs/theory_{name}.svg" for name in sorted(drawn)]),
        Group("commands", [["python3", "scripts/lib/figure_commands.py", "SNAPTHROUGH"]],
              ["docs/howto/monopile_moment.svg", "docs/howto/plots/pile_laws.svg", "docs/howto/plots/pipe_path.svg",
               "docs/howto/plots/pipe_shape.svg", "docs/tutorial_chart.svg", "docs/tutorial_mode.svg"]),
        # The points of scripts/bench.sh are kept; another run of the benchmarks would have other times than the tables.
        Group("performance", [["python3", "scripts/bench_report.py", "--figures"]],
              [f"docs/performance/{name}.svg" for name in performance]),
        Group("many-hosts", [["python3", "bench/cluster_simulation.py", *PERFORMANCE_COSTS, "--svg", many_hosts]], [many_hosts]),
        Group("page", [["bash", "scripts/web_pictures.sh", "SNAPTHROUGH"], ["node", "scripts/lib/tutorial_page.mjs", "SNAPTHROUGH"]],
              [*page_pictures(root), "docs/tutorial_page.png"]),
    ]


def mistakes(root, groups_):
    """Pictures that nothing makes, that two groups make, and that are missing."""
    there, made = set(pictures_under(root)), [picture for group in groups_ for picture in group.pictures]
    found = [f"{picture}: nothing makes it" for picture in sorted(there - set(made))]
    found += [f"{picture}: it is missing" for picture in sorted(set(made) - there)]
    return found + [f"{picture}: two groups make it" for picture in sorted(set(made)) if made.count(picture) > 1]

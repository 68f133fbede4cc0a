"""Figures of docs/performance: their measured points, kept in figures.json, and how they are drawn.

The points are kept because another run of the benchmarks has other times: figures in a new style show the numbers of the tables.
"""
import json

from lib.chart import Axes, Curve, chart, charts_beside, line_of, marks
from lib.svg_figure import ROOT, Size

DOCS = ROOT / "docs" / "performance"
STORED = DOCS / "figures.json"
BESIDE = Size(480, 400)  # of one of two charts


def plotted(title, x, y, curves):
    """What a chart shows, as it is kept. Curves: (label, points); both axes are logarithmic."""
    return {"title": title, "x": x, "y": y, "curves": [{"label": label, "points": points} for label, points in curves]}


def curve_of(stored, series):
    """Measured points are joined; those of the accuracy asked for are rings, and a power of n is a line without points."""
    label, points = stored["label"], stored["points"]
    if label == "asked":
        return marks(label, points, "known")
    return line_of(label, points, 4) if label.startswith("n^") else Curve(label, [points], series, mark="dot", dashed=True)


def write(figures):
    """Keeps {file: [what a chart shows]}, a line for each curve."""
    files = []
    for name, charts in figures.items():
        parts = []
        for one in charts:
            head = json.dumps({key: one[key] for key in ("title", "x", "y")})[:-1]
            parts.append(f'  {head}, "curves": [\n   ' + ",\n   ".join(map(json.dumps, one["curves"])) + "]}")
        files.append(f"{json.dumps(name)}: [\n" + ",\n".join(parts) + "]")
    STORED.write_text("{" + ",\n ".join(files) + "}\n", encoding="utf-8")


def draw():
    """Draws every figure from the kept points."""
    for name, charts in json.loads(STORED.read_text(encoding="utf-8")).items():
        drawn = [(Axes(one["title"], one["x"], one["y"], logarithmic="xy"), [curve_of(curve, i) for i, curve in enumerate(one["curves"])])
                 for one in charts]
        text = charts_beside(drawn, BESIDE) if len(drawn) > 1 else chart(*drawn[0])
        (DOCS / f"{name}.svg").write_text(text, encoding="utf-8")

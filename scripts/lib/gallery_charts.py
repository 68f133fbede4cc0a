"""Pictures of the gallery, drawn by `snapthrough plot`: results of requests, and tables of sweeps as design charts."""
import json
import re
import subprocess

from lib.gallery_values import NUMBERS, EXAMPLES, request_with
from lib.thesis_data import ROOT

DOCS = ROOT / "docs" / "gallery"


def draw(program, document, name, options):
    done = subprocess.run([program, "plot", "-", "-o", str(DOCS / f"{name}.svg"), *options], input=json.dumps(document),
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{name}.svg: exit status {done.returncode}: {done.stderr.strip()}")


def draw_figure(figure, runs, scratch):
    """[[figure]]: `file`, `request`, optional `changes` and `options` of snapthrough plot."""
    request, result = runs.result(figure["request"], figure.get("changes", {}))
    path = scratch / f"{figure['file']}.json"
    path.write_text(json.dumps(request), encoding="utf-8")
    draw(runs.program, result, figure["file"], ["--request", str(path), *figure.get("options", [])])


def chart_table(chart, runs):
    """A sweep's table with one output named as the chart's axis, and a curve for each formula that it is compared with.

    chart: `output` (JSON Pointer), `label` of the axis, `factor` (expression in the row's parameters,
    each character of their names that is no letter or digit as _) by which the output is multiplied,
    `ours` (name of the computed curve), `curves` {name: expression in the row's parameters}.
    """
    table = runs.table(chart["sweep"])
    parameters = [column for column in table["columns"] if not column.startswith("/") and column != "error"]
    output = table["columns"].index(chart["output"])
    curves = chart.get("curves", {})
    columns = parameters + (["curve"] if curves else []) + ["/" + chart["label"].replace("~", "~0").replace("/", "~1"), "error"]
    rows = []
    for row in table["rows"]:
        values = row[:len(parameters)]
        names = {re.sub(r"\W", "_", name): value for name, value in zip(parameters, values)}
        factor = eval(chart.get("factor", "1"), NUMBERS | names)
        found = None if row[output] is None else row[output] * factor
        rows.append(values + ([chart["ours"]] if curves else []) + [found, row[-1]])
        rows += [values + [curve, eval(formula, NUMBERS | names), None] for curve, formula in curves.items()]
    return {"columns": columns, "rows": rows}


def shares_table(chart, runs):
    """Random samples as the share of them that lies below each value, of each of the tables of `sweeps` {name: sweep}."""
    rows = []
    for name, sweep in chart["sweeps"].items():
        table = runs.table(sweep)
        output = table["columns"].index(chart["output"])
        values = sorted(row[output] for row in table["rows"])
        rows += [[value, name, (i + 0.5) / len(values), None] for i, value in enumerate(values)]
    return {"columns": [chart["label"], "curve", "/share of the samples below", "error"], "rows": rows}


def draw_chart(chart, runs):
    table = shares_table(chart, runs) if "sweeps" in chart else chart_table(chart, runs)
    draw(runs.program, table, chart["file"], ["--kind", "sweep", *chart.get("options", [])])


def failed_rows(chart, runs):
    """Mistakes: rows of the chart's sweeps with an error."""
    for sweep in chart.get("sweeps", {"": chart.get("sweep")}).values():
        for i, row in enumerate(runs.table(sweep)["rows"]):
            if row[-1] is not None:
                yield f"gallery/charts/{sweep}.json, row {i}: {row[-1]}"

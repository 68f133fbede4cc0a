"""Pictures of the gallery, drawn by `snapthrough plot`: results of requests, and tables of sweeps as design charts."""
import itertools
import json
import re
import subprocess

from lib.gallery_refined import compared, separate_points
from lib.gallery_values import NUMBERS, chart_document
from lib.thesis_data import ROOT

DOCS = ROOT / "docs" / "gallery"
PROVENANCE = ("program", "request_sha256")  # a picture that tells its program's build differs after each commit
OF_FORMULA = {"piece": 0, "change": None, "error": None}  # of rows that a formula gives


def draw(program, document, name, options):
    done = subprocess.run([program, "plot", "-", "-o", str(DOCS / f"{name}.svg"), *options], input=json.dumps(document),
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{name}.svg: exit status {done.returncode}: {done.stderr.strip()}")


def draw_figure(figure, runs, scratch):
    """[[figure]]: `file`, `request`, optional `changes` and `options` of snapthrough plot."""
    request, result = runs.result(figure["request"], figure.get("changes", {}))
    result = {key: value for key, value in result.items() if key not in PROVENANCE}
    path = scratch / f"{figure['file']}.json"
    path.write_text(json.dumps(request), encoding="utf-8")
    draw(runs.program, result, figure["file"], ["--request", str(path), *figure.get("options", [])])


def chart_table(chart, table):
    """A sweep's table with one output named as the chart's axis, and a curve for each formula that it is compared with.

    chart: `output` (JSON Pointer), `label` of the axis, `factor` (expression in the row's parameters,
    each character of their names that is no letter or digit as _) by which the output is multiplied,
    `ours` (name of the computed curve), `curves` {name: expression in the row's parameters}. Columns behind the
    outputs stay; rows of formulas are one piece.
    """
    parameters = list(itertools.takewhile(lambda column: not column.startswith("/"), table["columns"]))
    own = [column for column in table["columns"][len(parameters):] if not column.startswith("/")]
    output = table["columns"].index(chart["output"])
    curves = chart.get("curves", {})
    columns = [*parameters, *(["curve"] if curves else []), "/" + chart["label"].replace("~", "~0").replace("/", "~1"), *own]
    rows = []
    for row in table["rows"]:
        values = row[:len(parameters)]
        names = {re.sub(r"\W", "_", name): value for name, value in zip(parameters, values)}
        factor = eval(chart.get("factor", "1"), NUMBERS | names)
        found = None if row[output] is None else row[output] * factor
        rows.append([*values, *([chart["ours"]] if curves else []), found, *row[-len(own):]])
        rows += [[*values, curve, eval(formula, NUMBERS | names), *map(OF_FORMULA.get, own)] for curve, formula in curves.items()]
    return {"columns": columns, "rows": rows}


def shares_table(chart, runs):
    """Random samples as the share of them that lies below each value, of each of the tables of `sweeps` {name: sweep}."""
    rows = []
    for name, sweep in chart["sweeps"].items():
        table = runs.table(sweep)
        output = table["columns"].index(chart["output"])
        values = sorted(row[output] for row in table["rows"] if row[-1] is None)
        rows += [[value, name, (i + 0.5) / len(values), None] for i, value in enumerate(values)]
    return {"columns": [chart["label"], "curve", "/share of the samples below", "error"], "rows": rows}


def draw_chart(chart, runs):
    table = shares_table(chart, runs) if "sweeps" in chart else chart_table(chart, runs.table(chart["sweep"]))
    draw(runs.program, table, chart["file"], ["--kind", "sweep", *chart.get("options", [])])


def check_chart(chart, runs):
    """(mistakes, numbers compared): failed rows of the chart's sweeps, and lines of a refined one beside separate points."""
    if "sweeps" in chart:
        return [mistake for sweep in chart["sweeps"].values() for mistake in failed_rows(f"{sweep}.json", runs.table(sweep))], 0
    file = f"{chart['sweep']}.json"
    document, table = chart_document(chart["sweep"]), runs.table(chart["sweep"])
    answers = runs.swept(f"charts/{file}, separate points", separate_points(document))
    name = f"gallery/charts/{file}, {chart['output']}"
    found = compared(name, document, chart_table(chart, table), chart_table(chart, answers))
    runs.seconds.append(f"{'':10}  {name}: {found.compared} compared, {found.between} between pieces, "
                        f"at most {100 * found.worst:.2g} % off")
    wrong = [*failed_rows(file, table), *failed_rows(f"{file}, separate points", answers), *found.wrong]
    return wrong, found.compared


def failed_rows(sweep, table):
    """Mistakes: rows of a sweep with an error."""
    for i, row in enumerate(table["rows"]):
        if row[-1] is not None:
            yield f"gallery/charts/{sweep}, row {i}: {row[-1]}"

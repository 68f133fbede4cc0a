"""Pages of the gallery: examples/gallery/pages/NAME.md with its numbers filled in is docs/gallery/NAME.md."""
import pathlib
import re
import tempfile
import textwrap

from lib.gallery_charts import DOCS, check_chart, draw_chart, draw_figure
from lib.gallery_refined import SHARE, refined_self_test
from lib.gallery_values import PAGES, Runs, page_data, page_values, quantile

CASES = ("| problem | what | published | found | error at most | difference | source; why they differ |", "| --- | --- | --- | --- | --- | --- | --- |")
HEAD = ("| what | published | found | error at most | difference | source; why they differ |", "| --- | --- | --- | --- | --- | --- |")
LINES = (f"Straight lines between the computed points are within {100 * SHARE:g} % of the answer; a line breaks where the answer jumps "
         "or its kind changes.")
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def page_text(name):
    return (PAGES / f"{name}.md").read_text(encoding="utf-8")


def significant(value, digits):
    """A number with that many significant digits, without an exponent between 1e-4 and 1e7."""
    if value == 0 or not 1e-4 <= abs(value) < 1e7:
        return f"{value:.{digits - 1}e}"
    rounded = float(f"{value:.{digits - 1}e}")
    places = max(0, digits - len(f"{abs(rounded):.0f}") if abs(rounded) >= 1 else digits - 1 - int(f"{rounded:e}".split("e")[1]))
    return f"{rounded:.{places}f}"


def shown(value):
    return significant(value.found, value.entry.get("digits", 5))


def shown_difference(value):
    """The difference in per cent, or the accuracy asked for where the difference is below it."""
    if value.accuracy is not None and value.estimate is not None and abs(value.difference) <= value.accuracy:
        return f"< {value.accuracy:.0e}"
    if abs(value.difference) < 1e-6:
        return "< 1e-06"
    return f"{'+' if value.difference > 0 else '-'}{significant(abs(100 * value.difference), 2)} %"


def rows(values):
    """A row of the table for each value with a published one."""
    for value in values.values():
        if value.published is not None:
            entry = value.entry
            error = "-" if value.estimate is None else f"{value.accuracy:.0e}"
            published = entry.get("printed") or significant(value.published, entry.get("published_digits", entry.get("digits", 5)))
            yield (f"| {entry['what']} | {published} | {shown(value)} | {error} | {shown_difference(value)} | {entry['source']}; "
                   f"{entry['why']} |")


def cases(pages):
    """All rows of {page: values} in one table, which names the page."""
    yield from CASES
    for name, values in pages.items():
        title = page_text(name).partition("\n")[0].lstrip("# ")
        yield from (f"| [{title}]({name}.md) {row}" for row in rows(values))


def wrapped(text):
    """Paragraphs and items of lists wrapped at 120 columns; tables, headings and code stay."""
    lines = []
    for block in re.split(r"(```.*?```|\n\n+)", text, flags=re.DOTALL):
        for item in re.split(r"\n(?=- |\d\. )", block) if block and not block.startswith(("```", "\n", "#", "|", "!")) else [block]:
            if item.startswith(("```", "\n", "#", "|", "!")) or not item:
                lines.append(item)
            else:
                indent = "  " if item.startswith("- ") else "   " if re.match(r"\d\. ", item) else ""
                lines.append(textwrap.fill(" ".join(item.split()), 120, subsequent_indent=indent, break_long_words=False,
                                           break_on_hyphens=False))
                lines.append("\n")
        if lines and lines[-1] == "\n":
            lines.pop()
    return "".join(lines).rstrip("\n") + "\n"


def filled(name, values, tables):
    """The page with {NAME} as a value or as the lines of a table."""
    def put(match):
        return "\n".join(tables[match[1]]) if match[1] in tables else shown(values[match[1]])

    return wrapped(re.sub(r"\{(\w+)\}", put, page_text(name)))


def differences(page, expected):
    """Whether two texts differ other than by one unit of the last digit of a number; the first place."""
    if NUMBER.split(page) != NUMBER.split(expected):
        return "the text is not that of examples/gallery/pages"
    for ours, new in zip(NUMBER.findall(page), NUMBER.findall(expected)):
        mantissa, _, exponent = new.partition("e")
        unit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
        if abs(float(ours) - float(new)) > 1.001 * unit:
            return f"{ours} where {new} was found"
    return None


def names():
    return sorted(path.stem for path in PAGES.glob("*.toml"))


def check_text(name, text, write):
    """Mistakes of docs/gallery/NAME.md; writes it when asked to."""
    path = DOCS / f"{name}.md"
    if write:
        path.write_text(text, encoding="utf-8")
    elif not path.exists():
        yield f"docs/gallery/{name}.md is not there"
    elif found := differences(path.read_text(encoding="utf-8"), text):
        yield f"docs/gallery/{name}.md: {found}; scripts/report.sh writes it anew"


def draw(data, runs):
    """The pictures of a page."""
    with tempfile.TemporaryDirectory() as scratch:
        for figure in data.get("figure", []):
            draw_figure(figure, runs, pathlib.Path(scratch))
    for chart in data.get("chart", []):
        draw_chart(chart, runs)


def check_page(name, runs, write):
    """(mistakes, values, numbers compared in charts) of a page; writes it and its pictures when asked to."""
    data = page_data(name)
    values = page_values(data, runs)
    wrong = [f"gallery, {name}, {value.entry['name']}: {value.wrong()}" for value in values.values() if value.wrong()]
    compared = 0
    for chart in data.get("chart", []):
        more_wrong, more = check_chart(chart, runs)
        wrong, compared = wrong + more_wrong, compared + more
    if any("sweep" in chart for chart in data.get("chart", [])) and "{lines}" not in page_text(name):
        wrong.append(f"gallery/pages/{name}.md does not say {{lines}} under its charts")
    wrong += check_text(name, filled(name, values, {"values": [*HEAD, *rows(values)], "lines": [LINES]}), write)
    if write:
        draw(data, runs)
    return wrong, values, compared


def gallery(program, write, only=None):
    """(mistakes, numbers compared, run times) of all pages, or of one; writes them and their pictures when asked to."""
    runs = Runs(program)
    wrong, pages, compared = [], {}, 0
    for name in [only] if only else names():
        more_wrong, pages[name], more = check_page(name, runs, write)
        wrong, compared = wrong + more_wrong, compared + more
    if not only:
        index = filled("README", {}, {"cases": list(cases(pages))})
        wrong += check_text("README", index, write)
        if write:  # results of the problems of the page, which have no page of their own
            draw({"figure": [{"file": f"page_{name}", "request": f"../{name}"} for name in re.findall(r'"page_(\w+)\.svg"', index)]}, runs)
    return wrong, compared + sum(map(len, pages.values())), runs.seconds


def gallery_self_test():
    """Names of what is wrong with these functions; empty when all is well."""
    checks = {
        "digits": [significant(x, 3) for x in (1234.5, 0.012345, 99.96, 1e-9)] == ["1230", "0.0123", "100", "1.00e-09"],
        "one unit of the last digit": differences("P 1.23", "P 1.24") is None,
        "more than one unit": differences("P 1.23", "P 1.25") is not None,
        "another text": differences("P 1.23", "Q 1.23") is not None,
        "paragraphs are wrapped, tables are not": wrapped("a\nb\n\n| a |\n| b |\n") == "a b\n\n| a |\n| b |\n",
        "items of lists": wrapped("- a\n  b\n- c\n") == "- a b\n- c\n",
        "quantile": quantile([3.0, 1.0, 2.0], 0.5) == 2.0,
    }
    return [name for name, right in checks.items() if not right] + refined_self_test()

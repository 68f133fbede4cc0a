"""Refined sweeps: their documents, their tables, values between rows, and drawings.

The tables are made by hand, so that no solver and no service is needed.
"""
import json
import math
import tempfile
import unittest

from .support import Case, column, snapthrough

LOAD = "/summary/critical_load_factor"
TYPE = "/summary/critical_type"
STIFFNESS = "/model/foundations/0/stiffness"


def sweep_document(refine, *ranges, others=()):
    """A sweep document whose last parameters have ranges (name, from, to, spacing)."""
    parameters = [{"name": name, "targets": [{"pointer": "/model/sections/0/EI"}], "values": values}
                  for name, values in others]
    parameters += [{"name": name, "targets": [{"pointer": STIFFNESS}],
                    "range": {"from": first, "to": last, "count": 3, "spacing": spacing}}
                   for name, first, last, spacing in ranges]
    return {"model": {}, "analysis": {}, "parameters": parameters, "design": "grid", "outputs": [LOAD, TYPE],
            "refine": refine}


def row(values, load, piece, change=None, kind="limit_max"):
    """A row of a refined table; a load of None is a row that failed."""
    if load is None:
        return [*values, None, None, piece, change, {"code": "no_critical_point", "detail": "none"}]
    return [*values, load, kind, piece, change, None]


def table_of(names, rows, document=None):
    """A refined table of parameters' names and rows, each with the number of a point."""
    table = snapthrough.Table([*names, LOAD, TYPE, "piece", "change", "error"], 1)
    for point, one in enumerate(rows):
        table.append(11 * point, one, json.dumps(one, separators=(",", ":")))
    table.done = 1
    return table if document is None else table.with_sweep(document)


class Documents(Case):
    def sweep(self, refine, design="grid", **fields):
        sweep = snapthrough.Sweep(column(), snapthrough.Critical(), design, [LOAD], refine=refine, **fields)
        sweep.parameter("EI", "/model/sections/0/EI", values=[1, 2])
        return sweep.parameter("K", STIFFNESS, range={"from": 1, "to": 10, "count": 3})

    def test_a_pointer_alone_leaves_the_rest_to_the_contract(self):
        self.assertEqual(self.sweep(LOAD).document["refine"], {"output": LOAD})
        self.assertNotIn("refine", self.sweep(None).document)

    def test_a_dictionary_is_the_contracts_object(self):
        for refine in ({"output": LOAD}, {"output": LOAD, "within": 1e-3, "parameters": 1, "most": 50}):
            sweep = self.sweep(refine)
            self.assertEqual(sweep.document["refine"], refine)
            self.assertEqual([parameter["name"] for parameter in sweep.document["parameters"]], ["EI", "K"])

    def test_a_mistake_is_told_where_it_is_made(self):
        for refine, words in (({"output": LOAD, "witin": 0.1}, "'witin' is none of output, within, parameters, most"),
                              ({"within": 0.1}, "output must be the pointer"), (7, "7 is neither the pointer"),
                              ({"output": LOAD, "within": 0}, "within is 0; it must be a share greater than 0"),
                              ({"output": LOAD, "within": math.nan}, "within is nan"),
                              ({"output": LOAD, "parameters": 3}, "parameters is 3; it must be 1 or 2"),
                              ({"output": LOAD, "parameters": True}, "parameters is True"),
                              ({"output": LOAD, "most": 2.5}, "most is 2.5; it must be a whole number")):
            with self.assertRaisesRegex(ValueError, "^refine: " + words):
                self.sweep(refine)

    def test_the_rest_of_the_sweep_must_allow_for_it(self):
        for sweep, words in ((self.sweep({"output": LOAD, "parameters": 2}), "'EI' needs a range"),
                             (self.sweep(LOAD, "zip"), 'the design must be "grid"; it is \'zip\''),
                             (self.sweep(LOAD, follow="K"), "follow or refine, not both"),
                             (self.sweep(TYPE), f"'{TYPE}' must be one of the outputs"),
                             (snapthrough.Sweep(column(), snapthrough.Critical(), "grid", [LOAD], refine=LOAD),
                              "1 of the parameters must be refined; the sweep has 0")):
            with self.assertRaisesRegex(ValueError, "^refine: .*" + words):
                sweep.document


class Tables(Case):
    ROWS = [row([1.0], 2.0, 0), row([1.5], 3.5, 0), row([1.5000001], 9.0, 1, "jump", "bifurcation"),
            row([4.0], None, 2, "no value")]

    def test_piece_and_change_are_columns_but_no_outputs(self):
        table = table_of(["K"], self.ROWS)
        self.assertTrue(table.refined)
        self.assertEqual((table.parameters, table.outputs), (["K"], [LOAD, TYPE]))
        self.assertEqual(table.column("piece"), [0, 0, 1, 2])
        self.assertEqual(table.column("change"), [None, None, "jump", "no value"])
        self.assertEqual((table.failed, table.complete), (1, True))
        self.assertEqual(repr(table),
                         f"Table(4 rows, 1 with an error; columns K, {LOAD}, {TYPE}, piece, change, error)")

    def test_parameters_of_these_names_make_no_refined_table(self):
        table = snapthrough.Table(["piece", "change", LOAD, "error"], 2)
        table.append(0, [1, 2, 3.0, None], "[1,2,3.0,null]")
        self.assertFalse(table.refined or table.complete)
        self.assertEqual((table.parameters, table.outputs), (["piece", "change"], [LOAD]))

    def test_tables_are_read_again(self):
        table = table_of(["K"], self.ROWS)
        document = sweep_document({"output": LOAD}, ("K", 1, 4, "linear"))
        with tempfile.TemporaryDirectory() as folder:
            for name, write in (("t.json", table.to_json), ("t.ndjson", table.to_ndjson)):
                write(f"{folder}/{name}")
                again = snapthrough.read_table(f"{folder}/{name}", sweep=json.dumps(document))
                self.assertEqual((again.rows, again.points), (table.rows, [0, 11, 22, 33]))
                self.assertTrue(again.refined and again.complete)
                self.assertEqual(again.interpolated({"K": 1.25}), 2.75)
        self.assertEqual(table.to_csv().splitlines()[3], "1.5000001,9.0,bifurcation,1,jump,")

    def test_a_frame_has_them(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not there")
        frame = table_of(["K"], self.ROWS).to_pandas()
        self.assertEqual(list(frame.index), [0, 11, 22, 33])
        self.assertEqual(frame["change"].dropna().tolist(), ["jump", "no value"])


class OneParameter(Case):
    def at(self, table, *values, name="K", **others):
        return [table.interpolated({name: value, **others}) for value in values]

    def test_lines_join_rows_of_a_piece_only(self):
        table = table_of(["K"], Tables.ROWS, sweep_document({"output": LOAD}, ("K", 1, 4, "linear")))
        self.assertEqual(self.at(table, 1, 1.25, 1.5), [2.0, 2.75, 3.5])
        self.assertEqual(self.at(table, 1.50000005, 1.5000001), [None, 9.0])
        self.assertEqual(self.at(table, 3, 4, 0.999, 4.001), [None, None, None, None])

    def test_lines_are_straight_over_the_logarithm_where_the_range_is(self):
        rows = [row([10.0 ** power], 3.0 * power, 0) for power in (0, 1, 3)]
        table = table_of(["K"], rows, sweep_document({"output": LOAD}, ("K", 1, 1000, "log")))
        for value in (1, 2, 10, 77, 1000):
            self.assertAlmostEqual(table.interpolated({"K": value}), 3 * math.log10(value), places=12)
        self.assertEqual(self.at(table, 0, -1), [None, None])
        plain = table_of(["K"], rows, sweep_document({"output": LOAD}, ("K", 1, 1000, "linear")))
        self.assertAlmostEqual(plain.interpolated({"K": 505}), 6)

    def test_a_range_that_falls(self):
        rows = [row([8.0], 1.0, 0), row([4.0], 2.0, 0), row([3.9], 7.0, 1, "jump"), row([1.0], 4.1, 1)]
        table = table_of(["K"], rows, sweep_document({"output": LOAD}, ("K", 8, 1, "linear")))
        self.assertEqual(self.at(table, 8, 6, 3.95, 3.9), [1.0, 1.5, None, 7.0])
        self.assertAlmostEqual(table.interpolated({"K": 2.45}), 5.55)

    def test_a_row_without_value_alone_ends_the_piece_before_it(self):
        for places, spacing in (((1.0, 2.0, 2.1, 2.2, 3.0), "linear"), ((3.0, 2.2, 2.1, 2.0, 1.0), "log")):
            rows = [row([place], load, piece) for place, load, piece in zip(places, (1.0, 5.0, None, 8.0, 9.0),
                                                                            (0, 0, 0, 1, 1))]
            table = table_of(["K"], rows, sweep_document({"output": LOAD}, ("K", places[0], places[-1], spacing)))
            self.assertEqual(self.at(table, *places), [1.0, 5.0, None, 8.0, 9.0])
            self.assertEqual(self.at(table, 2.05, 2.15), [None, None])
            self.assertLess(1.0, table.interpolated({"K": (places[0] + places[1]) / 2}))

    def test_other_parameters_have_a_value_of_the_table(self):
        rows = [row([feet, ends, place], load, 0) for feet, ends, load in (("pinned", 1, 2.0), ([{"x": 1}], 2, 5.0))
                for place in (0.0, 1.0)]
        rows.append(["pinned", 3, None, *failed_curve()])
        document = sweep_document({"output": LOAD}, ("K", 0, 1, "linear"), others=[("feet", []), ("ends", [])])
        table = table_of(["feet", "ends", "K"], rows, document)
        self.assertEqual(self.at(table, 0.5, feet="pinned", ends=1.0), [2.0])
        self.assertEqual(self.at(table, 0.5, feet=[{"x": 1}], ends=2), [5.0])
        self.assertEqual(self.at(table, 0.5, feet="pinned", ends=3), [None])  # the curve failed as a whole
        with self.assertRaisesRegex(ValueError, "no row has feet 'pinned', ends 2"):
            self.at(table, 0.5, feet="pinned", ends=2)

    def test_values_that_do_not_fit_are_told(self):
        table = table_of(["K"], Tables.ROWS, sweep_document({"output": LOAD}, ("K", 1, 4, "linear")))
        for values, words in (({}, "K must have a value"), ({"K": 1, "EI": 2}, "'EI' is none of the parameters K"),
                              ({"K": "1"}, "'K' is '1'; a refined parameter must be a finite number"),
                              ({"K": math.inf}, "'K' is inf")):
            with self.assertRaisesRegex(ValueError, "values: " + words):
                table.interpolated(values)

    def test_a_table_must_know_its_sweep(self):
        table = table_of(["K"], Tables.ROWS)
        with self.assertRaisesRegex(ValueError, "with_sweep"):
            table.interpolated({"K": 1})
        with self.assertRaisesRegex(ValueError, "the member refine"):
            table.with_sweep({"parameters": []})
        with self.assertRaisesRegex(ValueError, "over EI; the table has the columns K,"):
            table.with_sweep(sweep_document({"output": LOAD}, ("EI", 1, 4, "linear"))).interpolated({"K": 1})
        plain = snapthrough.Table(["K", LOAD, "error"], 1)
        with self.assertRaisesRegex(ValueError, "was not refined"):
            plain.with_sweep(sweep_document({"output": LOAD}, ("K", 1, 4, "linear"))).interpolated({"K": 1})

    def test_rows_that_are_added_count(self):
        table = table_of(["K"], Tables.ROWS[:1], sweep_document({"output": LOAD}, ("K", 1, 4, "linear")))
        self.assertIsNone(table.interpolated({"K": 1.25}))
        table.append(1, Tables.ROWS[1], "")
        self.assertEqual(table.interpolated({"K": 1.25}), 2.75)


def failed_curve():
    """The end of the row of a curve that failed as a whole."""
    return [None, None, None, None, {"code": "refinement_limit", "detail": "1000 points are not enough"}]


def jump_at(p):
    """The place of a jump that is linear in the logarithm of p."""
    return 20 + 10 * math.log10(p)


def surface_rows(p, gap=1e-6):
    """Rows of a curve of two pieces with a jump at jump_at(p); both pieces are linear in q, and along them in log p."""
    at = jump_at(p)
    return [row([p, 0.0], 1.0, 0), row([p, at], 1 + math.log10(p), 0), row([p, at + gap], 50.0, 1, "jump"),
            row([p, (at + gap + 100) / 2], 60.0, 1), row([p, 100.0], 70.0, 1)]


class TwoParameters(Case):
    DOCUMENT = sweep_document({"output": LOAD, "parameters": 2}, ("p", 1, 1000, "log"), ("q", 0, 100, "linear"))

    def table(self, *curves, document=None):
        return table_of(["p", "q"], [one for curve in curves for one in curve], document or self.DOCUMENT)

    def test_a_jump_moves_between_curves_as_pieces_are_blended(self):
        table = self.table(surface_rows(1), surface_rows(10), surface_rows(1000))
        for p in (1, 2.5, 10, 31, 400, 1000):
            at = jump_at(p)
            for share in (0, 0.3, 0.999999):
                expected = 1 + share * math.log10(p)
                self.assertAlmostEqual(table.interpolated({"p": p, "q": share * at}), expected, places=9)
            for share in (0.001, 0.5, 1):
                q = at + 2e-6 + share * (100 - at - 2e-6)
                self.assertAlmostEqual(table.interpolated({"p": p, "q": q}), 50 + 20 * (q - at) / (100 - at), places=5)
            self.assertIsNone(table.interpolated({"p": p, "q": at + 5e-7}))

    def test_the_ends_of_the_ranges_belong_to_them(self):
        document = sweep_document({"output": LOAD, "parameters": 2}, ("p", 1, 7, "linear"), ("q", 0.1, 0.7, "log"))
        curves = [[row([p, q], p * math.log(q), 0) for q in (0.1, 0.7)] for p in (1.0, 3.0, 7.0)]
        table = self.table(*curves, document=document)
        for p in [1 + 0.06 * part for part in range(100)] + [7]:
            for q in (0.1, 0.7):
                self.assertAlmostEqual(table.interpolated({"p": p, "q": q}), p * math.log(q), places=12)
        for p, q in ((0.99, 0.5), (7.01, 0.5), (5, 0.0999), (5, 0.7001), (5, 0)):
            self.assertIsNone(table.interpolated({"p": p, "q": q}))

    def test_at_the_value_of_a_curve_it_is_that_curve_alone(self):
        table = self.table([row([1.0, 0.0], 1.0, 0), row([1.0, 100.0], 3.0, 0)], surface_rows(10),
                           [row([1000.0, q], None, 0) for q in (0.0, 100.0)])
        self.assertEqual(table.interpolated({"p": 1, "q": 50}), 2.0)
        self.assertEqual(table.interpolated({"p": 10, "q": 15}), 1.5)
        self.assertIsNone(table.interpolated({"p": 1000, "q": 50}))

    def test_curves_with_other_numbers_of_pieces_are_blended_at_the_place(self):
        table = self.table([row([1.0, 0.0], 1.0, 0), row([1.0, 100.0], 3.0, 0)], surface_rows(10))
        share = math.log10(2)
        self.assertAlmostEqual(table.interpolated({"p": 2, "q": 15}), (1 - share) * 1.3 + share * 1.5, places=12)
        self.assertAlmostEqual(table.interpolated({"p": 2, "q": 100}), (1 - share) * 3 + share * 70, places=12)
        self.assertIsNone(table.interpolated({"p": 2, "q": 30 + 5e-7}))

    def test_pieces_without_values_count(self):
        curves = [[row([p, 0.0], 1.0, 0), row([p, 10 * p], 2.0, 0), row([p, 10 * p + 1], None, 1, "no value"),
                   row([p, 90.0], None, 1), row([p, 91.0], 5.0, 2, "value begins"), row([p, 100.0], 6.0, 2)]
                  for p in (1.0, 4.0)]
        document = sweep_document({"output": LOAD, "parameters": 2}, ("p", 1, 4, "linear"), ("q", 0, 100, "linear"))
        table = self.table(*curves, document=document)
        self.assertAlmostEqual(table.interpolated({"p": 2, "q": 10}), 1.5)
        self.assertEqual([table.interpolated({"p": 2, "q": q}) for q in (20.5, 21, 50, 90.5)], [None] * 4)
        self.assertAlmostEqual(table.interpolated({"p": 2, "q": 95.5}), 5.5)

    def test_a_row_without_value_alone_is_no_part_of_a_pieces_length(self):
        for end, begin in ((0.0, 100.0), (100.0, 0.0)):
            way = (end - begin) / 100
            curves = []
            for p in (1.0, 3.0):
                at = [begin + way * q for q in (0, 10 * p, 10 * p + 1, 10 * p + 2, 100)]
                gap = [] if p == 3 else [row([p, at[2]], None, 0)]  # here the first piece ends at 10 p alone
                curves.append([row([p, at[0]], 1.0, 0), row([p, at[1]], 2.0, 0), *gap,
                               row([p, at[3]], 5.0, 1, "jump"), row([p, at[4]], 6.0, 1)])
            document = sweep_document({"output": LOAD, "parameters": 2}, ("p", 1, 3, "linear"),
                                      ("q", begin, end, "linear"))
            table = self.table(*curves, document=document)
            found = [table.interpolated({"p": 2, "q": begin + way * q}) for q in (0, 10, 20, 21, 22, 61, 100)]
            self.assertEqual(found, [1.0, 1.5, 2.0, None, 5.0, 5.5, 6.0])

    def test_a_single_row_and_one_without_value(self):
        curves = [[row([p, 0.0], p, 0), row([p, 1.0], None, 0), row([p, 2.0], 7 * p, 1, "value begins"),
                   row([p, 100.0], 7 * p, 1)] for p in (1.0, 3.0)]
        document = sweep_document({"output": LOAD, "parameters": 2}, ("p", 1, 3, "linear"), ("q", 0, 100, "linear"))
        table = self.table(*curves, document=document)
        self.assertEqual([table.interpolated({"p": 2, "q": q}) for q in (0, 0.5, 1, 1.5, 2, 50)],
                         [2.0, None, None, None, 14.0, 14.0])

    def test_pieces_of_single_rows(self):
        curves = [[row([p, 0.0], p, 0), row([p, 50.0 + p], 7 * p, 1, "jump"), row([p, 51.0 + p], 0.0, 2, "jump"),
                   row([p, 100.0], 0.0, 2)] for p in (1.0, 3.0)]
        document = sweep_document({"output": LOAD, "parameters": 2}, ("p", 1, 3, "linear"), ("q", 0, 100, "linear"))
        table = self.table(*curves, document=document)
        self.assertEqual([table.interpolated({"p": 2, "q": q}) for q in (0, 1, 52, 52.5, 53, 100)],
                         [2.0, None, 14.0, None, 0.0, 0.0])

    def test_a_third_parameter_has_a_value_of_the_table(self):
        rows = [[feet, *one] for feet in ("pinned", "clamped") for one in surface_rows(1) + surface_rows(10)]
        document = {**self.DOCUMENT, "parameters": [{"name": "feet", "values": []}, *self.DOCUMENT["parameters"]]}
        table = table_of(["feet", "p", "q"], rows, document)
        self.assertAlmostEqual(table.interpolated({"feet": "clamped", "p": 10 ** 0.5, "q": 12.5}), 1.25)
        with self.assertRaisesRegex(ValueError, "no row has feet 'free'"):
            table.interpolated({"feet": "free", "p": 2, "q": 1})


class Drawings(Case):
    def setUp(self):
        super().setUp()
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not there")
        matplotlib.use("Agg")

    def draw(self, table, *arguments):
        from matplotlib import pyplot
        axes = table.plot(*arguments)
        self.addCleanup(pyplot.close, axes.figure)
        lines = [list(zip(line.get_xdata(), line.get_ydata())) for line in axes.lines]
        return axes, lines[:-1], lines[-1], [text.get_text() for text in axes.texts]

    def test_lines_break_between_pieces_and_changes_are_named(self):
        table = table_of(["p", "q"], surface_rows(1) + surface_rows(10))
        axes, lines, rings, texts = self.draw(table)
        self.assertEqual([len(line) for line in lines], [2, 3, 2, 3])
        self.assertEqual(lines[0], [(0.0, 1.0), (20.0, 1.0)])
        self.assertEqual(rings, [(20 + 1e-6, 50.0), (30 + 1e-6, 50.0)])
        self.assertEqual(texts, ["jump", "jump"])
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("q", LOAD))
        self.assertEqual([text.get_text() for text in axes.get_legend().get_texts()], ["p 1", "p 10"])
        self.assertEqual(axes.get_xscale(), "linear")

    def test_the_first_of_each_change_is_named_before_others_and_at_most_six(self):
        changes = [*["jump"] * 7, "type: limit_max to bifurcation", "contact: " + "x" * 60, "no value"]
        rows = [row([1.0], 1.0, 0)] + [row([2.0 + at], 1.0, 1 + at, change) for at, change in enumerate(changes)]
        _, _, rings, texts = self.draw(table_of(["q"], rows))
        self.assertEqual(len(rings), 10)
        self.assertEqual(texts, ["jump", "limit_max to bifurcation", "contact: " + "x" * 27 + " ...", "no value",
                                 "jump", "jump"])

    def test_where_rows_have_no_value_nothing_is_drawn(self):
        rows = [row([1.0], 1.0, 0), row([2.0], 2.0, 0), row([3.0], None, 1, "no value"),
                row([4.0], 5.0, 2, "value begins"),
                [None, *failed_curve()]]
        document = sweep_document({"output": LOAD}, ("q", 1, 4, "log"))
        axes, lines, rings, texts = self.draw(table_of(["q"], rows, document))
        self.assertEqual([len(line) for line in lines], [2, 1, 1])
        self.assertTrue(math.isnan(lines[1][0][1]))
        self.assertEqual(rings, [(2.0, 2.0), (4.0, 5.0)])
        self.assertEqual((texts, axes.get_xscale()), (["no value", "value begins"], "log"))

    def test_a_single_value_beside_a_row_without_one_is_a_dot(self):
        rows = [row([1.0], 1.0, 0), row([2.0], None, 0), row([3.0], 2.0, 1, "value begins"), row([4.0], 2.0, 1)]
        axes, lines, rings, texts = self.draw(table_of(["q"], rows))
        self.assertEqual([line.get_marker() for line in axes.lines[:2]], [".", "None"])
        self.assertEqual((len(lines[0]), rings, texts), (2, [(3.0, 2.0)], ["value begins"]))

    def test_tables_that_are_not_refined_are_drawn(self):
        table = snapthrough.Table(["EI", "K", LOAD, "error"], 4)
        for point, one in enumerate([[1, 1, 2.0, None], [1, 2, 3.0, None], [2, 1, 4.0, None], [2, 2, None, {}]]):
            table.append(point, one, "")
        _, lines, rings, texts = self.draw(table, LOAD)
        self.assertEqual((lines[0], rings, texts), ([(1.0, 2.0), (2.0, 3.0)], [], []))
        for output in ("piece", "/summary"):
            with self.assertRaisesRegex(ValueError, "is none of " + LOAD):
                table.plot(output)
        table.rows[0][1] = "pinned"
        with self.assertRaisesRegex(ValueError, "'K' has values that are no numbers"):
            table.plot()


if __name__ == "__main__":
    unittest.main()

// Pictures of refined sweeps, whose tables say where a line may be drawn; and the documents that ask for them.

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  changesOf, changeText, curveAxes, piecesOf, sweepLine, sweepLineChart, sweepMap, sweepMapChart, sweepMapLocate, type Shape, type Table,
} from "../../../web/src/figures/index";
import { place } from "../../../web/src/figures/chart/axes";
import { refinedOutput, sweepOf } from "../../../web/src/model/sweep_document";
import {
  boxOf, must, piecesOf as drawnPieces, readCase, readTable, refinedTable, tableOf, textOf, textsOf, withClass, without,
} from "./support";

const size = { width: 560, height: 420 };
const kLoad = { column: "/summary/critical_load_factor" };
const one = without(refinedTable([1]), "k");
const map = { table: refinedTable([1, 1.25, 1.5]), x: { column: "k" }, y: { column: "t" }, value: kLoad };
const line = { table: one, x: { column: "t" }, y: kLoad };

function labelsOf(picture: Shape): string[] {
  return withClass(picture, "break-text").map(textOf);
}

test("a line breaks where the piece changes, and at rows without a value", () => {
  const chart = sweepLineChart(line, size);
  const pieces = drawnPieces(must(withClass(sweepLine(line, size, chart), "series-line")[0]));
  const ends = pieces.map((piece) => [must(piece[0]).x, must(piece.at(-1)).x].map(Math.round));
  const pixel = (t: number) => Math.round(place(chart.frame.x, t));
  assert.deepEqual(ends, [[0, 2.99], [3.01, 5.99], [6.01, 8], [9, 10]].map((piece) => piece.map(pixel)));
  assert.deepEqual(must(chart.lines[0]).breaks.map(({ before, after }) => [before.row, after.row]), [[2, 3], [4, 5], [6, 7], [8, 9]]);
});

test("a table without pieces has one line through its jumps", () => {
  const plain = { ...line, table: without(one, "piece", "change") };
  const picture = sweepLine(plain, size);
  const pieces = drawnPieces(must(withClass(picture, "series-line")[0]));
  assert.equal(pieces.length, 2, "before and after the rows without values");
  for (const name of ["breaks", "break-mark", "break-text"]) assert.equal(withClass(picture, name).length, 0, name);
  assert.ok(!String(picture.attributes["aria-label"]).includes("broken"));
  assert.equal(piecesOf(plain.table), null);
  assert.equal(curveAxes(plain.table), null);
  assert.deepEqual(changesOf(plain.table), []);
});

test("each break has rings at its ends, and its change is named once there is room", () => {
  const chart = sweepLineChart(line, size);
  const picture = sweepLine(line, size, chart);
  const rings = withClass(picture, "break-mark");
  const pixels = rings.map((ring) => [Number(ring.attributes["cx"]), Number(ring.attributes["cy"])]);
  assert.equal(rings.length, 5, "two at the jump, one where the kind changes, one at each end of what has no value");
  for (const row of [2, 3, 6, 9]) {
    const spot = must(must(chart.lines[0]).spots[row]);
    const [x, y] = [place(chart.frame.x, spot.x), place(chart.frame.y, spot.y)];
    assert.ok(pixels.some(([cx, cy]) => Math.hypot(must(cx) - x, must(cy) - y) < 0.1), String(row));
  }
  assert.deepEqual(labelsOf(picture), ["jump", "limit point to bifurcation", "no value", "value begins"]);
  assert.ok(rings.map(textOf).includes("t = 6.01: limit point to bifurcation"), "what a pointer is told");
  assert.match(String(picture.attributes["aria-label"]), /, broken at 4 places$/);
});

/** A curve of which each row is a piece of its own. */
function shattered(count: number): Table {
  const rows = Array.from({ length: count }, (_, i) => [i, Math.sin(i) * 10, i, i === 0 ? null : `load of type ${i}`, null]);
  return tableOf(["t", kLoad.column, "piece", "change", "error"], rows);
}

test("names of changes cover neither one another nor the axes, and there are six at most", () => {
  for (const [width, height, count] of [[320, 260, 6], [560, 420, 40], [1200, 700, 40], [1200, 700, 400]] as const) {
    const picture = sweepLine({ ...line, table: shattered(count) }, { width, height });
    const texts = withClass(picture, "break-text");
    assert.ok(texts.length <= 6 && (count === 400 || texts.length >= 2), `${width} ${count}: ${texts.length}`);
    const boxes = texts.map(boxOf);
    boxes.forEach((a, n) => boxes.slice(n + 1).forEach((b) =>
      assert.ok(a.right <= b.left || b.right <= a.left || Math.abs(a.y - b.y) >= 11, JSON.stringify([a, b]))));
    assert.ok(boxes.every(({ left, right, y }) => left >= 60 && right <= width && y < height - 44 && y > 8));
    assert.equal(withClass(picture, "break-mark").length, count, "every break has its mark");
  }
  assert.equal(changesOf(shattered(40)).length, 39, "the list for screen readers has all");
});

test("curves are told apart by all parameters but the last, also where their rows are at other values", () => {
  const table = refinedTable([1, 1.5]);
  assert.deepEqual(curveAxes(table), { x: "t", series: ["k"] });
  const chart = sweepLineChart({ ...line, table, series: ["k"] }, size);
  assert.deepEqual(chart.lines.map(({ name, spots, breaks }) => [name, spots.length, breaks.length]), [["k = 1", 11, 4], ["k = 1.5", 11, 4]]);
  const picture = sweepLine({ ...line, table, series: ["k"] }, size, chart);
  assert.deepEqual(labelsOf(picture).slice(0, 4), ["jump", "limit point to bifurcation", "no value", "value begins"]);
  const wide: Table = { ...table, columns: ["feet", ...table.columns], rows: table.rows.map((row, i) => [i < 11 ? "a" : "b", ...row]) };
  const names = sweepLineChart({ ...line, table: wide, series: must(curveAxes(wide)).series }, size).lines.map(({ name }) => name);
  assert.deepEqual(names, ["feet = a, k = 1", "feet = b, k = 1.5"]);
});

test("rows that failed part a curve once, and a curve that failed as a whole is told in words", () => {
  const failed = (t: number | null) => [t, null, null, null, { code: "no_start", detail: "none" }];
  const rows = [[0, 5, 0, null, null], [1, 6, 0, null, null], failed(2), failed(3), [4, 9, 1, "value begins, failure: no_start to none", null]];
  const columns = ["t", kLoad.column, "piece", "change", "error"];
  const chart = sweepLineChart({ ...line, table: tableOf(columns, rows) }, size);
  assert.deepEqual(must(chart.lines[0]).breaks.map(({ before, after, change }) => [before.row, after.row, change]),
                   [[1, 2, "no value, failure: no start"], [3, 4, "value begins, failure: no start to none"]]);
  assert.equal(withClass(sweepLine({ ...line, table: tableOf(columns, rows) }, size, chart), "break-mark").length, 2);
  const none = sweepLine({ ...line, table: tableOf(columns, [failed(null)]) }, size);
  assert.ok(textsOf(none).includes("1 failed: 1 no_start"));
  const { table } = map;
  const lost = { ...table, rows: [...table.rows, [2, null, null, null, null, null, { code: "refinement_limit", detail: "" }]] };
  assert.ok(textsOf(sweepMap({ ...map, table: lost }, size)).includes("1 failed: 1 refinement_limit"));
});

test("dots stay at the rows of a short refined curve, and are left out of a long one", () => {
  assert.equal(withClass(sweepLine(line, size), "series-dot").length, 9);
  const rows = Array.from({ length: 90 }, (_, i) => [i, i, i < 40 ? 0 : 1, i === 40 ? "jump" : null, null]);
  const picture = sweepLine({ ...line, table: tableOf(["t", kLoad.column, "piece", "change", "error"], rows) }, size);
  assert.equal(withClass(picture, "series-dot").length, 0);
  assert.deepEqual(labelsOf(picture), ["jump"]);
});

test("parameters that are called piece and change stay parameters", () => {
  const table = tableOf(["piece", "change", kLoad.column, "error"], [[0, 1, 5, null], [1, 2, 6, null], [2, 3, 9, null]]);
  assert.equal(piecesOf(table), null);
  const picture = sweepLine({ table, x: { column: "piece" }, y: kLoad }, size);
  assert.equal(drawnPieces(must(withClass(picture, "series-line")[0])).length, 1);
  assert.equal(piecesOf(readTable("map")), null);
});

test("changes are in words, with the values of the parameters where they are", () => {
  assert.equal(changeText("type: limit_max to broken_bifurcation"), "limit point to broken bifurcation");
  assert.equal(changeText("jump, type: limit_max to bifurcation"), "jump, limit point to bifurcation");
  assert.equal(changeText("no value, type: limit_max to none"), "no value, type: limit point to none");
  assert.equal(changeText("zones of contact of wall_left: 1 to 2"), "zones of contact of wall_left: 1 to 2");
  const [first] = changesOf(refinedTable([2]));
  assert.deepEqual(first, { row: 3, where: [{ name: "k", value: 2 }, { name: "t", value: 6.01 }], change: "jump" });
});

test("a map of refined curves has the values of straight lines within pieces, and strokes where the curves break", () => {
  const chart = sweepMapChart(map, size);
  assert.equal(chart.cells.length, chart.xs.length * chart.ys.length);
  chart.ys.forEach((t, j) => {
    const [k, cell] = [1.25, must(chart.cells[j * 3 + 1])];
    const near = [3.74, 3.76, 5.99, 6.01, 8, 8.02, 8.98, 9].some((end) => Math.abs(t - end) < 0.02);
    const load = t > 8 && t < 9 ? Number.NaN : 10 * k + t - (t > 3 * k ? 5 * k : 0);
    if (!near) assert.ok(Object.is(cell.value, load) || Math.abs(cell.value - load) < 1e-9, `${t}: ${cell.value}, ${load}`);
  });
  assert.equal(must(chart.curves).breaks.length, 12);
  const picture = sweepMap(map, size, chart);
  assert.equal(withClass(picture, "break-line").length, 4, "a path for each change");
  const jumps = drawnPieces(must(withClass(picture, "break-line")[0]));
  assert.deepEqual(jumps.map((stroke) => Math.round(must(stroke[0]).y)), [3, 3.75, 4.5].map((t) => Math.round(place(chart.frame.y, t))));
  assert.ok(labelsOf(picture).includes("jump") && labelsOf(picture).length <= 6);
  for (const spot of chart.spots) {
    const found = must(sweepMapLocate(chart, { x: place(chart.frame.x, spot.x), y: place(chart.frame.y, spot.y) }));
    assert.ok(Math.abs(must(chart.spots.find(({ row }) => row === found.row)).y - spot.y) < 0.05, String(spot.row));
  }
  assert.ok(textsOf(picture).includes("6 without a value"));
});

test("contour lines of a map do not run along the breaks of its curves", () => {
  const chart = sweepMapChart(map, size);
  const { isJoined } = must(chart.curves);
  const below = (t: number) => chart.ys.findIndex((y) => y > t) - 1;
  assert.ok(isJoined(0, below(1)) && isJoined(1, below(5)));
  assert.ok(!isJoined(0, below(3)), "the jump of the left curve");
  assert.ok(!isJoined(0, below(3.4)), "the right curve has not jumped yet");
  for (const piece of withClass(sweepMap(map, size, chart), "contour").flatMap((node) => drawnPieces(node))) {
    assert.ok(Math.abs(must(piece[0]).y - must(piece[1]).y) < 20, "no piece is as high as the step between two jumps");
  }
});

test("curves with different numbers of pieces are parted by their own breaks alone", () => {
  const [whole, broken] = [refinedTable([1]), refinedTable([2])];
  const rows = [...whole.rows.map((row) => row.map((cell, i) => (i === 4 ? 0 : i === 5 ? null : cell))), ...broken.rows];
  const chart = sweepMapChart({ ...map, table: tableOf(whole.columns, rows) }, size);
  const below = (t: number) => chart.ys.findIndex((y) => y > t) - 1;
  const { breaks, isJoined } = must(chart.curves);
  assert.deepEqual(breaks.map(({ column }) => column), [1, 1, 1, 1]);
  assert.deepEqual([3, 5, 6, 7].map((t) => isJoined(0, below(t))), [true, true, false, true]);
});

test("a map of a grid is without strokes", () => {
  const grid = { table: readTable("map"), x: { column: "k", log: true }, y: { column: "EI" }, value: kLoad };
  assert.equal(sweepMapChart(grid, size).curves, null);
  assert.equal(withClass(sweepMap(grid, size), "break-line").length, 0);
});

test("a sweep of the page asks for refined curves along a range, by an output that is a number", () => {
  const { request } = readCase("arch_outside");
  const range = { name: "t", targets: [{ pointer: "/model/sections/0/EI" }], range: { from: 1, to: 2, count: 41 } };
  const list = { name: "k", targets: [{ pointer: "/model/sections/0/EA" }], values: [1, 2] };
  const sweep = sweepOf(request, [list, range], true);
  assert.deepEqual(sweep.refine, { output: "/summary/critical_load_factor", within: 0.01 });
  assert.equal(sweep.design, "grid");
  assert.ok(!("refine" in sweepOf(request, [list, range], false)));
  assert.ok(!("refine" in sweepOf(request, [range, list], true)), "the last parameter is a list");
  assert.equal(refinedOutput([range], ["/summary/critical_type"]), null);
});

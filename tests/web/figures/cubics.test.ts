// Paths with rates are drawn by cubics through few rows; the curves that they are compared with are known.

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  chosenShape, frequencyChart, frequencyFigure, pathChart, pathData, pathFigure, softestNear, softestPoint, type PathInput,
  type PathQuantity, type PathResult, type Pixel, type Shape,
} from "../../../web/src/figures/index";
import { place, valueAt } from "../../../web/src/figures/chart/axes";
import { thinned } from "../../../web/src/figures/chart/thin";
import type { Branch } from "../../../web/src/figures/chart/curves";
import { distanceTo, kCases, must, piecesOf, plainBranch, pointsOf, readCase, withClass } from "./support";

const size = { width: 520, height: 440 };
const load: PathQuantity = { kind: "load_factor" };
const down: PathQuantity = { kind: "monitor", id: "crown", reversed: true };

/** A path at arc lengths: its load factor and minus its monitor, with the rates of both. */
interface Known {
  load: (s: number) => readonly [number, number];
  down: (s: number) => readonly [number, number];
}

const kCircle: Known = { load: (s) => [Math.sin(s), Math.cos(s)], down: (s) => [1 - Math.cos(s), Math.sin(s)] };

function branchOf({ load: loads, down: downs }: Known, arcs: readonly number[]): Branch {
  return {
    id: 0, parent: null, load_factor: arcs.map((s) => loads(s)[0]), arc_length: [...arcs],
    monitors: { crown: arcs.map((s) => -downs(s)[0]) }, negative_eigenvalues: arcs.map(() => 0),
    stiffness_ratio: arcs.map(() => null), contact_fraction: {}, termination: "steps",
    rates: { load_factor: arcs.map((s) => loads(s)[1]), monitors: { crown: arcs.map((s) => -downs(s)[1]) } },
  };
}

function resultOf(...branches: Branch[]): PathResult {
  return { branches, critical_points: [], contact_events: [] };
}

/** Arc lengths from 0 to `end` in so many equal steps. */
function steps(end: number, count: number): number[] {
  return Array.from({ length: count + 1 }, (_, i) => (i * end) / count);
}

function pathLines(picture: Shape): Shape[] {
  return withClass(must(withClass(picture, "plot-lines")[0]), "path");
}

/** The points of the drawn path in the quantities of its axes. */
function drawn(input: PathInput): { x: number; y: number }[] {
  const chart = pathChart(input, size);
  return pathLines(pathFigure(input, size, chart)).flatMap(pointsOf)
    .map(({ x, y }) => ({ x: valueAt(chart.frame.x, x), y: valueAt(chart.frame.y, y) }));
}

function worst(points: readonly { x: number; y: number }[], error: (x: number, y: number) => number): number {
  return Math.max(...points.map(({ x, y }) => Math.abs(error(x, y))));
}

const kQuarters = branchOf(kCircle, steps(Math.PI, 4));

test("the line through five rows of a half circle is round, and also over the arc length and with the axes exchanged", () => {
  const radius = (x: number, y: number): number => Math.hypot(1 - x, y) - 1;
  const result = resultOf(kQuarters);
  const points = drawn({ result, x: down, y: load });
  assert.ok(points.length > 100 && worst(points, radius) < 0.002, String(worst(points, radius)));
  assert.ok(worst(drawn({ result, x: load, y: down }), (x, y) => radius(y, x)) < 0.002);
  assert.ok(worst(drawn({ result, x: { kind: "arc_length" }, y: load }), (x, y) => y - Math.sin(x)) < 0.002);
  assert.ok(worst(drawn({ result, x: { ...down, reversed: false }, y: load }), (x, y) => radius(-x, y)) < 0.002);
  const middle = { x: 1 - Math.cos(0.375 * Math.PI), y: Math.sin(0.375 * Math.PI) };
  assert.ok(distanceTo(drawn({ result: resultOf(plainBranch(kQuarters)), x: down, y: load }), middle) > 0.03, "straight lines");
});

test("a kink between rows next to one another stays sharp", () => {
  const bend = 1 + 1e-7;
  const kink: Known = { load: (s) => (s < bend ? [s * s, 2 * s] : [(2 - s) ** 2, 2 * s - 4]), down: (s) => [s, 1] };
  const points = drawn({ result: resultOf(branchOf(kink, [0, 1, bend, 2])), x: down, y: load });
  assert.ok(worst(points, (x, y) => y - kink.load(x)[0]) < 2e-4, String(worst(points, (x, y) => y - kink.load(x)[0])));
  assert.ok(Math.abs(Math.max(...points.map(({ y }) => y)) - 1) < 2e-4);
});

test("results without rates are drawn by straight lines without the points that nobody sees", () => {
  for (const name of kCases) {
    const { result } = readCase(name);
    if (result.branches.length === 0) continue;
    const input: PathInput = { result: { ...result, branches: result.branches.map(plainBranch) }, x: { kind: "arc_length" }, y: load };
    const chart = pathChart(input, size);
    const picture = pathFigure(input, size, chart);
    const lines = chart.curves.flatMap(({ vertices, stable }) => {
      const ends = [0, ...stable.flatMap((one, i) => (i > 0 && one !== stable[i - 1] ? [i] : [])), stable.length];
      const all = vertices.map(({ x, y }) => ({ x: place(chart.frame.x, x), y: place(chart.frame.y, y) }));
      return ends.slice(1).map((end, i) => all.slice(ends[i], end + 1)).filter((part) => part.length > 1);
    });
    assert.deepEqual(pathLines(picture).map((line) => line.attributes["d"]),
                     lines.map((part) => pathData(thinned(part).map((k) => must(part[k])))), name);
  }
});

test("20 000 rows with rates become few points, and no row is seen elsewhere", () => {
  const turns: Known = {
    load: (s) => [s * Math.sin(s), Math.sin(s) + s * Math.cos(s)], down: (s) => [s * Math.cos(s), Math.cos(s) - s * Math.sin(s)],
  };
  const input = { result: resultOf(branchOf(turns, steps(40, 20000))), x: down, y: load };
  const chart = pathChart(input, size);
  const [line] = pathLines(pathFigure(input, size, chart));
  assert.ok(String(must(line).attributes["d"]).split(/[LC]/).length < 1200);
  const points = pointsOf(must(line));
  must(chart.curves[0]).vertices.forEach(({ x, y }, i) => {
    if (i % 37 !== 0) return;
    const off = distanceTo(points, { x: place(chart.frame.x, x), y: place(chart.frame.y, y) });
    assert.ok(off < 0.31, `row ${i} is off by ${off}`);
  });
});

/** A half circle that loses stability at its top, its third row; a broken bifurcation lies beside the path. */
function losing(): PathResult {
  const point = must(readCase("ring").result.critical_points[0]);
  return {
    ...resultOf({ ...kQuarters, negative_eigenvalues: [0, 0, 1, 1, 1] }),
    critical_points: [
      { ...point, type: "broken_bifurcation", arc_length: 0.9, load_factor: 2, monitors: { crown: -0.1 } },
      { ...point, type: "limit_max", arc_length: 0.5 * Math.PI, load_factor: 1, monitors: { crown: -1 } },
    ],
  };
}

test("stability changes at the critical row, and a point beside the path does not bend it", () => {
  const input: PathInput = { result: losing(), x: down, y: load, domain: { x: [0, 2], y: [0, 2] } };
  const chart = pathChart(input, size);
  const lines = pathLines(pathFigure(input, size, chart)).map(pointsOf);
  assert.equal(lines.length, 2);
  const top = { x: place(chart.frame.x, 1), y: place(chart.frame.y, 1) };
  for (const end of [must(lines[0]).at(-1), must(lines[1])[0]]) assert.ok(distanceTo([top], must(end)) < 0.02);
  assert.ok(worst(drawn(input), (x, y) => Math.hypot(1 - x, y) - 1) < 0.002);
});

/** Whether a pixel is on the drawn path; straight lines between the rows would be 15 pixels away. */
function onPath(picture: Shape, pixel: Pixel): boolean {
  return Math.min(...pathLines(picture).map((line) => distanceTo(pointsOf(line), pixel))) < 0.5;
}

test("marks and the chosen point between rows lie on the drawn line", () => {
  const result: PathResult = {
    ...resultOf(kQuarters),
    contact_events: [{ ...must(readCase("ring").result.contact_events[0]), branch: 0, arc_length: 2, load_factor: Math.sin(2) }],
    summary: { softest: { ...must(readCase("bays").result.summary.softest), load_factor: 0.4 } },
  };
  const input = { result, x: down, y: load };
  const chart = pathChart(input, size);
  const picture = pathFigure(input, size, chart);
  assert.ok(Math.abs(must(softestPoint(result)).arc - Math.asin(0.4)) < 1e-3);
  const softest = { x: place(chart.frame.x, must(chart.softest).x), y: place(chart.frame.y, 0.4) };
  assert.ok(softestNear(chart, softest, 0.01) && onPath(picture, softest));
  const [event] = withClass(must(withClass(picture, "events")[0]), "event");
  assert.ok(onPath(picture, { x: Number(must(event).attributes["cx"]), y: Number(must(event).attributes["cy"]) }));
  const [ring] = withClass(chosenShape(chart, { branch: 0, index: 1, arc: 1.2 }), "chosen-ring");
  const at = { x: Number(must(ring).attributes["cx"]), y: Number(must(ring).attributes["cy"]) };
  assert.ok(onPath(picture, at) && Math.abs(valueAt(chart.frame.y, at.y) - Math.sin(1.2)) < 0.002);
});

/** A branch with a row that is not computed after each of its rows but the last. */
function spread(branch: Branch): Branch {
  const between = (list: readonly number[]): number[] =>
    list.flatMap((value, i) => (i + 1 < list.length ? [value, 0.5 * (value + must(list[i + 1]))] : [value]));
  const none = <T>(list: readonly T[]): (T | null)[] => list.flatMap((value, i) => (i + 1 < list.length ? [value, null] : [value]));
  const { frequencies, ...rest } = branch;
  return {
    ...rest, load_factor: between(branch.load_factor), arc_length: between(branch.arc_length),
    monitors: Object.fromEntries(Object.entries(branch.monitors).map(([id, values]) => [id, between(values)])),
    negative_eigenvalues: branch.negative_eigenvalues.flatMap((count, i, all) => (i + 1 < all.length ? [count, count] : [count])),
    stiffness_ratio: none(branch.stiffness_ratio), computed: branch.load_factor.map((_, i) => 2 * i),
    ...(frequencies ? { frequencies: none(frequencies) } : {}),
  };
}

test("rows that are not computed, or have no ratio, leave no gap in the line of the stiffness ratio", () => {
  const { result } = readCase("bays");
  const branch = plainBranch(must(result.branches[0]));
  const line = (one: Branch): Pixel[][] => {
    const input = { result: { ...result, branches: [one] }, x: load, y: load, stiffness: true };
    return withClass(must(withClass(pathFigure(input, size), "plot-lines")[0]), "ratio-line").flatMap(piecesOf);
  };
  const [before, after] = [line(branch), line(spread(branch))];
  assert.deepEqual([before.length, after], [1, before]);
  const partly = { ...branch, stiffness_ratio: branch.stiffness_ratio.map((ratio, i) => (i === 3 ? null : ratio)) };
  assert.deepEqual([line(partly).length, line(spread(partly)).length], [2, 1]);
});

test("rows that are not computed leave no gap in frequencies, and a computed row without them does", () => {
  const { result } = readCase("beck");
  const branch = plainBranch(must(result.branches[0]));
  const lines = (one: Branch): unknown[] => {
    const input = { result: { ...result, branches: [one] } };
    return pathLines(frequencyFigure(input, size)).map((node) => node.attributes["d"]);
  };
  assert.deepEqual(lines(spread(branch)), lines(branch));
  const gap = { ...branch, frequencies: must(branch.frequencies).map((one, i) => (i === 4 ? null : one)) };
  assert.equal(lines(spread(gap)).length, lines(gap).length);
  assert.ok(lines(gap).length > lines(branch).length);
  const [series] = frequencyChart({ result: { ...result, branches: [spread(branch)] } }, size).series;
  assert.deepEqual(must(series).rows.map(({ row }) => row), branch.load_factor.map((_, i) => 2 * i));
});

test("dots on request are the computed rows of every branch, and of a branch that does not tell, all rows", () => {
  const { result } = readCase("arch_branches");
  const plain = result.branches.map(plainBranch);
  const branches = plain.map((branch, i) => (i === 0 ? spread(branch) : branch));
  const input = { result: { ...result, branches }, x: { kind: "arc_length" } as const, y: load };
  assert.equal(withClass(pathFigure(input, size), "row").length, 0);
  const chart = pathChart(input, size);
  const picture = pathFigure({ ...input, points: true }, size, chart);
  const dots = withClass(picture, "row").map(({ attributes }) => [attributes["cx"], attributes["cy"]]);
  const hundredths = (value: number): number => Math.round(100 * value) / 100;
  const rows = plain.flatMap(({ arc_length: arcs, load_factor: loads }) => arcs.map((arc, i) =>
    [hundredths(place(chart.frame.x, arc)), hundredths(place(chart.frame.y, must(loads[i])))]));
  assert.deepEqual(dots, rows);
  assert.equal(withClass(picture, "row branch").length, rows.length - must(plain[0]).load_factor.length);
});

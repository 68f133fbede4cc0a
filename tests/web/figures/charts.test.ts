import assert from "node:assert/strict";
import { test } from "node:test";
import {
  bucklingFigure, columnLabel, errorsOf, failureText, nearestInSweep, nearestMode, sectionsChart, sectionsFigure, sectionsLocate, sweepLine,
  sweepLineChart, sweepMap, sweepMapChart, sweepMapLocate, type SectionsInput, type SweepMapInput, type Table,
} from "../../../web/src/figures/index";
import { makeScale, place, ticks, valueAt, widened } from "../../../web/src/figures/chart/axes";
import { bucklingFrame } from "../../../web/src/figures/chart/buckling";
import { contours } from "../../../web/src/figures/chart/contours";
import { bandLevels } from "../../../web/src/figures/chart/sweep_map";
import { formatNumber } from "../../../web/src/figures/numbers";
import { boxOf, must, piecesOf, pointsOf, readCase, readTable, textOf, textsOf, withClass } from "./support";

const size = { width: 560, height: 420 };
const kLoad = { column: "/summary/critical_load_factor" };

test("ticks are round and inside, on linear and logarithmic scales", () => {
  assert.deepEqual(ticks(makeScale(0, 1, 0, 400), 80), [0, 0.2, 0.4, 0.6, 0.8, 1]);
  assert.deepEqual(ticks(makeScale(-0.3, 0.3, 0, 300), 50), [-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3]);
  assert.deepEqual(ticks(makeScale(2, 2000, 0, 300, true), 80), [10, 100, 1000]);
  assert.deepEqual(ticks(makeScale(1, 100, 0, 500, true), 80), [1, 2, 5, 10, 20, 50, 100]);
  for (const value of ticks(makeScale(1e-4, 1, 0, 500, true), 80)) assert.ok(value >= 1e-4 && value <= 1);
  assert.deepEqual(ticks(makeScale(3, 3, 0, 100), 50), [3]);
});

test("scales turn back to the value", () => {
  for (const scale of [makeScale(-2, 7, 60, 500), makeScale(1e-3, 1e4, 400, 20, true)]) {
    for (const value of [scale.from, 1, 6.5, scale.to]) assert.ok(Math.abs(valueAt(scale, place(scale, value)) / value - 1) < 1e-9);
  }
});

test("ranges are never empty, and begin at zero where it is near", () => {
  assert.deepEqual(widened(0, 10), [0, 10.6]);
  assert.deepEqual(widened(3, 3), [1.5, 4.5]);
  assert.deepEqual(widened(0, 0), [-1, 1]);
  assert.deepEqual(widened(Infinity, -Infinity), [0, 1]);
  assert.equal(widened(90, 100)[0], 90 - 0.6);
  assert.equal(widened(1, 10)[0], 0);
  assert.equal(widened(-10, -1)[1], 0);
});

function sectionsOf(name: string, state = 0): SectionsInput {
  const { request, result } = readCase(name);
  return { model: request.model, state: must(result.states[state]) };
}

/** The state as earlier versions have it, without extremes between its places. */
function listed(input: SectionsInput): SectionsInput {
  const plain = <T extends object>(all: Record<string, T>) =>
    Object.fromEntries(Object.entries(all).map(([id, one]) => [id, { ...one, extremes: undefined }]));
  return { ...input, state: { ...input.state, members: plain(input.state.members), foundations: plain(input.state.foundations) } as typeof input.state };
}

test("sections show the largest and the smallest value of the state", () => {
  const input = listed(sectionsOf("ring"));
  const state = must(input.state.members["ring"]);
  const texts = textsOf(sectionsFigure(input, { width: 900, height: 160 }));
  const lists = { N: state.axial_force, Q: state.shear_force, M: state.bending_moment, r: must(input.state.foundations["soil"]).reaction };
  for (const [name, list] of Object.entries(lists)) {
    for (const value of [Math.max(...list), Math.min(...list)]) {
      if (Math.abs(value) < 0.03 * Math.max(...list.map(Math.abs))) continue;
      assert.ok(texts.includes(formatNumber(value)), `${name} ${formatNumber(value)}`);
    }
  }
});

test("sections show extremes between the places of the state, and without them what the state lists", () => {
  const input = sectionsOf("ring");
  const state = must(input.state.members["ring"]);
  const foundation = must(input.state.foundations["soil"]);
  const largest = (list: readonly number[]): number => Math.max(...list.map(Math.abs));
  const peaks = (list: readonly number[], s: readonly number[]) => ({
    min: { s: (must(s[2]) + must(s[3])) / 2, value: -2 * largest(list) }, max: { s: (must(s[4]) + must(s[5])) / 2, value: 3 * largest(list) },
  });
  const extremes = {
    axial_force: peaks(state.axial_force, state.s), shear_force: peaks(state.shear_force, state.s),
    bending_moment: peaks(state.bending_moment, state.s), displacement: { max: { s: 0, value: 1 } },
  };
  const changed = { ...input.state, members: { ring: { ...state, extremes } },
                    foundations: { soil: { ...foundation, extremes: peaks(foundation.reaction, foundation.s) } } };
  const texts = textsOf(sectionsFigure({ ...input, state: changed }, { width: 900, height: 160 }));
  for (const list of [state.axial_force, state.shear_force, state.bending_moment, foundation.reaction]) {
    assert.ok(texts.includes(formatNumber(3 * largest(list))) && texts.includes(formatNumber(-2 * largest(list))));
  }
});

test("positive values are drawn upwards from the zero line", () => {
  const input = sectionsOf("ring");
  const chart = sectionsChart(input, { width: 900, height: 160 });
  const picture = sectionsFigure(input, { width: 900, height: 160 }, chart);
  const panel = must(chart.panels.find((item) => item.quantity === "M"));
  const line = pointsOf(must(withClass(must(withClass(picture, "section-M")[0]), "section-line")[0]));
  const moments = must(input.state.members["ring"]).bending_moment;
  const end = must(line.at(-1));
  assert.ok(Math.abs(end.y - place(panel.y, must(moments.at(-1)))) < 0.01);
  assert.equal(must(moments.at(-1)) > 0, end.y < place(panel.y, 0));
});

test("what is rounding of larger forces is said to be zero", () => {
  const input = sectionsOf("pipe");
  const chart = sectionsChart(input, { width: 900, height: 160 });
  assert.deepEqual(chart.panels.map((panel) => panel.zero), [false, true, true, true, false]);
  const picture = sectionsFigure(input, { width: 900, height: 160 }, chart);
  assert.equal(withClass(must(withClass(picture, "section-Q")[0]), "section-line").length, 0);
});

test("pointing at a panel gives the member and s, one member after another", () => {
  const input = sectionsOf("pipe");
  const chart = sectionsChart(input, { width: 900, height: 160 });
  const panel = must(chart.panels[0]);
  const half = must(chart.members[0]).length;
  const found = must(sectionsLocate(chart, { x: place(panel.x, 1.25 * half), y: panel.y.end }));
  assert.equal(found.member, "left");
  assert.ok(Math.abs(found.s - 0.25 * half) < 1e-9 && found.quantity === "N");
  assert.equal(sectionsLocate(chart, { x: panel.x.end + 8, y: 80 }), null);
});

test("panels stay apart and inside for every size", () => {
  for (const [width, height] of [[900, 150], [560, 260], [350, 620], [300, 500]] as const) {
    const { panels } = sectionsChart(sectionsOf("ring"), { width, height });
    panels.forEach((a, i) => {
      assert.ok(a.x.start >= 0 && a.x.end <= width && a.y.end >= 0 && a.y.start <= height);
      assert.ok(a.y.start - a.y.end > 15, `${width}x${height}: ${a.y.start - a.y.end}`);
      for (const b of panels.slice(i + 1)) {
        assert.ok(a.x.end < b.x.start || b.x.end < a.x.start || a.y.start < b.y.end || b.y.start < a.y.end);
      }
    });
  }
});

test("values of a panel do not cover one another", () => {
  for (const [width, height] of [[900, 150], [560, 130], [350, 620]] as const) {
    for (const name of ["ring", "pile", "springs", "arch_outside"]) {
      const picture = sectionsFigure({ ...sectionsOf(name, 1 % readCase(name).result.states.length),
                                       cursor: { member: must(readCase(name).request.model.members[0]).id, s: 0.4 } }, { width, height });
      for (const panel of withClass(picture, "section")) {
        const boxes = [...withClass(panel, "section-value"), ...withClass(panel, "contact-text")].map(boxOf);
        boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) =>
          assert.ok(a.right <= b.left || b.right <= a.left || Math.abs(a.y - b.y) >= 11, `${name} ${JSON.stringify([a, b])}`)));
      }
    }
  }
});

test("lengths along a member have room between them, and the last one has its unit", () => {
  const whole = sectionsOf("pile");
  for (const factor of [1, 7, 50, 600, 9e4]) {
    const state = JSON.parse(JSON.stringify(whole.state), (key, value: unknown) =>
      key === "s" ? (value as number[]).map((s) => factor * s) : value) as typeof whole.state;
    for (const width of [260, 420, 560, 900]) {
      const picture = sectionsFigure({ ...whole, state }, { width, height: 150 });
      for (const panel of withClass(picture, "section")) {
        const texts = withClass(panel, "tick").filter((one) => one.name === "text");
        assert.ok(textOf(must(texts[texts.length - 1])).endsWith("m"), textOf(must(texts[texts.length - 1])));
        const boxes = texts.map(boxOf);
        boxes.slice(1).forEach((box, j) => assert.ok(box.left >= must(boxes[j]).right, `${factor} ${width} ${texts.map(textOf).join("|")}`));
      }
    }
  }
});

test("a cursor is on the curve", () => {
  const input = { ...sectionsOf("ring"), cursor: { member: "ring", s: 20 } };
  const picture = sectionsFigure(input, { width: 900, height: 160 });
  const panel = must(withClass(picture, "section-N")[0]);
  const dot = must(withClass(panel, "cursor-dot")[0]);
  const line = pointsOf(must(withClass(panel, "section-line")[0]));
  const x = Number(dot.attributes["cx"]);
  const i = line.findIndex((point) => point.x >= x);
  const low = Math.min(must(line[i - 1]).y, must(line[i]).y);
  const high = Math.max(must(line[i - 1]).y, must(line[i]).y);
  assert.ok(Number(dot.attributes["cy"]) >= low - 0.6 && Number(dot.attributes["cy"]) <= high + 0.6);
});

test("columns are called what people call them", () => {
  assert.equal(columnLabel(kLoad), "critical load factor");
  assert.equal(columnLabel({ column: "/critical_points/1/monitors/crown" }), "crown at critical point 2");
  assert.equal(columnLabel({ column: "/buckling/load_factors/0" }), "buckling load 1");
  assert.equal(columnLabel({ column: "k", label: "soil" }), "soil");
});

test("failed points of a sweep are crosses on the axis with their reason", () => {
  const table = readTable("map");
  const errors = errorsOf(table);
  assert.equal(errors.filter((error) => error !== null).length, 7);
  assert.equal(failureText(errors), "7 failed: 7 wrong_request");
  const input = { table, x: { column: "k", log: true }, y: kLoad, series: "EI" };
  const chart = sweepLineChart(input, size);
  const picture = sweepLine(input, size, chart);
  const crosses = withClass(must(withClass(picture, "failed-points")[0]), "failed");
  assert.equal(crosses.length, 7);
  assert.ok(crosses.every((node) => node.children.some((child) => typeof child !== "string" && child.name === "title")));
  assert.ok(textsOf(picture).includes("7 failed: 7 wrong_request"));
  const failed = must(chart.failed[2]);
  const found = must(nearestInSweep(chart, { x: place(chart.frame.x, failed.x), y: chart.frame.y.start - 5 }));
  assert.equal(found.row, failed.row);
});

test("a line for each value of the second parameter, in the order of the first", () => {
  const table = readTable("map");
  const chart = sweepLineChart({ table, x: { column: "k", log: true }, y: kLoad, series: "EI" }, size);
  assert.deepEqual(chart.lines.map((item) => item.name), ["EI = −1", "EI = 1", "EI = 1.5", "EI = 2", "EI = 3"]);
  for (const { spots } of chart.lines) spots.slice(1).forEach((spot, i) => assert.ok(spot.x > must(spots[i]).x));
  const spot = must(chart.lines[2]?.spots[3]);
  assert.equal(spot.y, table.rows[spot.row]?.[2]);
  const found = must(nearestInSweep(chart, { x: place(chart.frame.x, spot.x) + 1, y: place(chart.frame.y, spot.y) - 1 }));
  assert.equal(found.row, spot.row);
});

/// Members of a table that no program has computed.
const unmade = { kind: "table", program: null, request_sha256: null } as const;

test("names instead of numbers have their places on an axis", () => {
  const table: Table = {
    ...unmade,
    columns: ["feet", "/summary/critical_load_factor", "error"], points: [0, 1, 2], links: { request: "", job: "" },
    rows: [["pinned", 3, null], ["clamped", 5, null], ["free", null, { code: "mechanism", detail: "it moves" }]],
  };
  const texts = textsOf(sweepLine({ table, x: { column: "feet" }, y: kLoad }, size));
  for (const name of ["pinned", "clamped", "free"]) assert.ok(texts.includes(name), name);
});

const map: SweepMapInput = { table: readTable("map"), x: { column: "k", log: true }, y: { column: "EI" }, value: kLoad };

test("every cell of a map is coloured by its value, failed ones are crossed out", () => {
  const chart = sweepMapChart(map, size);
  assert.equal(chart.cells.length, 35);
  const picture = sweepMap(map, size, chart);
  const covered = withClass(picture, "band").filter((node) => node.name === "path").flatMap((node) => piecesOf(node));
  const area = covered.reduce((sum, piece) => {
    const x = piece.map((p) => p.x);
    const y = piece.map((p) => p.y);
    return sum + (Math.max(...x) - Math.min(...x)) * (Math.max(...y) - Math.min(...y));
  }, 0);
  const whole = (chart.frame.x.end - chart.frame.x.start) * (chart.frame.y.start - chart.frame.y.end);
  assert.ok(Math.abs(area / whole - 1) < 1e-3, String(area / whole));
  assert.equal(piecesOf(must(withClass(picture, "failed")[0])).length, 14, "two strokes a cross");
  assert.equal(withClass(picture, "no-value").length, 1);
});

test("pointing at a cell gives its row", () => {
  const chart = sweepMapChart(map, size);
  for (const spot of chart.spots) {
    const found = must(sweepMapLocate(chart, { x: place(chart.frame.x, spot.x), y: place(chart.frame.y, spot.y) }));
    assert.equal(found.row, spot.row);
  }
  assert.equal(sweepMapLocate(chart, { x: 3, y: 3 }), null);
});

test("bands lie between round values, and no more of them than colours", () => {
  for (const [low, high] of [[0, 1], [18.3, 412], [-7, 2], [1e-8, 3e-8], [99.99, 100.01]] as const) {
    const levels = bandLevels(low, high);
    assert.ok(levels.length >= 3 && levels.length <= 11, `${low} ${high}: ${levels.join()}`);
    assert.ok(levels.every((level) => level > low && level < high));
  }
  assert.deepEqual(bandLevels(3, 3000, true), [5, 10, 20, 50, 100, 200, 500, 1000, 2000]);
  assert.deepEqual(bandLevels(Infinity, -Infinity), []);
});

test("contour lines are where the level is, also around a saddle", () => {
  const n = 41;
  const ticksOf = Array.from({ length: n }, (_, i) => -2 + i / 10);
  const grid = (f: (x: number, y: number) => number) =>
    ({ x: ticksOf, y: ticksOf, values: ticksOf.flatMap((y) => ticksOf.map((x) => f(x, y))) });
  const [circle] = contours(grid((x, y) => Math.hypot(x, y)), [1.234]);
  assert.ok(must(circle).length > 40);
  for (const point of must(circle).flat()) assert.ok(Math.abs(Math.hypot(point.x, point.y) - 1.234) < 0.01);
  // between four corners of the grid: the middle of the saddle is in a cell, and tells which branches are one
  const saddle = contours(grid((x, y) => (x - 0.05) * (y - 0.05) + 1e-5), [-0.001, 0.001]);
  for (const [a, b] of saddle.flatMap((pieces) => pieces)) {
    assert.ok(Math.abs((a.x - 0.05) * (a.y - 0.05)) < 0.004, "on the hyperbola");
    assert.ok((a.x - 0.05) * (b.x - 0.05) > 0 && (a.y - 0.05) * (b.y - 0.05) > 0, "a piece stays on its branch");
  }
  const hole = grid((x, y) => (Math.hypot(x, y) < 0.5 ? Number.NaN : x));
  for (const point of must(contours(hole, [0])[0]).flat()) assert.ok(Math.hypot(point.x, point.y) > 0.4);
});

test("numbers at the axes of a map leave room for one another and for its name", () => {
  const [kColumn, eiColumn, loadColumn] = ["k", "EI", "/summary/critical_load_factor"].map((name) => map.table.columns.indexOf(name));
  for (const [k, ei] of [[1, 1], [1.2345678e7, 1], [7.654321e5, 3.14159e8], [1.3e-6, 2.71828e-4]] as const) {
    const rows = map.table.rows.map((row) => row.map((cell, column) =>
      typeof cell !== "number" ? cell : column === kColumn ? k * cell : column === eiColumn ? ei * cell : cell));
    for (const [width, height] of [[300, 260], [560, 420], [900, 400]] as const) {
      const picture = sweepMap({ ...map, table: { ...map.table, rows } }, { width, height });
      const boxes = withClass(must(withClass(picture, "frame")[0]), "tick").map(boxOf);
      assert.ok(boxes.length >= 2);
      boxes.forEach((a, n) => boxes.slice(n + 1).forEach((b) =>
        assert.ok(a.right <= b.left || b.right <= a.left || Math.abs(a.y - b.y) >= 11, `${k} ${width} ${JSON.stringify([a, b])}`)));
      assert.ok(boxes.every(({ left }) => left >= 18), "the name of the upright axis is not covered");
    }
  }
  const emptied = map.table.rows.map((row, n) => (n === 3 ? row.map((cell, column) => (column === loadColumn ? null : cell)) : row));
  const texts = textsOf(sweepMap({ ...map, table: { ...map.table, rows: emptied } }, size));
  assert.ok(texts.includes("1 without a value"), texts.join("|"));
  assert.ok(!textsOf(sweepMap(map, size)).some((text) => text.includes("without a value")));
});

test("points that are no grid are dots", () => {
  const rows = Array.from({ length: 30 }, (_, i) => [Math.sin(i) * 5, Math.cos(i * 1.7) * 3, i, null]);
  const table: Table = { ...unmade, columns: ["a", "b", "c", "error"], rows, points: rows.map((_, i) => i), links: { request: "", job: "" } };
  const input = { table, x: { column: "a" }, y: { column: "b" }, value: { column: "c" } };
  const chart = sweepMapChart(input, size);
  assert.equal(withClass(sweepMap(input, size, chart), "dot").length, 30);
  const spot = must(chart.spots[11]);
  assert.equal(must(sweepMapLocate(chart, { x: place(chart.frame.x, spot.x) + 1, y: place(chart.frame.y, spot.y) })).row, spot.row);
});

test("buckling loads of the opposite actions hang below zero", () => {
  const buckling = { load_factors: [-2, 3], error_estimates: [null, null], modes: [] };
  const input = { buckling };
  const dots = withClass(bucklingFigure(input, size), "stem-dot").map((dot) => Number(dot.attributes["cy"]));
  const zero = place(bucklingFrame(input, size).y, 0);
  assert.ok(must(dots[0]) > zero && must(dots[1]) < zero);
  assert.ok(must(dots[0]) < size.height);
});

test("buckling loads are stems from the lowest on", () => {
  const buckling = must(readCase("portal").result.buckling);
  const picture = bucklingFigure({ buckling, chosen: 1 }, size);
  assert.equal(withClass(picture, "stem").length, 2);
  assert.ok(textsOf(picture).includes(formatNumber(must(buckling.load_factors[0]), 5)));
  assert.equal(nearestMode({ buckling }, size, { x: 100, y: 50 }), 0);
  assert.equal(nearestMode({ buckling }, size, { x: 500, y: 50 }), 1);
  assert.equal(nearestMode({ buckling: { load_factors: [], error_estimates: [], modes: [] } }, size, { x: 1, y: 1 }), null);
});

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  criticalNear, defaultQuantities, hasStiffness, nearestOnPath, pathChart, pathFigure, quantityLabel, rowsOfStates, softestNear,
  softestPoint, stateNear, walk, type PathInput, type PathQuantity, type Pixel,
} from "../../../web/src/figures/index";
import { place } from "../../../web/src/figures/chart/axes";
import { thinned } from "../../../web/src/figures/chart/thin";
import { boxOf, distanceTo, must, piecesOf, plainBranch, pointsOf, readCase, shapesOf, textOf, textsOf, withClass } from "./support";

const size = { width: 520, height: 440 };
const load: PathQuantity = { kind: "load_factor" };

function inputOf(name: string): PathInput {
  const { request, result } = readCase(name);
  return { result, ...defaultQuantities(result), monitors: request.model.monitors, units: request.model.units };
}

test("the line is solid up to the limit point and dashed beyond it", () => {
  const input = inputOf("ring");
  const chart = pathChart(input, size);
  const picture = pathFigure(input, size, chart);
  const lines = withClass(picture, "path").filter((node) => node.name === "path");
  assert.equal(lines.length, 2);
  const [stable, unstable] = lines.map(pointsOf);
  const point = must(input.result.critical_points[0]);
  const limit = { x: place(chart.frame.x, -must(point.monitors["top"])), y: place(chart.frame.y, point.load_factor) };
  for (const end of [must(stable).at(-1), must(unstable)[0]]) {
    assert.ok(Math.hypot(must(end).x - limit.x, must(end).y - limit.y) < 0.02, "both end at the limit point");
  }
  assert.ok(String(must(lines[0]).attributes["class"]).includes("path stable"));
  assert.ok(String(must(lines[1]).attributes["class"]).includes("path unstable"));
});

test("rows on both sides of a point tell stability, also where more eigenvalues are negative", () => {
  const input = inputOf("arch_branches");
  const chart = pathChart(input, size);
  for (const curve of chart.curves) {
    const branch = must(input.result.branches[curve.branch]);
    curve.stable.forEach((stable, i) => {
      const rows = [curve.vertices[i]?.row, curve.vertices[i + 1]?.row].filter((row) => typeof row === "number");
      const critical = [curve.vertices[i]?.negative, curve.vertices[i + 1]?.negative].some((n) => n === null);
      const negative = Math.max(...rows.map((row) => must(branch.negative_eigenvalues[row])));
      if (!critical) assert.equal(stable, negative === 0);
    });
  }
  assert.ok(withClass(pathFigure(input, size), "branch").length > 0);
});

test("where nobody counted eigenvalues nothing is said to be stable", () => {
  const input = inputOf("springs");
  const table = must(input.result.static);
  const counts = [0, 0, null, null];
  const picture = pathFigure({ ...input, result: { ...input.result, static: { ...table, negative_eigenvalues: counts } } }, size);
  const lines = withClass(picture, "path").filter((node) => node.name === "path").map((node) => node.attributes["class"]);
  assert.deepEqual(lines, ["path stable", "path untold"]);
  assert.ok(textsOf(picture).includes("stability not counted"));
});

test("axes show what they say: a reversed monitor, its sense and its unit; another monitor", () => {
  const { request } = readCase("arch_outside");
  const crown: PathQuantity = { kind: "monitor", id: "crown", reversed: true };
  assert.equal(quantityLabel(crown, request.model.monitors, request.model.units), "crown, down (m)");
  assert.equal(quantityLabel({ ...crown, reversed: false }, request.model.monitors, {}), "crown, up");
  assert.equal(quantityLabel({ ...crown, id: "gone" }, request.model.monitors), "−gone");
  const input = inputOf("arch_outside");
  assert.deepEqual(input.x, crown);
  const chart = pathChart({ ...input, x: load, y: crown }, size);
  const vertex = must(chart.curves[0]?.vertices[10]);
  assert.equal(vertex.x, input.result.branches[0]?.load_factor[must(vertex.row)]);
  assert.equal(vertex.y, -must(input.result.branches[0]?.monitors["crown"]?.[must(vertex.row)]));
});

test("the legend has what occurs and nothing else", () => {
  const legend = (name: string) => textsOf(must(withClass(pathFigure(inputOf(name), size), "legend")[0]));
  assert.deepEqual(legend("pile"), ["stable"]);
  assert.deepEqual(legend("ring"), ["stable", "unstable", "limit point", "contact made"]);
  assert.ok(legend("arch_branches").includes("bifurcation") && legend("arch_branches").includes("branch"));
});

test("marks differ in form: triangles for limit points, diamonds for bifurcations, dots for contact", () => {
  const picture = pathFigure(inputOf("arch_outside"), size);
  const marks = must(withClass(picture, "marks")[0]);
  const kinds = inputOf("arch_outside").result.critical_points.map((point) => point.type);
  assert.equal(withClass(marks, "limit").length, kinds.filter((kind) => kind.startsWith("limit")).length);
  assert.equal(withClass(marks, "bifurcation").length, kinds.filter((kind) => kind === "bifurcation").length);
  assert.ok(withClass(marks, "limit").every((node) => pointsOf(node).length === 3));
  assert.ok(withClass(marks, "bifurcation").every((node) => pointsOf(node).length === 4));
  assert.equal(withClass(must(withClass(picture, "events")[0]), "event").length, inputOf("arch_outside").result.contact_events.length);
});

test("a point that no finer mesh confirms says so", () => {
  const input = inputOf("ring");
  const point = { ...must(input.result.critical_points[0]), confirmed: false };
  const texts = textsOf(pathFigure({ ...input, result: { ...input.result, critical_points: [point] } }, size));
  assert.ok(texts.some((text) => text.endsWith("limit point, not confirmed")));
});

test("labels of points do not cover one another, and the first is always there", () => {
  for (const name of ["arch_branches", "arch_outside", "bays", "ring"]) {
    for (const [width, height] of [[520, 440], [390, 360], [300, 260], [900, 300]] as const) {
      const picture = pathFigure(inputOf(name), { width, height });
      const labels = withClass(picture, "mark-label");
      const first = must(inputOf(name).result.critical_points[0]).load_factor.toPrecision(4);
      assert.ok(labels.some((node) => textOf(node).startsWith(first)), `${name} ${width}: the first point has its label`);
      const boxes = labels.map(boxOf);
      boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) => {
        const apart = a.right <= b.left || b.right <= a.left || Math.abs(a.y - b.y) >= 11;
        assert.ok(apart, `${name} ${width}x${height}: ${JSON.stringify([a, b])}`);
      }));
      assert.ok(boxes.every((box) => box.left >= -1 && box.right <= width + 1));
    }
  }
});

/** A path of many points that winds: nothing to thin out by eye, and far more points than pixels. */
function winding(count: number): Pixel[] {
  return Array.from({ length: count }, (_, i) => {
    const t = (i / count) * 12 * Math.PI;
    return { x: 250 + (20 + 15 * t * 0.3) * Math.cos(t), y: 200 + (20 + 15 * t * 0.3) * Math.sin(t * 1.01) };
  });
}

test("20 000 points become few, and no point is seen elsewhere", () => {
  const points = winding(20000);
  const kept = thinned(points).map((i) => must(points[i]));
  assert.ok(kept.length < 1200, String(kept.length));
  for (let i = 0; i < points.length; i += 7) {
    assert.ok(distanceTo(kept, must(points[i])) <= 0.2501, `point ${i} is off by ${distanceTo(kept, must(points[i]))}`);
  }
  assert.deepEqual([kept[0], kept.at(-1)], [points[0], points.at(-1)]);
});

test("thinning keeps turns back on the same line, single points and jumps", () => {
  const back = [0, 5, 10, 4, 12].map((x) => ({ x, y: 0 }));
  assert.deepEqual(thinned(back), [0, 2, 3, 4]);
  assert.deepEqual(thinned([{ x: 1, y: 1 }]), [0]);
  assert.deepEqual(thinned([]), []);
  const noise = Array.from({ length: 1000 }, (_, i) => ({ x: Math.sin(i * 12.9898) * 0.05, y: Math.cos(i * 78.233) * 0.05 }));
  assert.ok(thinned(noise).length <= 3);
});

test("pointing finds the nearest row, and the critical point within reach", () => {
  const input = inputOf("arch_outside");
  const chart = pathChart(input, size);
  const curve = must(chart.curves[0]);
  for (const vertex of curve.vertices.filter((item) => item.row !== null)) {
    const found = must(nearestOnPath(chart, { x: place(chart.frame.x, vertex.x) + 0.01, y: place(chart.frame.y, vertex.y) }));
    assert.ok(found.distance <= 0.0101);
    assert.ok(found.index === vertex.row || found.distance < 0.01);
  }
  const mark = must(chart.marks[1]);
  const near = { x: place(chart.frame.x, mark.x) + 4, y: place(chart.frame.y, mark.y) - 4 };
  assert.equal(must(criticalNear(chart, near)).number, mark.number);
  assert.equal(criticalNear(chart, { x: near.x + 400, y: near.y }), null);
});

test("the chosen row has its ring", () => {
  const input = { ...inputOf("ring"), chosen: { branch: 0, index: 12 } };
  const chart = pathChart(input, size);
  const ring = must(withClass(pathFigure(input, size, chart), "chosen-ring")[0]);
  assert.ok(Math.abs(Number(ring.attributes["cy"]) - place(chart.frame.y, must(input.result.branches[0]?.load_factor[12]))) < 0.01);
  assert.equal(withClass(pathFigure({ ...input, chosen: { branch: 7, index: 0 } }, size), "chosen-ring").length, 0);
});

test("states are found on their path: the monitor's value in the state is that of the row", () => {
  const { result, request } = readCase("arch_outside");
  const rows = rowsOfStates(result);
  assert.equal(rows.length, result.states.length);
  const crown = must(request.model.monitors?.[0]);
  assert.equal(crown.component, "y");
  result.states.forEach((state, number) => {
    const row = must(rows[number], `row of state ${number}`);
    const v = must(state.members["arch"]?.v[7]);  // 15 points: the crown is the eighth
    const path = must(result.branches[row.branch]?.monitors["crown"]?.[row.index]);
    assert.ok(Math.abs(v - path) < 1e-9, `state ${number}: ${v} and ${path}`);
  });
  const between = must(rows[3]);
  assert.equal(stateNear(rows, between), 3);
  assert.equal(stateNear(rows, { branch: 9, index: 0 }), null);
});

test("walking stops at the ends, and goes from a branch back to where it left its parent", () => {
  const { result } = readCase("arch_branches");
  const last = must(result.branches[0]).load_factor.length - 1;
  assert.deepEqual(walk(result, { branch: 0, index: 0 }, -1), { branch: 0, index: 0 });
  assert.deepEqual(walk(result, { branch: 0, index: last - 1 }, 5), { branch: 0, index: last });
  assert.deepEqual(walk(result, { branch: 0, index: 3 }, 1), { branch: 0, index: 4 });
  const parent = walk(result, { branch: 1, index: 0 }, -1);
  assert.equal(parent.branch, 0);
  const from = must(result.branches[0]?.load_factor[parent.index]);
  assert.ok(Math.abs(from - must(result.branches[1]?.load_factor[0])) < 1e-6 * Math.abs(from), String(from));
});

test("shadows are there with their names, under the path", () => {
  const input = inputOf("ring");
  const shadows = [{ label: "before: k = 3000", result: input.result, kind: "earlier" as const }];
  const picture = pathFigure({ ...input, shadows }, size);
  assert.ok(withClass(picture, "shadow earlier").length >= 2);
  assert.ok(textsOf(picture).includes("before: k = 3000"));
  const order = [...shapesOf(picture)].filter((node) => node.name === "path").map((node) => String(node.attributes["class"]));
  assert.ok(order.findIndex((name) => name.startsWith("shadow")) < order.findIndex((name) => name.startsWith("path")));
});

test("a domain shows its part, and nothing outside of the plot", () => {
  const input = { ...inputOf("ring"), domain: { x: [0, 1] as const, y: [0, 10] as const } };
  const picture = pathFigure(input, size);
  const plot = must(withClass(picture, "plot-lines")[0]);
  assert.equal(plot.name, "svg");
  assert.equal(plot.attributes["overflow"], "hidden");
  assert.equal(withClass(picture, "mark-label").length, 0, "the limit point is above");
});

/** The points of the second curve in the plot, without that of the legend. */
function ratioPieces(picture: ReturnType<typeof pathFigure>): Pixel[][] {
  return withClass(picture, "ratio-line").filter((node) => node.name === "path").flatMap(piecesOf);
}

test("the stiffness ratio is read at its load, from 1 at the right to 0 at the left, with its minimum at the softest point", () => {
  const input = inputOf("bays");
  const chart = pathChart(input, size);
  const { softest } = input.result.summary as { softest: { load_factor: number; stiffness_ratio: number } };
  const [points = [], ...others] = ratioPieces(pathFigure(input, size, chart));
  assert.equal(others.length, 0);
  const across = (ratio: number) => chart.frame.x.start + ratio * (chart.frame.x.end - chart.frame.x.start);
  const expected = [[across(1), 0], [across(0), must(input.result.critical_points[0]).load_factor]] as const;
  [points[0], points.at(-1)].forEach((point, i) => {
    assert.ok(Math.abs(must(point).x - must(expected[i])[0]) < 0.02, `end ${i}`);
    assert.ok(Math.abs(must(point).y - place(chart.frame.y, must(expected[i])[1])) < 0.02, `end ${i}`);
  });
  const lowest = { x: across(softest.stiffness_ratio), y: place(chart.frame.y, softest.load_factor) };
  assert.ok(distanceTo(points, lowest) < 0.3, "the line goes through the softest point");
  const branch = must(input.result.branches[0]);
  branch.load_factor.forEach((value, i) => {
    const ratio = branch.stiffness_ratio[i];
    if (ratio == null) return;
    assert.ok(distanceTo(points, { x: across(ratio), y: place(chart.frame.y, value) }) < 0.3, `row ${i}`);
  });
});

test("the softest point is a hollow square on the path with its load and ratio, and is pointed at", () => {
  const input = inputOf("bays");
  for (const x of [input.x, load, { kind: "arc_length" } as const]) {
    const y = x.kind === "load_factor" ? input.x : load;
    const chart = pathChart({ ...input, x, y }, size);
    const picture = pathFigure({ ...input, x, y }, size, chart);
    const square = pointsOf(must(withClass(must(withClass(picture, "softest-mark")[0]), "softest")[0]));
    assert.equal(square.length, 4);
    const middle = { x: (must(square[0]).x + must(square[2]).x) / 2, y: (must(square[0]).y + must(square[2]).y) / 2 };
    const lines = withClass(picture, "path").filter((node) => node.name === "path").map(pointsOf);
    assert.ok(Math.min(...lines.map((points) => distanceTo(points, middle))) < 0.3, `${x.kind}: on the path`);
    const loads = x.kind === "load_factor" ? [middle.x, place(chart.frame.x, 109.91323822748286)]
      : [middle.y, place(chart.frame.y, 109.91323822748286)];
    assert.ok(Math.abs(must(loads[0]) - must(loads[1])) < 0.02, `${x.kind}: at its load`);
    assert.ok(softestNear(chart, { x: middle.x + 4, y: middle.y - 4 }) && !softestNear(chart, { x: middle.x + 40, y: middle.y }));
    assert.ok(textsOf(picture).some((text) => /^109\.91\u00a0softest, ratio 0\.03(99|98)$/.test(text)), x.kind);
  }
});

test("where the load goes across the ratio goes upward, with its scale at the right", () => {
  const input = { ...inputOf("bays"), x: load, y: inputOf("bays").x };
  const chart = pathChart(input, size);
  const picture = pathFigure(input, size, chart);
  const points = ratioPieces(picture).flat();
  assert.ok(Math.abs(must(points[0]).y - chart.frame.y.end) < 0.02 && Math.abs(must(points.at(-1)).y - chart.frame.y.start) < 0.02);
  const scale = must(withClass(picture, "ratio-scale")[0]);
  assert.deepEqual(textsOf(scale), ["0", "0.1", "0.5", "1"]);
  assert.ok(withClass(scale, "tick").every((node) => Number(node.attributes["x"]) > chart.frame.x.end && boxOf(node).right <= size.width));
  assert.ok(textsOf(picture).includes("stiffness ratio (0 to 1 upward)"));
});

test("a path that loses stability without a softest point shows no ratio until it is asked for, and ends it there", () => {
  const input = inputOf("arch_outside");
  assert.equal(softestPoint(input.result), null);
  const plain = pathFigure(input, size);
  assert.equal(withClass(plain, "ratio-line").length + withClass(plain, "softest").length + withClass(plain, "ratio-scale").length, 0);
  const chart = pathChart({ ...input, stiffness: true }, size);
  const picture = pathFigure({ ...input, stiffness: true }, size, chart);
  const points = ratioPieces(picture).flat();
  const first = must(input.result.critical_points[0]).load_factor;
  assert.ok(Math.abs(must(points.at(-1)).y - place(chart.frame.y, first)) < 0.02);
  assert.ok(Math.abs(must(points.at(-1)).x - chart.frame.x.start) < 0.02);
  assert.ok(textsOf(picture).includes("stiffness ratio (0 to 1 across)"));
  assert.equal(withClass(picture, "softest").length, 0);
  assert.equal(withClass(pathFigure({ ...inputOf("bays"), stiffness: false }, size), "ratio-line").length, 0);
});

test("rows whose ratio is not known are gaps in its line, where the branch does not tell which rows are computed", () => {
  const input = inputOf("bays");
  const branch = plainBranch(must(input.result.branches[0]));
  const last = branch.stiffness_ratio.length - 3;
  const ratios = branch.stiffness_ratio.map((ratio, i) => (i === 3 || i === last ? null : ratio));
  const pieces = ratioPieces(pathFigure({ ...input, result: { ...input.result, branches: [{ ...branch, stiffness_ratio: ratios }] } }, size));
  assert.equal(pieces.length, 3);
  const none = { ...input.result, branches: [{ ...branch, stiffness_ratio: ratios.map(() => null) }] };
  assert.equal(hasStiffness(none), false);
  assert.equal(withClass(pathFigure({ ...input, result: none, stiffness: true }, size), "ratio-line").length, 0);
});

test("a static analysis shows the critical point that it ended before, and no ratio", () => {
  const input = inputOf("springs");
  const [id = ""] = Object.keys(must(input.result.static).monitors);
  const point = {
    ...must(inputOf("ring").result.critical_points[0]), load_factor: 1.5 * Math.max(...must(input.result.static).load_factor),
    monitors: { [id]: 2 * Math.max(...must(must(input.result.static).monitors[id])) },
  };
  const result = { ...input.result, critical_points: [point] };
  const chart = pathChart({ ...input, result, stiffness: true }, size);
  const picture = pathFigure({ ...input, result, stiffness: true }, size, chart);
  const mark = must(pointsOf(must(withClass(must(withClass(picture, "marks")[0]), "limit")[0]))[0]);
  assert.ok(mark.y > chart.frame.y.end - 8 && mark.x < chart.frame.x.end);
  assert.equal(withClass(picture, "ratio-line").length, 0);
  const counted = pathFigure({ ...input, result, x: { kind: "arc_length" } }, size);
  assert.equal(withClass(counted, "limit").filter((node) => pointsOf(node).length === 3).length, 1, "only that of the legend");
});

test("results without a path say so; a static analysis is a line with its rows", () => {
  assert.ok(textsOf(pathFigure(inputOf("pipe"), size)).some((text) => text.startsWith("no path")));
  const picture = pathFigure(inputOf("springs"), size);
  assert.equal(withClass(picture, "row").length, 4);
  const empty: PathInput = { result: { branches: [], critical_points: [], contact_events: [] }, x: load, y: load };
  assert.ok(textsOf(pathFigure(empty, size)).some((text) => text.startsWith("no path")));
});

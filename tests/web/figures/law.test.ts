import assert from "node:assert/strict";
import { test } from "node:test";
import { lawChart, lawFigure, lawTable, type LawInput } from "../../../web/src/figures/index";
import { place } from "../../../web/src/figures/chart/axes";
import { drawnLaw } from "../../../web/src/figures/chart/law";
import { interpolate } from "../../../web/src/figures/geometry";
import { reactionCurve } from "../../../web/src/figures/reaction";
import { boxOf, distanceTo, must, pointsOf, readCase, textsOf, withClass } from "./support";

const size = { width: 246, height: 210 };  // as in the form
const { request, result } = readCase("laws");
const units = request.model.units;

function lawOf(list: LawInput["list"], id: string, changed: Record<string, unknown> = {}): LawInput {
  const support = must((request.model[list] ?? []).find((item) => item.id === id), id);
  return { list, support: { ...support, ...changed }, units };
}

function near(value: number, expected: number, scale: number, what: string): void {
  assert.ok(Math.abs(value - expected) < 1e-9 * scale, `${what}: ${value}, not ${expected}`);
}

/** The reaction of a support at a displacement, by what its chart is drawn from. */
function reaction(input: LawInput, fraction: number, w: number): number {
  const law = must(drawnLaw(input));
  const curve = must(reactionCurve(input.support["law"], fraction));
  const sense = law.senses.find((one) => one * w > law.gap);
  return sense === undefined ? 0 : sense * curve.reaction(sense * w - law.gap);
}

test("forces that the solver found in springs are on the curves of their laws", () => {
  const springs = must(request.model.springs);
  const acting = new Set<string>();
  for (const state of result.states) {
    for (const { id } of springs) {
      const { displacement, force } = must(state.springs[id]);
      near(reaction(lawOf("springs", id), 0, displacement), force, 4, `${id} at ${displacement}`);
      if (force !== 0) acting.add(id);
    }
  }
  assert.equal(acting.size, springs.length, "every spring acts in some state");
});

test("reactions that the solver found along members are on the curves of their depth", () => {
  const length = 4;
  let compared = 0;
  for (const state of result.states) {
    for (const { id, member } of must(request.model.foundations)) {
      const found = must(state.foundations[id]);
      const along = must(state.members[member]);
      const displacements = id === "shaft" ? along.u : along.v.map((v) => (id === "layers" ? -v : v));
      found.s.forEach((s, i) => {
        if (!along.s.some((one) => Math.abs(one - s) < 1e-9)) return;
        const w = interpolate(along.s, displacements, s);
        near(reaction(lawOf("foundations", id), s / length, w), must(found.reaction[i]), 4, `${id} at s = ${s}, w = ${w}`);
        ++compared;
      });
    }
  }
  assert.equal(compared, result.states.length * (3 + 5 + 5));
});

test("the line on the chart is the curve, in both senses or from the gap on", () => {
  for (const { id } of must(request.model.springs)) {
    const input = lawOf("springs", id);
    const chart = must(lawChart(input, size));
    const { x, y } = chart.frame;
    const line = pointsOf(must(withClass(lawFigure(input, size, chart), "series-line")[0]));
    const bilateral = input.support["reaction"] === undefined;
    assert.equal(bilateral, Math.abs(x.from + x.to) < 1e-12, id);
    for (let i = 0; i <= 400; ++i) {
      const w = x.from + (i / 400) * (x.to - x.from);
      const pixel = { x: place(x, w), y: place(y, reaction(input, 0, w)) };
      assert.ok(distanceTo(line, pixel) < 0.6, `${id} at ${w}: ${distanceTo(line, pixel)}`);
    }
  }
});

test("a power law is bounded by its first stiffness and by its capacity", () => {
  const law = { type: "power", stiffness: 1000, capacity: 3, reference: 0.02, exponent: 0.5 };
  const curve = must(reactionCurve(law, 0));
  const [meeting = 0, end = 0] = curve.ends;
  near(1000 * meeting, 3 * Math.sqrt(meeting / 0.02), 3, "the line meets the power");
  assert.equal(end, 0.02);
  near(curve.reaction(meeting / 2), 500 * meeting, 3, "line");
  near(curve.reaction(0.01), 3 * Math.SQRT1_2, 3, "power");
  near(curve.reaction(0.5), 3, 3, "capacity");
  const soft = must(reactionCurve({ ...law, stiffness: 100 }, 0));
  assert.deepEqual(soft.ends, [0.03]);
  near(soft.reaction(0.02), 2, 3, "the line up to the capacity");
});

test("a table on a line is that line, and no table rises above its points", () => {
  const line = must(reactionCurve({ type: "table", points: [[0.01, 1], [0.03, 3], [0.1, 10]] }, 0));
  for (const w of [0.001, 0.02, 0.07]) near(line.reaction(w), 100 * w, 10, `line at ${w}`);
  const flat = must(reactionCurve({ type: "table", points: [[1, 2], [2, 2], [5, 8]] }, 0));
  for (let w = 0, before = 0; w < 6; w += 0.01) {
    const p = flat.reaction(w);
    assert.ok(p >= before - 1e-12 && p <= 8 && (w < 1 || w > 2 || Math.abs(p - 2) < 1e-12), `${w}: ${p}`);
    before = p;
  }
});

test("numbers along the member give curves at the start, the middle and the end of the range", () => {
  const input = lawOf("foundations", "deep");
  const picture = lawFigure(input, size, must(lawChart(input, size)));
  assert.equal(withClass(picture, "series-line").filter((node) => node.name === "path").length, 3);
  const names = ["0.5\u00a0L", "0.75\u00a0L", "1\u00a0L"];
  for (const name of names) assert.ok(textsOf(picture).includes(name), name);
  const boxes = withClass(picture, "legend-text").map(boxOf);
  assert.ok(boxes.every(({ right, y }) => right <= size.width && y === boxes[0]?.y), "the names are on one line");
  const table = lawTable(input);
  assert.deepEqual(table.columns, ["displacement w (m)", ...names.map((name) => `reaction p (kN/m) at ${name}`)]);
  for (const [w, ...forces] of table.rows) {
    [0.5, 0.75, 1].forEach((fraction, i) => near(Number(forces[i]), reaction(input, fraction, Number(w)), 4, `${w}`));
  }
});

test("axes have the units of the model: force, moment, or force per length", () => {
  const labels = (input: LawInput) => {
    const { xLabel, yLabel } = must(lawChart(input, size)).frame;
    return [xLabel, yLabel];
  };
  assert.deepEqual(labels(lawOf("springs", "tanh0")), ["displacement w (m)", "reaction p (kN)"]);
  assert.deepEqual(labels(lawOf("springs", "turn")), ["rotation w (rad)", "moment p (kN\u202fm)"]);
  assert.deepEqual(labels(lawOf("foundations", "shaft")), ["displacement w (m)", "reaction p (kN/m)"]);
});

test("points of a table are dots, in both senses", () => {
  const input = lawOf("springs", "table4");
  const chart = must(lawChart(input, size));
  const picture = lawFigure(input, size, chart);
  const [points] = [(input.support["law"] as { points: [number, number][] }).points];
  const dots = withClass(picture, "series-dot").map((node) => [Number(node.attributes["cx"]), Number(node.attributes["cy"])]);
  const expected = [...points, ...points.map(([w, p]) => [-w, -p] as const)].map(([w, p]) => [place(chart.frame.x, w), place(chart.frame.y, p)]);
  assert.equal(dots.length, expected.length);
  for (const [x = 0, y = 0] of expected) assert.ok(dots.some(([a = 0, b = 0]) => Math.hypot(a - x, b - y) < 0.02), `${x} ${y}`);
  assert.match(String(picture.attributes["aria-label"]), /Law of table4: table; reaction p \(kN\) against displacement w \(m\), up to 4.kN/);
});

test("nothing is drawn without a law, or of one that is not right yet", () => {
  const tanh = { type: "tanh", stiffness: 400, capacity: 3 };
  const wrong: unknown[] = [
    undefined, null, 3, {}, { type: "spline" }, { ...tanh, capacity: -1 }, { ...tanh, stiffness: "x" }, { ...tanh, stiffness: 0 },
    { ...tanh, capacity: { along: [] } }, { ...tanh, capacity: { along: [[0, 1], [0, 2]] } }, { ...tanh, capacity: { along: 3 } },
    { type: "power", stiffness: 1, capacity: 1, reference: 1, exponent: 1 }, { type: "table" }, { type: "table", points: [] },
    { type: "table", points: [[0, 0]] }, { type: "table", points: [[0.2, 1], [0.1, 2]] }, { type: "table", points: [[1, null]] },
  ];
  for (const law of wrong) assert.equal(lawChart(lawOf("springs", "tanh0", { law }), size), null, JSON.stringify(law));
  assert.equal(lawChart(lawOf("springs", "tanh0", { reaction: "other" }), size), null);
  assert.equal(lawTable(lawOf("springs", "tanh0", { law: {} })).rows.length, 0);
});

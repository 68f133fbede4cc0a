import assert from "node:assert/strict";
import { test } from "node:test";
import { cubicSpline, interpolate, last, memberAxis } from "../../../web/src/figures/geometry";
import { must, readCase } from "./support";

test("axes are those of the solver: every curve, with stress-free offsets, by arc length", () => {
  const { request, result } = readCase("curves");
  const nodes = new Map(request.model.nodes.map((node) => [node.id, node]));
  for (const member of request.model.members) {
    const axis = must(memberAxis(member, nodes, request.model.imperfections));
    const state = must(result.states[0]?.members[member.id]);
    const length = last(state.s);
    assert.ok(Math.abs(last(axis.s) - length) < 2e-3 * length, member.id);
    state.s.forEach((s, i) => {
      const x = interpolate(axis.s, axis.x, s) - must(state.x0[i]);
      const y = interpolate(axis.s, axis.y, s) - must(state.y0[i]);
      assert.ok(Math.hypot(x, y) < 2e-3 * length, `${member.id} at ${s}: off by ${Math.hypot(x, y)}`);
    });
  }
});

test("the deep arch turns right where its sweep is negative", () => {
  const nodes = new Map([["a", { x: -1, y: 0 }], ["b", { x: 1, y: 0 }]]);
  const arc = (sweep_degrees: number) => must(memberAxis(
    { id: "m", start: "a", end: "b", section: "s", curve: { type: "arc", sweep_degrees } }, nodes));
  assert.ok(Math.max(...arc(-215).y) > 1);
  assert.ok(Math.min(...arc(215).y) < -1);
  assert.ok(Math.abs(Math.max(...arc(-180).y) - 1) < 1e-3);
});

test("splines reproduce cubics, three points a parabola, two a line", () => {
  const cubic = (t: number) => 1 - 2 * t + 3 * t * t - 0.5 * t ** 3;
  const t = [0, 0.7, 1, 2.5, 3, 4];
  const spline = cubicSpline(t, t.map(cubic));
  for (const where of [0.1, 0.9, 2, 3.7]) assert.ok(Math.abs(spline(where) - cubic(where)) < 1e-12);
  const four = cubicSpline(t.slice(0, 4), t.slice(0, 4).map(cubic));
  assert.ok(Math.abs(four(1.8) - cubic(1.8)) < 1e-12);
  const parabola = cubicSpline([0, 1, 3], [0, 1, 9]);
  assert.ok(Math.abs(parabola(2) - 4) < 1e-12);
  assert.equal(cubicSpline([0, 2], [1, 3])(1), 2);
});

test("a member without its nodes, or of no length, has no axis", () => {
  const nodes = new Map([["a", { x: 0, y: 0 }], ["b", { x: 0, y: 0 }]]);
  assert.equal(memberAxis({ id: "m", start: "a", end: "c", section: "s" }, nodes), null);
  assert.equal(memberAxis({ id: "m", start: "a", end: "b", section: "s" }, nodes), null);
});

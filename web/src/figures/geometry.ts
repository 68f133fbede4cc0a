// Plane geometry of members: axes as docs/requests.md documents them (line, arc, parabola, sine, spline), places along
// them by undeformed arc length, left normals. Model axes: x to the right, y up, angles counter-clockwise.

import type { components } from "../api/types";
import { valueBetween } from "./cubic";

type Schemas = components["schemas"];
export type Member = Schemas["Member"];
export type Curve = Schemas["Curve"];
export type Imperfection = Schemas["Imperfection"];

export interface Point {
  x: number;
  y: number;
}

/** A line through points with the undeformed arc length of each; lists of equal length, s increasing. */
export interface Axis {
  s: number[];
  x: number[];
  y: number[];
}

/** A list's value; NaN beyond its ends, so that nothing is drawn there. */
export function at(list: readonly number[], index: number): number {
  return list[index] ?? Number.NaN;
}

export function last(list: readonly number[]): number {
  return at(list, list.length - 1);
}

/** Index i of the interval [s_i, s_{i+1}] that holds a value, for increasing lists of two and more. */
export function intervalOf(list: readonly number[], value: number): number {
  let low = 0;
  let high = list.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (at(list, middle) <= value) low = middle;
    else high = middle;
  }
  return low;
}

/** Values between those of an increasing list: cubic where they have `rates` by the list, else linear; beyond its ends the end values. */
export function interpolate(s: readonly number[], values: readonly number[], where: number, rates: readonly number[] = []): number {
  if (s.length < 2) return at(values, 0);
  const i = intervalOf(s, where);
  const step = at(s, i + 1) - at(s, i);
  const t = step > 0 ? Math.min(1, Math.max(0, (where - at(s, i)) / step)) : 0;
  const knot = (k: number) => ({ value: at(values, k), rate: at(rates, k) });
  return valueBetween(knot(i), knot(i + 1), step, t);
}

/** Unit left normals of a line through points: its tangent turned by +90 degrees. */
export function leftNormals(x: readonly number[], y: readonly number[]): Point[] {
  const n = x.length;
  return x.map((_, i) => {
    const a = Math.max(0, i - 1);
    const b = Math.min(n - 1, i + 1);
    const dx = a === i || b === i ? endSlope(x, i) : at(x, b) - at(x, a);
    const dy = a === i || b === i ? endSlope(y, i) : at(y, b) - at(y, a);
    const length = Math.hypot(dx, dy);
    return length > 0 ? { x: -dy / length, y: dx / length } : { x: 0, y: 1 };
  });
}

/** Three-point difference at an end of evenly spaced values, so that a curve's normal there is as good as between. */
function endSlope(values: readonly number[], end: number): number {
  const n = values.length;
  const way = end === 0 ? 1 : -1;
  const next = at(values, end + way);
  if (n < 3) return way * (next - at(values, end));
  return way * (4 * next - 3 * at(values, end) - at(values, end + 2 * way));
}

/** Second derivatives of the C2 cubic spline through (t, f), not-a-knot at its ends (docs/requests.md, curves). */
function splineBends(t: readonly number[], f: readonly number[]): number[] {
  const n = t.length;
  const h = (i: number) => at(t, i + 1) - at(t, i);
  const slope = (i: number) => (at(f, i + 1) - at(f, i)) / h(i);
  if (n < 3) return t.map(() => 0);
  if (n === 3) return t.map(() => (2 * (slope(1) - slope(0))) / (h(0) + h(1)));
  // unknowns m_1 .. m_{n-2}: m_0 and m_{n-1} are eliminated by the equal third derivatives on both sides
  const left = h(0) / h(1);
  const right = h(n - 2) / h(n - 3);
  const lower: number[] = [];
  const diagonal: number[] = [];
  const upper: number[] = [];
  const rhs: number[] = [];
  for (let i = 1; i < n - 1; ++i) {
    const first = i === 1;
    const final = i === n - 2;
    lower.push(first ? 0 : h(i - 1) - (final ? right * h(i) : 0));
    diagonal.push(2 * (h(i - 1) + h(i)) + (first ? (1 + left) * h(0) : 0) + (final ? (1 + right) * h(i) : 0));
    upper.push(final ? 0 : h(i) - (first ? left * h(0) : 0));
    rhs.push(6 * (slope(i) - slope(i - 1)));
  }
  const inner = tridiagonal(lower, diagonal, upper, rhs);
  const m0 = (1 + left) * at(inner, 0) - left * at(inner, 1);
  const m1 = (1 + right) * at(inner, n - 3) - right * at(inner, n - 4);
  return [m0, ...inner, m1];
}

/** Thomas' algorithm. */
function tridiagonal(lower: number[], diagonal: number[], upper: number[], rhs: number[]): number[] {
  const n = diagonal.length;
  const d = [...diagonal];
  const r = [...rhs];
  for (let i = 1; i < n; ++i) {
    const factor = at(lower, i) / at(d, i - 1);
    d[i] = at(d, i) - factor * at(upper, i - 1);
    r[i] = at(r, i) - factor * at(r, i - 1);
  }
  const x = new Array<number>(n).fill(0);
  for (let i = n - 1; i >= 0; --i) x[i] = (at(r, i) - (i + 1 < n ? at(upper, i) * at(x, i + 1) : 0)) / at(d, i);
  return x;
}

/** The C2 cubic spline through (t, f), t increasing. */
export function cubicSpline(t: readonly number[], f: readonly number[]): (where: number) => number {
  const m = splineBends(t, f);
  return (where) => {
    const i = intervalOf(t, where);
    const h = at(t, i + 1) - at(t, i);
    const a = (at(t, i + 1) - where) / h;
    const b = (where - at(t, i)) / h;
    const bend = ((a * a * a - a) * at(m, i) + (b * b * b - b) * at(m, i + 1)) * h * h / 6;
    return a * at(f, i) + b * at(f, i + 1) + bend;
  };
}

/** A curve as a function of a parameter from 0 to 1. */
function parametric(curve: Curve, start: Point, end: Point): (t: number) => Point {
  const dx = end.x - start.x;
  const dy = end.y - start.y;
  const chord = Math.hypot(dx, dy);
  const nx = -dy / chord;
  const ny = dx / chord;
  const over = (offset: (t: number) => number) => (t: number) => ({
    x: start.x + t * dx + offset(t) * nx,
    y: start.y + t * dy + offset(t) * ny,
  });
  switch (curve.type) {
    case "line": return over(() => 0);
    case "parabola": {
      const [ux, uy] = curve.direction ?? [nx, ny];
      const rise = (4 * curve.rise) / Math.hypot(ux, uy);
      return (t) => ({ x: start.x + t * dx + rise * t * (1 - t) * ux, y: start.y + t * dy + rise * t * (1 - t) * uy });
    }
    case "sine": return over((t) => curve.rise * Math.sin((curve.half_waves ?? 1) * Math.PI * t));
    case "arc": return arc(curve.sweep_degrees, start, end);
    case "points": return splineCurve(curve.points, start, end);
  }
}

function arc(degrees: number, start: Point, end: Point): (t: number) => Point {
  const sweep = (degrees * Math.PI) / 180;
  const chord = Math.hypot(end.x - start.x, end.y - start.y);
  const direction = Math.atan2(end.y - start.y, end.x - start.x);
  const radius = chord / (2 * Math.sin(sweep / 2));  // of the sweep's sign: the centre is on the left where positive
  const angle = direction - sweep / 2;
  return (t) => ({
    x: start.x + radius * (Math.sin(angle + t * sweep) - Math.sin(angle)),
    y: start.y - radius * (Math.cos(angle + t * sweep) - Math.cos(angle)),
  });
}

function splineCurve(points: readonly (readonly [number, number])[], start: Point, end: Point): (t: number) => Point {
  const x = [start.x, ...points.map((p) => p[0]), end.x];
  const y = [start.y, ...points.map((p) => p[1]), end.y];
  const t = [0];
  for (let i = 1; i < x.length; ++i) t.push(last(t) + Math.hypot(at(x, i) - at(x, i - 1), at(y, i) - at(y, i - 1)));
  const whole = last(t);
  const fx = cubicSpline(t, x);
  const fy = cubicSpline(t, y);
  return (where) => ({ x: fx(where * whole), y: fy(where * whole) });
}

function intervalsOf(curve: Curve, straight: boolean): number {
  switch (curve.type) {
    case "line": return straight ? 1 : 64;
    case "arc": return Math.max(32, Math.ceil(Math.abs(curve.sweep_degrees) / 2));
    case "parabola": return 64;
    case "sine": return Math.min(4000, 48 * (curve.half_waves ?? 1));
    case "points": return Math.min(8000, 24 * (curve.points.length + 1));
  }
}

/** Offset of the axis along its left normal at a fraction of its length: imperfections, those by modes and the worst left out. */
function offsetOf(imperfections: readonly Imperfection[], member: string): ((fraction: number) => number) | null {
  const parts: ((fraction: number) => number)[] = [];
  for (const item of imperfections) {
    if (item.type === "mode" || item.type === "worst" || item.member !== member) continue;
    if (item.type === "sine") {
      parts.push((f) => item.amplitude * Math.sin(item.half_waves * Math.PI * f));
      continue;
    }
    const pairs = [...item.offsets];
    if ((pairs[0]?.[0] ?? 0) > 0) pairs.unshift([0, 0]);
    if ((pairs[pairs.length - 1]?.[0] ?? 1) < 1) pairs.push([1, 0]);
    if (pairs.length > 1) parts.push(cubicSpline(pairs.map((pair) => pair[0]), pairs.map((pair) => pair[1])));
  }
  return parts.length === 0 ? null : (f) => parts.reduce((sum, part) => sum + part(f), 0);
}

/** The stress-free axis of a member; null when its nodes are unknown or coincide. */
export function memberAxis(member: Member, nodes: ReadonlyMap<string, Point>,
                           imperfections: readonly Imperfection[] = []): Axis | null {
  const start = nodes.get(member.start);
  const end = nodes.get(member.end);
  if (!start || !end || (start.x === end.x && start.y === end.y)) return null;
  const curve: Curve = member.curve ?? { type: "line" };
  const along = parametric(curve, start, end);
  const offset = offsetOf(imperfections, member.id);
  const count = intervalsOf(curve, offset === null);
  const axis: Axis = { s: [], x: [], y: [] };
  for (let i = 0; i <= count; ++i) {
    const point = along(i / count);
    const before = axis.x.length - 1;
    const step = i === 0 ? 0 : Math.hypot(point.x - at(axis.x, before), point.y - at(axis.y, before));
    axis.s.push(i === 0 ? 0 : at(axis.s, before) + step);
    axis.x.push(point.x);
    axis.y.push(point.y);
  }
  return withOffset(axis, offset);
}

function withOffset(axis: Axis, offset: ((fraction: number) => number) | null): Axis {
  if (offset === null) return axis;
  const normals = leftNormals(axis.x, axis.y);
  const length = last(axis.s);
  const moved = (values: number[], pick: (normal: Point) => number) =>
    values.map((value, i) => {
      const normal = normals[i];
      return normal ? value + offset(at(axis.s, i) / length) * pick(normal) : value;
    });
  return { s: axis.s, x: moved(axis.x, (normal) => normal.x), y: moved(axis.y, (normal) => normal.y) };
}

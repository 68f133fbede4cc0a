// Equilibrium paths as lines of points: any monitor or the load factor on either axis, cut where stability changes.
// Stable: no negative eigenvalue of the tangent stiffness (docs/results.md, branches).

import type { components } from "../../api/types";
import { valueBetween } from "../cubic";
import { at, interpolate, type Point } from "../geometry";
import { unitOf, withUnit, type Units } from "../numbers";

type Schemas = components["schemas"];
export type Result = Schemas["Result"];
export type Branch = Schemas["Branch"];
export type CriticalPoint = Schemas["CriticalPoint"];
export type ContactEvent = Schemas["ContactEvent"];
export type Monitor = Schemas["Monitor"];

/** The parts of a result that a path is drawn from; a running analysis has them piece by piece. */
export type PathResult = Pick<Result, "branches" | "critical_points" | "contact_events"> &
  { static?: Result["static"]; summary?: Pick<Result["summary"], "softest">; first_yield?: Result["first_yield"] };

/** What an axis shows; `reversed` shows minus the monitor's value, and says so. */
export type PathQuantity =
  | { kind: "load_factor" }
  | { kind: "arc_length" }
  | { kind: "monitor"; id: string; reversed?: boolean };

/** A row of a branch: `branch` is its index in the result's list. */
export interface PathPoint {
  branch: number;
  index: number;
}

/**
 * The branches, or the table of a static analysis as one: its arc length counts rows, eigenvalues that were not counted are NaN, and
 * its rows have no stiffness ratios.
 */
export function branchesOf(result: PathResult): Branch[] {
  const table = result.static;
  if (result.branches.length > 0 || !table) return result.branches;
  return [{
    id: 0, parent: null, load_factor: table.load_factor, arc_length: table.load_factor.map((_, i) => i),
    monitors: table.monitors, negative_eigenvalues: table.negative_eigenvalues.map((n) => n ?? Number.NaN),
    stiffness_ratio: table.load_factor.map(() => null), contact_fraction: table.contact_fraction, termination: "load_factors",
  }];
}

function listOf(lists: Pick<Branch, "load_factor" | "monitors">, arcs: readonly number[], quantity: PathQuantity): readonly number[] {
  if (quantity.kind === "load_factor") return lists.load_factor;
  if (quantity.kind === "arc_length") return arcs;
  const values = lists.monitors[quantity.id] ?? [];
  return quantity.reversed ? values.map((value) => -value) : values;
}

/** The values of a quantity along a branch; an empty list when the branch has no such monitor. */
export function valuesOf(branch: Branch, quantity: PathQuantity): readonly number[] {
  return listOf(branch, branch.arc_length, quantity);
}

/** The rates of a quantity by arc length, one a row; an empty list when the branch has none. */
function ratesOf(branch: Branch, quantity: PathQuantity): readonly number[] {
  return branch.rates ? listOf(branch.rates, branch.arc_length.map(() => 1), quantity) : [];
}

/** A quantity at an arc length of a branch. */
export function valueAlong(branch: Branch, quantity: PathQuantity, arc: number): number {
  return interpolate(branch.arc_length, valuesOf(branch, quantity), arc, ratesOf(branch, quantity));
}

/** Indices of the rows at which an equilibrium was solved: all where the branch does not tell. */
export function computedRows(branch: Pick<Branch, "load_factor" | "computed">): readonly number[] {
  return branch.computed ?? branch.load_factor.map((_, row) => row);
}

/** A quantity at a critical point; NaN where the point has none. */
export function criticalValue(point: CriticalPoint, quantity: PathQuantity): number {
  if (quantity.kind === "load_factor") return point.load_factor;
  if (quantity.kind === "arc_length") return point.arc_length;
  const value = point.monitors[quantity.id] ?? Number.NaN;
  return quantity.reversed ? -value : value;
}

/** A point of a line: a row of the branch, or a critical point between rows; stability is not told at the latter. */
export interface Vertex {
  x: number;
  y: number;
  arc: number;
  /** Rates of x and y by arc length; NaN where they are not known, and straight lines lead there. */
  rate: Point;
  row: number | null;
  negative: number | null;
}

export type Stability = boolean | null;

export interface PathCurve {
  branch: number;
  vertices: Vertex[];
  /** For each vertex but the last: whether the line to the next one is stable; null where nobody counted. */
  stable: Stability[];
}

/** The place at a fraction of the arc length between two neighbours. */
export function placeBetween(from: Vertex, to: Vertex, fraction: number): Point {
  const along = (axis: "x" | "y"): number => valueBetween(
    { value: from[axis], rate: from.rate[axis] }, { value: to[axis], rate: to.rate[axis] }, to.arc - from.arc, fraction);
  return { x: along("x"), y: along("y") };
}

const kNoRate: Point = { x: Number.NaN, y: Number.NaN };

/**
 * Leaves the row at a critical point without its count, or inserts a vertex between rows. A curve of cubics has rows at all of its
 * critical points; the others, of broken bifurcations, lie beside it.
 */
function insertCritical(vertices: Vertex[], point: CriticalPoint, x: number, y: number, cubics: boolean): void {
  const near = 1e-9 * Math.max(1e-30, vertices[vertices.length - 1]?.arc ?? 0);
  const found = vertices.findIndex((vertex) => vertex.arc >= point.arc_length - near);
  const after = vertices[found];
  if (!after) return;
  if (after.arc <= point.arc_length + near) after.negative = null;
  else if (found > 0 && !cubics) vertices.splice(found, 0, { x, y, arc: point.arc_length, rate: kNoRate, row: null, negative: null });
}

/** Stability of each piece from the rows at its ends; between two critical points it is that of the piece before. */
function stabilityOf(vertices: readonly Vertex[]): Stability[] {
  const stable: Stability[] = [];
  for (let i = 0; i + 1 < vertices.length; ++i) {
    const here = vertices[i]?.negative ?? null;
    const next = vertices[i + 1]?.negative ?? null;
    if (here === null && next === null) stable.push(i === 0 ? true : stable[i - 1] ?? null);
    else if (Number.isNaN(here) || Number.isNaN(next)) stable.push(null);
    else stable.push(Math.max(here ?? 0, next ?? 0) === 0);
  }
  return stable;
}

/** Arc length at which flutter begins on a branch; infinite where it does not. Negative eigenvalues do not show flutter. */
export function flutterArc(result: Pick<PathResult, "critical_points">, branch: number): number {
  const arcs = result.critical_points.filter((point) => point.branch === branch && point.type === "flutter");
  return Math.min(...arcs.map((point) => point.arc_length));
}

/** The curve of a branch; null when it has not both quantities. */
export function curveOf(result: PathResult, branch: Branch, index: number, x: PathQuantity, y: PathQuantity):
    PathCurve | null {
  const xs = valuesOf(branch, x);
  const ys = valuesOf(branch, y);
  const count = Math.min(xs.length, ys.length);
  if (count === 0) return null;
  const [xRates, yRates] = [ratesOf(branch, x), ratesOf(branch, y)];
  const vertices: Vertex[] = [];
  for (let i = 0; i < count; ++i) {
    vertices.push({ x: at(xs, i), y: at(ys, i), arc: at(branch.arc_length, i), rate: { x: at(xRates, i), y: at(yRates, i) }, row: i,
                    negative: branch.negative_eigenvalues[i] ?? null });
  }
  for (const point of result.critical_points) {
    if (point.branch !== index || result.branches.length === 0) continue;
    insertCritical(vertices, point, criticalValue(point, x), criticalValue(point, y), branch.rates !== undefined);
  }
  const flutter = result.branches.length === 0 ? Infinity : flutterArc(result, index);
  const begin = flutter - 1e-9 * at(branch.arc_length, count - 1);
  const stable = stabilityOf(vertices).map((one, i) => ((vertices[i]?.arc ?? 0) >= begin ? false : one));
  return { branch: index, vertices, stable };
}

/** A critical point on the chart. */
export interface CriticalMark {
  point: CriticalPoint;
  number: number;
  x: number;
  y: number;
}

/** Critical points that have both quantities. The arc length of a point is not on the axis that counts rows of a static analysis. */
export function criticalMarks(result: PathResult, x: PathQuantity, y: PathQuantity): CriticalMark[] {
  const counts = result.static && (x.kind === "arc_length" || y.kind === "arc_length");
  return (counts ? [] : result.critical_points)
    .map((point, number) => ({ point, number, x: criticalValue(point, x), y: criticalValue(point, y) }))
    .filter((mark) => Number.isFinite(mark.x) && Number.isFinite(mark.y));
}

/** A contact event on the chart. */
export interface ContactMark {
  event: ContactEvent;
  x: number;
  y: number;
}

/** Contact events, at their arc length on their branch. */
export function contactMarks(result: PathResult, x: PathQuantity, y: PathQuantity): ContactMark[] {
  return result.contact_events.flatMap((event) => {
    const branch = result.branches[event.branch];
    if (!branch) return [];
    const along = (quantity: PathQuantity) => valueAlong(branch, quantity, event.arc_length);
    const mark = { event, x: along(x), y: y.kind === "load_factor" ? event.load_factor : along(y) };
    return Number.isFinite(mark.x) && Number.isFinite(mark.y) ? [mark] : [];
  });
}

const kSenses = {
  x: ["to the right", "to the left"], y: ["up", "down"], rotation: ["counter-clockwise", "clockwise"],
  normal: ["to the member's left", "to the member's right"],
} as const;

/** The name of a quantity with its unit, as on an axis: "crown, down (m)". */
export function quantityLabel(quantity: PathQuantity, monitors: readonly Monitor[] = [], units?: Units): string {
  if (quantity.kind === "load_factor") return "load factor";
  if (quantity.kind === "arc_length") return "arc length of the path";
  const monitor = monitors.find((item) => item.id === quantity.id);
  if (!monitor) return quantity.reversed ? `−${quantity.id}` : quantity.id;
  const unit = unitOf(units, monitor.component === "rotation" ? "rotation" : "length");
  return withUnit(`${quantity.id}, ${kSenses[monitor.component][quantity.reversed ? 1 : 0]}`, unit);
}

/**
 * Whether a monitor is shown with minus its value: it is negative along the primary path by more than rounding, which is what a
 * displacement has there that only branches give values to.
 */
export function isReversed(result: PathResult, id: string): boolean {
  const branches = branchesOf(result);
  const values = branches[0]?.monitors[id] ?? [result.critical_points[0]?.monitors[id] ?? 0];
  let largest = 0;
  for (const branch of branches) for (const value of branch.monitors[id] ?? []) largest = Math.max(largest, Math.abs(value));
  const mean = values.reduce((total, value) => total + value, 0) / Math.max(1, values.length);
  return mean < -1e-9 * largest;
}

/** Load factor against the first monitor, turned so that the path begins to the right; against arc length without one. */
export function defaultQuantities(result: PathResult): { x: PathQuantity; y: PathQuantity } {
  const y: PathQuantity = { kind: "load_factor" };
  const first = branchesOf(result)[0];
  const id = Object.keys(first?.monitors ?? result.critical_points[0]?.monitors ?? {})[0];
  if (id === undefined) return { x: { kind: "arc_length" }, y };
  return { x: { kind: "monitor", id, reversed: isReversed(result, id) }, y };
}

/** The row of each state: by its load factor, in order along its branch; that of a critical point by its arc length. */
export function rowsOfStates(result: Pick<Result, "branches" | "states" | "critical_points">): (PathPoint | null)[] {
  const next = new Map<number, number>();
  return result.states.map((state, number) => {
    const branch = result.branches[state.branch];
    if (!branch || branch.load_factor.length === 0) return null;
    const from = next.get(state.branch) ?? 0;
    let index = branch.load_factor.indexOf(state.load_factor, from);
    if (index < 0) {
      const point = result.critical_points.find((item) => item.state === number && item.branch === state.branch);
      if (!point) return null;
      index = branch.arc_length.findIndex((arc) => arc >= point.arc_length);
      if (index < 0) index = branch.arc_length.length - 1;
    }
    next.set(state.branch, index);
    return { branch: state.branch, index };
  });
}

/** Number of the state that is nearest along the branch to a point of the path; null when the branch has none. */
export function stateNear(rows: readonly (PathPoint | null)[], point: PathPoint): number | null {
  let best: number | null = null;
  let least = Infinity;
  rows.forEach((row, number) => {
    if (!row || row.branch !== point.branch) return;
    const distance = Math.abs(row.index - point.index);
    if (distance < least) {
      least = distance;
      best = number;
    }
  });
  return best;
}

/** The point so many rows further along; before a branch's first row the path goes on along its parent. */
export function walk(result: PathResult, from: PathPoint, steps: number): PathPoint {
  const branches = branchesOf(result);
  const branch = branches[from.branch];
  if (!branch) return from;
  const index = from.index + steps;
  const parent = branch.parent === null ? -1 : branches.findIndex((item) => item.id === branch.parent);
  const above = branches[parent];
  if (index < 0 && above) return { branch: parent, index: forkRow(above, branch) };
  return { branch: from.branch, index: Math.min(branch.load_factor.length - 1, Math.max(0, index)) };
}

/** The row of the parent that is nearest to where the branch leaves it. */
function forkRow(parent: Branch, branch: Branch): number {
  let best = 0;
  let least = Infinity;
  for (let i = 0; i < parent.load_factor.length; ++i) {
    let distance = Math.abs(at(parent.load_factor, i) - at(branch.load_factor, 0));
    for (const [id, values] of Object.entries(parent.monitors)) {
      distance += Math.abs(at(values, i) - at(branch.monitors[id] ?? [], 0)) || 0;
    }
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

// The stiffness ratio along the primary path against a scale of its own, and the softest point (docs/results.md, What can be
// acted on): 1 without load, 0 where stability is lost.

import { fractionAt } from "../cubic";
import { at } from "../geometry";
import { group, label, line, path, type Pixel, type Shape } from "../shape";
import { makeScale, place, type Frame, type Scale } from "./axes";
import {
  branchesOf, criticalValue, valueAlong, valuesOf, type Branch, type CriticalPoint, type PathQuantity, type PathResult,
} from "./curves";
import { thinned } from "./thin";

/** The softest point before the first loss of stability, where its ratio is not zero: a minimum between two rises. */
export interface SoftestPoint {
  loadFactor: number;
  /** Least stiffness there over that of the unloaded structure, more than 0. */
  ratio: number;
  /** Arc length of the path where its load factor first comes to that one. */
  arc: number;
}

/**
 * The first critical point of the primary path at which its stiffness is zero. A broken bifurcation lies beside the path, and
 * flutter begins at a stiffness that is not zero.
 */
function firstLoss(result: PathResult): CriticalPoint | undefined {
  return result.critical_points.filter((point) => point.branch === 0 && !["broken_bifurcation", "flutter"].includes(point.type))
    .sort((a, b) => a.arc_length - b.arc_length)[0];
}

/** Arc length at which a branch first comes to a load factor; null where it does not. */
function arcAtLoad(branch: Branch, load: number): number | null {
  const { load_factor: loads, arc_length: arcs, rates } = branch;
  const knot = (row: number) => ({ value: at(loads, row), rate: at(rates?.load_factor ?? [], row) });
  for (let i = 1; i < loads.length; ++i) {
    const before = knot(i - 1);
    const after = knot(i);
    if ((before.value - load) * (after.value - load) > 0) continue;
    const length = at(arcs, i) - at(arcs, i - 1);
    return at(arcs, i - 1) + length * fractionAt(before, after, length, load);
  }
  return null;
}

/** The softest point on the primary path; null where the stiffness has no minimum before it is zero, or without a path. */
export function softestPoint(result: PathResult): SoftestPoint | null {
  const softest = result.summary?.softest;
  const branch = branchesOf(result)[0];
  if (!softest || !branch || !(softest.stiffness_ratio > 0)) return null;
  const arc = arcAtLoad(branch, softest.load_factor);
  return arc === null ? null : { loadFactor: softest.load_factor, ratio: softest.stiffness_ratio, arc };
}

/** Whether any row of the primary path has a stiffness ratio. */
export function hasStiffness(result: PathResult): boolean {
  return (branchesOf(result)[0]?.stiffness_ratio ?? []).some((ratio) => ratio !== null);
}

interface Sample {
  /** What the plot's axis has there. */
  value: number;
  /** NaN where it is not known. */
  ratio: number;
  arc: number;
}

/**
 * Ratios of the rows, of the softest point and of the first loss of stability, up to which they are shown. A branch that tells which
 * of its rows are computed has none in the others, and the line goes on past every row without a ratio.
 */
function samplesOf(result: PathResult, branch: Branch, quantity: PathQuantity): Sample[] {
  const values = valuesOf(branch, quantity);
  const samples = values.map((value, i): Sample =>
    ({ value, ratio: branch.stiffness_ratio[i] ?? Number.NaN, arc: branch.arc_length[i] ?? Number.NaN }));
  const loss = firstLoss(result);
  const softest = softestPoint(result);
  const before = samples.filter(({ arc, ratio }) => (!loss || arc < loss.arc_length) && !(branch.computed && Number.isNaN(ratio)));
  if (softest) before.push({ value: valueAlong(branch, quantity, softest.arc), ratio: softest.ratio, arc: softest.arc });
  if (loss) before.push({ value: criticalValue(loss, quantity), ratio: 0, arc: loss.arc_length });
  return before.sort((a, b) => a.arc - b.arc);
}

/** The second curve of a path: places in pixels, and the scale of 0 to 1 that they are read on. */
export interface StiffnessCurve {
  /** Whether 1 is at the top; else it is at the right. */
  upward: boolean;
  scale: Scale;
  /** Not a number where the ratio is not known: the line has a gap there. */
  points: Pixel[];
}

/** Whether the ratio goes upward: where the load factor is not on the vertical axis, on which its curve is read. */
export function isUpward(y: PathQuantity): boolean {
  return y.kind !== "load_factor";
}

/** The curve in a frame; null where no row has a ratio. */
export function stiffnessCurve(result: PathResult, x: PathQuantity, y: PathQuantity, frame: Frame): StiffnessCurve | null {
  const branch = branchesOf(result)[0];
  if (!branch || !hasStiffness(result)) return null;
  const upward = isUpward(y);
  const scale = upward ? makeScale(0, 1, frame.y.start, frame.y.end) : makeScale(0, 1, frame.x.start, frame.x.end);
  const points = samplesOf(result, branch, upward ? x : y).map(({ value, ratio }) =>
    upward ? { x: place(frame.x, value), y: place(scale, ratio) } : { x: place(scale, ratio), y: place(frame.y, value) });
  return { upward, scale, points };
}

/** The points of a line without those that nobody sees; what is not a number parts it, and stays between its parts. */
function thinnedParts(points: readonly Pixel[]): Pixel[] {
  const parts: Pixel[][] = [[]];
  for (const point of points) {
    if (Number.isFinite(point.x + point.y)) parts[parts.length - 1]?.push(point);
    else parts.push([]);
  }
  const gap = { x: Number.NaN, y: Number.NaN };
  return parts.flatMap((part, i) => [...(i > 0 ? [gap] : []), ...thinned(part).flatMap((k) => part[k] ?? [])]);
}

export function stiffnessLine(curve: StiffnessCurve): Shape {
  return path("ratio-line", thinnedParts(curve.points));
}

/** Room that the numbers of the scale take above the plot, or at its right. */
export const kScaleRoom = { above: 15, right: 22 };

/** Ends, middle, and the tenth below which a structure is nearly unstable. */
const kRatios = [0, 0.1, 0.5, 1];

/** Ticks and numbers of the ratio's scale, outside of the plot. */
export function stiffnessScale(curve: StiffnessCurve, frame: Frame): Shape {
  return group("ratio-scale", ...kRatios.flatMap((ratio) => {
    const at = place(curve.scale, ratio);
    const from = curve.upward ? { x: frame.x.end, y: at } : { x: at, y: frame.y.end };
    const to = curve.upward ? { x: from.x + 4, y: at } : { x: at, y: from.y - 4 };
    const text = curve.upward ? label("tick", { x: to.x + 3, y: at + 4 }, "start", String(ratio))
                              : label("tick", { x: at, y: to.y - 3 }, "middle", String(ratio));
    return [line("ratio-tick", from, to), text];
  }));
}

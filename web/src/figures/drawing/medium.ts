// Where the medium of a foundation begins, and its direction.

import type { components } from "../../api/types";
import type { Point } from "../geometry";

type Foundation = components["schemas"]["Foundation"];
type Outline = components["schemas"]["Outline"];

/** A place on the initial axis of a member. */
export interface AxisPlace {
  point: Point;
  /** Unit left normal. */
  normal: Point;
  /** Fraction of the member's length. */
  fraction: number;
}

/** The way from a place to the medium: unit direction, and the distance to the surface, negative below it. */
export interface Way {
  into: Point;
  gap: number;
}

function unit(x: number, y: number): Point {
  const length = Math.hypot(x, y) || 1;
  return { x: x / length, y: y / length };
}

/** The gap of a foundation at a fraction of its member. */
function gapAt(foundation: Foundation, fraction: number): number {
  const gap = "gap" in foundation ? foundation.gap ?? 0 : 0;
  if (typeof gap === "number") return gap;
  const points = gap.along;
  const next = points.findIndex(([place]) => place > fraction);
  const after = points[next === -1 ? points.length - 1 : next];
  const before = points[Math.max(next === -1 ? points.length - 1 : next - 1, 0)];
  if (!before || !after) return 0;
  const width = after[0] - before[0];
  return before[1] + (width > 0 ? (fraction - before[0]) / width : 0) * (after[1] - before[1]);
}

/** The way to straight lines through points; the medium is on their left for sense 1. */
function toLines(points: readonly (readonly [number, number])[], sense: number, from: Point): Way {
  let best: Way = { into: { x: 0, y: sense }, gap: Infinity };
  let least = Infinity;
  points.slice(1).forEach(([bx, by], i) => {
    const [ax, ay] = points[i] ?? [bx, by];
    const along = unit(bx - ax, by - ay);
    const length = Math.hypot(bx - ax, by - ay);
    const first = i === 0 ? -Infinity : 0;
    const last = i + 2 === points.length ? Infinity : length;
    const t = Math.min(last, Math.max(first, (from.x - ax) * along.x + (from.y - ay) * along.y));
    const away = { x: from.x - ax - t * along.x, y: from.y - ay - t * along.y };
    const distance = Math.hypot(away.x, away.y);
    if (distance >= least) return;
    least = distance;
    const into = { x: -sense * along.y, y: sense * along.x };
    best = { into, gap: -(away.x * into.x + away.y * into.y) };
  });
  return best;
}

/** The way to the nearest point of an outline. Splines and rounded corners are taken as straight lines between their points. */
function toOutline(outline: Outline, from: Point): Way {
  if (outline.type === "circle") {
    const [x, y] = outline.center;
    const sense = outline.medium === "outside" ? 1 : -1;
    const out = unit(from.x - (x ?? 0), from.y - (y ?? 0));
    const distance = Math.hypot(from.x - (x ?? 0), from.y - (y ?? 0)) - outline.radius;
    return { into: { x: sense * out.x, y: sense * out.y }, gap: -sense * distance };
  }
  if (outline.type === "line") {
    const into = unit(outline.into[0], outline.into[1]);
    const [x, y] = outline.through;
    return { into, gap: ((x ?? 0) - from.x) * into.x + ((y ?? 0) - from.y) * into.y };
  }
  return toLines(outline.points as readonly (readonly [number, number])[], outline.medium === "left" ? 1 : -1, from);
}

/** The way into the medium of a foundation from a place. */
export function wayInto(foundation: Foundation, place: AxisPlace): Way {
  if ("outline" in foundation && foundation.outline) return toOutline(foundation.outline, place.point);
  const gap = gapAt(foundation, place.fraction);
  if ("direction" in foundation && Array.isArray(foundation.direction)) {
    return { into: unit(foundation.direction[0], foundation.direction[1]), gap };
  }
  const sign = "side" in foundation && foundation.side === "right" ? -1 : 1;
  return { into: { x: sign * place.normal.x, y: sign * place.normal.y }, gap };
}

/** The largest gap of a foundation; 0 with an outline. */
export function largestGap(foundation: Foundation): number {
  const gap = "gap" in foundation ? foundation.gap ?? 0 : 0;
  return typeof gap === "number" ? gap : Math.max(...gap.along.map(([, value]) => value));
}

// Thinning of lines by what can be seen: O(n), and no point of the line is farther from what is drawn than the tolerance.

import type { Pixel } from "../shape";

/** Sector of directions from an anchor within which a straight line passes all points so far within the tolerance. */
interface Sector {
  middle: number;
  low: number;
  high: number;
  reach: number;
}

function turned(angle: number, from: number): number {
  const turn = angle - from;
  return turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI));
}

/** The sector that still passes by the next point; null when none does or the line turns back. */
function narrowed(sector: Sector | null, anchor: Pixel, next: Pixel, tolerance: number): Sector | null {
  const dx = next.x - anchor.x;
  const dy = next.y - anchor.y;
  const distance = Math.hypot(dx, dy);
  const angle = Math.atan2(dy, dx);
  if (sector === null) {
    if (distance <= tolerance) return { middle: angle, low: -Math.PI, high: Math.PI, reach: distance };
    const half = Math.asin(tolerance / distance);
    return { middle: angle, low: -half, high: half, reach: distance };
  }
  if (distance < sector.reach - tolerance) return null;
  const reach = Math.max(sector.reach, distance);
  if (distance <= tolerance) return { ...sector, reach };
  const turn = turned(angle, sector.middle);
  const half = Math.asin(tolerance / distance);
  if (turn < sector.low || turn > sector.high) return null;
  return { middle: sector.middle, low: Math.max(sector.low, turn - half), high: Math.min(sector.high, turn + half), reach };
}

/**
 * Indices of the points to draw: the first, the last, and those without which the line would be off by more than the
 * tolerance in pixels. The sector algorithm of Williams (Cartography 15, 1978), with a stop where the line turns back.
 */
export function thinned(points: readonly Pixel[], tolerance = 0.25): number[] {
  if (points.length < 3) return points.map((_, i) => i);
  const kept = [0];
  let sector: Sector | null = null;
  let anchor = points[0];
  for (let i = 1; i < points.length; ++i) {
    const next = points[i];
    if (!next || !anchor) continue;
    const narrower: Sector | null = narrowed(sector, anchor, next, tolerance);
    if (narrower !== null) {
      sector = narrower;
      continue;
    }
    kept.push(i - 1);
    anchor = points[i - 1];
    sector = anchor ? narrowed(null, anchor, next, tolerance) : null;
  }
  kept.push(points.length - 1);
  return kept;
}

// Marks of charts: each kind has its own form, so that they are told apart without colour.

import type { components } from "../../api/types";
import { coordinate, path, shape, type Pixel, type Shape } from "../shape";

export type CriticalType = components["schemas"]["CriticalType"];
export type MarkKind = CriticalType | "softest" | "first_yield" | "opened" | "closed";

/** What a legend calls a mark. */
export const kMarkNames: Record<MarkKind, string> = {
  limit_max: "limit point", limit_min: "limit point, minimum", bifurcation: "bifurcation",
  broken_bifurcation: "broken bifurcation", flutter: "flutter", capacity: "capacity of supports", softest: "softest point", first_yield: "first yield", closed: "contact made", opened: "contact lost",
};

function polygon(className: string, at: Pixel, corners: readonly (readonly [number, number])[]): Shape {
  return path(className, corners.map(([x, y]) => ({ x: at.x + x, y: at.y + y })), true);
}

function circle(className: string, at: Pixel, radius: number): Shape {
  return shape("circle", { class: className, cx: coordinate(at.x), cy: coordinate(at.y), r: radius });
}

/**
 * Triangle up or down: limit point; diamond: bifurcation, hollow when broken; hourglass: flutter; bar: capacity of supports;
 * hollow square: softest point; hollow triangle to the right: first yield; dot: contact made, ring: lost.
 */
export function mark(kind: MarkKind, at: Pixel): Shape {
  switch (kind) {
    case "limit_max": return polygon("mark limit", at, [[0, -6.5], [6, 4.5], [-6, 4.5]]);
    case "limit_min": return polygon("mark limit", at, [[0, 6.5], [6, -4.5], [-6, -4.5]]);
    case "bifurcation": return polygon("mark bifurcation", at, [[0, -7], [6, 0], [0, 7], [-6, 0]]);
    case "broken_bifurcation": return polygon("mark broken", at, [[0, -7], [6, 0], [0, 7], [-6, 0]]);
    case "flutter": return polygon("mark flutter", at, [[-6, -6.5], [6, -6.5], [-6, 6.5], [6, 6.5]]);
    case "capacity": return polygon("mark limit", at, [[-6, -5], [6, -5], [6, -1], [-6, -1]]);
    case "softest": return polygon("mark softest", at, [[-5, -5], [5, -5], [5, 5], [-5, 5]]);
    case "first_yield": return polygon("mark yield", at, [[-4.5, -6], [6.5, 0], [-4.5, 6]]);
    case "closed": return circle("mark event", at, 3);
    case "opened": return circle("mark event open", at, 3);
  }
}

// Symbols of supports and springs. A support is drawn where its node is in the state; one that slides moves with it.
// Triangle: held along both axes; triangle on rollers: held across the rollers only; bar: held against rotation too;
// two bars with rollers between: held across them and against rotation; square: against rotation only.

import type { components } from "../../api/types";
import { type Point } from "../geometry";
import type { Occupancy } from "../labels";
import { group, line, path, pathData, shape, type Pixel, type Shape } from "../shape";
import { placeOf, toPixel, type Joint, type Scene, type View } from "./scene";

type Support = components["schemas"]["Support"];
type Spring = components["schemas"]["Spring"];

const kSymbol = 13;

/** A frame in pixels: `out` points away from the structure (down where there is a choice), `along` to its left. */
interface Frame {
  at: Pixel;
  out: Point;
  along: Point;
}

function frame(at: Pixel, angle: number): Frame {
  return { at, out: { x: Math.cos(angle), y: Math.sin(angle) }, along: { x: -Math.sin(angle), y: Math.cos(angle) } };
}

function offset(f: Frame, out: number, along: number): Pixel {
  return { x: f.at.x + out * f.out.x + along * f.along.x, y: f.at.y + out * f.out.y + along * f.along.y };
}

/** Hatched line across `out` at a distance. */
function groundLine(f: Frame, distance: number, half: number): Shape[] {
  let strokes = "";
  for (let a = -half + 2; a <= half; a += 5) {
    strokes += pathData([offset(f, distance, a), offset(f, distance + 5, a - 4)]);
  }
  return [line("support", offset(f, distance, -half), offset(f, distance, half)),
          shape("path", { class: "support-hatch", d: strokes })];
}

function triangle(f: Frame): Shape {
  return path("support-body", [offset(f, 0, 0), offset(f, kSymbol, -8), offset(f, kSymbol, 8)], true);
}

function rollers(f: Frame, distance: number, half: number): Shape[] {
  return [-half, 0, half].map((a) => {
    const centre = offset(f, distance, a);
    return shape("circle", { class: "support-body", cx: centre.x.toFixed(2), cy: centre.y.toFixed(2), r: 2 });
  });
}

/** Of the two senses of a direction, in pixels with y down, that which members leave least; down and left when equal. */
function outward(angle: number, joint: Joint): number {
  const score = (a: number) => {
    const away = joint.leaving.reduce((sum, t) => sum - (t.x * Math.cos(a) - t.y * Math.sin(a)), 0);
    const taste = 1.1 * Math.sin(a) - 0.2 * Math.cos(a);
    return away / joint.leaving.length + taste;
  };
  return score(angle) >= score(angle + Math.PI) ? angle : angle + Math.PI;
}

/** The direction that a clamp stands across: the mean tangent that leaves the node. */
function clampAngle(joint: Joint): number {
  const x = joint.leaving.reduce((sum, t) => sum + t.x, 0);
  const y = joint.leaving.reduce((sum, t) => sum + t.y, 0);
  return Math.hypot(x, y) < 0.1 ? Math.PI / 2 : Math.atan2(y, -x);
}

function supportShape(support: Support, joint: Joint, at: Pixel): Shape {
  const holds = new Set(support.fixed);
  const turn = (-(support.angle_degrees ?? 0) * Math.PI) / 180;  // pixels have y down
  const rotation = holds.has("rotation");
  if (holds.has("x") && holds.has("y")) {
    const angle = rotation ? clampAngle(joint) : outward(Math.PI / 2 + turn, joint);
    const f = frame(at, angle);
    return group("support-symbol",
                 ...(rotation ? [path("support-bar", [offset(f, 0, -11), offset(f, 0, 11)]), ...groundLine(f, 1, 11)]
                              : [triangle(f), ...groundLine(f, kSymbol, 12)]));
  }
  if (holds.has("x") || holds.has("y")) {
    const f = frame(at, outward((holds.has("y") ? Math.PI / 2 : Math.PI) + turn, joint));
    return group("support-symbol",
                 ...(rotation ? [line("support", offset(f, 3, -9), offset(f, 3, 9)), ...rollers(f, 6, 6),
                                 ...groundLine(f, 9, 11)]
                              : [triangle(f), ...rollers(f, kSymbol + 3, 5), ...groundLine(f, kSymbol + 6, 12)]));
  }
  const f = frame(at, Math.PI / 2);
  return group("support-symbol",
               path("support-body", [offset(f, -6, -6), offset(f, 6, -6), offset(f, 6, 6), offset(f, -6, 6)], true));
}

/** Symbols of all supports. */
export function supportShapes(scene: Scene, view: View, taken: Occupancy): Shape {
  const symbols = (scene.input.model.supports ?? []).map((support) => {
    const joint = scene.joints.get(support.node);
    if (!joint) return null;
    const at = toPixel(view, joint);
    taken.addBox({ left: at.x - 14, right: at.x + 14, top: at.y - 4, bottom: at.y + 18 }, 12);
    return supportShape(support, joint, at);
  });
  return group("supports", ...symbols);
}

const kSpringLength = 34;

/** A spring: a zigzag that ends in ground, with its gap, or at another node; a spiral for rotation. */
function springShape(spring: Spring, scene: Scene, view: View, taken: Occupancy): Shape | null {
  const place = placeOf(scene, spring.at);
  if (!place) return null;
  const state = scene.input.state?.springs[spring.id];
  const oneSided = (spring.reaction ?? "bilateral") !== "bilateral";
  const className = oneSided && state?.closed ? "spring contact-spring" : "spring";
  const tip = toPixel(view, place.moved);
  const other = spring.to ? placeOf(scene, spring.to) : null;
  if (other) {
    const end = toPixel(view, other.moved);
    const between = frame(tip, Math.atan2(end.y - tip.y, end.x - tip.x));
    return group("spring-symbol", path(className, zigzag(between, 0, Math.hypot(end.x - tip.x, end.y - tip.y))));
  }
  if (spring.direction === "rotation") return spiral(tip, className);
  const [dx, dy] = spring.direction;
  // the ground does not move: the far end stands where the undeformed structure says
  const still = toPixel(view, place.still);
  const gap = Math.min((spring.gap ?? 0) * view.scale, 60);
  const f = frame(still, Math.atan2(-dy, dx));
  const moved = (tip.x - still.x) * f.out.x + (tip.y - still.y) * f.out.y;
  const touches = !oneSided || state?.closed;
  const near = touches ? Math.min(moved, gap + kSpringLength - 8) : gap;
  const far = gap + kSpringLength;
  const drawn = touches ? { ...f, at: { x: tip.x - moved * f.out.x, y: tip.y - moved * f.out.y } } : f;
  const middle = [near + 6, far];
  for (const along of [-6, 0, 6]) taken.addLine(middle.map((out) => offset(drawn, out, along)), 30);
  const plate = oneSided ? path(className, [offset(drawn, near, -5), offset(drawn, near, 5)]) : null;
  return group("spring-symbol", path(className, zigzag(drawn, near, far)), plate, ...groundLine(drawn, far, 9));
}

function zigzag(f: Frame, near: number, far: number): Pixel[] {
  const points = [offset(f, near, 0), offset(f, near + 4, 0)];
  const turns = 6;
  const pitch = (far - near - 8) / turns;
  for (let i = 0; i < turns; ++i) points.push(offset(f, near + 4 + (i + 0.5) * pitch, i % 2 === 0 ? 5 : -5));
  points.push(offset(f, far - 4, 0), offset(f, far, 0));
  return points;
}

function spiral(centre: Pixel, className: string): Shape {
  const points: Pixel[] = [];
  for (let i = 0; i <= 48; ++i) {
    const angle = (i / 48) * 4.5 * Math.PI;
    const radius = 2 + (i / 48) * 11;
    points.push({ x: centre.x + radius * Math.cos(angle), y: centre.y + radius * Math.sin(angle) });
  }
  const end = points[points.length - 1] ?? centre;
  return group("spring-symbol", path(className, points), ...groundLine(frame(end, 0), 0, 7));
}

/** Symbols of all springs. */
export function springShapes(scene: Scene, view: View, taken: Occupancy): Shape {
  return group("springs", ...(scene.input.model.springs ?? []).map((spring) => springShape(spring, scene, view, taken)));
}

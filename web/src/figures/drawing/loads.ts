// Loads as arrows with their heads on the deformed structure: what acts in the state, that is proportional loads times
// its load factor; the model's own values where there is no state.

import type { components } from "../../api/types";
import { last, type Point } from "../geometry";
import { placeLabel, type Occupancy } from "../labels";
import { formatWithUnit, unitOf, type Quantity } from "../numbers";
import { group, pathData, shape, type Pixel, type Shape } from "../shape";
import { drawnLoadFactor, placeOf, placeOn, toPixel, type Place, type Scene, type View } from "./scene";

type Load = components["schemas"]["Load"];
type Distributed = Extract<Load, { type: "distributed" }>;
type Pressure = Extract<Load, { type: "pressure" }>;
type PointLoad = Extract<Load, { type: "point" }>;
type Strain = Extract<Load, { type: "initial_strain" | "temperature" }>;
type Amount = NonNullable<Extract<Load, { type: "temperature" }>["change"]>;

const kPointArrow = 46;
const kLineArrow = 26;
const kLineSpacing = 30;
const kHead = 8;

/** Lines and heads of arrows as two paths, so that a hundred arrows are two shapes; the values of the labels. */
class Arrows {
  lines = "";
  heads = "";
  notes: { at: Pixel; text: string; size: number }[] = [];
  drawn: [Pixel, Pixel][] = [];

  add(tail: Pixel, tip: Pixel): void {
    const length = Math.hypot(tip.x - tail.x, tip.y - tail.y);
    if (!(length > 2)) return;
    const ux = (tip.x - tail.x) / length;
    const uy = (tip.y - tail.y) / length;
    const head = Math.min(kHead, 0.6 * length);
    const neck = { x: tip.x - head * ux, y: tip.y - head * uy };
    const half = 0.42 * head;
    this.drawn.push([tail, tip]);
    this.lines += pathData([tail, neck]);
    this.heads += pathData([tip, { x: neck.x - half * uy, y: neck.y + half * ux },
                            { x: neck.x + half * uy, y: neck.y - half * ux }], true);
  }
}

function factorOf(load: Load, scene: Scene): number {
  return (load.pattern ?? "proportional") === "constant" ? 1 : drawnLoadFactor(scene);
}

/** A number that gives the arrows their direction when the load factor is zero. */
function senseOf(factor: number): number {
  return factor === 0 ? 1 : factor;
}

/** A force turned as the member's axis has turned at a place since it was undeformed. */
function turned([fx, fy]: readonly [number, number], { normal, tangent }: Place): readonly [number, number] {
  const still = { x: normal.y, y: -normal.x };
  const cosine = still.x * tangent.x + still.y * tangent.y;
  const sine = still.x * tangent.y - still.y * tangent.x;
  return [cosine * fx - sine * fy, sine * fx + cosine * fy];
}

/** The place nearest to a displaced one on the line of a force through the undeformed one. */
function footOnLine({ still, moved }: Place, [fx, fy]: readonly [number, number]): Point {
  const share = ((moved.x - still.x) * fx + (moved.y - still.y) * fy) / (fx * fx + fy * fy);
  return { x: still.x + share * fx, y: still.y + share * fy };
}

function pointArrow(load: PointLoad, scene: Scene, view: View, largest: number, arrows: Arrows): void {
  const place = placeOf(scene, load.at);
  if (!place) return;
  const factor = factorOf(load, scene);
  const at = toPixel(view, place.moved);
  const unit = (quantity: Quantity) => unitOf(scene.input.model.units, quantity);
  const [fx, fy] = load.follows ? turned(load.force, place) : load.force;
  const size = Math.hypot(fx, fy);
  if (size > 0) {
    const tip = load.fixed_line ? toPixel(view, footOnLine(place, load.force)) : at;
    if (load.fixed_line) arrows.lines += pathData([at, tip]);
    const sign = Math.sign(senseOf(factor));
    const length = kPointArrow * Math.max(0.45, size / largest);
    const tail = { x: tip.x - (sign * length * fx) / size, y: tip.y + (sign * length * fy) / size };
    const gap = { x: tip.x - (sign * 3 * fx) / size, y: tip.y + (sign * 3 * fy) / size };
    arrows.add(tail, gap);
    arrows.notes.push({ at: tail, text: formatWithUnit(Math.abs(factor) * size, unit("force")), size });
  }
  if (load.moment) {
    addMoment(at, load.moment * senseOf(factor) > 0, arrows);
    arrows.notes.push({
      at: { x: at.x + 14, y: at.y - 14 },
      text: formatWithUnit(Math.abs(factor * load.moment), unit("moment")), size: Math.abs(load.moment),
    });
  }
}

function addMoment(centre: Pixel, counterClockwise: boolean, arrows: Arrows): void {
  const radius = 17;
  const points: Pixel[] = [];
  for (let i = 0; i <= 24; ++i) {
    const angle = (-150 + i * 11.25) * (Math.PI / 180) * (counterClockwise ? -1 : 1) + (counterClockwise ? 0 : Math.PI);
    points.push({ x: centre.x + radius * Math.cos(angle), y: centre.y + radius * Math.sin(angle) });
  }
  arrows.lines += pathData(points.slice(0, -3));
  const tail = points[points.length - 4];
  const tip = points[points.length - 1];
  if (tail && tip) arrows.add(tail, tip);
}

/** Supports between members, whose symbols an arrow of a line load would cover. */
function heldPlaces(scene: Scene, view: View): Pixel[] {
  return (scene.input.model.supports ?? []).flatMap(({ node }) => {
    const joint = scene.joints.get(node);
    return joint && joint.leaving.length > 1 ? [toPixel(view, joint)] : [];
  });
}

/** Arrows along a member; `pull` gives the load at a place, in model axes, 1 for the largest. */
function lineArrows(range: readonly [number, number], member: string, scene: Scene, view: View,
                    pull: (s: number) => Point, arrows: Arrows): Pixel | null {
  const drawn = scene.members.get(member);
  if (!drawn) return null;
  const length = last(drawn.s);
  const [from, to] = range;
  const pixels = (to - from) * length * view.scale;
  const count = Math.min(60, Math.max(2, Math.round(pixels / kLineSpacing)));
  const symbols = heldPlaces(scene, view);
  let highest: Pixel | null = null;
  for (let i = 0; i <= count; ++i) {
    const s = (from + ((to - from) * i) / count) * length;
    const place = placeOn(drawn, s);
    const q = pull(s);
    const tip = toPixel(view, place.moved);
    const tail = { x: tip.x - kLineArrow * q.x, y: tip.y + kLineArrow * q.y };
    if (symbols.some((at) => Math.hypot(at.x - tip.x, at.y - tip.y) < 0.4 * kLineSpacing)) continue;
    arrows.add(tail, { x: tip.x - 2.5 * q.x, y: tip.y + 2.5 * q.y });
    if (highest === null || tail.y < highest.y) highest = tail;
  }
  return highest;
}

/** Largest force per length of a distributed load. */
export function largestForce({ force }: Distributed): number {
  return "along" in force ? Math.max(...force.along.map(([, value]) => Math.hypot(...value))) : Math.hypot(...force);
}

/** The pressure of largest size, with its sign. */
export function largestPressure({ value }: Pressure): number {
  if (typeof value === "number") return value;
  return value.along.reduce((most, [, one]) => Math.abs(one) > Math.abs(most) ? one : most, 0);
}

/** Two neighbours of a fraction among places that ascend, and its share of the way between them. */
function between<T>(along: readonly (readonly [number, T])[], fraction: number): [T, T, number] | null {
  const next = along.findIndex(([at]) => at > fraction);
  const after = along[next < 0 ? along.length - 1 : next];
  const before = along[next < 0 ? along.length - 1 : Math.max(0, next - 1)];
  if (!before || !after) return null;
  return [before[1], after[1], after[0] > before[0] ? (fraction - before[0]) / (after[0] - before[0]) : 0];
}

function pressureAt({ value }: Pressure, fraction: number): number {
  if (typeof value === "number") return value;
  const [before, after, share] = between(value.along, fraction) ?? [0, 0, 0];
  return before + share * (after - before);
}

/** Force per length at a fraction of the member, in the axes of the load. */
function forceAt({ force }: Distributed, fraction: number): readonly [number, number] {
  if (!("along" in force)) return force;
  const [before, after, share] = between(force.along, fraction) ?? [[0, 0], [0, 0], 0];
  return [before[0] + share * (after[0] - before[0]), before[1] + share * (after[1] - before[1])];
}

function distributedArrows(load: Distributed, scene: Scene, view: View, largest: number, arrows: Arrows): void {
  const drawn = scene.members.get(load.member);
  const size = largestForce(load);
  if (!drawn || size === 0) return;
  const factor = factorOf(load, scene);
  const scale = Math.sign(senseOf(factor)) * Math.max(0.5, size / largest) / size;
  const share = (s: number) => {
    const { normal } = placeOn(drawn, s);
    if (load.per === "horizontal") return Math.abs(normal.y);
    return load.per === "vertical" ? Math.abs(normal.x) : 1;
  };
  const pull = (s: number) => {
    const { tangent, normal } = placeOn(drawn, s);
    const [a, b] = forceAt(load, s / last(drawn.s));
    const [qx, qy] = load.axes === "member" ? [a * tangent.x + b * normal.x, a * tangent.y + b * normal.y] : [a, b];
    return { x: share(s) * scale * qx, y: share(s) * scale * qy };
  };
  const top = lineArrows(load.range ?? [0, 1], load.member, scene, view, pull, arrows);
  const unit = unitOf(scene.input.model.units, "line_load");
  if (top) arrows.notes.push({ at: top, text: formatWithUnit(Math.abs(factor) * size, unit), size });
}

function pressureArrows(load: Pressure, scene: Scene, view: View, largest: number, arrows: Arrows): void {
  const drawn = scene.members.get(load.member);
  const most = largestPressure(load);
  if (!drawn || most === 0) return;
  const factor = factorOf(load, scene);
  const side = load.side === "right" ? 1 : -1;
  const scale = side * Math.sign(senseOf(factor) * most) * Math.max(0.5, Math.abs(most) / largest);
  const pull = (s: number) => {
    const { tangent } = placeOn(drawn, s);
    const share = pressureAt(load, s / last(drawn.s)) / most;
    return { x: -share * scale * tangent.y, y: share * scale * tangent.x };
  };
  const top = lineArrows([0, 1], load.member, scene, view, pull, arrows);
  const unit = unitOf(scene.input.model.units, "line_load");
  const text = formatWithUnit(Math.abs(factor * most), unit);
  if (top) arrows.notes.push({ at: top, text, size: Math.abs(most) });
}

function strainNote(load: Strain, scene: Scene, view: View, arrows: Arrows): void {
  const drawn = scene.members.get(load.member);
  if (!drawn) return;
  const factor = factorOf(load, scene);
  const texts: string[] = [];
  const add = (name: string, value: Amount | undefined) => {
    if (value === undefined || value === 0) return;
    texts.push(typeof value === "number" ? `${name} ${formatWithUnit(factor * value, "", 3)}` : `${name} that varies`);
  };
  if (load.type === "initial_strain") {
    add("initial strain", load.axial);
    add("initial curvature", load.curvature);
  } else {
    add("temperature", load.change);
    add("temperature gradient", load.gradient);
  }
  const place = toPixel(view, placeOn(drawn, 0.35 * last(drawn.s)).moved);
  arrows.notes.push({ at: place, text: texts.join(", "), size: 0 });
}

function largestOf(loads: readonly Load[], type: "point" | "line"): number {
  const sizes = loads.map((load) => {
    if (load.type === "point") return type === "point" ? Math.hypot(...load.force) : 0;
    if (load.type === "distributed") return type === "line" ? largestForce(load) : 0;
    return load.type === "pressure" && type === "line" ? Math.abs(largestPressure(load)) : 0;
  });
  return sizes.reduce((most, size) => Math.max(most, size), 0) || 1;
}

/** Arrows of all loads; their labels take their places later, the largest first. */
export function loadShapes(scene: Scene, view: View, taken: Occupancy): { arrows: Shape; notes: () => Shape } {
  const loads = scene.input.model.loads ?? [];
  const largestPoint = largestOf(loads, "point");
  const largestLine = largestOf(loads, "line");
  const arrows = new Arrows();
  for (const load of loads) {
    if (load.type === "point") pointArrow(load, scene, view, largestPoint, arrows);
    else if (load.type === "distributed") distributedArrows(load, scene, view, largestLine, arrows);
    else if (load.type === "pressure") pressureArrows(load, scene, view, largestLine, arrows);
    else if (load.type !== "self_weight") strainNote(load, scene, view, arrows);
  }
  for (const arrow of arrows.drawn) taken.addLine(arrow, 20);
  if (scene.mirror !== null) {
    const twice = 2 * toPixel(view, { x: scene.mirror, y: 0 }).x;
    for (const arrow of arrows.drawn) taken.addLine(arrow.map((p) => ({ x: twice - p.x, y: p.y })), 20);
  }
  const drawn = group("loads", shape("path", { class: "load", d: arrows.lines }),
                      shape("path", { class: "load-head", d: arrows.heads }));
  return { arrows: drawn, notes: () => group("load-notes", ...notesOf(arrows, taken)) };
}

/** At most four labels, and each text once: equal loads are read from one of them. */
function notesOf(arrows: Arrows, taken: Occupancy): (Shape | null)[] {
  const seen = new Set<string>();
  const texts = [...arrows.notes].sort((a, b) => b.size - a.size).filter(({ text }) => {
    if (text === "" || seen.has(text)) return false;
    seen.add(text);
    return true;
  });
  return texts.slice(0, 4).map(({ at, text }) =>
    placeLabel({ at, runs: [{ text }], className: "note", prefer: 0, tolerance: 90 }, taken));
}

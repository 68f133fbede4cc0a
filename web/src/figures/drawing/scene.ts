// The members of a drawing with their undeformed and deformed axes, and how the model's axes lie on the figure.

import type { components } from "../../api/types";
import {
  at, interpolate, last, leftNormals, memberAxis, type Axis, type Point,
} from "../geometry";
import type { Pixel, Size } from "../shape";
import { withSoil, type GivenFoundation, type GivenModel } from "../soil";
import { largestGap, wayInto, type Way } from "./medium";

type Schemas = components["schemas"];
export type Model = Schemas["Model"];
export type State = Schemas["State"];
export type Mode = Schemas["Mode"];
export type Location = Schemas["Location"];
export type Foundation = GivenFoundation;

/**
 * What is drawn. Lengths in the model's unit, x to the right, y up; signs as docs/results.md (Axes and signs).
 */
export interface DrawingInput {
  model: Model;
  /** Deformed shape, contact and reactions; the model alone when left out. */
  state?: State | null | undefined;
  /** A mode drawn over the state, or over the undeformed axis. */
  mode?: Mode | null | undefined;
  /** The shape of the mode's motion a quarter of a period later; left out where the whole motion then passes the equilibrium. */
  quadrature?: Mode | null | undefined;
  /** Displacements are drawn so many times as large; 1, true scale, when left out. */
  factor?: number | undefined;
  /** The load factor when there is no state, such as that of a buckling mode. */
  loadFactor?: number | null | undefined;
  /** States that the view must have room for as well, so that it does not move while they are walked through. */
  room?: readonly State[] | undefined;
  /** A place that is pointed at. */
  cursor?: { member: string; s: number } | null | undefined;
  /** Whether the state is known to be unstable; the caption says so. */
  unstable?: boolean | undefined;
  /** Whether to draw the mirror image of a half structure as well; when left out, where `symmetryLine` finds a closed half. */
  mirror?: boolean | undefined;
  /** Whether to draw overall dimensions; true when left out. */
  dimensions?: boolean | undefined;
  /** Whether to say in the figure what it shows; true when left out. */
  caption?: boolean | undefined;
}

/** A member; lists of equal length. */
export interface DrawnMember {
  id: string;
  start: string;
  end: string;
  s: readonly number[];
  x0: readonly number[];
  y0: readonly number[];
  /** Deformed, with the factor. */
  x: readonly number[];
  y: readonly number[];
  /** Initial left normals. */
  normals: readonly Point[];
}

export interface Scene {
  /** As given, but for foundations that name a soil. */
  input: Omit<DrawingInput, "model"> & { model: GivenModel };
  members: ReadonlyMap<string, DrawnMember>;
  /** A node's undeformed and deformed place, and the members that meet there with the tangents that leave it. */
  joints: ReadonlyMap<string, Joint>;
  box: { left: number; right: number; bottom: number; top: number };
  /** Vertical line that the structure is mirrored at; null when it is drawn as it is. */
  mirror: number | null;
  /** Larger side of the undeformed structure's box. */
  extent: number;
  /** Depth of the ground that is drawn. */
  depth: number;
  deformed: boolean;
}

export interface Joint {
  x0: number;
  y0: number;
  x: number;
  y: number;
  leaving: Point[];
}

function drawnMember(id: string, ends: { start: string; end: string }, axis: Axis, state: State | null,
                     factor: number): DrawnMember {
  const found = state?.members[id];
  const base = { id, start: ends.start, end: ends.end };
  if (!found || found.s.length < 2) {
    return { ...base, s: axis.s, x0: axis.x, y0: axis.y, x: axis.x, y: axis.y, normals: leftNormals(axis.x, axis.y) };
  }
  const moved = (from: readonly number[], by: readonly number[]) => from.map((v, i) => v + factor * at(by, i));
  return {
    ...base, s: found.s, x0: found.x0, y0: found.y0,
    x: factor === 1 ? found.x : moved(found.x0, found.u),
    y: factor === 1 ? found.y : moved(found.y0, found.v),
    normals: leftNormals(found.x0, found.y0),
  };
}

function addJoint(joints: Map<string, Joint>, node: string, member: DrawnMember, atStart: boolean): void {
  const n = member.s.length;
  const i = atStart ? 0 : n - 1;
  const next = atStart ? 1 : n - 2;
  const dx = at(member.x0, next) - at(member.x0, i);
  const dy = at(member.y0, next) - at(member.y0, i);
  const length = Math.hypot(dx, dy) || 1;
  const leaving = { x: dx / length, y: dy / length };
  const known = joints.get(node);
  if (known) {
    known.leaving.push(leaving);
    return;
  }
  joints.set(node, {
    x0: at(member.x0, i), y0: at(member.y0, i), x: at(member.x, i), y: at(member.y, i), leaving: [leaving],
  });
}

/** The members and joints of the input; members whose nodes are missing or coincide are left out. */
/** Share of the structure's extent: how large a mode is drawn. */
export const kModeShare = 0.1;

/** How far a mode reaches in both of its directions, and in all phases of a motion that has two shapes. */
function reachOfMode({ mode, quadrature }: DrawingInput, members: ReadonlyMap<string, DrawnMember>, extent: number): { x: number[]; y: number[] }[] {
  return Object.entries(mode?.members ?? {}).flatMap(([id, { s, u, v }]) => {
    const member = members.get(id);
    const later = quadrature?.members[id];
    if (!member) return [];
    const reach = (now: readonly number[], then: readonly number[] | undefined, i: number): number =>
      kModeShare * extent * Math.hypot(at(now, i), then ? at(then, i) : 0);
    return [-1, 1].map((sign) => ({
      x: s.map((here, i) => interpolate(member.s, member.x, here) + sign * reach(u, later?.u, i)),
      y: s.map((here, i) => interpolate(member.s, member.y, here) + sign * reach(v, later?.v, i)),
    }));
  });
}

export function makeScene(given: DrawingInput): Scene {
  const input = { ...given, ...withSoil(given.model, given.state) };
  const nodes = new Map(input.model.nodes.map((node) => [node.id, node]));
  const members = new Map<string, DrawnMember>();
  const joints = new Map<string, Joint>();
  for (const member of input.model.members) {
    const axis = memberAxis(member, nodes, input.model.imperfections);
    if (!axis) continue;
    const drawn = drawnMember(member.id, member, axis, input.state ?? null, input.factor ?? 1);
    members.set(member.id, drawn);
    addJoint(joints, member.start, drawn, true);
    addJoint(joints, member.end, drawn, false);
  }
  const still = boxOf([...members.values()].map((m) => ({ x: m.x0, y: m.y0 })));
  const extent = Math.max(still.right - still.left, still.top - still.bottom) || 1;
  const shapes = [...members.values()].flatMap((m) => [{ x: m.x0, y: m.y0 }, { x: m.x, y: m.y }]);
  for (const state of input.room ?? []) {
    for (const member of Object.values(state.members)) shapes.push({ x: member.x, y: member.y });
  }
  shapes.push(...reachOfMode(input, members, extent));
  const gaps = (input.model.foundations ?? []).map(largestGap).filter((gap) => gap < extent);
  const depth = Math.max(0.13 * extent, ...gaps.map((gap) => 0.8 * gap));
  const symmetry = input.mirror === false ? null : symmetryLine(input.model, members, extent);
  const mirror = symmetry && (input.mirror || symmetry.ends > 1) ? symmetry.x : null;
  return { input, members, joints, box: boxOf(shapes), extent, depth, deformed: Boolean(input.state), mirror };
}

/**
 * The vertical line that a model is one half beside: where supports hold x and rotation and nothing else, as symmetry does,
 * all of them at one x with the whole structure on one side. `ends` is the number of such supports; null when there is none.
 */
function symmetryLine(model: Model, members: ReadonlyMap<string, DrawnMember>, extent: number):
    { x: number; ends: number } | null {
  const nodes = new Map(model.nodes.map((node) => [node.id, node]));
  const places: number[] = [];
  for (const support of model.supports ?? []) {
    const holds = new Set(support.fixed);
    if (holds.size !== 2 || holds.has("y") || support.angle_degrees) continue;
    const node = nodes.get(support.node);
    if (node) places.push(node.x);
  }
  const [x] = places;
  const slack = 1e-6 * extent;
  if (x === undefined || places.some((place) => Math.abs(place - x) > slack)) return null;
  const all = [...members.values()].flatMap((member) => [...member.x0]);
  const oneSide = all.every((value) => value >= x - slack) || all.every((value) => value <= x + slack);
  return oneSide ? { x, ends: places.length } : null;
}

/** A scene's box with the mirror image in it. */
function mirrored(box: Scene["box"], mirror: number | null): Scene["box"] {
  if (mirror === null) return box;
  return { ...box, left: Math.min(box.left, 2 * mirror - box.right), right: Math.max(box.right, 2 * mirror - box.left) };
}

function boxOf(lines: { x: readonly number[]; y: readonly number[] }[]): Scene["box"] {
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (const { x, y } of lines) {
    for (let i = 0; i < x.length; ++i) {
      box.left = Math.min(box.left, at(x, i));
      box.right = Math.max(box.right, at(x, i));
      box.bottom = Math.min(box.bottom, at(y, i));
      box.top = Math.max(box.top, at(y, i));
    }
  }
  return Number.isFinite(box.left + box.right + box.top + box.bottom) ? box : { left: 0, right: 1, bottom: 0, top: 1 };
}

/** How the model lies on the figure: pixel = (left + scale x, top - scale y). */
export interface View {
  scale: number;
  left: number;
  top: number;
}

export function toPixel(view: View, point: Point): Pixel {
  return { x: view.left + view.scale * point.x, y: view.top - view.scale * point.y };
}

export function toModel(view: View, pixel: Pixel): Point {
  return { x: (pixel.x - view.left) / view.scale, y: (view.top - pixel.y) / view.scale };
}

/** The view zoomed by a factor about a pixel, and moved. */
export function zoomed(view: View, factor: number, about: Pixel, moved: Pixel = { x: 0, y: 0 }): View {
  return {
    scale: view.scale * factor,
    left: about.x + factor * (view.left - about.x) + moved.x,
    top: about.y + factor * (view.top - about.y) + moved.y,
  };
}

/** Foundations with ground beside the member: all but those along its tangent and against rotation, which act on its surface. */
export function foundationsWithGround(scene: Scene): Foundation[] {
  return (scene.input.model.foundations ?? []).filter((item) => !("component" in item && item.component !== "normal"));
}

/** The way into a foundation's medium from a place of its member. @param s arc length of the initial axis */
export function wayFrom(foundation: Foundation, member: DrawnMember, s: number): Way {
  const of = (values: readonly number[]) => interpolate(member.s, values, s);
  return wayInto(foundation, {
    point: { x: of(member.x0), y: of(member.y0) },
    normal: { x: of(member.normals.map((n) => n.x)), y: of(member.normals.map((n) => n.y)) },
    fraction: s / (last(member.s) || 1),
  });
}

/** The box of the structure and its ground, mirror image included. */
export function boxWithGround(scene: Scene): Scene["box"] {
  const box = { ...scene.box };
  for (const foundation of foundationsWithGround(scene)) {
    const member = scene.members.get(foundation.member);
    if (!member) continue;
    const pulls = scene.deformed && (foundation.reaction ?? "bilateral") !== "compression_only";
    const include = (x: number, y: number) => {
      box.left = Math.min(box.left, x);
      box.right = Math.max(box.right, x);
      box.bottom = Math.min(box.bottom, y);
      box.top = Math.max(box.top, y);
    };
    const outline = "outline" in foundation ? foundation.outline : undefined;
    if (outline && "points" in outline) for (const [x, y] of outline.points) include(x ?? 0, y ?? 0);
    member.s.forEach((s, i) => {
      const { into: d, gap } = wayFrom(foundation, member, s);
      const reach = Math.min(gap, scene.extent) + scene.depth;
      include(at(member.x0, i) + reach * d.x, at(member.y0, i) + reach * d.y);
      for (const sign of pulls ? [-1, 1] : []) {
        include(at(member.x, i) + sign * 0.8 * scene.depth * d.x, at(member.y, i) + sign * 0.8 * scene.depth * d.y);
      }
    });
  }
  return mirrored(box, scene.mirror);
}

/** Room around the structure and its ground for caption, arrows, symbols and dimensions, in pixels. */
function marginOf(scene: Scene): { left: number; right: number; top: number; bottom: number } {
  const loads = scene.input.model.loads ?? [];
  const points = loads.some((load) => load.type === "point");
  const sideways = loads.some((load) => load.type === "point" && load.force[0] !== 0);
  const above = points ? 54 : loads.length > 0 ? 36 : 24;
  if (scene.input.dimensions === false) return { left: 24, right: sideways ? 58 : 24, top: above, bottom: 24 };
  return { left: 58, right: sideways ? 58 : 40, top: above + ((scene.input.caption ?? true) ? 18 : 0), bottom: 58 };
}

/** A view that shows the whole structure with its ground, loads, supports and dimensions. */
export function sceneView(scene: Scene, size: Size): View {
  const box = boxWithGround(scene);
  const margin = marginOf(scene);
  const width = Math.max(20, size.width - margin.left - margin.right);
  const height = Math.max(20, size.height - margin.top - margin.bottom);
  const scale = Math.min(width / Math.max(box.right - box.left, 1e-9 * scene.extent),
                         height / Math.max(box.top - box.bottom, 1e-9 * scene.extent));
  return {
    scale,
    left: margin.left + width / 2 - (scale * (box.left + box.right)) / 2,
    top: margin.top + height / 2 + (scale * (box.bottom + box.top)) / 2,
  };
}

/** A place on a member: undeformed, deformed, initial left normal and deformed unit tangent. */
export interface Place {
  member: DrawnMember;
  s: number;
  still: Point;
  moved: Point;
  normal: Point;
  tangent: Point;
}

export function placeOn(member: DrawnMember, s: number): Place {
  const pick = (values: readonly number[]) => interpolate(member.s, values, s);
  const h = last(member.s) / 400;
  const dx = interpolate(member.s, member.x, s + h) - interpolate(member.s, member.x, s - h);
  const dy = interpolate(member.s, member.y, s + h) - interpolate(member.s, member.y, s - h);
  const length = Math.hypot(dx, dy) || 1;
  const ux = interpolate(member.s, member.x0, s + h) - interpolate(member.s, member.x0, s - h);
  const uy = interpolate(member.s, member.y0, s + h) - interpolate(member.s, member.y0, s - h);
  const still = Math.hypot(ux, uy) || 1;
  return {
    member, s,
    still: { x: pick(member.x0), y: pick(member.y0) },
    moved: { x: pick(member.x), y: pick(member.y) },
    normal: { x: -uy / still, y: ux / still },
    tangent: { x: dx / length, y: dy / length },
  };
}

/** The place of a location; that of a node is on a member that ends there. */
export function placeOf(scene: Scene, location: Location): Place | null {
  if ("member" in location) {
    const member = scene.members.get(location.member);
    return member ? placeOn(member, location.fraction * last(member.s)) : null;
  }
  for (const member of scene.members.values()) {
    if (member.start === location.node) return placeOn(member, 0);
    if (member.end === location.node) return placeOn(member, last(member.s));
  }
  return null;
}

/** The load factor that the actions are drawn at; 1 where there is none, so that the model's own are shown. */
export function drawnLoadFactor(scene: Scene): number {
  return scene.input.state?.load_factor ?? scene.input.loadFactor ?? 1;
}

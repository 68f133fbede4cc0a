// What the state says at the nearest point of the structure.

import { at, interpolate, last } from "../geometry";
import { makeScene, sceneView, toPixel, type DrawingInput, type DrawnMember, type Scene, type View } from "./scene";
import type { Pixel, Size } from "../shape";

/** Signs and units as docs/results.md: N tension positive, Q along the left normal, M turning to the left positive. */
export interface Located {
  member: string;
  /** Undeformed arc length from the member's start, and the member's length. */
  s: number;
  length: number;
  /** Where the point is in the figure, and how far away, in pixels. */
  pixel: Pixel;
  distance: number;
  /** What the state says there; null without a state. */
  state: LocatedState | null;
}

export interface LocatedState {
  u: number;
  v: number;
  displacement: number;
  rotation: number;
  N: number;
  Q: number;
  M: number;
  /** Reactions of the foundations that lie along there, positive when the medium pushes. */
  reactions: { foundation: string; reaction: number; contact: boolean }[];
}

interface Nearest {
  member: DrawnMember;
  s: number;
  pixel: Pixel;
  distance: number;
}

function nearestOn(member: DrawnMember, view: View, to: Pixel): Nearest | null {
  let best: Nearest | null = null;
  let a = toPixel(view, { x: at(member.x, 0), y: at(member.y, 0) });
  for (let i = 1; i < member.x.length; ++i) {
    const b = toPixel(view, { x: at(member.x, i), y: at(member.y, i) });
    const dx = b.x - a.x;
    const dy = b.y - a.y;
    const square = dx * dx + dy * dy;
    const t = square > 0 ? Math.min(1, Math.max(0, ((to.x - a.x) * dx + (to.y - a.y) * dy) / square)) : 0;
    const pixel = { x: a.x + t * dx, y: a.y + t * dy };
    const distance = Math.hypot(to.x - pixel.x, to.y - pixel.y);
    if (best === null || distance < best.distance) {
      best = { member, s: at(member.s, i - 1) + t * (at(member.s, i) - at(member.s, i - 1)), pixel, distance };
    }
    a = b;
  }
  return best;
}

function reactionsAt(scene: Scene, member: string, s: number): LocatedState["reactions"] {
  const found: LocatedState["reactions"] = [];
  for (const foundation of scene.input.model.foundations ?? []) {
    const state = scene.input.state?.foundations[foundation.id];
    if (foundation.member !== member || !state || state.s.length === 0) continue;
    if (s < at(state.s, 0) || s > last(state.s)) continue;
    found.push({
      foundation: foundation.id,
      reaction: interpolate(state.s, state.reaction, s),
      contact: state.contact.some(([from, to]) => s >= from && s <= to),
    });
  }
  return found;
}

/** What the state says at a place of a member; null without a state. */
export function stateAt(scene: Scene, member: string, s: number): LocatedState | null {
  const state = scene.input.state?.members[member];
  if (!state) return null;
  const value = (list: readonly number[]) => interpolate(state.s, list, s);
  const u = value(state.u);
  const v = value(state.v);
  return {
    u, v, displacement: Math.hypot(u, v), rotation: value(state.rotation),
    N: value(state.axial_force), Q: value(state.shear_force), M: value(state.bending_moment),
    reactions: reactionsAt(scene, member, s),
  };
}

function nearestIn(scene: Scene, view: View, to: Pixel): Nearest | null {
  let best: Nearest | null = null;
  for (const member of scene.members.values()) {
    const next = nearestOn(member, view, to);
    if (next && (best === null || next.distance < best.distance)) best = next;
  }
  return best;
}

/** The nearest point of the drawn structure, its mirror image included; null when nothing is drawn. */
export function locate(input: DrawingInput, size: Size, to: Pixel, view?: View): Located | null {
  const scene = makeScene(input);
  const shown = view ?? sceneView(scene, size);
  const own = nearestIn(scene, shown, to);
  if (own === null) return null;
  let best = own;
  if (scene.mirror !== null) {
    const twice = 2 * toPixel(shown, { x: scene.mirror, y: 0 }).x;
    const image = nearestIn(scene, shown, { x: twice - to.x, y: to.y });
    if (image && image.distance < own.distance) best = { ...image, pixel: { x: twice - image.pixel.x, y: image.pixel.y } };
  }
  const { member, s, pixel, distance } = best;
  return { member: member.id, s, length: last(member.s), pixel, distance, state: stateAt(scene, member.id, s) };
}

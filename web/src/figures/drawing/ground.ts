// The ground: hatched on its side of the member, as far away as its gap; where it touches, and its reaction.
// A foundation's reaction is drawn from the deformed axis into the medium where the medium pushes (positive, docs/results.md),
// and to the other side where it pulls.

import { at, interpolate, last, type Point } from "../geometry";
import { placeLabel, type Occupancy } from "../labels";
import { formatWithUnit, unitOf } from "../numbers";
import { withPeaks } from "../peaks";
import { coordinate, group, path, pathData, shape, type Pixel, type Shape, type Size } from "../shape";
import { largestForce, largestPressure } from "./loads";
import { drawnLoadFactor, foundationsWithGround, toPixel, wayFrom, type DrawnMember, type Foundation, type Scene, type View } from "./scene";

const kHatchSpacing = 9;

/** Places of a member within a foundation's range, the range's ends among them. */
function rangePlaces(member: DrawnMember, foundation: Foundation): number[] {
  const length = last(member.s);
  const [from, to] = foundation.range ?? [0, 1];
  const inside = member.s.filter((s) => s > from * length && s < to * length);
  return [from * length, ...inside, to * length];
}

interface Surface {
  points: Point[];
  directions: Point[];
}

/** The surface of the ground beside the initial axis. @param farthest largest distance that is drawn */
function surfaceOf(member: DrawnMember, foundation: Foundation, farthest: number): Surface {
  const points: Point[] = [];
  const directions: Point[] = [];
  for (const s of rangePlaces(member, foundation)) {
    const { into, gap } = wayFrom(foundation, member, s);
    const distance = Math.min(gap, farthest);
    directions.push(into);
    points.push({
      x: interpolate(member.s, member.x0, s) + distance * into.x,
      y: interpolate(member.s, member.y0, s) + distance * into.y,
    });
  }
  return { points, directions };
}

/** The surface of a medium whose outline has points, side by side. */
function surfaceThrough(points: readonly (readonly number[])[], sense: number): Surface {
  const surface: Surface = { points: [], directions: [] };
  points.slice(1).forEach((b, i) => {
    const a = points[i] ?? b;
    const [ax = 0, ay = 0] = a;
    const [bx = 0, by = 0] = b;
    const length = Math.hypot(bx - ax, by - ay) || 1;
    const into = { x: (-sense * (by - ay)) / length, y: (sense * (bx - ax)) / length };
    surface.points.push({ x: ax, y: ay }, { x: bx, y: by });
    surface.directions.push(into, into);
  });
  return surface;
}

/** The surface of the ground of a foundation. */
function groundOf(member: DrawnMember, foundation: Foundation, farthest: number): Surface {
  const outline = "outline" in foundation ? foundation.outline : undefined;
  return outline && "points" in outline ? surfaceThrough(outline.points, outline.medium === "left" ? 1 : -1)
    : surfaceOf(member, foundation, farthest);
}

/** Depth that does not run over the centre of curvature on a member's hollow side. */
function depthOf(surface: Surface, depth: number): number {
  let least = depth;
  const { points, directions } = surface;
  for (let i = 1; i < points.length; ++i) {
    const a = points[i - 1], b = points[i], da = directions[i - 1], db = directions[i];
    if (!a || !b || !da || !db) continue;
    const step = Math.hypot(b.x - a.x, b.y - a.y);
    const closer = step > 0 ? -((db.x - da.x) * (b.x - a.x) + (db.y - da.y) * (b.y - a.y)) / (step * step) : 0;
    if (closer > 0) least = Math.min(least, 0.7 / closer);
  }
  return Math.max(least, 0.3 * depth);
}

/** Pieces of lines at 45 degrees inside polygons (non-zero winding), as one path. */
function hatch(polygons: readonly Pixel[][], size: Size): string {
  let text = "";
  const margin = 40;
  const end = size.width + size.height + margin;
  for (const polygon of polygons) {
    const crossings = new Map<number, { t: number; way: number }[]>();
    polygon.forEach((a, i) => {
      const b = polygon[(i + 1) % polygon.length];
      if (b) addCrossings(crossings, a, b, -margin, end);
    });
    for (const [sum, cuts] of crossings) text += hatchLine(sum, cuts);
  }
  return text;
}

/** Where an edge crosses the lines x + y = k spacing; t is x along the line. */
function addCrossings(crossings: Map<number, { t: number; way: number }[]>, a: Pixel, b: Pixel, low: number,
                      high: number): void {
  const from = a.x + a.y;
  const to = b.x + b.y;
  if (from === to || !Number.isFinite(from + to)) return;
  const first = Math.ceil(Math.max(low, Math.min(from, to)) / kHatchSpacing) * kHatchSpacing;
  for (let sum = first; sum < Math.min(high, Math.max(from, to)); sum += kHatchSpacing) {
    const t = a.x + ((sum - from) / (to - from)) * (b.x - a.x);
    const cuts = crossings.get(sum) ?? [];
    cuts.push({ t, way: to > from ? 1 : -1 });
    crossings.set(sum, cuts);
  }
}

function hatchLine(sum: number, cuts: { t: number; way: number }[]): string {
  cuts.sort((a, b) => a.t - b.t);
  let text = "";
  let winding = 0;
  let begin = 0;
  for (const { t, way } of cuts) {
    const next = winding + way;
    if (winding === 0) begin = t;
    else if (next === 0) text += pathData([{ x: begin, y: sum - begin }, { x: t, y: sum - t }]);
    winding = next;
  }
  return text;
}

/** The ground of all foundations. */
export function groundShapes(scene: Scene, view: View, size: Size): Shape {
  const bands: Pixel[][] = [];
  const surfaces: Pixel[][] = [];
  for (const foundation of foundationsWithGround(scene)) {
    const member = scene.members.get(foundation.member);
    if (!member) continue;
    const surface = groundOf(member, foundation, scene.extent);
    const depth = depthOf(surface, scene.depth);
    const inner = surface.points.map((p) => toPixel(view, p));
    const outer = surface.points.map((p, i) => {
      const d = surface.directions[i] ?? { x: 0, y: 0 };
      return toPixel(view, { x: p.x + depth * d.x, y: p.y + depth * d.y });
    });
    bands.push([...inner, ...outer.reverse()]);
    surfaces.push(inner);
  }
  if (scene.mirror !== null) {
    const twice = 2 * toPixel(view, { x: scene.mirror, y: 0 }).x;
    const turned = (points: Pixel[]) => points.map((p) => ({ x: twice - p.x, y: p.y })).reverse();
    bands.push(...bands.map(turned));
    surfaces.push(...surfaces.map(turned));
  }
  return group(
    "ground",
    ...bands.map((band) => path("ground-body", band, true)),
    shape("path", { class: "ground-hatch", d: hatch(bands, size) }),
    ...surfaces.map((surface) => path("ground-surface", surface)),
  );
}

const kRounding = 1e-6;  // of the largest axial force over the structure's size

/** The reaction that is drawn as the ground's depth: the largest, but no less than a fiftieth of the line loads or rounding. */
function referenceReaction(scene: Scene): number {
  let largest = 0;
  for (const load of scene.input.model.loads ?? []) {
    const size = load.type === "distributed" ? largestForce(load) : load.type === "pressure" ? largestPressure(load) : 0;
    largest = Math.max(largest, 0.02 * Math.abs(size * drawnLoadFactor(scene)));
  }
  for (const { axial_force: forces } of Object.values(scene.input.state?.members ?? {})) {
    for (const force of forces) largest = Math.max(largest, (kRounding * Math.abs(force)) / scene.extent);
  }
  for (const { id } of foundationsWithGround(scene)) {
    const state = scene.input.state?.foundations[id];
    const peaks = state?.extremes ? [state.extremes.min.value, state.extremes.max.value] : [];
    for (const value of [...(state?.reaction ?? []), ...peaks]) largest = Math.max(largest, Math.abs(value));
  }
  return largest;
}

interface Profile {
  base: Pixel[];
  tips: Pixel[];
  /** Index of the largest reaction. */
  peak: number;
  value: number;
}

function profileOf(scene: Scene, view: View, foundation: Foundation, member: DrawnMember, scale: number): Profile {
  const state = scene.input.state?.foundations[foundation.id];
  const profile: Profile = { base: [], tips: [], peak: 0, value: 0 };
  const line = withPeaks({ s: state?.s ?? [], values: state?.reaction ?? [] }, state?.extremes);
  line.s.forEach((s, i) => {
    const { into: d } = wayFrom(foundation, member, s);
    const p = { x: interpolate(member.s, member.x, s), y: interpolate(member.s, member.y, s) };
    const value = at(line.values, i);
    if (Math.abs(value) > Math.abs(profile.value)) {
      profile.peak = i;
      profile.value = value;
    }
    profile.base.push(toPixel(view, p));
    profile.tips.push(toPixel(view, { x: p.x + scale * value * d.x, y: p.y + scale * value * d.y }));
  });
  return profile;
}

/** Pieces of a member's deformed axis that touch a one-sided foundation. */
function contactLines(foundation: Foundation, member: DrawnMember, contact: readonly (readonly [number, number])[],
                      view: View): Shape[] {
  if ((foundation.reaction ?? "bilateral") === "bilateral") return [];
  return contact.map(([from, to]) => {
    const places = [from, ...member.s.filter((s) => s > from && s < to), to];
    const points = places.map((s) => toPixel(view, {
      x: interpolate(member.s, member.x, s), y: interpolate(member.s, member.y, s),
    }));
    return path("contact", points);
  });
}

/** Reactions of foundations under the members, and contact zones over them; labels take their places. */
export function reactionShapes(scene: Scene, view: View, taken: Occupancy): { under: Shape; over: Shape; text: Shape } {
  const reference = referenceReaction(scene);
  const scale = reference > 0 ? (0.85 * scene.depth) / reference : 0;
  const unit = unitOf(scene.input.model.units, "line_load");
  const under: Shape[] = [];
  const over: Shape[] = [];
  const peaks: { at: Pixel; value: number }[] = [];
  for (const foundation of foundationsWithGround(scene)) {
    const member = scene.members.get(foundation.member);
    const state = scene.input.state?.foundations[foundation.id];
    if (!member || !state) continue;
    over.push(...contactLines(foundation, member, state.contact, view));
    if (scale === 0) continue;
    const profile = profileOf(scene, view, foundation, member, scale);
    under.push(path("reaction", [...profile.base, ...[...profile.tips].reverse()], true));
    under.push(path("reaction-line", profile.tips));
    taken.addLine(profile.tips, 3);
    const tip = profile.tips[profile.peak];
    if (tip && Math.abs(profile.value) > 0.02 * reference) peaks.push({ at: tip, value: profile.value });
  }
  peaks.sort((a, b) => Math.abs(b.value) - Math.abs(a.value));
  const text = peaks.slice(0, 1).map(({ at: tip, value }) => placeLabel({
    at: { x: coordinate(tip.x), y: coordinate(tip.y) },
    runs: [{ text: `r = ${formatWithUnit(value, unit, 3)}`, bold: true }],
    className: "note contact-text", tolerance: 140, leader: true,
  }, taken));
  return { under: group("reactions", ...under), over: group("contacts", ...over), text: group("reaction-notes", ...text) };
}

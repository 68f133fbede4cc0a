// The drawing: a model and a state of its result. Undeformed thin, deformed thick at true scale unless a factor is given,
// ground hatched on its side, contact and reactions in orange, loads as arrows, monitors, supports, dimensions.

import { at, interpolate } from "../geometry";
import { Occupancy } from "../labels";
import { coordinate, figure, group, line, path, shape, type Pixel, type Shape, type Size } from "../shape";
import { groundShapes, reactionShapes } from "./ground";
import { loadShapes } from "./loads";
import { captionShape, dimensionShapes, sceneCaption, hingeShapes, monitorShapes } from "./notes";
import {
  kModeShare, makeScene, placeOn, sceneView, toPixel, type DrawingInput, type DrawnMember, type Scene, type View,
} from "./scene";
import { springShapes, supportShapes } from "./supports";

function pixels(x: readonly number[], y: readonly number[], view: View): Pixel[] {
  return x.map((value, i) => toPixel(view, { x: value, y: at(y, i) }));
}

/**
 * The lines of the mode, a list of pixels for each member, by the phase of the motion in radians: `mode` is the shape at 0,
 * `quadrature` that at pi / 2, and minus `mode` that at pi.
 */
function modeLines({ input, members, extent }: Scene, view: View): (phase: number) => Pixel[][] {
  const amplitude = kModeShare * extent;
  const lines = Object.entries(input.mode?.members ?? {}).flatMap(([id, shapeOfMember]) => {
    const member = members.get(id);
    const quadrature = input.quadrature?.members[id];
    if (!member) return [];
    return [shapeOfMember.s.map((s, i) => ({
      x: interpolate(member.s, member.x, s), u: at(shapeOfMember.u, i), uLater: quadrature ? at(quadrature.u, i) : 0,
      y: interpolate(member.s, member.y, s), v: at(shapeOfMember.v, i), vLater: quadrature ? at(quadrature.v, i) : 0,
    }))];
  });
  return (phase) => {
    const now = Math.cos(phase);
    const later = Math.sin(phase);
    return lines.map((line) => line.map(({ x, u, uLater, y, v, vLater }) => toPixel(view, {
      x: x + amplitude * (now * u + later * uLater), y: y + amplitude * (now * v + later * vLater),
    })));
  };
}

function modeGroup(lines: readonly Pixel[][]): Shape {
  return group("modes", ...lines.map((points) => path("mode", points)));
}

/** The group `modes` of `drawingFigure` by the phase of the motion in radians; that of phase 0 is in the figure. */
export function modeMotion(input: DrawingInput, view: View): (phase: number) => Shape {
  const lines = modeLines(makeScene(input), view);
  return (phase) => modeGroup(lines(phase));
}

function modeShapes(scene: Scene, view: View, taken: Occupancy): Shape | null {
  if (!scene.input.mode) return null;
  const lines = modeLines(scene, view)(0);
  for (const points of lines) taken.addLine(points, 30);
  return modeGroup(lines);
}

/** Whether a member that carries a force of one sense alone carries none in the drawn state. */
function isSlack(scene: Scene, id: string): boolean {
  const member = scene.input.model.members.find((one) => one.id === id);
  const state = scene.input.state?.members[id];
  return (member?.reaction ?? "bilateral") !== "bilateral" && state !== undefined && state.axial_force[0] === 0;
}

/** The undeformed axes, and over them the deformed ones; both take room that labels keep away from. */
function memberShapes(members: DrawnMember[], scene: Scene, view: View, taken: Occupancy): { still: Shape; moved: Shape } {
  const still: Shape[] = [];
  const moved: Shape[] = [];
  for (const member of members) {
    const here = pixels(member.x, member.y, view);
    taken.addLine(here, 40);
    if (scene.mirror !== null) {
      const twice = 2 * toPixel(view, { x: scene.mirror, y: 0 }).x;
      taken.addLine(here.map((p) => ({ x: twice - p.x, y: p.y })), 20);
    }
    if (scene.deformed) {
      const before = pixels(member.x0, member.y0, view);
      taken.addLine(before, 8);
      still.push(path("undeformed", before));
    }
    const looks = isSlack(scene, member.id) ? "member slack" : "member";
    moved.push(path(scene.input.mode && !scene.deformed ? "undeformed" : looks, here));
  }
  return { still: group("undeformed-members", ...still), moved: group("members", ...moved) };
}

function cursorShape(scene: Scene, view: View): Shape | null {
  const cursor = scene.input.cursor;
  const member = cursor && scene.members.get(cursor.member);
  if (!cursor || !member) return null;
  const place = toPixel(view, placeOn(member, cursor.s).moved);
  return shape("circle", { class: "cursor", cx: place.x.toFixed(2), cy: place.y.toFixed(2), r: 6 });
}

/** The view that shows everything; pass it (zoomed or moved) to `drawingFigure` and `locate`. */
export function drawingView(input: DrawingInput, size: Size): View {
  return sceneView(makeScene(input), size);
}

/**
 * The drawing of a model and a state of its result: lengths in the model's unit, x to the right, y up (docs/requests.md, Units,
 * axes, signs). A member's left normal is its tangent turned by +90 degrees; ground lies on the `side` or along the `direction` of
 * its foundation. Reactions stand on the deformed axis, into the medium where it pushes (positive), the largest 0.85 of the
 * ground's depth. Loads are those of the state: proportional ones times its load factor, the head of each arrow on the structure.
 */
export function drawingFigure(input: DrawingInput, size: Size, view?: View): Shape {
  const scene = makeScene(input);
  const shown = view ?? sceneView(scene, size);
  const taken = new Occupancy(size);
  const text = sceneCaption(scene);
  const caption = (input.caption ?? true) ? captionShape(text, size) : null;
  if (caption) taken.addBox({ left: 0, top: 0, right: size.width, bottom: 18 });
  const dimensions = (input.dimensions ?? true) ? dimensionShapes(scene, shown, size, taken) : null;
  const lines = memberShapes([...scene.members.values()], scene, shown, taken);
  const monitors = monitorShapes(scene, shown, taken);
  const loads = loadShapes(scene, shown, taken);
  const supports = supportShapes(scene, shown, taken);
  const reactions = reactionShapes(scene, shown, taken);
  const own = [reactions.under, lines.still, springShapes(scene, shown, taken), lines.moved, reactions.over,
               modeShapes(scene, shown, taken), hingeShapes(scene, shown), loads.arrows];
  return figure("drawing", size, text, groundShapes(scene, shown, size), dimensions, ...mirrorShapes(scene, shown, own),
                ...own.slice(0, 3), supports, ...own.slice(3), monitors.marks, cursorShape(scene, shown),
                reactions.text, monitors.notes(), loads.notes(), caption);
}

/** The mirror image of what is drawn, and the line of symmetry. */
function mirrorShapes(scene: Scene, view: View, own: (Shape | null)[]): Shape[] {
  if (scene.mirror === null) return [];
  const { x } = toPixel(view, { x: scene.mirror, y: 0 });
  const top = toPixel(view, { x: 0, y: scene.box.top }).y - 24;
  const bottom = toPixel(view, { x: 0, y: scene.box.bottom }).y + 24;
  const image = group("mirror-image", ...own);
  image.attributes["transform"] = `translate(${coordinate(2 * x)} 0) scale(-1 1)`;
  return [line("symmetry", { x, y: top }, { x, y: bottom }), image];
}

/** What a drawing shows, as a sentence. */
export function drawingCaption(input: DrawingInput): string {
  return sceneCaption(makeScene(input));
}

/** A round factor (1, 2, 5 times a power of ten) that makes the state's displacements a twelfth of the structure. */
export function suggestedFactor(input: DrawingInput): number {
  const scene = makeScene({ ...input, factor: 1 });
  let largest = 0;
  for (const member of Object.values(input.state?.members ?? {})) {
    member.u.forEach((u, i) => { largest = Math.max(largest, Math.hypot(u, at(member.v, i))); });
  }
  if (largest === 0 || largest > scene.extent / 60) return 1;
  const wanted = scene.extent / 12 / largest;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const round = [5, 2, 1].find((value) => value * power <= wanted) ?? 1;
  return Math.max(1, round * power);
}

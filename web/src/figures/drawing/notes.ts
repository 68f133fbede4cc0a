// Monitors with their values, overall dimensions, and the sentence that says what is drawn.

import type { components } from "../../api/types";
import { at, interpolate } from "../geometry";
import { placeLabel, textWidth, type Occupancy } from "../labels";
import { formatNumber, formatWithUnit, unitOf } from "../numbers";
import { coordinate, group, label, line, pathData, shape, type Pixel, type Shape, type Size } from "../shape";
import { boxWithGround, placeOf, toPixel, type Place, type Scene, type View } from "./scene";

type Monitor = components["schemas"]["Monitor"];

/** Value of a monitor in the scene's state: u, v, rotation, or the displacement along the initial left normal. */
export function monitorValue(scene: Scene, monitor: Monitor): number | null {
  const place = placeOf(scene, monitor.at);
  const state = place && scene.input.state?.members[place.member.id];
  if (!place || !state) return null;
  const u = interpolate(state.s, state.u, place.s);
  const v = interpolate(state.s, state.v, place.s);
  switch (monitor.component) {
    case "x": return u;
    case "y": return v;
    case "rotation": return interpolate(state.s, state.rotation, place.s);
    case "normal": return u * place.normal.x + v * place.normal.y;
  }
}

const kComponents = { x: "u", y: "v", rotation: "φ", normal: "w" } as const;

function monitorText(scene: Scene, monitor: Monitor): string {
  const value = monitorValue(scene, monitor);
  if (value === null) return monitor.id;
  const unit = unitOf(scene.input.model.units, monitor.component === "rotation" ? "rotation" : "length");
  return `${monitor.id} ${kComponents[monitor.component]} = ${formatWithUnit(value, unit, 3)}`;
}

/** Dots at the monitors, with a dotted line from where they came. */
export function monitorShapes(scene: Scene, view: View, taken: Occupancy): { marks: Shape; notes: () => Shape } {
  const marks: Shape[] = [];
  const places: { monitor: Monitor; tip: Pixel }[] = [];
  for (const monitor of scene.input.model.monitors ?? []) {
    const place = placeOf(scene, monitor.at);
    if (!place) continue;
    const still = toPixel(view, place.still);
    const tip = toPixel(view, place.moved);
    if (Math.hypot(tip.x - still.x, tip.y - still.y) > 6) marks.push(line("monitor-way", still, tip));
    marks.push(shape("circle", { class: "monitor", cx: tip.x.toFixed(2), cy: tip.y.toFixed(2), r: 3.5 }));
    taken.addBox({ left: tip.x - 4, right: tip.x + 4, top: tip.y - 4, bottom: tip.y + 4 }, 60);
    places.push({ monitor, tip });
  }
  const notes = () => group("monitor-notes", ...places.slice(0, 12).map(({ monitor, tip }) => placeLabel({
    at: tip, runs: [{ text: monitorText(scene, monitor) }], className: "note monitor-text", distance: 8, prefer: 1, tolerance: 100, leader: true,
  }, taken)));
  return { marks: group("monitors", ...marks), notes };
}

/** Hinges at released ends. */
export function hingeShapes(scene: Scene, view: View): Shape {
  const circles: Shape[] = [];
  for (const member of scene.input.model.members) {
    const drawn = scene.members.get(member.id);
    if (!drawn) continue;
    for (const end of ["start", "end"] as const) {
      const rod = (member.reaction ?? "bilateral") !== "bilateral" || member.cable === true;
      const released = rod ? ["rotation"] : member.release?.[end];
      if (released === undefined || (Array.isArray(released) && !released.includes("rotation"))) continue;
      const place = hingePlace(drawn, end, view);
      circles.push(shape("circle", { class: "hinge", cx: place.x.toFixed(2), cy: place.y.toFixed(2), r: 3.5 }));
    }
  }
  return group("hinges", ...circles);
}

function hingePlace(member: Place["member"], end: "start" | "end", view: View): Pixel {
  const n = member.x.length;
  const [i, next] = end === "start" ? [0, 1] : [n - 1, n - 2];
  const p = toPixel(view, { x: member.x[i] ?? 0, y: member.y[i] ?? 0 });
  const q = toPixel(view, { x: member.x[next] ?? 0, y: member.y[next] ?? 0 });
  const length = Math.hypot(q.x - p.x, q.y - p.y) || 1;
  return { x: p.x + (5 * (q.x - p.x)) / length, y: p.y + (5 * (q.y - p.y)) / length };
}

/** Overall width below and height on the left, of the undeformed structure. */
export function dimensionShapes(scene: Scene, view: View, size: Size, taken: Occupancy): Shape {
  const box = stillBox(scene);
  const around = boxWithGround(scene);
  const low = toPixel(view, { x: box.left, y: box.bottom });
  const high = toPixel(view, { x: box.right, y: box.top });
  const outer = toPixel(view, { x: around.left, y: around.bottom });
  const unit = unitOf(scene.input.model.units, "length");
  const shapes: Shape[] = [];
  if (high.x - low.x > 24) {
    const springs = (scene.input.model.springs ?? []).length > 0;
    const y = Math.min(size.height - 20, outer.y + (springs ? 60 : 38));
    const text = formatWithUnit(box.right - box.left, unit);
    const width = textWidth(text);
    const middle = (low.x + high.x) / 2;
    shapes.push(dimensionLine({ x: low.x, y }, { x: high.x, y }),
                label("dimension-text", { x: middle, y: y + 15 }, "middle", text));
    taken.addBox({ left: low.x, right: high.x, top: y - 4, bottom: y + 4 }, 40);
    taken.addBox({ left: middle - width / 2, right: middle + width / 2, top: y + 2, bottom: y + 18 });
  }
  if (low.y - high.y > 24) {
    const x = Math.max(20, outer.x - 36);
    const text = formatWithUnit(box.top - box.bottom, unit);
    const middle = (low.y + high.y) / 2;
    const turned = label("dimension-text", { x: x - 7, y: middle }, "middle", text);
    turned.attributes["transform"] = `rotate(-90 ${coordinate(x - 7)} ${coordinate(middle)})`;
    shapes.push(dimensionLine({ x, y: low.y }, { x, y: high.y }), turned);
    taken.addBox({ left: x - 18, right: x + 4, top: high.y, bottom: low.y }, 40);
  }
  return group("dimensions", ...shapes);
}

/** Values along a curve, and its peaks between them by parabolas, so that a ring of diameter 1 measures 1. */
function withPeaks(values: readonly number[]): number[] {
  const all = [...values];
  for (let i = 1; i + 1 < values.length; ++i) {
    const before = at(values, i - 1) - at(values, i);
    const after = at(values, i + 1) - at(values, i);
    if (before * after >= 0 && before !== after) all.push(at(values, i) - (after - before) ** 2 / (8 * (after + before)));
  }
  return all;
}

/** The box of the undeformed axes, mirror image included. */
function stillBox(scene: Scene): Scene["box"] {
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (const member of scene.members.values()) {
    for (const x of withPeaks(member.x0)) {
      const other = scene.mirror === null ? x : 2 * scene.mirror - x;
      box.left = Math.min(box.left, x, other);
      box.right = Math.max(box.right, x, other);
    }
    for (const y of withPeaks(member.y0)) {
      box.bottom = Math.min(box.bottom, y);
      box.top = Math.max(box.top, y);
    }
  }
  return box;
}

function dimensionLine(a: Pixel, b: Pixel): Shape {
  const tick = (p: Pixel) => pathData([{ x: p.x - 3.5, y: p.y + 3.5 }, { x: p.x + 3.5, y: p.y - 3.5 }]);
  return shape("path", { class: "dimension", d: pathData([a, b]) + tick(a) + tick(b) });
}

/** What is drawn, as a sentence; the scale of displacements is always said, and a mirror image too. */
export function sceneCaption(scene: Scene): string {
  return captionOf(scene.input) + (scene.mirror === null ? "" : ", half mirrored");
}

/** The caption, without its first words where it is wider than the figure. */
export function captionShape(text: string, size: Size): Shape {
  const fits = textWidth(text, 12, true) <= size.width;
  return label("caption", { x: 0, y: 14 }, "start", fits ? text : text.replace("Deformed shape at load", "Load"));
}

function captionOf(input: Scene["input"]): string {
  const factor = input.factor ?? 1;
  const scale = factor === 1 ? "true scale" : `displacements × ${formatNumber(factor, 3)}`;
  const load = input.state?.load_factor ?? input.loadFactor ?? null;
  const at = load === null ? "" : ` at load factor ${formatNumber(load)}`;
  if (input.mode) return `Mode${at}, size without meaning${input.state && factor !== 1 ? `, ${scale}` : ""}`;
  return input.state ? `Deformed shape${at}${input.unstable ? " (unstable)" : ""}, ${scale}` : "Model, undeformed, its own loads";
}

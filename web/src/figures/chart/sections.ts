// Internal forces, rotation and base reaction along the members of a state, extremes marked.
// Signs as docs/results.md: N tension positive, Q along the left normal, M positive when it turns the member to its left,
// rotation counter-clockwise, reaction positive when the medium pushes. Positive values are drawn upwards.

import type { components } from "../../api/types";
import { at, interpolate, last } from "../geometry";
import { Occupancy, placeLabel, textWidth } from "../labels";
import { formatNumber, formatWithUnit, unitOf, type Quantity, type Units } from "../numbers";
import { withPeaks, type Line } from "../peaks";
import { withSoil } from "../soil";
import { coordinate, figure, group, label, line, pathData, shape, type Anchor, type Pixel, type Shape, type Size } from "../shape";
import { kBetweenTexts, makeScale, place, ticks, valueAt, type Scale } from "./axes";
import { thinned } from "./thin";

type Schemas = components["schemas"];
type State = Schemas["State"];
type Model = Schemas["Model"];

export type SectionQuantity = "N" | "Q" | "M" | "rotation" | "reaction";

/** What is drawn: a state's members one after another, in the model's order unless `members` says otherwise. */
export interface SectionsInput {
  model: Model;
  state: State;
  members?: readonly string[] | undefined;
  quantities?: readonly SectionQuantity[] | undefined;
  cursor?: { member: string; s: number } | null | undefined;
}

interface Described {
  name: string;
  unit: Quantity;
}

export const kSections: Record<SectionQuantity, Described> = {
  N: { name: "axial force N", unit: "force" },
  Q: { name: "shear force Q", unit: "force" },
  M: { name: "bending moment M", unit: "moment" },
  rotation: { name: "rotation φ", unit: "rotation" },
  reaction: { name: "base reaction r", unit: "line_load" },
};

/** The states of a member's foundations whose reaction is a force per length: those against rotation have a moment. */
function reactionsOf(input: SectionsInput, member: string): State["foundations"][string][] {
  const { model, state } = withSoil(input.model, input.state);
  return (model.foundations ?? []).flatMap((foundation) => {
    const turns = "component" in foundation && foundation.component === "rotation";
    return foundation.member === member && !turns ? state.foundations[foundation.id] ?? [] : [];
  });
}

/** The listed values of a quantity along a member, one line for each foundation with reactions. */
export function sectionLines(input: SectionsInput, member: string, quantity: SectionQuantity): Line[] {
  const state = input.state.members[member];
  if (!state) return [];
  switch (quantity) {
    case "N": return [{ s: state.s, values: state.axial_force }];
    case "Q": return [{ s: state.s, values: state.shear_force }];
    case "M": return [{ s: state.s, values: state.bending_moment }];
    case "rotation": return [{ s: state.s, values: state.rotation }];
    case "reaction": return reactionsOf(input, member).map(({ s, reaction }) => ({ s, values: reaction }));
  }
}

const kPeaks = { N: "axial_force", Q: "shear_force", M: "bending_moment" } as const;

/** The lines that are drawn: the listed values, with the extremes along the whole member. */
export function drawnLines(input: SectionsInput, member: string, quantity: SectionQuantity): Line[] {
  const lines = sectionLines(input, member, quantity);
  if (quantity === "rotation") return lines;
  if (quantity !== "reaction") {
    const peaks = input.state.members[member]?.extremes?.[kPeaks[quantity]];
    return lines.map((line) => withPeaks(line, peaks));
  }
  const states = reactionsOf(input, member);
  return lines.map((line, i) => withPeaks(line, states[i]?.extremes));
}

/** A panel: one quantity along all members. */
export interface SectionPanel {
  quantity: SectionQuantity;
  x: Scale;
  y: Scale;
  /** Whether there is nothing but rounding. */
  zero: boolean;
}

/** The layout: where each member begins along the common axis, and the panels; for hovering. */
export interface SectionsChart {
  members: { id: string; from: number; length: number }[];
  panels: SectionPanel[];
  size: Size;
}

function membersOf(input: SectionsInput): SectionsChart["members"] {
  let from = 0;
  const ids = input.members ?? input.model.members.map((member) => member.id);
  return ids.flatMap((id) => {
    const state = input.state.members[id];
    if (!state) return [];
    const member = { id, from, length: last(state.s) };
    from += member.length;
    return [member];
  });
}

function quantitiesOf(input: SectionsInput): SectionQuantity[] {
  if (input.quantities) return [...input.quantities];
  const all: SectionQuantity[] = ["N", "Q", "M", "rotation"];
  return Object.keys(input.state.foundations).length > 0 ? [...all, "reaction"] : all;
}

function largestOf(input: SectionsInput, ids: readonly string[], quantity: SectionQuantity): number {
  const [low, high] = extentOf(input, ids, quantity);
  return Math.max(-low, high);
}

/** Below this a quantity is rounding: forces of the largest force, moments of that times the length, radians of 1. */
function negligible(input: SectionsInput, ids: readonly string[], quantity: SectionQuantity, length: number): number {
  if (quantity === "rotation") return kNegligible;
  const force = Math.max(largestOf(input, ids, "N"), largestOf(input, ids, "Q"));
  return kNegligible * (quantity === "M" ? force * length : quantity === "reaction" ? force / length : force);
}

function extentOf(input: SectionsInput, ids: readonly string[], quantity: SectionQuantity): [number, number] {
  let low = 0;
  let high = 0;
  for (const id of ids) {
    for (const { values } of drawnLines(input, id, quantity)) {
      for (const value of values) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
  }
  return [low, high];
}

const kNegligible = 1e-6;
const kAlike = 0.02;  // extremes that differ by less are one
const kTitle = 20;
const kHead = 20;  // for a value above the highest point
const kFoot = 20;
const kBelow = 20;  // for a value below the lowest point
const kLeastWidth = 84;
const kRowGap = 10;
const kGap = 16;
const kSide = 4;

/** Columns of panels: as many as leave each wide enough to be read. */
function columnsOf(count: number, size: Size): number {
  let best = 1;
  let most = 0;
  for (let columns = 1; columns <= count; ++columns) {
    const rows = Math.ceil(count / columns);
    const width = (size.width - kGap * (columns - 1)) / columns;
    const height = (size.height - kRowGap * (rows - 1)) / rows - kTitle - kHead - kBelow - kFoot;
    const readable = Math.min(width, 3.2 * height);
    if (width >= kLeastWidth && readable > most + 1) {
      most = readable;
      best = columns;
    }
  }
  return best;
}

/** Lays the panels out. */
export function sectionsChart(input: SectionsInput, size: Size): SectionsChart {
  const members = membersOf(input);
  const ids = members.map((member) => member.id);
  const length = members.reduce((sum, member) => sum + member.length, 0) || 1;
  const quantities = quantitiesOf(input);
  const columns = columnsOf(quantities.length, size);
  const rows = Math.ceil(quantities.length / columns);
  const width = (size.width - kGap * (columns - 1)) / columns;
  const height = (size.height - kRowGap * (rows - 1)) / rows;
  const panels = quantities.map((quantity, i) => {
    const left = (i % columns) * (width + kGap);
    const top = Math.floor(i / columns) * (height + kRowGap);
    const [least, most] = extentOf(input, ids, quantity);
    const zero = Math.max(-least, most) <= negligible(input, ids, quantity, length);
    const [low, high] = zero ? [-1, 1] : [least, most];
    return {
      quantity,
      x: makeScale(0, length, left + kSide, left + width - kSide),
      y: makeScale(low, high, top + height - kFoot - (low < 0 ? kBelow : 0), top + kTitle + (high > 0 ? kHead : 6)),
      zero,
    };
  });
  return { members, panels, size };
}

interface Extreme {
  at: Pixel;
  value: number;
}

/** The largest and the smallest value of a panel, where they differ well and are not small beside one another. */
function extremesOf(chart: SectionsChart, input: SectionsInput, panel: SectionPanel): Extreme[] {
  let low: Extreme = { at: { x: 0, y: 0 }, value: Infinity };
  let high: Extreme = { at: { x: 0, y: 0 }, value: -Infinity };
  for (const member of chart.members) {
    for (const { s, values } of drawnLines(input, member.id, panel.quantity)) {
      values.forEach((value, i) => {
        const spot = { at: { x: place(panel.x, member.from + at(s, i)), y: place(panel.y, value) }, value };
        if (value < low.value) low = spot;
        if (value > high.value) high = spot;
      });
    }
  }
  const largest = Math.max(Math.abs(high.value), Math.abs(low.value));
  const alike = high.value - low.value < kAlike * largest;
  const both = !alike ? [high, low] : Math.abs(low.value) > Math.abs(high.value) ? [low] : [high];
  return both.filter((item) => Number.isFinite(item.value) && Math.abs(item.value) > 0.03 * largest);
}

function curveShapes(chart: SectionsChart, input: SectionsInput, panel: SectionPanel, taken: Occupancy): Shape[] {
  const zero = place(panel.y, 0);
  return chart.members.flatMap((member) =>
    drawnLines(input, member.id, panel.quantity).flatMap(({ s, values }) => {
      const all = s.map((value, i) => ({ x: place(panel.x, member.from + value), y: place(panel.y, at(values, i)) }));
      const points = thinned(all).flatMap((i) => all[i] ?? []);
      const first = points[0];
      const end = points[points.length - 1];
      if (!first || !end) return [];
      taken.addLine(points, 20);
      const area = [{ x: first.x, y: zero }, ...points, { x: end.x, y: zero }];
      return [shape("path", { class: "section-area", d: pathData(area, true) }),
              shape("path", { class: "section-line", d: pathData(points) })];
    }));
}

/** Where members begin and end; their names where there is room. */
function memberMarks(chart: SectionsChart, panel: SectionPanel): Shape[] {
  const many = chart.members.length > 1;
  return chart.members.flatMap((member, i) => {
    const from = place(panel.x, member.from);
    const to = place(panel.x, member.from + member.length);
    const shapes: Shape[] = [];
    if (i > 0) shapes.push(line("section-joint", { x: from, y: footTop(panel) }, { x: from, y: panel.y.end }));
    if (many && textWidth(member.id) < to - from - 4) {
      shapes.push(label("tick", { x: (from + to) / 2, y: footTop(panel) + 14 }, "middle", member.id));
    }
    return shapes;
  });
}

interface LengthTick {
  x: number;
  anchor: Anchor;
  text: string;
  /** Where the text begins and ends. */
  from: number;
  to: number;
}

function lengthTick(panel: SectionPanel, value: number, text: string): LengthTick {
  const x = place(panel.x, value);
  const anchor = x - panel.x.start < 12 ? "start" : panel.x.end - x < 24 ? "end" : "middle";
  const width = textWidth(text);
  const from = x - { start: 0, middle: 0.5, end: 1 }[anchor] * width;
  return { x, anchor, text, from, to: from + width };
}

/** Lengths along the only member. The last one has the unit; of the others those have texts that leave room between them. */
function lengthTicks(chart: SectionsChart, panel: SectionPanel, units: Units | undefined): Shape[] {
  const [only] = chart.members;
  if (chart.members.length !== 1 || !only) return [];
  const marks = ticks(panel.x, 70);
  const all = marks.map((value, i) => lengthTick(panel, value,
    i === marks.length - 1 ? formatWithUnit(value, unitOf(units, "length")) : i === 0 && value === 0 ? "s = 0" : formatNumber(value)));
  const last = all[all.length - 1];
  let end = -Infinity;
  return all.map((tick) => {
    const fits = tick === last || (tick.from >= end + kBetweenTexts && tick.to + kBetweenTexts <= (last?.from ?? Infinity));
    if (fits) end = tick.to;
    return group("section-tick", line("axis", { x: tick.x, y: footTop(panel) }, { x: tick.x, y: footTop(panel) + 3 }),
                 ...(fits ? [label("tick", { x: tick.x, y: footTop(panel) + 15 }, tick.anchor, tick.text)] : []));
  });
}

function cursorShapes(chart: SectionsChart, input: SectionsInput, panel: SectionPanel, taken: Occupancy): Shape[] {
  const cursor = input.cursor;
  const member = chart.members.find((item) => item.id === cursor?.member);
  if (!cursor || !member) return [];
  const x = place(panel.x, member.from + cursor.s);
  const shapes = [line("cursor-line", { x, y: panel.y.start }, { x, y: panel.y.end })];
  for (const { s, values } of drawnLines(input, member.id, panel.quantity)) {
    if (cursor.s < at(s, 0) || cursor.s > last(s)) continue;
    const value = interpolate(s, values, cursor.s);
    const spot = { x, y: place(panel.y, value) };
    shapes.push(shape("circle", { class: "cursor-dot", cx: coordinate(spot.x), cy: coordinate(spot.y), r: 3.5 }));
    const text = placeLabel({ at: spot, className: "contact-text strong", runs: [{ text: formatNumber(value), bold: true }],
                              tolerance: 900 }, taken);
    if (text) shapes.push(text);
  }
  return shapes;
}

function panelShape(chart: SectionsChart, input: SectionsInput, panel: SectionPanel): Shape {
  const taken = new Occupancy(chart.size);
  const { unit } = kSections[panel.quantity];
  const label0 = unitOf(input.model.units, unit);
  const name = fittedName(chart, input.model.units, panel.quantity);
  const top = titleTop(panel);
  const runs = [shape("tspan", { class: "strong" }, name), label0 === "" ? null : shape("tspan", { class: "muted" }, `\u00a0${label0}`)];
  const title = label("section-title", { x: panel.x.start, y: top + 13 }, "start", ...runs);
  taken.addBox({ left: 0, right: panel.x.start - 4, top: 0, bottom: chart.size.height });
  taken.addBox({ left: panel.x.end + 4, right: chart.size.width, top: 0, bottom: chart.size.height });
  taken.addBox({ left: panel.x.start, top: top - 2, right: panel.x.start + titleWidth(name, label0) + 8, bottom: top + 15 });
  taken.addBox({ left: panel.x.start, top: footTop(panel) + 3, right: panel.x.end, bottom: footTop(panel) + kFoot });
  taken.addBox({ left: 0, top: 0, right: chart.size.width, bottom: Math.max(0, top - 4) });
  taken.addBox({ left: 0, top: footTop(panel) + kFoot, right: chart.size.width, bottom: chart.size.height });
  const curves = panel.zero ? [] : curveShapes(chart, input, panel, taken);
  const zero = place(panel.y, 0);
  if (panel.zero) curves.push(label("muted", { x: panel.x.start, y: zero - 5 }, "start", "zero"));
  const cursor = panel.zero ? [] : cursorShapes(chart, input, panel, taken);
  const extremes = panel.zero ? [] : extremesOf(chart, input, panel).flatMap(({ at: spot, value }) => [
    shape("circle", { class: "section-dot", cx: coordinate(spot.x), cy: coordinate(spot.y), r: 2.8 }),
    placeLabel({ at: spot, className: "section-value", prefer: value > 0 ? 6 : 2, distance: 5, tolerance: 900, rings: 1,
                 runs: [{ text: formatNumber(value), bold: true }] }, taken),
  ]);
  return group(`section section-${panel.quantity}`, title, ...curves,
               line("axis", { x: panel.x.start, y: zero }, { x: panel.x.end, y: zero }), ...memberMarks(chart, panel),
               ...lengthTicks(chart, panel, input.model.units), ...cursor, ...extremes);
}

/** Where the names of members, or the lengths, begin: below the room for the lowest value. */
function footTop(panel: SectionPanel): number {
  return panel.y.start + (panel.y.from < 0 ? kBelow : 0);
}

function titleWidth(name: string, unit: string): number {
  return textWidth(name, 12, true) + textWidth(` ${unit}`);
}

/** The name of a quantity, or its symbol alone where a panel is too narrow for its name. */
function fittedName(chart: SectionsChart, units: Units | undefined, quantity: SectionQuantity): string {
  const fits = chart.panels.every((panel) => {
    const { name, unit } = kSections[panel.quantity];
    return titleWidth(name, unitOf(units, unit)) <= panel.x.end - panel.x.start + 2 * kSide;
  });
  const { name } = kSections[quantity];
  return fits ? name : name.slice(name.lastIndexOf(" ") + 1);
}

function titleTop(panel: SectionPanel): number {
  return panel.y.end - kTitle - (panel.y.to > 0 ? kHead : 6);
}

/**
 * N, Q, M, rotation and base reaction over the undeformed arc length s, one member after another, in the model's units. Positive
 * values upwards: N tension, Q along the left normal (of the part beyond on the part before), M turning the member to its left as
 * s grows, rotation counter-clockwise, reaction pushing on the structure (docs/results.md and docs/results.svg).
 */
export function sectionsFigure(input: SectionsInput, size: Size, chart: SectionsChart = sectionsChart(input, size)): Shape {
  const title = `Section forces along the members at load factor ${formatNumber(input.state.load_factor)}`;
  return figure("chart sections", size, title, ...chart.panels.map((panel) => panelShape(chart, input, panel)));
}

/** The place on a member at a pixel of a panel; null outside of all panels. */
export function sectionsLocate(chart: SectionsChart, pixel: Pixel): { member: string; s: number; quantity: SectionQuantity } | null {
  const panel = chart.panels.find(({ x, y }) =>
    pixel.x >= x.start && pixel.x <= x.end && pixel.y >= y.end - kTitle - kHead && pixel.y <= y.start + kBelow + kFoot);
  if (!panel) return null;
  const along = valueAt(panel.x, pixel.x);
  const member = chart.members.find((item) => along <= item.from + item.length) ?? chart.members[chart.members.length - 1];
  return member ? { member: member.id, s: along - member.from, quantity: panel.quantity } : null;
}

// Marks and names of the places at which curves break.

import { placeLabel, textWidth, type Occupancy } from "../labels";
import { coordinate, group, shape, type Pixel, type Shape } from "../shape";

/** A break as it is drawn. */
export interface DrawnBreak {
  /** The ends of the curve at the break; without the end of a row that has no value. */
  ends: Pixel[];
  /** What changes; "" where it is not known. */
  change: string;
  /** What a pointer that rests on a mark is told. */
  title: string;
}

const kMostLabels = 6;       // names in a figure; further ones are read under the pointer
const kNameSize = 12;        // px
const kMostTried = 60;       // breaks for whose names a place is looked for
const kLongest = 48;         // characters of a name
const kSamePlace = 1.5;      // px between two ends that get one ring

/** Rings at both ends of each break: one where the ends are at the same place, as where only the kind of a value changes. */
export function breakMarks(breaks: readonly DrawnBreak[], radius: number): Shape {
  const taken = new Set<string>();
  const isFree = (end: Pixel): boolean => {
    const cell = `${Math.round(end.x / kSamePlace)} ${Math.round(end.y / kSamePlace)}`;
    return !taken.has(cell) && taken.add(cell) !== undefined;
  };
  return group("breaks", ...breaks.flatMap(({ ends, title }) => {
    const [first, second] = ends;
    const apart = first && second && Math.hypot(second.x - first.x, second.y - first.y) >= kSamePlace;
    return (apart ? ends : ends.slice(0, 1)).filter(isFree).map((end) => shape("circle", {
      class: "break-mark", cx: coordinate(end.x), cy: coordinate(end.y), r: radius,
    }, shape("title", {}, title)));
  }));
}

function shortened(text: string): string {
  return text.length <= kLongest ? text : `${text.slice(0, kLongest - 1)}…`;
}

/** The breaks in the order in which they get names: the first one of each change, then the others. */
function byNews(breaks: readonly DrawnBreak[]): DrawnBreak[] {
  const known = new Set<string>();
  const fresh: DrawnBreak[] = [];
  const again: DrawnBreak[] = [];
  for (const one of breaks) {
    if (one.change === "" || one.ends.length === 0) continue;
    (known.has(one.change) ? again : fresh).push(one);
    known.add(one.change);
  }
  return [...fresh, ...again];
}

/** Paper behind a name, so that it can be read on any band of a map. */
function paperBehind({ attributes }: Shape, text: string): Shape {
  const width = textWidth(text, kNameSize);
  const [x, y] = [Number(attributes["x"]), Number(attributes["y"])];
  const left = attributes["text-anchor"] === "start" ? x : attributes["text-anchor"] === "end" ? x - width : x - width / 2;
  return shape("rect", { class: "break-paper", x: coordinate(left - 3), y: coordinate(y - kNameSize), width: coordinate(width + 6), height: 16 });
}

/**
 * The names of the first changes, as many as find a place where they cover nothing.
 * @param onBands whether the names stand on the bands of a map
 */
export function breakLabels(breaks: readonly DrawnBreak[], taken: Occupancy, onBands = false): Shape {
  const labels: Shape[] = [];
  for (const { ends, change } of byNews(breaks).slice(0, kMostTried)) {
    const end = ends[ends.length - 1];
    if (labels.length === kMostLabels || !end) break;
    const name = shortened(change);
    const text = placeLabel({
      at: end, className: "break-text", runs: [{ text: name }], distance: 7, rings: 3, leader: !onBands, size: kNameSize,
    }, taken);
    if (text) labels.push(onBands ? group("backed", paperBehind(text, name), text) : text);
  }
  return group("break-texts", ...labels);
}

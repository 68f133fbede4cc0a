// A slider: a number that is written into one or more places of a request, as a parameter of a sweep is.

import type { RequestDocument, SweepParameter } from "../api/documents";
import { pointerOf, segments, valueAt, withValue } from "./pointer";

export interface Target {
  pointer: string;
  /** value^power scale is written; both 1 when left out. */
  scale?: number;
  power?: number;
}

export interface Slider {
  name: string;
  unit: string;
  targets: Target[];
  min: number;
  max: number;
  /** Whether equal ways of the slider multiply the value. */
  log: boolean;
  /** Places of a linear slider; a log slider has 3 significant digits. */
  step?: number;
}

export const kPlaces = 1000;  // of the slider's way

function isOnPlace(document: unknown, target: Target): boolean {
  return typeof valueAt(document, target.pointer) === "number";
}

/** The value that a document has for a slider; null when it has none. */
export function valueOf(slider: Slider, document: RequestDocument): number | null {
  const target = slider.targets[0];
  if (!target) return null;
  const written = valueAt(document, target.pointer);
  if (typeof written !== "number") return optionalZero(target.pointer);
  const value = written / (target.scale ?? 1);
  return tidy((target.power ?? 1) === 1 ? value : Math.sign(value) * Math.abs(value) ** (1 / (target.power ?? 1)));
}

/** What a field that may be left out has when it is. */
function optionalZero(pointer: string): number | null {
  return /\/(gap|shear_stiffness)$/.test(pointer) ? 0 : null;
}

function tidy(value: number): number {
  return Number(value.toPrecision(12));
}

/** The document with a slider's value written to all its targets. */
export function withSlider(slider: Slider, document: RequestDocument, value: number): RequestDocument {
  return slider.targets.reduce((result, { pointer, scale = 1, power = 1 }) => {
    const written = tidy(scale * value ** power);
    const unset = written === 0 && optionalZero(pointer) === 0;  // a two-sided spring must not have a gap, even 0
    return withValue(result, pointer, unset ? undefined : written);
  }, document);
}

/** Whether a document has what the slider writes to. */
export function fits(slider: Slider, document: RequestDocument): boolean {
  return slider.targets.every((target) =>
    isOnPlace(document, target) ||
    (optionalZero(target.pointer) === 0 && valueAt(document, parentOf(target.pointer)) !== undefined));
}

function parentOf(pointer: string): string {
  return pointerOf(segments(pointer).slice(0, -1));
}

/** Where a value stands on the slider's way, 0 to kPlaces. */
export function placeOf(slider: Slider, value: number): number {
  const share = slider.log
    ? Math.log(Math.max(value, slider.min) / slider.min) / Math.log(slider.max / slider.min)
    : (value - slider.min) / (slider.max - slider.min);
  return Math.round(kPlaces * Math.min(1, Math.max(0, share)));
}

/** The value at a place of the slider's way. */
export function valueAtPlace(slider: Slider, place: number): number {
  const share = place / kPlaces;
  if (slider.log) return Number((slider.min * (slider.max / slider.min) ** share).toPrecision(3));
  const value = slider.min + share * (slider.max - slider.min);
  const step = slider.step ?? (slider.max - slider.min) / 200;
  return tidy(Math.min(slider.max, slider.min + Math.round((value - slider.min) / step) * step));
}

/** A slider for any number of a request; its range is a factor of 10 each way, or -1 to 1 around 0. */
export function sliderFor(document: RequestDocument, pointer: string): Slider | null {
  const value = valueAt(document, pointer);
  if (typeof value !== "number") return null;
  const base = { name: nameOf(document, pointer), unit: "", targets: [{ pointer }] };
  if (value === 0) return { ...base, min: -1, max: 1, log: false };
  const positive = /\/(EA|EI|GA|E|A|I|stiffness|shear_stiffness|shear_area)$/.test(pointer);
  if (positive) return { ...base, min: value / 10, max: value * 10, log: true };
  const ends = [value / 4, value * 4] as const;
  return { ...base, min: Math.min(...ends), max: Math.max(...ends), log: false };
}

/** What people call the number at a pointer: the id of what it belongs to, and the field. */
export function nameOf(document: unknown, pointer: string): string {
  const parts = segments(pointer);
  const field = parts.filter((part) => !/^\d+$/.test(part)).pop() ?? pointer;
  const owner = valueAt(document, pointerOf(parts.slice(0, 3)));
  const id = parts.length > 3 && typeof owner === "object" && owner !== null ? (owner as { id?: unknown }).id : undefined;
  const index = /^\d+$/.test(parts[parts.length - 1] ?? "") ? ` ${parts[parts.length - 1] ?? ""}` : "";
  return `${typeof id === "string" ? `${id}: ` : ""}${field.replace(/_/g, " ")}${index}`;
}

/** The parameter of a sweep that goes where the slider goes. */
export function parameterOf(slider: Slider, name: string, from: number, to: number, count: number): SweepParameter {
  return {
    name,
    targets: slider.targets.map((target) => ({ ...target })),
    range: { from, to, count, ...(slider.log && from > 0 ? { spacing: "log" as const } : {}) },
  } as SweepParameter;
}

/** Targets in a field of the first foundations. */
export function foundations(count: number, field: string, scale = 1): { pointer: string; scale: number }[] {
  return Array.from({ length: count }, (_, i) => ({ pointer: `/model/foundations/${i}/${field}`, scale }));
}

/** A plate strip of width 1 m and thickness t in mm, of modulus E in kN/m². */
export function wall(modulus: number, min: number, max: number): Slider {
  return {
    name: "Wall thickness", unit: "mm", min, max, log: false, step: 0.5,
    targets: [
      { pointer: "/model/sections/0/EI", scale: modulus * 1e-9 / 12, power: 3 },
      { pointer: "/model/sections/0/EA", scale: modulus * 1e-3 },
    ],
  };
}

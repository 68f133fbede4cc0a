// How figures write numbers and units: significant digits, thin spaces between thousands, powers of ten as superscripts.

import type { components } from "../api/types";

export type Units = components["schemas"]["Units"];

/** What a number is, so that its unit can be told from the model's labels of length and force. */
export type Quantity = "none" | "length" | "rotation" | "force" | "moment" | "line_load";

const kSuperscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const kThinSpace = "\u202f";
const kNoBreak = "\u00a0";
const kMinus = "−";

/** A whole number as a superscript. */
export function superscript(value: number): string {
  const digits = String(Math.abs(value)).split("").map((digit) => kSuperscripts[Number(digit)] ?? "");
  return `${value < 0 ? "⁻" : ""}${digits.join("")}`;
}

/** Thousands of numbers of five digits and more are set apart. */
function grouped(text: string): string {
  const [whole = "", part] = text.split(".");
  const parted = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, kThinSpace) : whole;
  return part === undefined ? parted : `${parted}.${part}`;
}

function trimmed(text: string): string {
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/**
 * A number with so many significant digits, trailing zeros left out; below 1e-3 and from 1e6 on with a power of ten.
 * What is not finite is a dash.
 */
export function formatNumber(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const sign = value < 0 ? kMinus : "";
  const [mantissa = "0", power = "0"] = Math.abs(value).toExponential(digits - 1).split("e");
  const exponent = Number(power);
  if (exponent >= -3 && exponent < 6) {
    const decimals = Math.max(0, digits - 1 - exponent);
    return sign + grouped(trimmed(Math.abs(value).toFixed(decimals)));
  }
  const factor = trimmed(mantissa);
  const ten = `10${superscript(exponent)}`;
  return factor === "1" ? sign + ten : `${sign}${factor}${kThinSpace}×${kThinSpace}${ten}`;
}

/** A number and its unit, with a space that does not break. */
export function formatWithUnit(value: number, unit: string, digits = 4): string {
  return unit === "" ? formatNumber(value, digits) : `${formatNumber(value, digits)}${kNoBreak}${unit}`;
}

/** The unit of a quantity from the model's labels; "" where they don't tell. */
export function unitOf(units: Units | undefined, quantity: Quantity): string {
  const length = units?.["length"] ?? "";
  const force = units?.["force"] ?? "";
  switch (quantity) {
    case "none": return "";
    case "rotation": return "rad";
    case "length": return length;
    case "force": return force;
    case "moment": return units?.["moment"] ?? (length !== "" && force !== "" ? `${force}${kThinSpace}${length}` : "");
    case "line_load": return length !== "" && force !== "" ? `${force}/${length}` : "";
  }
}

/** "name (unit)", or the name alone. */
export function withUnit(name: string, unit: string): string {
  return unit === "" ? name : `${name} (${unit})`;
}

/** The exact number, as CSV and other programs read it. */
export function exactNumber(value: number): string {
  return Number.isFinite(value) ? String(value) : "";
}

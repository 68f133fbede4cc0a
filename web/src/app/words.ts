// Times, states and numbers in words.

import { formatNumber } from "../figures/numbers";

const kSecond = 1000;

/** How long ago, or the date when that is longer than a day. */
export function ago(time: string, now = Date.now()): string {
  const seconds = Math.max(0, (now - Date.parse(time)) / kSecond);
  if (seconds < 60) return `${Math.floor(seconds)} s ago`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ago`;
  if (seconds < 86400) return `${Math.floor(seconds / 3600)} h ago`;
  return new Date(time).toLocaleDateString();
}

export function duration(from: string | null, to: string | null): string {
  if (from === null || to === null) return "";
  const seconds = (Date.parse(to) - Date.parse(from)) / kSecond;
  return seconds < 1 ? `${Math.round(1000 * seconds)} ms` : seconds < 120 ? `${seconds.toFixed(1)} s` : `${Math.round(seconds / 60)} min`;
}

/** The class of a status' badge. */
export function badgeOf(status: string): string {
  return { successful: "badge good", failed: "badge bad", running: "badge run", accepted: "badge run" }[status] ?? "badge";
}

export const kStatuses = ["accepted", "running", "successful", "failed", "dismissed"] as const;

/** A message of the service as a sentence of its own: a capital, short numbers, a full stop. */
export function asSentence(text: string): string {
  const short = withShortNumbers(text);
  return `${short.charAt(0).toUpperCase()}${short.slice(1)}.`;
}

/** A sentence of the service with its numbers as the page writes them. */
export function withShortNumbers(text: string): string {
  return text.replace(/-?\d+\.\d{5,}(?:e[-+]?\d+)?/g, (number) => formatNumber(Number(number), 5));
}

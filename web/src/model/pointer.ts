// JSON Pointers (RFC 6901) into documents that are never changed, only copied.

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };

export function segments(pointer: string): string[] {
  return pointer.split("/").slice(1).map((part) => part.replace(/~1/g, "/").replace(/~0/g, "~"));
}

export function pointerOf(parts: readonly (string | number)[]): string {
  return parts.map((part) => `/${String(part).replace(/~/g, "~0").replace(/\//g, "~1")}`).join("");
}

function child(value: unknown, part: string): unknown {
  if (Array.isArray(value)) return /^(0|[1-9]\d*)$/.test(part) ? (value as unknown[])[Number(part)] : undefined;
  if (typeof value === "object" && value !== null && Object.prototype.hasOwnProperty.call(value, part)) {
    return (value as Record<string, unknown>)[part];
  }
  return undefined;
}

/** What is at the pointer; undefined where there is nothing. */
export function valueAt(document: unknown, pointer: string): unknown {
  return segments(pointer).reduce(child, document);
}

function replaced(value: unknown, parts: string[], next: unknown): unknown {
  const [part, ...rest] = parts;
  if (part === undefined) return next;
  if (Array.isArray(value)) {
    const copy = [...(value as unknown[])];
    const index = Number(part);
    if (rest.length === 0 && next === undefined) copy.splice(index, 1);
    else copy[index] = replaced(copy[index], rest, next);
    return copy;
  }
  const copy = { ...(typeof value === "object" && value !== null ? (value as Record<string, unknown>) : {}) };
  if (rest.length === 0 && next === undefined) delete copy[part];
  else copy[part] = replaced(copy[part], rest, next);
  return copy;
}

/** A copy with `next` at the pointer; undefined takes away what is there. Objects on the way are made. */
export function withValue<T>(document: T, pointer: string, next: unknown): T {
  return replaced(document, segments(pointer), next) as T;
}

/** Every number in a document with its pointer, in order. */
export function numbersIn(document: unknown, at = ""): { pointer: string; value: number }[] {
  if (typeof document === "number") return [{ pointer: at, value: document }];
  if (typeof document !== "object" || document === null) return [];
  const entries = Array.isArray(document)
    ? (document as unknown[]).map((value, i) => [String(i), value] as const)
    : Object.entries(document);
  return entries.flatMap(([name, value]) => numbersIn(value, at + pointerOf([name])));
}

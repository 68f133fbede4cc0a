// Extremes of a quantity along a member, which lie between its listed places as a rule.

/** Values along a member; lists of equal length. */
export interface Line {
  s: readonly number[];
  values: readonly number[];
}

interface Peak {
  s: number;
  value: number;
}

/** The line with its extremes among its points; results of earlier versions have none. */
export function withPeaks(line: Line, peaks: { min: Peak; max: Peak } | undefined): Line {
  const more = peaks ? [peaks.min, peaks.max].filter(({ s }) => !line.s.includes(s)) : [];
  if (more.length === 0) return line;
  const all = [...line.s.map((s, i) => ({ s, value: line.values[i] ?? 0 })), ...more].sort((a, b) => a.s - b.s);
  return { s: all.map(({ s }) => s), values: all.map(({ value }) => value) };
}

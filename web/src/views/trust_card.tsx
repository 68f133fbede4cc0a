// What was asked, first: the load to use, or what monitors read; then how far it can be trusted: the kind of a critical load, its
// estimated error, whether a finer mesh confirms it, and what was left out; and ways to do the same without the page.

import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import type { CriticalPoint, Model, RequestDocument, Result, Vibration } from "../api/documents";
import { hasKey } from "../api/client";
import { withShortNumbers } from "../app/words";
import { curlCommand, fileName, pythonProgram, saveJson } from "../export/files";
import { branchesOf, formatNumber, formatWithUnit, motionsOf, unitOf, type Quantity } from "../figures";
import type { Run } from "../model/run";
import { Card } from "./card";

const kNothing = 1e-12;  // smaller displacements are rounding
const kSaidElsewhere: ReadonlySet<string> = new Set(["nearly_unstable", "unstable"]);  // above the path, and as the headline
const kKinds: Record<string, string> = {
  bifurcation: "bifurcation", limit_max: "limit point", limit_min: "limit point (least load)",
  broken_bifurcation: "broken bifurcation", flutter: "flutter", capacity: "capacity of supports",
};

export function kindOf(type: string): string {
  return kKinds[type] ?? type;
}

function Badge({ good, children }: { good: boolean; children: string }) {
  return <span class={good ? "badge good" : "badge warn"}>{children}</span>;
}

function errorText(result: Result): string {
  const { error_estimate: estimate } = result.summary;
  const { requested } = result.discretization.accuracy;
  const asked = requested === null ? "on a given mesh" : `${formatNumber(requested, 1)} was asked`;
  return estimate === null ? `no error estimate, ${asked}` : `relative error about ${formatNumber(estimate, 1)}, ${asked}`;
}

/** The critical point that the summary speaks of, or the one that a static analysis ended at. */
function firstPoint(result: Result): CriticalPoint | undefined {
  const load = result.summary.critical_load_factor ?? (result.static ? result.critical_points[0]?.load_factor : null);
  return result.critical_points.find((one) => one.load_factor === load);
}

function warningOf(result: Result, code: Result["warnings"][number]["code"]): string | undefined {
  return result.warnings.find((one) => one.code === code)?.detail;
}

/** The lowest frequency of the first load factor of a vibration analysis, or that the structure is unstable there. */
function LowestFrequency({ vibration, earlier }: { vibration: Vibration; earlier: ComponentChildren }) {
  const motions = motionsOf(vibration.frequencies);
  const kind = motions.find((one) => one.kind !== "vibrates")?.kind;
  return (
    <>
      <p class="headline"><strong>{kind === undefined ? formatNumber(motions[0]?.omega ?? Number.NaN, 5) : ""}</strong>
        {earlier ?? (kind === undefined ? null : <Badge good={false}>{`unstable: ${kind}`}</Badge>)}</p>
      <p class="hint">{kind === undefined ? "lowest circular frequency," : "small motions grow"} at load factor {
        formatNumber(vibration.load_factor, 5)}</p>
    </>
  );
}

/** A reading of a monitor. */
interface Reading {
  id: string;
  text: string;
}

/** What monitors read at the end of the first path, or in the last row of a static analysis, and the load factor there. */
function lastReadings({ request, result }: Run): { load: number; readings: Reading[] } | null {
  const [branch] = branchesOf(result);
  const last = (branch?.load_factor.length ?? 0) - 1;
  const load = branch?.load_factor[last];
  if (!branch || load === undefined) return null;
  const readings = (request.model.monitors ?? []).flatMap(({ id, component }): Reading[] => {
    const value = branch.monitors[id]?.[last];
    return value === undefined ? [] : [{ id, text: readingText(request.model, component, value) }];
  });
  return { load, readings };
}

function readingText(model: Model, component: string, value: number): string {
  const unit = unitOf(model.units, component === "rotation" ? "rotation" : "length");
  return formatWithUnit(Math.abs(value) < kNothing ? 0 : value, unit);
}

/** Why there is no answer: a failure, or unstable rows of a static analysis; null where there is one. */
function troubleOf(result: Result): { word: string; detail: string } | null {
  if (result.failure) return { word: result.failure.code.replace(/_/g, " "), detail: result.failure.detail };
  const unstable = warningOf(result, "unstable");
  return unstable === undefined ? null : { word: "unstable", detail: unstable };
}

/** What leads where no critical load was found: a failure, the first buckling load, or what a monitor reads at the end. */
function WithoutLoad({ run, earlier }: { run: Run; earlier: ComponentChildren }) {
  const { result } = run;
  const trouble = troubleOf(result);
  const buckling = result.buckling?.load_factors[0];
  if (trouble) {
    return (
      <>
        <p class="headline">{earlier ?? <Badge good={false}>{trouble.word}</Badge>}<NearlyUnstable result={result} /></p>
        <p class="hint">{withShortNumbers(trouble.detail)}</p>
      </>
    );
  }
  const last = buckling === undefined ? lastReadings(run) : null;
  const [first] = last?.readings ?? [];
  const headline = buckling !== undefined ? formatNumber(buckling, 5) : first?.text ?? "none";
  const hint = buckling !== undefined ? "first buckling load" : `${first && last
    ? `${first.id} at load factor ${formatNumber(last.load, 5)}, ` : ""}no loss of stability on this path`;
  return (
    <>
      <p class="headline"><strong>{headline}</strong>{earlier}<NearlyUnstable result={result} /></p>
      <p class="hint">{hint}</p>
    </>
  );
}

function NearlyUnstable({ result }: { result: Result }) {
  return warningOf(result, "nearly_unstable") === undefined ? null : <Badge good={false}>nearly unstable</Badge>;
}

/** The load factor to use: that of the softest point where the structure is nearly unstable there; null elsewhere, and where the
 *  analysis has no answer. */
function loadToUse(result: Result): number | null {
  const { softest } = result.summary;
  return softest && !troubleOf(result) && warningOf(result, "nearly_unstable") !== undefined ? softest.load_factor : null;
}

function ratioText(result: Result): string {
  const ratio = result.summary.softest?.stiffness_ratio;
  return ratio == null ? "" : `, stiffness ratio ${formatNumber(ratio, 3)}`;
}

function confirmationOf(result: Result): { good: boolean; word: string } {
  const good = firstPoint(result)?.confirmed ?? result.summary.error_estimate !== null;
  return { good, word: good ? "confirmed" : result.discretization.accuracy.requested === null ? "this mesh only" : "not confirmed" };
}

function Headline({ run, stale }: { run: Run; stale: boolean }) {
  const { result } = run;
  const { critical_load_factor: load, critical_type: type } = result.summary;
  const earlier = stale ? <Badge good={false}>of an earlier model</Badge> : null;
  const vibration = result.failure ? undefined : result.vibrations?.[0];
  const use = loadToUse(result);
  if (vibration) return <LowestFrequency vibration={vibration} earlier={earlier} />;
  const { good, word } = confirmationOf(result);
  if (use !== null) {
    const beyond = load === null ? "no loss of stability on this path"
      : `${kindOf(type ?? "")} at ${formatNumber(load, 5)} (${word}), ${errorText(result)}`;
    return (
      <>
        <p class="headline"><strong>{formatNumber(use, 5)}</strong>{earlier}<NearlyUnstable result={result} /></p>
        <p class="hint">load factor to use{ratioText(result)}; {beyond}</p>
      </>
    );
  }
  if (load === null) return <WithoutLoad run={run} earlier={earlier} />;
  return (
    <>
      <p class="headline"><strong>{formatNumber(load, 5)}</strong>{earlier ?? <Badge good={good}>{word}</Badge>}
        <NearlyUnstable result={result} /></p>
      <p class="hint">{kindOf(type ?? "")}, {errorText(result)}</p>
    </>
  );
}

/** What the card tells. */
function titleOf(result: Result): string {
  if (result.vibrations) return "Vibrations";
  if (loadToUse(result) !== null) return "Load to use";
  const asked = result.summary.critical_load_factor === null && !troubleOf(result) && !result.buckling && branchesOf(result).length > 0;
  return asked ? "Result" : "First loss of stability";
}

function othersText(result: Result): string {
  const first = firstPoint(result);
  const counts = new Map<string, number>();
  for (const point of result.critical_points) {
    if (point !== first) counts.set(kindOf(point.type), (counts.get(kindOf(point.type)) ?? 0) + 1);
  }
  const texts = [...counts].map(([kind, count]) =>
    `${count} ${count === 1 ? kind : kind.replace(/^(\S*(?: bifurcation| point|bifurcation))/, "$1s")}`);
  return texts.length === 0 ? "no other critical point" : texts.join(", ");
}

/** What the load factor multiplies, where all proportional loads are of one kind and one size; else "". */
function loadText(model: Model, factor: number): string {
  const sizes = (model.loads ?? []).flatMap((load): [number, Quantity][] => {
    if (!("pattern" in load) || load.pattern !== "constant") {
      switch (load.type) {
        case "point": return (load.moment ?? 0) === 0 ? [[Math.hypot(...(load.force ?? [0, 0])), "force"]] : [[Number.NaN, "moment"]];
        case "distributed": return "along" in load.force ? [[Number.NaN, "none"]] : [[Math.hypot(...load.force), "line_load"]];
        case "pressure": return typeof load.value === "number" ? [[Math.abs(load.value), "line_load"]] : [[Number.NaN, "none"]];
        case "initial_strain":
        case "self_weight":
        case "temperature": return [[Number.NaN, "none"]];
      }
    }
    return [];
  });
  const [first] = sizes;
  if (!first || !sizes.every(([size, kind]) => size === first[0] && kind === first[1])) return "";
  const unit = unitOf(model.units, first[1]);
  return unit === "" ? "" : `${formatNumber(factor, 5)} × ${formatWithUnit(first[0], unit)} = ${formatWithUnit(factor * first[0], unit)}`;
}

function meshText(result: Result): string {
  const { elements, order, unknowns } = result.discretization;
  return elements === null ? "none" : `${elements} elements of order ${order ?? 1}, ${unknowns ?? "?"} unknowns`;
}

function effortText(run: Run): string {
  const { wall_time_s: seconds, steps } = run.result.diagnostics;
  const time = run.cached ? "stored earlier" : `${formatNumber(1000 * seconds, 2)} ms`;
  return steps === null || steps === 0 ? time : `${steps} steps, ${time}`;
}

/** Where the structure is softest before its critical load, if it is softer there than before and after. */
function softestRows(result: Result): [string, string][] {
  const { softest } = result.summary;
  if (!softest || !(softest.stiffness_ratio > 0)) return [];
  return [["Softest", `${formatNumber(softest.load_factor, 5)}, stiffness ratio ${formatNumber(softest.stiffness_ratio, 3)}`]];
}

/** How far the structure has moved at the critical load, and, where there are several members, the one that buckles. */
function stateRows(result: Result, model: Model, point: CriticalPoint | undefined, there: string): [string, string][] {
  const { at_critical: moved } = result.summary;
  const rows: [string, string][] = [];
  if (moved) {
    const size = Math.abs(moved.displacement) < kNothing ? 0 : moved.displacement;
    const share = `${formatNumber(100 * moved.relative_displacement, 2)} % of the size`;
    rows.push([`Moved ${there}`, `${formatWithUnit(size, unitOf(model.units, "length"))}, ${share}`]);
  }
  if (point?.member != null && model.members.length > 1) rows.push(["Member", `${point.member} buckles`]);
  return rows;
}

function rowsOf(run: Run): [string, string][] {
  const { result } = run;
  const point = firstPoint(result);
  const use = loadToUse(result);
  const there = point && use !== null ? `at ${formatNumber(point.load_factor, 5)}` : "there";
  const factor = use ?? point?.load_factor;
  const load = factor === undefined ? "" : loadText(run.request.model, factor);
  const rows = use === null ? softestRows(result) : [];
  if (load !== "") rows.push([use === null ? "Load there" : "Load to use", load]);
  rows.push(...stateRows(result, run.request.model, point, there));
  for (const { id, component } of run.request.model.monitors ?? []) {
    const value = point?.monitors[id];
    if (value !== undefined) rows.push([`${id} ${there}`, readingText(run.request.model, component, value)]);
  }
  if (!point && result.summary.critical_load_factor === null) {
    rows.push(...(lastReadings(run)?.readings ?? []).slice(troubleOf(result) || use !== null ? 0 : 1).map(({ id, text }): [string, string] => [id, text]));
  }
  if (point && result.critical_points.length > 0) rows.push(["Also on this path", othersText(result)]);
  rows.push(["Mesh", meshText(result)], ["Effort", effortText(run)]);
  const others = result.buckling?.load_factors.slice(1, 6) ?? [];
  if (others.length > 0) rows.push(["Further loads", others.map((load) => formatNumber(load, 5)).join(", ")]);
  return rows;
}

/** Copies a text, and says so for a moment. */
export function CopyButton({ label, text, disabled = false }: { label: string; text: () => string; disabled?: boolean }) {
  const [said, say] = useState(false);
  const copy = async (): Promise<void> => {
    await navigator.clipboard.writeText(text()).catch(() => undefined);
    say(true);
    setTimeout(() => say(false), 1500);
  };
  return <button type="button" disabled={disabled} onClick={() => void copy()}>{said ? "Copied" : label}</button>;
}

interface TrustProps {
  run: Run | null;
  /** What the user asked for, without the output that pictures need. */
  request: RequestDocument | null;
  /** The request got no answer, and the run is of an earlier one. */
  stale?: boolean;
  class?: string;
}

export function TrustCard({ run, request, stale = false, class: name = "" }: TrustProps) {
  if (!run || !request) return <Card title="First loss of stability" class={`trust-card ${name}`}><p class="hint">No result yet.</p></Card>;
  const { result } = run;
  const file = fileName(request.model.title ?? "", "");
  return (
    <Card title={titleOf(result)} class={`trust-card ${name}`}>
      <Headline run={run} stale={stale} />
      <dl class="rows">
        {rowsOf(run).map(([term, value]) => <div key={term}><dt>{term}</dt><dd>{value}</dd></div>)}
      </dl>
      {result.warnings.filter(({ code }) => !kSaidElsewhere.has(code)).map((one, i) => <p class="warning" key={i}>{one.detail}</p>)}
      {result.diagnostics.skipped.length > 0 ? (
        <details class="skipped"><summary>Left out ({result.diagnostics.skipped.length})</summary>
          <ul>{result.diagnostics.skipped.map((text) => <li key={text}>{text}</li>)}</ul></details>
      ) : null}
      <div class="buttons">
        <CopyButton label="Copy curl" disabled={stale} text={() => curlCommand(request, location.origin, hasKey())} />
        <CopyButton label="Copy Python" disabled={stale} text={() => pythonProgram(request, location.origin, hasKey())} />
        <button type="button" disabled={stale} onClick={() => saveJson(`${file}-request.json`, request)}>Request</button>
        <button type="button" disabled={stale} onClick={() => saveJson(`${file}-result.json`, result)}>Result</button>
      </div>
    </Card>
  );
}

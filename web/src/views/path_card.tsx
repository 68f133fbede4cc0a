// The equilibrium path: choose what is on the axes, walk along it by pointer or keys, play it.

import type { ComponentChildren } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Branch, Model } from "../api/documents";
import { shapeNode } from "../app/shape_view";
import { useSize } from "../app/size";
import { asSentence } from "../app/words";
import { fileName, savePng, saveSvg, saveText } from "../export/files";
import {
  branchesOf, bucklingFigure, chosenShape, criticalNear, defaultQuantities, formatNumber, formatWithUnit, frequencyTable, hasFrequencies,
  hasStiffness, isReversed,
  nearestMode, nearestOnPath, pathChart, pathFigure, pathTable, quantityLabel, softestNear, softestPoint, tableCsv, unitOf,
  type PathInput, type PathPoint, type PathQuantity, type PathResult, type PathShadow, type Size,
} from "../figures";
import { choiceOf, lengthOf, rowOf, stationFor, type Run } from "../model/run";
import type { Choice } from "../model/gallery";
import { Card, Menu } from "./card";
import { PathFrequencies } from "./frequency_card";
import { LongTable } from "./long_table";

const kPlayFrame = 70;  // ms that each state is shown for
const kNoResult: PathResult = { branches: [], critical_points: [], contact_events: [] };

/** A mark that is chosen: the number of a critical point, or the softest point. */
export type Marked = number | "softest";

export interface PathProps {
  model: Model;
  run: Run | null;
  growing: Branch[] | null;
  shadows: readonly PathShadow[];
  choice: Choice;
  onChoice: (choice: Choice) => void;
  /** What is said of the chosen mark. */
  note: ComponentChildren;
  marked: Marked | null;
  onMark: (marked: Marked | null) => void;
  class?: string;
}

function sameQuantity(a: PathQuantity, b: PathQuantity): boolean {
  return a.kind === b.kind && (a.kind !== "monitor" || (b.kind === "monitor" && a.id === b.id));
}

function nameOf(quantity: PathQuantity): string {
  return quantity.kind === "monitor" ? quantity.id : { load_factor: "load", arc_length: "arc length" }[quantity.kind];
}

/** Every quantity that the result has, monitors turned as the default is. */
function quantitiesOf(result: PathResult): PathQuantity[] {
  const [branch] = branchesOf(result);
  const monitors = Object.keys(branch?.monitors ?? {}).map((id): PathQuantity =>
    ({ kind: "monitor", id, reversed: isReversed(result, id) }));
  return [...monitors, { kind: "load_factor" }, { kind: "arc_length" }];
}

interface AxisProps {
  label: string;
  value: PathQuantity;
  from: PathQuantity[];
  onChange: (value: PathQuantity) => void;
}

function AxisChoice({ label, value, from, onChange }: AxisProps) {
  return (
    <label class="axis-choice">{label}
      <select value={from.findIndex((one) => sameQuantity(one, value))}
              onChange={(event) => {
                const chosen = from[Number(event.currentTarget.value)];
                if (chosen) onChange(chosen);
              }}>
        {from.map((one, i) => <option key={i} value={i}>{nameOf(one)}</option>)}
      </select>
    </label>
  );
}

/** Choices of the axes that hold for as long as the result has them. */
function useAxes(result: PathResult): { x: PathQuantity; y: PathQuantity; all: PathQuantity[];
                                        setX: (x: PathQuantity) => void; setY: (y: PathQuantity) => void } {
  const [wanted, setWanted] = useState<{ x: PathQuantity | null; y: PathQuantity | null }>({ x: null, y: null });
  const all = quantitiesOf(result);
  const usual = defaultQuantities(result);
  const known = (quantity: PathQuantity | null): PathQuantity | undefined =>
    quantity ? all.find((one) => sameQuantity(one, quantity)) : undefined;
  return {
    x: known(wanted.x) ?? usual.x, y: known(wanted.y) ?? usual.y, all,
    setX: (x) => setWanted({ ...wanted, x }), setY: (y) => setWanted({ ...wanted, y }),
  };
}

interface ChartProps {
  input: PathInput;
  size: Size;
  point: PathPoint | null;
  onPoint: (point: PathPoint) => void;
  /** So many states further along the branch. */
  onStep: (steps: number) => void;
  onMark: (marked: Marked | null) => void;
  onPlay: () => void;
}

/** States along the path that a key means. */
function stepsOf(key: string): number | null {
  const steps: Record<string, number> = {
    ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 5, PageDown: -5, Home: -1e9, End: 1e9,
  };
  return steps[key] ?? null;
}

function Chart({ input, size, point, onPoint, onStep, onMark, onPlay }: ChartProps) {
  const chart = useMemo(() => pathChart(input, size), [input, size]);
  const figure = useMemo(() => shapeNode(pathFigure(input, size, chart)), [chart]);
  const drag = useRef(false);
  const pick = (event: PointerEvent): void => {
    const box = (event.currentTarget as Element).getBoundingClientRect();
    const at = { x: event.clientX - box.left, y: event.clientY - box.top };
    const pressed = event.type === "pointerdown";
    const mark = pressed ? criticalNear(chart, at)?.number ?? (softestNear(chart, at) ? "softest" : null) : null;
    if (mark !== null) {
      onMark(mark);
      return;
    }
    const near = nearestOnPath(chart, at);
    if (near) onPoint({ branch: near.branch, index: near.index });
  };
  const press = (event: KeyboardEvent): void => {
    const steps = stepsOf(event.key);
    const branches = branchesOf(input.result);
    if (event.key === " " || event.key === "p") onPlay();
    else if (event.key === "b" && branches.length > 1) {
      onPoint({ branch: ((point?.branch ?? 0) + 1) % branches.length, index: 1 });
    } else if (steps !== null) onStep(steps);
    else return;
    event.preventDefault();
  };
  return (
    <div class="picture walkable" tabIndex={0} role="group" onKeyDown={press}
         aria-label="Equilibrium path. Arrow keys walk along it, b changes the branch, space plays."
         onPointerDown={(event) => {
           drag.current = true;
           event.currentTarget.setPointerCapture(event.pointerId);
           pick(event);
         }}
         onPointerMove={(event) => (drag.current ? pick(event) : undefined)} onPointerUp={() => (drag.current = false)}>
      {figure}
      <svg class="figure overlay" width={size.width} height={size.height} aria-hidden="true">{shapeNode(chosenShape(chart, point))}</svg>
    </div>
  );
}

/** Walks from state to state along a branch while it plays. */
function usePlay(props: PathProps): [boolean, () => void] {
  const [playing, setPlaying] = useState(false);
  const now = useRef(props);
  now.current = props;
  useEffect(() => {
    if (!playing) return undefined;
    const timer = setInterval(() => {
      const { run, choice, onChoice } = now.current;
      if (!run) return;
      const here = stationFor(run, choice);
      const next = run.stations[here + 1];
      const station = next && next.branch === run.stations[here]?.branch ? next : null;
      const length = station ? lengthOf(branchesOf(run.result)[station.branch]) : 0;
      if (station && length > 0) onChoice({ kind: "along", branch: station.branch, share: station.arc / length });
      else setPlaying(false);
    }, kPlayFrame);
    return () => clearInterval(timer);
  }, [playing]);
  const toggle = (): void => {
    const { run, choice, onChoice } = now.current;
    const station = run?.stations[run ? stationFor(run, choice) : -1];
    const atEnd = run && station && !run.stations.some((one) => one.branch === station.branch && one.arc > station.arc);
    if (!playing && atEnd) onChoice({ kind: "along", branch: station.branch, share: 0 });
    setPlaying(!playing);
  };
  return [playing, toggle];
}

/** The loads of a buckling analysis; a click chooses the mode that is drawn. */
export function BucklingCard({ run, mode, onMode }: { run: Run; mode: number; onMode: (mode: number) => void }) {
  const [place, size] = useSize<HTMLDivElement>();
  const buckling = run.result.buckling;
  if (!buckling) return null;
  const input = { buckling, chosen: mode };
  const name = fileName(run.request.model.title ?? "", "-buckling");
  const take = (): ReturnType<typeof bucklingFigure> => bucklingFigure(input, size ?? { width: 640, height: 440 });
  const last = buckling.load_factors.length - 1;
  return (
    <Card title="Buckling loads" class="path-card" tools={<Menu label="Export" items={[
      { text: "SVG", act: () => saveSvg(`${name}.svg`, take()) }, { text: "PNG", act: () => void savePng(`${name}.png`, take()) },
    ]} />}>
      <div class="fill" ref={place}>
        {size ? (
          <div class="picture walkable" tabIndex={0} role="group" aria-label="Buckling loads. Left and right choose a mode."
               onKeyDown={(event) => {
                 if (event.key === "ArrowRight") onMode(Math.min(last, mode + 1));
                 if (event.key === "ArrowLeft") onMode(Math.max(0, mode - 1));
               }}
               onPointerDown={(event) => {
                 const box = event.currentTarget.getBoundingClientRect();
                 const near = nearestMode(input, size, { x: event.clientX - box.left, y: event.clientY - box.top });
                 if (near !== null) onMode(near);
               }}>{shapeNode(take())}</div>
        ) : null}
      </div>
    </Card>
  );
}

/** Which load to use where a structure is nearly unstable: the warning of that name, short. */
function shortAdvice(run: Run): string {
  const { softest, at_critical: moved, critical_load_factor: critical } = run.result.summary;
  const at = softest ? ` at load factor ${formatNumber(softest.load_factor, 5)}: use it` : "";
  const not = critical === null ? "" : `, not ${formatNumber(critical, 5)}`;
  const far = moved ? `displacements of ${formatWithUnit(moved.displacement, unitOf(run.request.model.units, "length"), 3)}`
                    : "the displacements beyond it";
  return `Nearly unstable${at}${not}, unless ${far} are acceptable.`;
}

/** What a structure that is nearly unstable must not leave unsaid, and the motion that it is softest in. */
function NearlyUnstable({ run, marked, onMark }: { run: Run; marked: Marked | null; onMark: (marked: Marked | null) => void }) {
  const [whole, setWhole] = useState(false);
  const warning = run.result.warnings.find((one) => one.code === "nearly_unstable");
  if (!warning) return null;
  const chosen = marked === "softest";
  return (
    <div class="warning nearly-unstable" role="status">
      <p>{whole ? asSentence(warning.detail) : shortAdvice(run)}
        <button type="button" class="quiet" aria-expanded={whole} onClick={() => setWhole(!whole)}>{whole ? "In short" : "In full"}</button>
        {run.result.summary.softest?.mode ? (
          <button type="button" class="quiet" aria-pressed={chosen} onClick={() => onMark(chosen ? null : "softest")}>
            {chosen ? "Hide the motion" : "Show the motion"}</button>
        ) : null}</p>
    </div>
  );
}

/** Whether the warning that a structure is nearly unstable is shown. */
function isWarned(run: Run | null, growing: Branch[] | null): boolean {
  return run !== null && growing === null && run.result.warnings.some((one) => one.code === "nearly_unstable");
}

interface Stiffness {
  /** Whether the second curve is shown. */
  shown: boolean;
  /** Whether the path has stiffness ratios. */
  there: boolean;
  toggle: () => void;
}

function StiffnessButton({ of: { shown, there, toggle } }: { of: Stiffness }) {
  if (!there) return null;
  return <button type="button" aria-pressed={shown} onClick={toggle} title="Least stiffness over that without load">Stiffness</button>;
}

/** The second curve is shown where the path has a softest point, until the user says otherwise. */
function useStiffness(result: PathResult): Stiffness {
  const [wanted, setWanted] = useState<boolean | null>(null);
  const there = hasStiffness(result);
  const shown = there && (wanted ?? softestPoint(result) !== null);
  return { shown, there, toggle: () => setWanted(!shown) };
}

const kBeside = 560;  // px of width that have room for two charts

/** Frequencies are shown, where the path has them, beside the path or in its place, until the user says otherwise. */
function useFrequencies(result: PathResult, size: Size | null): { there: boolean; shown: boolean; path: Size | null; chart: Size | null;
                                                                   toggle: () => void } {
  const roomy = size !== null && size.width >= kBeside;
  const [wanted, setWanted] = useState<boolean | null>(null);
  const there = useMemo(() => hasFrequencies(result), [result]);
  const shown = there && (wanted ?? roomy);
  const half = useMemo(() => size && { width: Math.floor(size.width / 2), height: size.height }, [size]);
  const chart = !shown ? null : roomy ? half : size;
  return { there, shown, chart, path: !shown ? size : roomy ? half : null, toggle: () => setWanted(!shown) };
}

function PathMenu({ name, input, take, twin, toggle, togglePoints }: {
  name: string; input: PathInput; take: () => ReturnType<typeof pathFigure>; twin: boolean; toggle: () => void; togglePoints: () => void;
}) {
  // The rows of a static analysis are always marked.
  const points = twin || input.result.branches.length === 0 ? []
    : [{ text: input.points ? "Hide computed points" : "Show computed points", act: togglePoints }];
  const frequencies = hasFrequencies(input.result)
    ? [{ text: "CSV of frequencies", act: () => saveText(`${name}-frequencies.csv`, tableCsv(frequencyTable(input.result)), "text/csv") }]
    : [];
  return (
    <Menu label="Export" items={[
      { text: twin ? "Show the chart" : "Show as table", act: toggle },
      ...points,
      { text: "SVG", act: () => saveSvg(`${name}-path.svg`, take()) },
      { text: "PNG", act: () => void savePng(`${name}-path.png`, take()) },
      { text: "CSV", act: () => saveText(`${name}-path.csv`, tableCsv(pathTable(input)), "text/csv") },
      ...frequencies,
    ]} />
  );
}

export function PathCard(props: PathProps) {
  const { model, run, growing, shadows, choice, onChoice, marked, onMark } = props;
  const [place, size] = useSize<HTMLDivElement>();
  const [twin, setTwin] = useState(false);
  const result: PathResult = growing ? { ...kNoResult, branches: growing.filter(Boolean) } : run?.result ?? kNoResult;
  const axes = useAxes(result);
  const stiffness = useStiffness(result);
  const [points, setPoints] = useState(false);
  const frequencies = useFrequencies(result, size);
  const [playing, toggle] = usePlay(props);
  const input = useMemo<PathInput>(
    () => ({ result, x: axes.x, y: axes.y, shadows, monitors: run?.request.model.monitors ?? model.monitors, units: model.units,
             stiffness: stiffness.shown, points }),
    [result, nameOf(axes.x), nameOf(axes.y), shadows, model, stiffness.shown, points]);
  const station = run && !growing ? run.stations[stationFor(run, choice)] : undefined;
  const point = run && station ? rowOf(run, station) : null;
  const choose = (to: PathPoint): void => {
    if (!run) return;
    const branch = branchesOf(run.result)[to.branch];
    const length = lengthOf(branch);
    onMark(null);
    onChoice({ kind: "along", branch: to.branch, share: length > 0 ? (branch?.arc_length[to.index] ?? 0) / length : 0 });
  };
  const step = (steps: number): void => {
    if (!run || !station) return;
    onMark(null);
    const along = run.stations.filter((one) => one.branch === station.branch);
    const next = Math.min(along.length - 1, Math.max(0, along.indexOf(station) + steps));
    onChoice(choiceOf(run, run.stations.indexOf(along[next] ?? station)));
  };
  const name = fileName(model.title ?? "", "");
  const take = (): ReturnType<typeof pathFigure> => pathFigure({ ...input, chosen: point }, size ?? { width: 640, height: 440 });
  const paths = branchesOf(result).length > 0;
  const warned = isWarned(run, growing);
  return (
    <Card title="Equilibrium path" class={`path-card ${warned ? "warned" : ""} ${props.class ?? ""}`} tools={paths ? (
      <>
        {axes.all.length > 3 ? <AxisChoice label="y" value={axes.y} from={axes.all} onChange={axes.setY} /> : null}
        <AxisChoice label="x" value={axes.x} from={axes.all} onChange={axes.setX} />
        <StiffnessButton of={stiffness} />
        {frequencies.there
          ? <button type="button" aria-pressed={frequencies.shown} onClick={frequencies.toggle}>Frequencies</button> : null}
        <button type="button" aria-pressed={playing} onClick={toggle}>{playing ? "Stop" : "Play"}</button>
        <PathMenu name={name} input={input} take={take} twin={twin} toggle={() => setTwin(!twin)}
                  togglePoints={() => setPoints(!points)} />
      </>
    ) : null}>
      {warned && run ? <NearlyUnstable run={run} marked={marked} onMark={onMark} /> : null}
      {props.note}
      <div class="fill beside" ref={place}>
        {twin ? <LongTable table={pathTable(input)} caption={`${quantityLabel(axes.y)} against ${quantityLabel(axes.x)}`} /> : null}
        {!twin && frequencies.path && frequencies.path.height > 20
          ? <Chart input={input} size={frequencies.path} point={point} onPoint={choose} onStep={step} onPlay={toggle} onMark={onMark} />
          : null}
        {!twin && frequencies.chart && frequencies.chart.height > 20
          ? <PathFrequencies input={{ result, load: station?.load }} size={frequencies.chart} onPoint={choose} /> : null}
      </div>
    </Card>
  );
}

// Everything that is shown of a run: drawing, path, sections, and how far it can be trusted. The studio and the page of a job
// share it.

import { useMemo, useState } from "preact/hooks";
import type { Branch, Mode, RequestDocument, State, Vibration } from "../api/documents";
import { branchesOf, formatNumber, motionsOf, quadratureOf, softestPoint, type ChosenMotion, type PathShadow } from "../figures";
import type { Choice } from "../model/gallery";
import { isUnstable, lengthOf, stationFor, type Run } from "../model/run";
import { DrawingCard, type Pointed } from "./drawing_card";
import { VibrationCard } from "./frequency_card";
import { BucklingCard, PathCard, type Marked } from "./path_card";
import { SectionsCard } from "./sections_card";
import { kindOf, TrustCard } from "./trust_card";

export interface ResultProps {
  request: RequestDocument;
  run: Run | null;
  growing: Branch[] | null;
  shadows: readonly PathShadow[];
  choice: Choice;
  onChoice: (choice: Choice) => void;
  /** The request got no answer: what is shown is of an earlier one. */
  stale?: boolean | undefined;
  /** Asks for the branches of the first bifurcation as well; nothing where that can't be asked. */
  onFollow?: (() => void) | undefined;
}

/** What a chosen critical point says, above the drawing. */
function CriticalNote({ run, number, onFollow, onChoice, onClose }: {
  run: Run; number: number; onFollow: (() => void) | undefined; onChoice: (choice: Choice) => void; onClose: () => void;
}) {
  const point = run.result.critical_points[number];
  if (!point) return null;
  const branches = run.result.branches.flatMap((branch, index) =>
    branch.parent === run.result.branches[point.branch]?.id &&
    Math.abs((branch.load_factor[0] ?? Infinity) - point.load_factor) < 1e-6 * Math.max(1, Math.abs(point.load_factor)) ? [index] : []);
  return (
    <div class="note" role="status">
      <span><strong>{kindOf(point.type)}</strong> at {formatNumber(point.load_factor, 5)}
        {point.mode ? ", with its mode in purple" : ""}</span>
      {branches.map((index, i) => (
        <button type="button" key={index} onClick={() => onChoice({ kind: "along", branch: index, share: 0.5 })}>
          Go along branch {i + 1}
        </button>
      ))}
      {point.type === "bifurcation" && branches.length === 0 && onFollow
        ? <button type="button" onClick={onFollow}>Follow its branches</button> : null}
      <button type="button" onClick={onClose}>Close</button>
    </div>
  );
}

/** What the softest point says where no warning says it. */
function SoftestNote({ run, onClose }: { run: Run; onClose: () => void }) {
  const { softest } = run.result.summary;
  if (!softest || run.result.warnings.some((one) => one.code === "nearly_unstable")) return null;
  return (
    <div class="note" role="status">
      <span><strong>softest point</strong> at {formatNumber(softest.load_factor, 5)}: {formatNumber(softest.stiffness_ratio, 3)} of the
        unloaded stiffness{softest.mode ? ", with its motion in purple" : ""}</span>
      <button type="button" onClick={onClose}>Close</button>
    </div>
  );
}

/** The place along the primary path at which the structure is softest; null where the path does not come there. */
function softestChoice(run: Run): Choice | null {
  const point = softestPoint(run.result);
  const length = lengthOf(branchesOf(run.result)[0]);
  return point && length > 0 ? { kind: "along", branch: 0, share: point.arc / length } : null;
}

interface ShownVibration {
  all: readonly Vibration[];
  /** The motion that is shown: the chosen one, as far as the result has it. */
  chosen: ChosenMotion;
  mode: Mode | null;
  quadrature: Mode | null;
  /** Whether the motion oscillates: one that diverges has no period. */
  oscillates: boolean;
  /** The equilibrium that vibrates. */
  state: State | null;
}

/** What is shown of a vibration analysis; null for a result of another one. */
function vibrationOf(run: Run | null, wanted: ChosenMotion): ShownVibration | null {
  const { vibrations: all = [], static: table, states } = run?.result ?? {};
  const row = Math.min(all.length - 1, wanted.row);
  const one = all[row];
  if (!one) return null;
  const motion = Math.min(one.modes.length - 1, wanted.motion);
  const at = table?.state[table.load_factor.indexOf(one.load_factor)];
  return {
    all, chosen: { row, motion }, mode: one.modes[motion] ?? null, quadrature: quadratureOf(one, motion),
    oscillates: motionsOf(one.frequencies)[motion]?.kind !== "diverges", state: at == null ? null : states?.[at] ?? null,
  };
}

const kNothing: readonly State[] = [];

export function ResultViews({ request, run, growing, shadows, choice, onChoice, onFollow, stale = false }: ResultProps) {
  const [marked, setMarked] = useState<Marked | null>(null);
  const [modeNumber, setModeNumber] = useState(0);
  const [motion, setMotion] = useState<ChosenMotion>({ row: 0, motion: 0 });
  const [animated, setAnimated] = useState(() => !matchMedia("(prefers-reduced-motion: reduce)").matches);
  const [cursor, setCursor] = useState<Pointed | null>(null);
  const station = run?.stations[run ? stationFor(run, choice) : -1];
  const point = typeof marked === "number" ? run?.result.critical_points[marked] : undefined;
  const softest = marked === "softest" ? run?.result.summary.softest?.mode : null;
  const pointState = point?.state == null ? undefined : run?.result.states[point.state];
  const buckling = run?.result.buckling;
  const vibration = useMemo(() => vibrationOf(run, motion), [run, motion]);
  const state = pointState ?? vibration?.state ?? station?.state ?? null;
  const room = useMemo(() => run?.stations.map((one) => one.state) ?? kNothing, [run]);
  const first = request.analysis.type === "critical" ? run?.result.critical_points[0]?.mode : null;
  const mode = point?.mode ?? softest ?? first ?? vibration?.mode ?? buckling?.modes[modeNumber] ?? buckling?.modes[0] ?? null;
  const model = run?.request.model ?? request.model;
  const close = (): void => setMarked(null);
  const mark = (to: Marked | null): void => {
    setMarked(to);
    const there = run && to === "softest" ? softestChoice(run) : null;
    if (there) onChoice(there);
  };
  const note = !run || marked === null ? null : marked === "softest" ? <SoftestNote run={run} onClose={close} />
    : <CriticalNote run={run} number={marked} onFollow={onFollow} onClose={close} onChoice={(next) => {
        close();
        onChoice(next);
      }} />;
  return (
    <>
      <DrawingCard class={buckling ? "alone" : ""} model={model} state={state} mode={mode} room={room} cursor={cursor} onCursor={setCursor}
                   quadrature={vibration?.quadrature ?? null} animated={animated && vibration?.oscillates === true}
                   unstable={run !== null && station !== undefined && !pointState && !vibration && isUnstable(run, station)}
                   loadFactor={buckling?.load_factors[modeNumber] ?? null} />
      {run && buckling ? <BucklingCard run={run} mode={modeNumber} onMode={setModeNumber} />
        : run && vibration ? <VibrationCard run={run} vibrations={vibration.all} chosen={vibration.chosen} onChosen={setMotion}
                                            oscillates={vibration.oscillates} animated={animated} onAnimated={setAnimated} />
        : <PathCard model={model} run={run} growing={growing} shadows={shadows} choice={choice} onChoice={onChoice}
                    note={note} marked={marked} onMark={mark} />}
      {buckling ? null : <SectionsCard model={model} state={state} cursor={cursor} onCursor={setCursor} />}
      <TrustCard run={run} request={request} stale={stale} />
    </>
  );
}

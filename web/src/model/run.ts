// A result with the request that it answers, and where along its paths the states are.

import type { Branch, Location, Model, RequestDocument, Result, State } from "../api/documents";
import { branchesOf, flutterArc } from "../figures";
import type { Choice } from "./gallery";

/** A state and its place on a path: the branch's index and the arc length there. */
export interface Station {
  branch: number;
  arc: number;
  load: number;
  state: State;
}

export interface Run {
  job: string;
  /** What the user asked. */
  asked: RequestDocument;
  /** The same with the output that pictures need. */
  request: RequestDocument;
  result: Result;
  stations: Station[];
  /** What distinguishes it from other runs of the same model, such as "k = 3000". */
  label: string;
  milliseconds: number;
  cached: boolean;
  /** Its job is not removed when another run takes its place. */
  kept: boolean;
}

/** Whether a state that was reached on a path has negative eigenvalues or flutters there; a critical point itself is neither. */
export function isUnstable(run: Run, station: Station): boolean {
  const branch = branchesOf(run.result)[station.branch];
  const critical = run.result.critical_points.some((point) =>
    Math.abs(point.load_factor - station.load) <= 1e-6 * Math.abs(station.load));
  if (!branch || critical) return false;
  if (!run.result.static && station.arc > flutterArc(run.result, station.branch)) return true;
  const spans = branch.arc_length.map((arc) => Math.abs(arc - station.arc));
  return (branch.negative_eigenvalues[spans.indexOf(Math.min(...spans))] ?? 0) > 0;
}

function interpolated(s: readonly number[], values: readonly number[], at: number): number {
  const next = Math.max(1, s.findIndex((value) => value >= at));
  const from = s[next - 1] ?? 0;
  const to = s[next] ?? from;
  const share = to > from ? (at - from) / (to - from) : 0;
  const value = values[next - 1] ?? 0;
  return value + share * ((values[next] ?? value) - value);
}

/** A displacement of a state at a place: u, v and rotation. */
function displacementAt(model: Model, state: State, at: Location): { u: number; v: number; rotation: number } | null {
  let id: string | undefined;
  let share = 0;
  if ("member" in at) {
    id = at.member;
    share = at.fraction;
  } else {
    const member = model.members.find((one) => one.start === at.node || one.end === at.node);
    id = member?.id;
    share = member?.end === at.node ? 1 : 0;
  }
  const member = id === undefined ? undefined : state.members[id];
  if (!member) return null;
  const s = share * (member.s[member.s.length - 1] ?? 0);
  return {
    u: interpolated(member.s, member.u, s), v: interpolated(member.s, member.v, s),
    rotation: interpolated(member.s, member.rotation, s),
  };
}

/** The values that tell places of a path apart: the load factor, and monitors of x, y and rotation. */
function signature(model: Model, state: State): Map<string, number> {
  const values = new Map<string, number>();
  for (const monitor of model.monitors ?? []) {
    if (monitor.component === "normal") continue;
    const moved = displacementAt(model, state, monitor.at);
    if (moved) {
      values.set(monitor.id, { x: moved.u, y: moved.v, rotation: moved.rotation }[monitor.component]);
    }
  }
  return values;
}

function rangeOf(values: readonly number[]): number {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return high > low ? high - low : 1;
}

/** The arc length at which a branch comes nearest to a state, not before `after`. */
function arcOf(branch: Branch, state: State, values: Map<string, number>, after: number): number {
  const series = [...values].map(([id, value]) => ({ value, along: branch.monitors[id] ?? [] }));
  series.push({ value: state.load_factor, along: branch.load_factor });
  const terms = series.filter(({ along }) => along.length > 1).map((one) => ({ ...one, range: rangeOf(one.along) }));
  let best = { distance: Infinity, arc: after };
  for (let i = 1; i < branch.load_factor.length; ++i) {
    const from = branch.arc_length[i - 1] ?? 0;
    const to = branch.arc_length[i] ?? from;
    if (to < after) continue;
    let along = 0;
    let square = 0;
    for (const { value, along: list, range } of terms) {
      const way = ((list[i] ?? 0) - (list[i - 1] ?? 0)) / range;
      along += way * ((value - (list[i - 1] ?? 0)) / range);
      square += way * way;
    }
    const share = square > 0 ? Math.min(1, Math.max(0, along / square)) : 0;
    const distance = terms.reduce((sum, { value, along: list, range }) => {
      const here = (list[i - 1] ?? 0) + share * ((list[i] ?? 0) - (list[i - 1] ?? 0));
      return sum + ((value - here) / range) ** 2;
    }, 0);
    if (distance < best.distance - 1e-12) best = { distance, arc: from + share * (to - from) };
  }
  return best.arc;
}

/** Where the states of a result are, in the order of its paths; states of critical points are exactly there. */
export function stationsOf(model: Model, result: Result, states: readonly State[] = result.states): Station[] {
  const exact = new Map<State, number>();
  for (const point of result.critical_points) {
    const state = point.state === null ? undefined : result.states[point.state];
    if (state) exact.set(state, point.arc_length);
  }
  const branches = branchesOf(result);
  const stations = states.flatMap((state): Station[] => {
    const branch = branches[state.branch];
    if (!branch) return [];
    const arc = exact.get(state) ?? arcOf(branch, state, signature(model, state), 0);
    return [{ branch: state.branch, arc, load: state.load_factor, state }];
  });
  return stations.sort((a, b) => a.branch - b.branch || a.arc - b.arc);
}

/** The stations of a finer answer, and those of the run that are at critical points or where there are no finer ones. */
export function merged(run: Run, finer: readonly Station[]): Station[] {
  const critical = new Set(run.result.critical_points.map((point) => point.arc_length));
  const ends = branchesOf(run.result).map((_, branch) => finer.filter((one) => one.branch === branch).map((one) => one.arc));
  const kept = run.stations.filter((one) => {
    const arcs = ends[one.branch] ?? [];
    return critical.has(one.arc) || one.arc < Math.min(...arcs) || one.arc > Math.max(...arcs);
  });
  return [...kept, ...finer].sort((a, b) => a.branch - b.branch || a.arc - b.arc);
}

export function lengthOf(branch: Branch | undefined): number {
  return branch?.arc_length[branch.arc_length.length - 1] ?? 0;
}

/** The index of the station that a choice means; -1 when there is none. */
export function stationFor(run: Run, choice: Choice): number {
  const { stations, result } = run;
  const branches = branchesOf(result);
  let branch = 0;
  let arc = 0;
  if (choice.kind === "critical") {
    const load = result.summary.critical_load_factor;
    // A static analysis shows its last row: it ends before its critical point, and its arc length counts rows.
    const point = result.static ? undefined : result.critical_points.find((one) => one.load_factor === load) ?? result.critical_points[0];
    branch = point?.branch ?? 0;
    arc = point?.arc_length ?? lengthOf(branches[0]);
  } else {
    branch = choice.branch < branches.length ? choice.branch : 0;
    arc = choice.share * lengthOf(branches[branch]);
  }
  let best = -1;
  let distance = Infinity;
  stations.forEach((one, i) => {
    const away = one.branch === branch ? Math.abs(one.arc - arc) : Infinity;
    if (away < distance) {
      best = i;
      distance = away;
    }
  });
  return best >= 0 ? best : stations.length - 1;
}

/** The choice that means a station, also after the model has changed. */
export function choiceOf(run: Run, index: number): Choice {
  const station = run.stations[index];
  if (!station) return { kind: "critical" };
  const length = lengthOf(branchesOf(run.result)[station.branch]);
  return { kind: "along", branch: station.branch, share: length > 0 ? station.arc / length : 0 };
}

/** The row of its branch that is nearest to a station, as figures name points of a path. */
export function rowOf(run: Run, station: Station): { branch: number; index: number; arc: number } {
  const arcs = branchesOf(run.result)[station.branch]?.arc_length ?? [];
  let index = 0;
  arcs.forEach((arc, i) => {
    if (Math.abs(arc - station.arc) < Math.abs((arcs[index] ?? 0) - station.arc)) index = i;
  });
  return { branch: station.branch, index, arc: station.arc };
}

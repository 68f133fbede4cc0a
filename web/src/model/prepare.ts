// What the page asks the service for: a user's request with the output that pictures need.

import type { Branch, Model, RequestDocument, Result } from "../api/documents";

const kLiveStates = 8;       // of a path while a slider is dragged
const kModes = 6;            // of a buckling analysis
const kStations = 24;        // of each path that can be walked to; its curve is drawn by cubics between its rows
const kShapePoints = 96;     // of all members together in one state
const kLivePoints = 50;
const kLeastPoints = 15;     // of each member

/** Points along each member, fewer where there are many members. */
function pointsPerMember(model: Model, all: number): number {
  return Math.max(kLeastPoints, Math.round(all / Math.max(1, model.members.length)));
}

/** A model without monitors gets one, so that there is something to draw the path against. */
function withMonitor(model: Model): Model {
  const first = model.members[0];
  if (!first || (model.monitors ?? []).length > 0) return model;
  return { ...model, monitors: [{ id: `${first.id}, middle`, at: { member: first.id, fraction: 0.5 }, component: "normal" }] };
}

/**
 * The request with a smooth path and some states along it.
 * @param steps of the last answer, which says how many states "every" gives
 * @param live fewer and coarser states, for an answer as soon as can be
 */
export function forPictures(request: RequestDocument, steps: number | null, live: boolean): RequestDocument {
  const points = pointsPerMember(request.model, live ? kLivePoints : kShapePoints);
  const output = { ...request.analysis.output, points_per_member: points };
  switch (request.analysis.type) {
    case "path": {
      const every = Math.max(1, Math.round((steps ?? kLiveStates) / kLiveStates));
      const along = Math.max(kStations, request.analysis.output?.path_points ?? 0);
      return {
        model: withMonitor(request.model),
        analysis: { ...request.analysis, output: { ...output, states: { every }, path_points: along } },
      };
    }
    case "critical":
    case "static":
    case "vibration":
      return { model: withMonitor(request.model), analysis: { ...request.analysis, output: { ...output, states: "all" } } };
    case "buckling":
      return { ...request, analysis: { ...request.analysis, modes: Math.max(kModes, request.analysis.modes ?? 1), output } };
  }
}

function crossings(branch: Branch, load: number): number[] {
  const found: number[] = [];
  for (let i = 1; i < branch.load_factor.length; ++i) {
    const before = branch.load_factor[i - 1] ?? 0;
    const after = branch.load_factor[i] ?? 0;
    if ((before < load) === (after < load)) continue;
    const share = (load - before) / (after - before);
    const from = branch.arc_length[i - 1] ?? 0;
    found.push(from + share * ((branch.arc_length[i] ?? 0) - from));
  }
  return found;
}

/** Load factors at which the paths are cut, so that each path has states all along its way. */
export function loadsOfStations(branches: readonly Branch[]): number[] {
  const loads: number[] = [];
  const cuts = branches.map((): number[] => []);
  const few = branches.length > 1 ? kStations / 2 : kStations;
  branches.forEach((branch, number) => {
    const length = branch.arc_length[branch.arc_length.length - 1] ?? 0;
    const spacing = length / few;
    for (let k = 1; k <= few; ++k) {
      const arc = k * spacing;
      if (!(spacing > 0) || cuts[number]?.some((cut) => Math.abs(cut - arc) < 0.5 * spacing)) continue;
      const index = branch.arc_length.findIndex((value) => value >= arc - 1e-12 * length);
      const load = branch.load_factor[index];
      if (load === undefined || loads.includes(load)) continue;
      loads.push(load);
      branches.forEach((other, i) => cuts[i]?.push(...crossings(other, load)));
      cuts[number]?.push(arc);
    }
  });
  return loads;
}

/** The same analysis with states all along its paths and at its softest point, without frequencies; null when it has no paths to walk. */
export function forWalking(request: RequestDocument, result: Result): RequestDocument | null {
  const { softest } = result.summary;
  const between = softest && softest.stiffness_ratio > 0 ? [softest.load_factor] : [];
  const loads = [...new Set([...loadsOfStations(result.branches), ...between])];
  if (request.analysis.type !== "path" || loads.length === 0) return null;
  const output = {
    ...request.analysis.output, states: { at_load_factors: loads }, points_per_member: pointsPerMember(request.model, kShapePoints),
    frequencies: 0,
  };
  return { model: withMonitor(request.model), analysis: { ...request.analysis, output } };
}

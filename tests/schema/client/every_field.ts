// A client that sets every field of a request and of a sweep and reads every field of what comes back, against the types that
// openapi-typescript makes of the document.
import type {components, paths} from './generated/snapthrough.js';

type Schemas = components['schemas'];

const location: Schemas['Location'][] = [{node: 'a'}, {member: 'beam', fraction: 0.5}];

const sections: Schemas['Section'][] = [
  {id: 'stiffness', EA: 1e6, EI: 10, GA: 1e5},
  {id: 'material', E: 2e8, A: 1e-2, I: 1e-5, nu: 0.3, shear_area: 8e-3},
];

const curves: Schemas['Curve'][] = [
  {type: 'line'},
  {type: 'arc', sweep_degrees: -90},
  {type: 'parabola', rise: 1},
  {type: 'sine', rise: 1, half_waves: 2},
  {type: 'points', points: [[1, 0.5], [2, 0.7]]},
];

const supports: Schemas['Support'][] = [
  {node: 'a', fixed: ['x', 'y', 'rotation'], angle_degrees: 30,
   displacement: {x: 0.1, y: 0, rotation: 0.01, pattern: 'constant'}},
  {node: 'b', fixed: ['y'], displacement: {y: 0.1}, pattern: 'proportional'},
];

const springs: Schemas['Spring'][] = [
  {id: 'prop', at: {node: 'a'}, direction: [0, -1], stiffness: 1e3, reaction: 'compression_only', gap: 0.01},
  {id: 'turning', at: {member: 'beam', fraction: 1}, direction: 'rotation', stiffness: 5},
];

const foundations: Schemas['Foundation'][] = [
  {id: 'soil', member: 'beam', stiffness: 1e4, shear_stiffness: 0, reaction: 'tension_only', range: [0, 0.5], gap: 0,
   direction: 'normal', side: 'right'},
  {id: 'below', member: 'beam', stiffness: 1e4, direction: [0, -1]},
];

const loads: Schemas['Load'][] = [
  {type: 'point', at: {node: 'b'}, force: [0, -1], moment: 0.1, pattern: 'constant'},
  {type: 'distributed', member: 'beam', force: [0, -1], range: [0, 1], per: 'horizontal', pattern: 'proportional'},
  {type: 'pressure', member: 'beam', value: 1, side: 'left', pattern: 'proportional'},
  {type: 'initial_strain', member: 'beam', axial: 1e-4, curvature: 0, pattern: 'constant'},
];

const imperfections: Schemas['Imperfection'][] = [
  {type: 'sine', member: 'beam', half_waves: 1, amplitude: 1e-3},
  {type: 'mode', number: 1, amplitude: 1e-3},
  {type: 'points', member: 'beam', offsets: [[0, 0], [0.5, 1e-3], [1, 0]]},
];

const model: Schemas['Model'] = {
  title: 'every field', units: {length: 'm', force: 'kN'},
  nodes: [{id: 'a', x: 0, y: 0}, {id: 'b', x: 5, y: 0}],
  sections,
  members: curves.map((curve, i) => ({
    id: `beam ${i}`, start: 'a', end: 'b', section: 'stiffness', curve,
    release: {start: ['rotation'], end: []}})),
  supports, springs, foundations, loads, imperfections,
  monitors: location.map((at, i) => ({id: `m${i}`, at, component: 'y'})),
};

const discretizations: Schemas['Discretization'][] = [
  {accuracy: 1e-4}, {elements: 16, order: 3, foundation: 'lumped'}, {elements: {beam: 8}, order: 2, foundation: 'consistent'}];

const states: NonNullable<Schemas['Output']['states']>[] = ['none', 'critical', 'all', {every: 5}, {at_load_factors: [0.5, 1]}];

const analyses: Schemas['Analysis'][] = discretizations.flatMap((discretization) => states.map((one) => ({
  type: 'path', modes: 3, reversed: true, load_factors: [0.5, 1], geometry: 'nonlinear', unstable: 'follow', discretization,
  control: {displacement: 'm0'},
  start: {load_factor: 1, members: {beam: {s: [0, 1], u: [0, 0], v: [0, 0], rotation: [0, 0], axial_force: [0, 0],
                                           shear_force: [0, 0], bending_moment: [0, 0]}}},
  step: {initial: 0.1, min: 1e-6, max: 0.5, direction: -1},
  stop: {limit_points: 2, load_factor: [-1, 5], monitor: {id: 'm0', range: [-1, 1]}, steps: 100, negative_eigenvalues: 4},
  branches: {follow: 'all', limit: 3},
  output: {states: one, points_per_member: 51, path_points: 200, extremes: true},
  sensitivities: ['/model/nodes/0/x'], koiter: true,
})));

const sweep: Schemas['SweepDocument'] = {
  model: {...model}, analysis: {type: 'buckling', modes: 2},
  parameters: [
    {name: 'thickness', targets: [{pointer: '/model/sections/0/EA', scale: 2e8, power: 1},
                                  {pointer: '/model/sections/0/EI', scale: 2e7, power: 3}],
     range: {from: 0.01, to: 0.1, count: 5, spacing: 'log'}},
    {name: 'ends', targets: [{pointer: '/model/supports'}], values: [[{node: 'a', fixed: ['x']}], []], label: ['held', 'free']},
  ],
  design: {latin_hypercube: {samples: 10, seed: 1}}, follow: 'ends', outputs: ['/buckling/load_factors/0'],
};

/** Adds up whatever is a number, so that every field is read as the type that the document gives it. */
class Sum {
  total = 0;
  texts: string[] = [];
  number(...values: (number | null | undefined)[]) { for (const value of values) this.total += value ?? 0; }
  numbers(...lists: (readonly (number | null)[])[]) { for (const list of lists) this.number(...list); }
  text(...values: (string | null | undefined)[]) { for (const value of values) this.texts.push(value ?? ''); }
  flag(...values: boolean[]) { this.total += values.filter(Boolean).length; }
}

function readMode(mode: Schemas['Mode'], sum: Sum) {
  for (const {s, u, v, rotation} of Object.values(mode.members)) sum.numbers(s, u, v, rotation);
}

function readCriticalPoint(point: Schemas['CriticalPoint'], sum: Sum) {
  const type: 'bifurcation' | 'limit_max' | 'limit_min' | 'broken_bifurcation' = point.type;
  sum.text(type, point.cause, point.member);
  sum.number(point.branch, point.load_factor, point.error_estimate, point.arc_length, point.negative_before,
             point.negative_after, point.multiplicity, point.imperfection, point.state, ...Object.values(point.monitors));
  sum.flag(point.confirmed);
  for (const {elements, order, load_factor} of point.meshes) sum.number(elements, order, load_factor);
  if (point.mode !== null) readMode(point.mode, sum);
  if (point.koiter) {
    sum.text(point.koiter.kind);
    sum.number(point.koiter.a, point.koiter.b);
  }
  for (const {pointer, derivative, reason} of point.sensitivities ?? []) {
    sum.text(pointer, reason);
    sum.number(derivative);
  }
}

function readBranch(branch: Schemas['Branch'], sum: Sum) {
  sum.number(branch.id, branch.parent);
  sum.numbers(branch.load_factor, branch.arc_length, branch.negative_eigenvalues, ...Object.values(branch.monitors),
              ...Object.values(branch.contact_fraction));
  sum.numbers(branch.stiffness_ratio);
  sum.text(branch.termination);
}

function readResultant({fx, fy, moment}: Schemas['Resultant'], sum: Sum) { sum.number(fx, fy, moment); }

function readState(state: Schemas['State'], sum: Sum) {
  sum.number(state.branch, state.load_factor, state.refinements);
  for (const one of Object.values(state.members)) {
    sum.numbers(one.s, one.x0, one.y0, one.x, one.y, one.u, one.v, one.rotation, one.axial_force, one.shear_force, one.bending_moment);
  }
  for (const {fx, fy, moment} of Object.values(state.supports)) sum.number(fx, fy, moment);
  for (const {force, displacement, closed} of Object.values(state.springs)) {
    sum.number(force, displacement);
    sum.flag(closed);
  }
  for (const {s, reaction, displacement, contact, resultant} of Object.values(state.foundations)) {
    sum.numbers(s, reaction, displacement);
    for (const [from, to] of contact) sum.number(from, to);
    readResultant(resultant, sum);
  }
  readResultant(state.loads, sum);
}

function readExtremes(extremes: Schemas['Extremes'], sum: Sum) {
  for (const {axial_force, shear_force, bending_moment, displacement} of Object.values(extremes.members)) {
    for (const {min, max} of [axial_force, shear_force, bending_moment]) {
      for (const {value, s, branch, load_factor} of [min, max]) sum.number(value, s, branch, load_factor);
    }
    sum.number(displacement.max.value, displacement.max.s, displacement.max.branch, displacement.max.load_factor);
  }
}

function readNumbers({discretization, diagnostics}: Schemas['Result'], sum: Sum) {
  const {elements, order, unknowns, refinements, paths, accuracy} = discretization;
  sum.number(elements, order, unknowns, refinements, paths, accuracy.requested, accuracy.estimated);
  const {steps, rejected_steps, iterations, factorizations, max_relative_residual, wall_time_s, skipped} = diagnostics;
  sum.number(steps, rejected_steps, iterations, factorizations, max_relative_residual, wall_time_s);
  sum.text(...skipped);
}

export function readResult(result: Schemas['Result'], sum: Sum) {
  const {model: named, summary, critical_points, neutral_motion, contact_events, branches, states: all} = result;
  sum.text(named.title, ...Object.values(named.units), summary.critical_type, summary.termination, summary.message);
  sum.number(summary.critical_load_factor, summary.error_estimate);
  if (summary.softest) {
    sum.number(summary.softest.load_factor, summary.softest.stiffness_ratio);
    if (summary.softest.mode !== null) readMode(summary.softest.mode, sum);
  }
  if (summary.at_critical) {
    const {displacement, relative_displacement, rotation, strain} = summary.at_critical;
    sum.number(displacement, relative_displacement, rotation, strain);
  }
  for (const point of critical_points) readCriticalPoint(point, sum);
  for (const {branch, from, to, nodes} of neutral_motion) {
    sum.number(branch, from, to);
    for (const {u, v, rotation} of Object.values(nodes)) sum.number(u, v, rotation);
  }
  for (const {branch, id, type, load_factor, arc_length, zones_before, zones_after} of contact_events) {
    sum.number(branch, load_factor, arc_length, zones_before, zones_after);
    sum.text(id, type);
  }
  for (const branch of branches) readBranch(branch, sum);
  for (const state of all) readState(state, sum);
  if (result.static) {
    const {load_factor, monitors, negative_eigenvalues, contact_fraction, state} = result.static;
    sum.numbers(load_factor, negative_eigenvalues, state, ...Object.values(monitors), ...Object.values(contact_fraction));
  }
  sum.numbers(result.not_reached);
  if (result.buckling) {
    sum.numbers(result.buckling.load_factors, result.buckling.error_estimates);
    for (const mode of result.buckling.modes) readMode(mode, sum);
  }
  if (result.extremes) readExtremes(result.extremes, sum);
  for (const {code, detail} of result.warnings) sum.text(code, detail);
  readNumbers(result, sum);
  if (result.failure) sum.text(result.failure.code, result.failure.detail);
}

type Created = paths['/v1/jobs']['post'];

/** What POST /v1/jobs may answer, by status. */
export async function solve(service: string, request: Created['requestBody']['content']['application/json']): Promise<Sum> {
  const sum = new Sum();
  const response = await fetch(`${service}/v1/jobs`, {method: 'POST', body: JSON.stringify(request)});
  if (response.status === 200) {
    readResult(await response.json() as Schemas['Result'], sum); // a job only comes where one is preferred
  } else if (response.status === 201) {
    const job = await response.json() as Created['responses'][201]['content']['application/json'];
    sum.text(job.id, job.status, job.error?.code);
  } else {
    const problem = await response.json() as Schemas['Problem'];
    sum.text(problem.type, problem.detail, ...(problem.errors ?? []).map(({pointer, code, detail}) => pointer + code + detail));
    if (problem.reached) readResult(problem.reached, sum);
  }
  return sum;
}

export const requests: Schemas['Request'][] = analyses.map((analysis) => ({model, analysis}));
export const document: Schemas['SweepDocument'] = sweep;

// A client that sets every field of a request and of a sweep, against the types that openapi-typescript makes of the document.
// What comes back is read by a program that client.test.mjs makes of the document.
import type {components, paths} from './generated/snapthrough.js';

type Schemas = components['schemas'];

const location: Schemas['Location'][] = [{node: 'a'}, {member: 'beam', fraction: 0.5}];

const shapes: Schemas['Shape'][] = [
  {type: 'rectangle', width: 0.3, depth: 0.5},
  {type: 'tube', diameter: 0.5, thickness: 0.01},
  {type: 'i_section', depth: 0.3, width: 0.15, web: 0.007, flange: 0.011, root_radius: 0.015},
  {type: 'wall', thickness: 0.4, plane_strain: true, nu: 0.2},
];

const bends: Schemas['PowerBending'] = {law: {type: 'ramberg_osgood', moment: 5, exponent: 7, coefficient: 0.5}};
const table: Schemas['TableBending'] = {law: {type: 'table', points: [[0, 0], [0.1, 1], [0.3, 1.5]], interpolation: 'linear'}};

const sections: Schemas['Section'][] = [
  {id: 'stiffness', EA: 1e6, EI: 10, GA: 1e5, mass: 0.1, rotary_inertia: 1e-4, expansion: 1e-5, bending: bends},
  {id: 'table', EA: 1e6, GA: 1e5, mass: 0.1, rotary_inertia: 1e-4, expansion: 1e-5, bending: table},
  {id: 'tapering', EA: {along: [[0, 1e6], [1, 2.5e5]], power: 2}, EI: {along: [[0, 10], [1, 0.625]], power: 4},
    GA: {along: [[0, 1e5], [1, 2.5e4]], power: 2}, mass: {along: [[0, 0.1], [1, 0.025]]}},
  {id: 'strong', EA: 1e6, EI: 10, strength: {axial_force: 1e3, bending_moment: {along: [[0, 5], [1, 2.5]]}}},
  {id: 'material with strength', E: 2e8, A: 1e-2, I: 1e-5, W: 1e-3, strength: {tension: 2e4, compression: 1e5}},
  {id: 'profile with strength', E: 2.1e8, profile: 'HEA 200', unit: 'm', strength: 355e3},
  {id: 'shape with strength', E: 2.1e8, shape: {type: 'tube', diameter: 0.5, thickness: 0.01}, strength: 355e3},
  {id: 'rigid', EA: 'rigid', EI: 'rigid', GA: 'rigid'},
  {id: 'material', E: 2e8, A: 1e-2, I: 1e-5, nu: 0.3, shear_area: 8e-3, density: 7.85, expansion: 1e-5, bending: table},
  {id: 'profile', E: 2.1e8, profile: 'IPE 300', unit: 'm', nu: 0.3, mass: 0.0422, expansion: 1e-5, bending: bends},
  ...shapes.map((shape, i): Schemas['Section'] => ({id: `shape ${i}`, E: 3e7, shape, G: 1.2e7, density: 2.5, expansion: 1e-5,
    bending: bends})),
];

const curves: Schemas['Curve'][] = [
  {type: 'line'},
  {type: 'arc', sweep_degrees: -90},
  {type: 'parabola', rise: 1, direction: [0, 1]},
  {type: 'sine', rise: 1, half_waves: 2},
  {type: 'points', points: [[1, 0.5], [2, 0.7]]},
];

const supports: Schemas['Support'][] = [
  {node: 'a', fixed: ['x', 'y', 'rotation'], angle_degrees: 30,
   displacement: {x: 0.1, y: 0, rotation: 0.01, pattern: 'constant'}},
  {node: 'b', fixed: ['y'], displacement: {y: 0.1}, pattern: 'proportional'},
];

const springLaws: Schemas['SpringLaw'][] = [
  {type: 'tanh', stiffness: 1e3, capacity: 20},
  {type: 'hyperbolic', stiffness: 1e3, capacity: 20},
  {type: 'power', stiffness: 1e4, capacity: 30, reference: 0.02, exponent: 0.4},
  {type: 'table', points: [[0, 0], [0.01, 5], [0.02, 8]], factor: 2, interpolation: 'linear'},
];

const springs: Schemas['Spring'][] = [
  {id: 'prop', at: {node: 'a'}, direction: [0, -1], stiffness: 1e3, reaction: 'compression_only', gap: 0.01},
  {id: 'tie', at: {node: 'a'}, to: {node: 'b'}, direction: [1, 0], stiffness: 20, reaction: 'tension_only',
   pretension: {force: 3}},
  {id: 'turning', at: {member: 'beam', fraction: 1}, direction: 'rotation', stiffness: 5},
  ...springLaws.map((law, i): Schemas['Spring'] => ({id: `law ${i}`, at: {node: 'a'}, direction: 'rotation', law})),
];

const varying: Schemas['Along'] = {along: [[0, 0], [0.4, 2e3], [1, 3e3]]};

const foundationLaws: Schemas['FoundationLaw'][] = [
  {type: 'tanh', stiffness: varying, capacity: 20},
  {type: 'hyperbolic', stiffness: 1e3, capacity: varying},
  {type: 'power', stiffness: 1e4, capacity: 30, reference: 0.02, exponent: 0.4},
  {type: 'table', points: [[0.01, 5], [0.02, 8], [0.05, 8]], factor: varying, interpolation: 'linear'},
];

const foundations: Schemas['Foundation'][] = [
  {id: 'soil', member: 'beam', stiffness: 1e4, shear_stiffness: 1, ground_end: 'endless', reaction: 'tension_only', range: [0, 0.5], gap: 0,
   direction: 'normal', side: 'right'},
  {id: 'below', member: 'beam', stiffness: 1e4, direction: [0, -1]},
  {id: 'deeper', member: 'beam', stiffness: varying, component: 'tangent'},
  {id: 'fastenings', member: 'beam', stiffness: varying, component: 'rotation'},
  ...foundationLaws.map((law, i): Schemas['Foundation'] => ({
    id: `law ${i}`, member: 'beam', law, reaction: 'compression_only', side: 'left', direction: 'normal', gap: 0.01})),
];

const outlines: Schemas['Outline'][] = [
  {type: 'circle', center: [0, 1], radius: 2, medium: 'outside'},
  {type: 'line', through: [0, -1], into: [0, -1]},
  {type: 'spline', points: [[0, 0], [1, 0.1], [2, 0]], medium: 'right'},
  {type: 'polyline', points: [[0, 0], [1, 0.1], [2, 0]], rounding: 0.1, medium: 'left'},
];

foundations.push(
    {id: 'settles', member: 'beam', stiffness: 1e3, direction: [0, -1],
     displacement: {x: 0.01, y: {along: [[0, 0], [1, -0.02]]}, pattern: 'proportional'}},
    {id: 'obstacle', member: 'beam', stiffness: 'rigid', reaction: 'compression_only', gap: varying},
    ...outlines.map((outline, i): Schemas['Foundation'] => ({
      id: `outline ${i}`, member: 'beam', stiffness: 'rigid', reaction: 'compression_only', range: [0, 1], outline})),
    {id: 'yields', member: 'beam', law: foundationLaws[0]!, reaction: 'compression_only', range: [0, 1], outline: outlines[0]!});
foundations.push(
    {id: 'pile', member: 'beam', soil: 'site', ground_level: 0, diameter: 1.2, multiplier: {p: 0.8, y: 1.5}, base: true,
     displacement: {x: 0.01}});
foundations.push(
    {id: 'line', member: 'beam', displacement: {y: 0.01},
     pipe: {plane: 'vertical', depth: 1.2, diameter: 0.61, displacements: {axial: 0.003, lateral: 0.04, uplift: 0.01, bearing: 0.06},
            soil: {type: 'sand', unit_weight: 18, total_unit_weight: 19, phi: 35, coating_factor: 0.7, K0: 0.5, density: 'dense'}}},
    {id: 'plan', member: 'beam',
     pipe: {plane: 'horizontal', depth: 1.2, displacements: {axial: 0.01},
            soil: {type: 'clay', unit_weight: 9, Su: 40, adhesion: 0.9, consistency: 'soft'}}});

const layer = {top: 0, bottom: 5, unit_weight: 9};
const soils: Schemas['Soil'][] = [
  {id: 'site', water_table: 2, water_unit_weight: 9.81, scour: {general: 1, local: 0.5}, loading: 'cyclic', layering: 'georgiadis',
   accuracy: 0.01, layers: [
     {...layer, type: 'api_sand', phi: 35, k: 2e4, end_bearing: 5e3,
      axial: {type: 'api_tz_sand', friction: [5, 80], peak_displacement: 0.0025}},
     {...layer, type: 'api_sand', C1: 2, C2: 3, C3: 30, k: 2e4},
     {...layer, type: 'soft_clay', Su: [20, 45], eps50: 0.01, J: 0.5, axial: {type: 'api_tz_clay', friction: 30, residual: 0.8}},
     {...layer, type: 'soft_clay_matlock', Su: 20, eps50: 0.01, J: 0.5, start: 'api_points', first_point: 0.1},
     {...layer, type: 'stiff_clay', Su: 80, eps50: 0.005, J: 0.5, cycles: 100, first_point: 0.1},
     {...layer, type: 'stiff_clay_free_water', Su: 80, eps50: 0.005, k: [1e5, 2e5]},
     {...layer, type: 'reese_sand', phi: 35, k: 2e4},
     {...layer, type: 'pisa_clay', Su: 80, G0: [4e4, 8e4]},
     {...layer, type: 'pisa_sand', relative_density: 0.7, G0: 5e4},
     {...layer, type: 'weak_rock', q_u: 2e3, E_ir: 5e5, RQD: 50, k_rm: 5e-4},
     {...layer, type: 'liquefied_sand', metre: 1, kilonewton: 1}]},
];
springs.push({id: 'follows', at: {node: 'a'}, direction: [0, 1], stiffness: 3,
              displacement: {x: 0, y: -0.01, rotation: 0, pattern: 'constant'}});
springs.push({id: 'stop', at: {node: 'a'}, direction: [1, 0], stiffness: 'rigid', reaction: 'compression_only'});

const loads: Schemas['Load'][] = [
  {type: 'point', at: {node: 'b'}, force: [0, -1], moment: 0.1, pattern: 'constant', follows: true, fixed_line: false},
  {type: 'distributed', member: 'beam', force: [0, -1], range: [0, 1], per: 'horizontal', pattern: 'proportional'},
  {type: 'pressure', member: 'beam', value: 1, side: 'left', pattern: 'proportional'},
  {type: 'distributed', member: 'beam', force: {along: [[0, [0, 0]], [1, [0, -2]]]}, axes: 'member'},
  {type: 'initial_strain', member: 'beam', axial: 1e-4, curvature: 0, pattern: 'constant'},
  {type: 'pressure', member: 'beam', value: {along: [[0, 0], [1, 10]]}, side: 'right'},
  {type: 'initial_strain', member: 'beam', axial: {along: [[0, 0], [1, 1e-4]]}, curvature: {along: [[0, 0], [1, 1e-3]]}},
  {type: 'self_weight', gravity: [0, -9.81], pattern: 'constant'},
  {type: 'temperature', member: 'beam', change: 30, gradient: {along: [[0, 5], [1, 10]]}, pattern: 'proportional'},
];

const loadCases: Schemas['LoadCase'][] = [
  {id: 'snow', factor: 1.5, grows: true, loads: [{type: 'distributed', member: 'beam', force: [0, -1], per: 'horizontal'}]},
];

const imperfections: Schemas['Imperfection'][] = [
  {type: 'sine', member: 'beam', half_waves: 1, amplitude: 1e-3},
  {type: 'mode', number: 1, amplitude: 1e-3},
  {type: 'points', member: 'beam', offsets: [[0, 0], [0.5, 1e-3], [1, 0]]},
  {type: 'worst', norm: 'rms', amplitude: 1e-3},
];

const model: Schemas['Model'] = {
  title: 'every field', units: {length: 'm', force: 'kN'},
  nodes: [{id: 'a', x: 0, y: 0}, {id: 'b', x: 5, y: 0}],
  sections,
  members: [
    ...curves.map((curve, i): Schemas['Member'] => ({
      id: `beam ${i}`, start: 'a', end: 'b', section: 'stiffness', curve,
      release: {start: ['rotation'], end: {rotation: 5000}}})),
    ...springLaws.map((law, i): Schemas['Member'] => ({
      id: `joint ${i}`, start: 'a', end: 'b', section: 'stiffness', release: {start: {rotation: {law}}, end: {rotation: {law}}}})),
    {id: 'brace', start: 'a', end: 'b', section: 'stiffness', reaction: 'tension_only', pretension: {unstressed_length: 4.9}},
    {id: 'rope', start: 'a', end: 'b', section: 'stiffness', cable: true, pretension: {unstressed_length: 5.1}},
  ],
  supports, springs, soils, foundations, loads, load_cases: loadCases, imperfections,
  masses: location.map((at) => ({at, mass: 2, inertia: 0.1})), damping: {mass: 0.1, stiffness: 1e-3},
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
  output: {states: one, points_per_member: 51, path_points: 200, extremes: true, stiffness_at: location, frequencies: 3},
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
  design: {latin_hypercube: {samples: 10, seed: 1}}, follow: {parameter: 'ends', point: 1, locus: false},
  refine: {output: '/buckling/load_factors/0', within: 0.02, parameters: 1, most: 500}, outputs: ['/buckling/load_factors/0'],
};

type Created = paths['/v1/jobs']['post'];

/** What POST /v1/jobs may answer: a result or the status of a job, which `kind` tells, or a problem. */
export async function solve(service: string, request: Created['requestBody']['content']['application/json']): Promise<string> {
  const response = await fetch(`${service}/v1/jobs`, {method: 'POST', body: JSON.stringify(request)});
  if (response.ok) {
    const answer = await response.json() as Created['responses'][200 | 201 | 202]['content']['application/json'];
    if (answer.kind === 'result') return `${answer.summary.message} ${answer.program.version} ${answer.request_sha256}`;
    return `${answer.id} ${answer.status} ${answer.error?.code ?? ''} ${answer.usage?.cpu_seconds ?? ''}`;
  }
  const problem = await response.json() as Schemas['Problem'];
  const findings = (problem.errors ?? []).map(({pointer, code, detail}) => `${pointer} ${code} ${detail}`);
  return [problem.type, problem.detail, ...findings, problem.reached?.summary.message].join('; ');
}

export const requests: Schemas['Request'][] = analyses.map((analysis) => ({model, analysis}));
export const document: Schemas['SweepDocument'] = sweep;

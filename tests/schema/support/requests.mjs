// Requests of every kind: small models, each type of analysis, each option of what is given back.
import {readFileSync, readdirSync} from 'node:fs';

import {root} from './document.mjs';

const folder = new URL('examples/', root);

/** Every example request by name. */
export const examples = Object.fromEntries(readdirSync(folder).filter((name) => name.endsWith('.json')).sort().map(
    (name) => [name, JSON.parse(readFileSync(new URL(name, folder), 'utf8'))]));

const arch = () => ({
  title: 'pinned arch', units: {length: 'm', force: 'kN'},
  nodes: [{id: 'left', x: -5, y: 0}, {id: 'right', x: 5, y: 0}],
  sections: [{id: 'ring', EA: 1e6, EI: 100}],
  members: [{id: 'arch', start: 'left', end: 'right', section: 'ring', curve: {type: 'arc', sweep_degrees: -60}}],
  supports: [{node: 'left', fixed: ['x', 'y']}, {node: 'right', fixed: ['x', 'y']}],
  loads: [{type: 'point', at: {member: 'arch', fraction: 0.5}, force: [0, -1]}],
  monitors: [{id: 'crown', at: {member: 'arch', fraction: 0.5}, component: 'y'}],
});

/** A beam with everything that a state tells of: a one-sided base with lift-off, springs, an inclined roller, a constant load. */
const beam = () => ({
  nodes: [{id: 'a', x: 0, y: 0}, {id: 'b', x: 4, y: 0}, {id: 'c', x: 8, y: 1}],
  sections: [{id: 's', E: 2e8, A: 1e-2, I: 1e-5, nu: 0.3, shear_area: 8e-3}],
  members: [{id: 'first', start: 'a', end: 'b', section: 's'},
            {id: 'second', start: 'b', end: 'c', section: 's', release: {start: ['rotation']}}],
  supports: [{node: 'a', fixed: ['x', 'y', 'rotation']}, {node: 'c', fixed: ['y'], angle_degrees: 10}],
  springs: [{id: 'prop', at: {node: 'b'}, direction: [0, -1], stiffness: 500, reaction: 'compression_only', gap: 2e-3},
            {id: 'turn', at: {member: 'second', fraction: 0.5}, direction: 'rotation', stiffness: 20}],
  foundations: [{id: 'soil', member: 'first', stiffness: 1e4, reaction: 'compression_only', side: 'right'}],
  loads: [{type: 'point', at: {node: 'b'}, force: [0, -10], moment: 1},
          {type: 'distributed', member: 'second', force: [0, -1], pattern: 'constant'},
          {type: 'pressure', member: 'first', value: 0.5}, {type: 'initial_strain', member: 'first', axial: 1e-5}],
  monitors: [{id: 'middle', at: {node: 'b'}, component: 'y'},
             {id: 'turning', at: {member: 'second', fraction: 0.5}, component: 'rotation'}],
});

const column = () => ({
  nodes: [{id: 'foot', x: 0, y: 0}, {id: 'head', x: 0, y: 5}],
  sections: [{id: 'shaft', EA: 1e7, EI: 100}],
  members: [{id: 'column', start: 'foot', end: 'head', section: 'shaft'}],
  supports: [{node: 'foot', fixed: ['x', 'y']}, {node: 'head', fixed: ['x']}],
  foundations: [{id: 'base', member: 'column', stiffness: 10}],
  loads: [{type: 'point', at: {node: 'head'}, force: [0, -1]}],
});

/** A ring under outer pressure in one-sided soil, which it leaves: nothing holds it against rising. */
const ring = () => ({
  nodes: [{id: 'invert', x: 0, y: -1}, {id: 'crown', x: 0, y: 1}],
  sections: [{id: 'wall', EA: 1e5, EI: 1}],
  members: ['right', 'left'].map((id, i) => ({id, start: i ? 'crown' : 'invert', end: i ? 'invert' : 'crown', section: 'wall',
                                              curve: {type: 'arc', sweep_degrees: 180}})),
  supports: [{node: 'invert', fixed: ['x']}, {node: 'crown', fixed: ['x']}],
  foundations: ['right', 'left'].map((member) => ({id: member, member, stiffness: 180, reaction: 'compression_only', side: 'right'})),
  loads: ['right', 'left'].map((member) => ({type: 'pressure', member, value: 1, side: 'right'})),
});

const fixed = {elements: 12, order: 3};
const rule = {limit_points: 2};

/** A portal of a profile with semi-rigid joints, weight, temperature and a load case. */
const portal = () => ({
  nodes: [{id: 'a', x: 0, y: 0}, {id: 'b', x: 0, y: 4}, {id: 'c', x: 6, y: 4}, {id: 'd', x: 6, y: 0}],
  sections: [{id: 's', E: 2.1e8, profile: 'HEB 200', unit: 'm', density: 7.85, expansion: 1.2e-5}],
  members: [{id: 'left', start: 'a', end: 'b', section: 's'},
            {id: 'beam', start: 'b', end: 'c', section: 's', release: {start: {rotation: 5000}, end: {rotation: 5000}}},
            {id: 'right', start: 'd', end: 'c', section: 's'}],
  supports: [{node: 'a', fixed: ['x', 'y']}, {node: 'd', fixed: ['x', 'y']}],
  loads: [{type: 'self_weight', gravity: [0, -9.81], pattern: 'constant'},
          {type: 'temperature', member: 'beam', change: 20, pattern: 'constant'}],
  load_cases: [{id: 'roof', grows: true, loads: [{type: 'distributed', member: 'beam', force: {along: [[0, [0, -1]], [1, [0, -2]]]}}]}],
});

/** A stiff pile in soil of limited strength, pushed at its head: the soil carries 0.414 of its strength times the length. */
const pile = () => ({
  nodes: [{id: 'head', x: 0, y: 0}, {id: 'tip', x: 0, y: -4}],
  sections: [{id: 'shaft', EA: 1e6, EI: 1e6}],
  members: [{id: 'pile', start: 'head', end: 'tip', section: 'shaft'}],
  supports: [{node: 'tip', fixed: ['y']}],
  foundations: [{id: 'soil', member: 'pile', law: {type: 'tanh', stiffness: 5000, capacity: 50}}],
  loads: [{type: 'point', at: {node: 'head'}, force: [1, 0]}],
});

/** A request whose structure may move without stiffness beside the path: answered with that motion, or with a failure. */
export const loose = () => ({model: ring(), analysis: {type: 'critical'}});

/** Requests that an analysis answers, by what they are for. */
export function answerable() {
  const all = Object.fromEntries(Object.entries(examples).map(([name, request]) => [`example ${name}`, request]));
  const add = (name, model, analysis) => { all[name] = {model, analysis}; };
  for (const states of ['none', 'critical', 'all', {every: 3}, {at_load_factors: [0.5, 1e9]}]) {
    add(`path, states ${JSON.stringify(states)}`, arch(), {type: 'path', stop: rule, output: {states, points_per_member: 5}});
    add(`critical, states ${JSON.stringify(states)}`, arch(), {type: 'critical', output: {states, points_per_member: 5}});
  }
  for (const type of ['path', 'critical']) {
    const at = [{node: arch().members[0].start}, {member: arch().members[0].id, fraction: 0.25}];
    add(`${type}, stiffness_at`, arch(), {type, stop: rule, output: {stiffness_at: at, points_per_member: 5}});
    add(`${type}, path_points`, arch(), {type, stop: rule, output: {path_points: 50}});
    add(`${type}, extremes`, arch(), {type, stop: rule, output: {extremes: true, states: 'none'}});
    add(`${type}, sensitivities`, arch(),
        {type, stop: rule, sensitivities: ['/model/sections/0/EI', '/model/nodes/0/y', '/model/loads/0/force/1']});
    add(`${type}, koiter`, arch(), {type, stop: rule, koiter: true});
    add(`${type}, fixed mesh`, arch(), {type, stop: rule, discretization: fixed});
  }
  add('path, every branch', arch(), {type: 'path', stop: {steps: 30}, branches: {follow: 'all', limit: 2}});
  add('path, load control', arch(), {type: 'path', control: 'load'});
  add('path, displacement control', arch(),
      {type: 'path', control: {displacement: 'crown'}, stop: {monitor: {id: 'crown', range: [-1, 1]}}});
  const withStrength = beam();
  for (const section of withStrength.sections) Object.assign(section, {strength: 4e4, W: 1e-4});
  add('path, first yield', withStrength, {type: 'path', stop: {load_factor: [-2, 3]}, output: {states: 'all', extremes: true}});
  add('path with contact', beam(), {type: 'path', stop: {load_factor: [-2, 3]}, output: {states: 'all', extremes: true}});
  for (const geometry of ['linear', 'nonlinear']) {
    add(`static, ${geometry}`, beam(), {type: 'static', geometry, load_factors: [0.5, 1, 2]});
    add(`static, ${geometry}, states`, beam(), {type: 'static', geometry, load_factors: [1, 0.5], output: {states: 'all', extremes: true}});
  }
  add('static, lumped', beam(), {type: 'static', discretization: {elements: {first: 8, second: 4}, foundation: 'lumped'}});
  for (const modes of [1, 4]) {
    add(`buckling, ${modes} modes`, column(), {type: 'buckling', modes});
    add(`buckling, ${modes} modes, fixed mesh`, column(), {type: 'buckling', modes, discretization: fixed});
  }
  add('strains too large for the theory', {...column(), sections: [{id: 'shaft', EA: 10, EI: 100}]},
      {type: 'path', stop: {load_factor: [-1, 2]}});
  const {model: flutters} = examples['beck.json'];
  add('vibration', flutters, {type: 'vibration', load_factors: [0, 25], modes: 2});
  add('static, frequencies', flutters, {type: 'static', load_factors: [1, 25], unstable: 'follow', output: {frequencies: 2}});
  add('buckling, arch', arch(), {type: 'buckling', modes: 2});
  add('buckling, portal', portal(), {type: 'buckling', modes: 2});
  add('buckling, opposite actions', arch(), {type: 'buckling', modes: 2, reversed: true});
  add('path, falling load', arch(), {type: 'path', step: {direction: -1}, stop: {steps: 5}});
  add('static, unstable', arch(), {type: 'static', load_factors: [1, 24], unstable: 'follow'});
  add('path, bound on negative eigenvalues', arch(), {type: 'path', stop: {negative_eigenvalues: 0}});
  add('no buckling', {...column(), loads: [{type: 'point', at: {node: 'head'}, force: [0, 1]}]}, {type: 'buckling'});
  add('critical, capacity of supports', pile(), {type: 'critical'});
  add('imperfect', {...column(), imperfections: [{type: 'mode', number: 1, amplitude: 1e-3}]}, {type: 'path', stop: {steps: 10}});
  for (const norm of ['rms', 'max']) add(`worst imperfection, ${norm}`, {...arch(), imperfections: [{type: 'worst', norm, amplitude: 1e-2}]}, {type: 'critical'});
  return all;
}

/** Requests that are right and whose analyses fail, by code. */
export function failing() {
  const pressed = {...column(), loads: [{type: 'point', at: {node: 'head'}, force: [0, 1]}],
                   imperfections: [{type: 'mode', number: 1, amplitude: 1e-3}]};
  const shallow = arch();
  const touching = {...column(), sections: [{id: 'shaft', EA: 1e7, EI: 100, mass: 1}],
                    foundations: [{id: 'base', member: 'column', stiffness: 10, reaction: 'compression_only'}]};
  return {
    capacity: {model: pile(), analysis: {type: 'static', load_factors: [60, 120]}},
    beyond_limit_point: {model: shallow, analysis: {type: 'static', load_factors: [1, 1e5], unstable: 'follow'}},
    beyond_critical_point: {model: shallow, analysis: {type: 'static', load_factors: [1, 1e5]}},
    fewer_modes: {model: column(), analysis: {type: 'buckling', modes: 50, discretization: {elements: 2, order: 1}}},
    no_linear_vibration: {model: touching, analysis: {type: 'vibration'}},
    no_buckling_mode: {model: pressed, analysis: {type: 'critical'}},
    no_worst_imperfection: {model: {...pressed, imperfections: [{type: 'worst', norm: 'rms', amplitude: 1e-3}]}, analysis: {type: 'critical'}},
    constant_actions_limit: {model: {...arch(), loads: [{...arch().loads[0], force: [0, -1e5], pattern: 'constant'}, arch().loads[0]]},
                             analysis: {type: 'critical'}},
  };
}

/** Documents that are refused. */
export function wrong() {
  const good = {model: column(), analysis: {type: 'buckling'}};
  const spoilt = (change) => { const one = structuredClone(good); change(one); return one; };
  return [
    {}, [], {model: {}, analysis: {}}, spoilt((r) => { r.model.sections[0].EI = -1; }), spoilt((r) => { r.model.nodes[0].z = 1; }),
    spoilt((r) => { r.model.supports = []; r.model.foundations = []; r.model.loads = [{type: 'point', at: {node: r.model.nodes[0].id}, force: [1, 1]}]; }), spoilt((r) => { r.analysis.type = 'bukling'; }),
    spoilt((r) => { r.model.members[0].end = 'top'; }), spoilt((r) => { r.model.loads = []; }),
    spoilt((r) => { r.model.supports = [{node: r.model.nodes[0].id, fixed: ['x']}]; r.model.foundations = []; r.model.loads = [{type: 'point', at: {node: r.model.nodes[1].id}, force: [1, 1]}]; }),
    spoilt((r) => { r.analysis.discretization = {elements: 100000, order: 8}; }),
  ];
}

/** Sweeps: every design, values that are objects, points that fail. */
export function sweeps() {
  const stiffness = {name: 'k', targets: [{pointer: '/model/foundations/0/stiffness'}]};
  const base = {model: column(), analysis: {type: 'buckling'}, outputs: ['/buckling/load_factors/0', '/summary/termination']};
  const rigid = {name: 'ends', targets: [{pointer: '/model/supports/0/fixed'}], values: [['x', 'y'], ['x', 'y', 'rotation']],
                 label: ['pinned', 'clamped']};
  const thickness = {name: 't', values: [1, 2], targets: [{pointer: '/model/sections/0/EA', scale: 1e7},
                                                          {pointer: '/model/sections/0/EI', scale: 100, power: 3}]};
  return [
    {...base, design: 'grid', parameters: [{...stiffness, range: {from: -1, to: 10, count: 3}}, rigid]},
    {...base, design: 'zip', parameters: [{...stiffness, values: [1, 2]}, thickness]},
    {...base, design: {latin_hypercube: {samples: 4, seed: 1}}, parameters: [{...stiffness, range: {from: 1, to: 10, spacing: 'log'}}]},
    {...base, analysis: {type: 'critical', discretization: fixed}, outputs: ['/summary/critical_load_factor'], design: 'grid',
     parameters: [{...stiffness, range: {from: 1, to: 10, count: 5}}], follow: 'k'},
    {...base, analysis: {type: 'critical', discretization: fixed}, outputs: ['/curve/critical_points', '/curve/none_up_to'], design: 'grid',
     parameters: [{...stiffness, range: {from: 1, to: 10, count: 3}}], follow: {parameter: 'k', locus: true}},
    {...base, analysis: {type: 'critical', discretization: fixed}, outputs: ['/summary/critical_load_factor'], design: 'grid',
     parameters: [{...stiffness, range: {from: 1, to: 10, count: 3}}], follow: {parameter: 'k', point: 0}},
  ];
}

// Random instances of the document's schemas.
import {dereferenced} from './document.mjs';
import {validatorOf} from './validator.mjs';

/** Numbers from 0 to 1, the same for the same seed (mulberry32). */
export function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const kLetters = ['a', 'b', 'c', 'd', '/', '~', ' ', '"', 'ä', '梁', '🌉', '\u0080'];

/** Loads of a model, those of its load cases among them. */
const loadsOf = (model) => [...(model.loads ?? []), ...(model.load_cases ?? []).flatMap((one) => one.loads)];

/** Gives the points of a value that varies along a member fractions that ascend. */
const ascend = (value) => {
  if (value?.along) value.along = value.along.map(([, amount], i) => [i / value.along.length, amount]);
};

export class Drawer {
  constructor(seed) { this.random = randomNumbers(seed); }

  below(count) { return Math.floor(this.random() * count); }
  pick(list) { return list[this.below(list.length)]; }

  /** An instance: small, with the ends of ranges now and then. */
  draw(schema) {
    const {not, contains} = dereferenced(schema);
    if (not === undefined && contains === undefined) return this.candidate(schema);
    const validate = validatorOf(schema);
    let value;
    do value = this.candidate(schema); while (!validate(value));
    return value;
  }

  candidate(schema) {
    const at = dereferenced(schema);
    if ('const' in at) return at.const;
    if (at.enum ?? at['x-names']) return this.pick(at.enum ?? at['x-names']);
    const forms = at.oneOf ?? at.anyOf;
    if (forms) return this.draw(this.pick(forms));
    const type = Array.isArray(at.type) ? this.pick(at.type) : at.type;
    if (type === 'object') return this.object(at);
    if (type === 'array') return this.list(at);
    if (type === 'string') return this.text(at);
    if (type === 'boolean') return this.random() < 0.5;
    return type === 'null' ? null : this.number(at, type === 'integer');
  }

  object(at) {
    const value = {};
    for (const [name, one] of Object.entries(at.properties ?? {})) {
      if (at.required?.includes(name) || this.random() < 0.4) value[name] = this.draw(one);
    }
    for (const [name, others] of Object.entries(at.dependentRequired ?? {})) {
      if (name in value) for (const other of others) value[other] ??= this.draw(at.properties[other]);
    }
    if (at.additionalProperties) {
      const count = (at.minProperties ?? 0) + this.below(2);
      for (let i = 0; i < count; ++i) value[this.text(dereferenced(at.propertyNames ?? {}))] = this.draw(at.additionalProperties);
    }
    return value;
  }

  list(at) {
    if (at.prefixItems) return at.prefixItems.map((one) => this.draw(one));
    const least = at.minItems ?? 0;
    const count = least + this.below(Math.min(at.maxItems ?? Infinity, least + 3) - least + 1);
    const items = [];
    while (items.length < count) {
      const item = this.draw(at.items);
      if (!at.uniqueItems || !items.includes(item)) items.push(item);
    }
    return items;
  }

  text(at) {
    const long = at.maxLength && this.random() < 0.02;
    const length = long ? at.maxLength : 1 + this.below(3);
    return Array.from({length}, () => this.pick(this.random() < 0.1 ? kLetters : kLetters.slice(0, 4))).join('');
  }

  number(at, whole) {
    const inside = (end, sign) => end + sign * (whole ? 1 : Math.max(Math.abs(end) * 2 ** -52, Number.MIN_VALUE));
    const lo = at.exclusiveMinimum !== undefined ? inside(at.exclusiveMinimum, 1) : at.minimum ?? -50;
    const hi = at.exclusiveMaximum !== undefined ? inside(at.exclusiveMaximum, -1) : at.maximum ?? 50;
    const chance = this.random();
    if (chance < 0.03) return lo;
    if (chance < 0.06) return hi;
    const from = Math.max(lo, -50);
    const value = from + (Math.min(hi, from + 100) - from) * this.random();
    return whole ? Math.floor(value) : chance < 0.3 ? Math.min(hi, Math.max(lo, Math.round(value))) : value;
  }

  request() { return this.draw({$ref: '#/components/schemas/Request'}); }

  /**
   * Makes a drawn request's references and geometry agree, so that only single fields are left to be judged. Each repair is left
   * out once in 30 times.
   */
  repair(request) {
    const {model, analysis} = request;
    const often = (change) => { if (this.random() < 29 / 30) change(); };
    const size = () => (this.random() - 0.5) * 20;
    for (const list of ['nodes', 'sections', 'members', 'springs', 'soils', 'foundations', 'load_cases', 'monitors']) {
      often(() => (model[list] ?? []).forEach((one, i) => { one.id = `${[...one.id].slice(0, 190).join('')}#${i}`; }));
    }
    while (model.nodes.length < 2) model.nodes.push({id: `n${model.nodes.length}`, x: 0, y: 0});
    often(() => model.nodes.forEach((node, i) => Object.assign(node, {x: 3 * i + size() / 20, y: size()})));
    while (model.members.length < model.nodes.length - 1) model.members.push({...model.members[0], id: `m${model.members.length}`});
    model.members = model.members.slice(0, model.nodes.length - 1);
    often(() => model.members.forEach((one, i) => Object.assign(one, {
      start: model.nodes[i].id, end: model.nodes[i + 1].id, section: this.pick(model.sections).id})));
    const node = () => this.pick(model.nodes).id;
    const member = () => this.pick(model.members).id;
    const locate = (at) => { if ('node' in at) at.node = node(); else at.member = member(); };
    often(() => { (model.supports ??= []).forEach((one, i) => { one.node = model.nodes[i % model.nodes.length].id; }); });
    often(() => this.hold(model));
    const loads = loadsOf(model);
    often(() => [...(model.springs ?? []), ...(model.monitors ?? []), ...(model.masses ?? []), ...loads].forEach((one) => one.at && locate(one.at)));
    often(() => (model.springs ?? []).filter((one) => one.to).forEach((one) => {
      Object.assign(one, {at: {node: model.nodes[0].id}, to: {node: model.nodes.at(-1).id}});
    }));
    for (const list of [model.foundations ?? [], loads, model.imperfections ?? []]) {
      often(() => list.forEach((one) => { if ('member' in one) one.member = member(); }));
    }
    often(() => this.agreeSoils(model));
    often(() => this.agreeSections(model));
    often(() => this.agree(model, analysis));
    return request;
  }

  /** Holds the first node fully. */
  hold(model) {
    const [first] = model.nodes;
    model.supports = (model.supports ?? []).filter((one, i) => one.node !== first.id && i < model.nodes.length);
    model.supports.push({node: first.id, fixed: ['x', 'y', 'rotation']});
    for (const one of model.supports) delete one.displacement, delete one.pattern;
    for (const one of model.members) delete one.release, delete one.reaction, delete one.cable, delete one.pretension;
    for (const one of model.springs ?? []) delete one.pretension;
    for (const one of model.sections) for (const field of ['EA', 'EI', 'GA']) if (one[field] === 'rigid') one[field] = 1;
  }

  /** Layers from the surface to below all members, and straight members in them; pipes in plan at a depth of two diameters. */
  agreeSoils(model) {
    for (const soil of model.soils ?? []) {
      for (const field of ['water_table', 'water_unit_weight', 'scour']) delete soil[field];
      soil.layers.forEach((layer, i) => {
        Object.assign(layer, {top: i, bottom: i === soil.layers.length - 1 ? 1000 + i : i + 1});
        for (const field of ['Su', 'G0', 'k', 'q_u', 'E_ir', 'metre', 'kilonewton']) if (field in layer) layer[field] = 20;
        if (layer.axial) layer.axial.friction = 1;
      });
      if (soil.layers.some(({type}) => type.startsWith('pisa'))) delete soil.layering;
    }
    const straight = model.members.filter(({curve}) => !curve || curve.type === 'line');
    const inSoil = (one) => Object.assign(one, {
      soil: this.pick(model.soils).id, member: this.pick(straight).id, ground_level: 100, diameter: 1, base: false});
    if (model.soils?.length && straight.length) model.foundations?.filter(({soil}) => soil !== undefined).forEach(inSoil);
    else if (model.foundations) model.foundations = model.foundations.filter(({soil}) => soil === undefined);
    for (const {pipe} of model.foundations ?? []) {
      if (!pipe) continue;
      Object.assign(pipe, {plane: 'horizontal', depth: 2, diameter: 1});
      delete pipe.soil.total_unit_weight;
    }
  }

  /** Dimensions that go together, one of two fields, what the loads need. */
  agreeSections(model) {
    for (const one of model.sections) {
      if ('mass' in one) delete one.density;
      for (const number of [one.EA, one.EI, one.GA, one.mass, one.rotary_inertia]) ascend(number);
      if ('nu' in one) delete one.G;
      if (one.bending && one.EI?.along) one.EI = 1;
      if (one.bending || (one.A && !(one.W && one.strength))) {
        delete one.strength;
        delete one.W;
      }
      for (const number of [one.strength?.axial_force, one.strength?.bending_moment]) ascend(number);
      if (one.bending?.law.points) one.bending.law.points = one.bending.law.points.map((unused, i) => [i + 1, i + 1]);
      if (one.shape?.type === 'tube') one.shape.thickness = one.shape.diameter / 4 || one.shape.diameter;
      if (one.shape?.type === 'i_section') {
        Object.assign(one.shape, {web: one.shape.width / 4 || one.shape.width, flange: one.shape.depth / 4 || one.shape.depth});
        delete one.shape.root_radius;
      }
      if (!('density' in one)) one.mass ??= 1;
      one.expansion ??= 1e-5;
    }
    for (const one of (model.load_cases ?? []).flatMap(({loads}) => loads)) delete one.pattern;
  }

  /** Numbers along a member and points of laws that ascend; a foundation along the tangent without what it cannot have. */
  agreeLaws(model) {
    const positiveFirst = (value) => {
      ascend(value);
      if (value?.along) value.along[0][1] ||= 1;
    };
    for (const one of [...(model.springs ?? []), ...(model.foundations ?? [])]) {
      if (one.component === 'tangent') for (const field of ['side', 'direction', 'shear_stiffness', 'ground_end', 'reaction', 'gap']) delete one[field];
      if (Array.isArray(one.direction)) delete one.side;
      positiveFirst(one.stiffness);
      ascend(one.gap);
      if (one.outline) {
        for (const field of ['side', 'direction', 'gap', 'component', 'shear_stiffness', 'ground_end']) delete one[field];
        one.reaction = 'compression_only';
      }
      if (one.outline?.points) one.outline.points = one.outline.points.map(([, y], i) => [100 * i, y]);
      if ('rounding' in (one.outline ?? {})) one.outline.rounding = 1e-3;
      if (!one.law) continue;
      for (const field of ['stiffness', 'capacity', 'factor']) {
        positiveFirst(one.law[field]);
        if (one.law[field] === 0) one.law[field] = 1;
      }
      if (one.law.points) one.law.points = one.law.points.map((unused, i) => [i + 1, i + 1]);
    }
  }

  /** Motion of the ground that the support can follow. */
  agreeGround(model) {
    for (const one of model.springs ?? []) {
      if (one.to) delete one.displacement;
      for (const field of one.direction === 'rotation' ? ['x', 'y'] : ['rotation']) delete one.displacement?.[field];
    }
    for (const one of (model.foundations ?? []).filter(({displacement}) => displacement)) {
      delete one.shear_stiffness;
      ascend(one.displacement.x);
      ascend(one.displacement.y);
    }
  }

  /** What goes with what between fields. */
  agree(model, analysis) {
    if (analysis.output) delete analysis.output.stiffness_at;
    const order = (pair) => { if (pair) pair.sort((a, b) => a - b); if (pair && pair[0] === pair[1]) pair[0] -= 0.5; };
    for (const one of [...(model.springs ?? []), ...(model.foundations ?? [])]) {
      if (one.stiffness === 'rigid') one.reaction = 'compression_only';
      if (one.reaction !== 'compression_only' && one.reaction !== 'tension_only') delete one.gap;
      else if (one.law || one.outline || !(one.stiffness > 0) || one.gap?.along) delete one.shear_stiffness;
      if (!(one.shear_stiffness > 0) || !['compression_only', 'tension_only'].includes(one.reaction)) delete one.ground_end;
      else delete analysis.discretization;
    }
    this.agreeLaws(model);
    this.agreeGround(model);
    const loads = loadsOf(model);
    for (const one of [...(model.foundations ?? []), ...loads]) if (one.range) order(one.range);
    for (const value of loads.flatMap((one) => Object.values(one))) {
      ascend(value);
    }
    for (const one of model.monitors ?? []) if ('node' in one.at && one.component === 'normal') one.component = 'x';
    (model.loads ??= []).push({type: 'point', at: {node: model.nodes.at(-1).id}, force: [0, -1]});
    for (const one of model.imperfections ?? []) {
      if (one.offsets) one.offsets = one.offsets.map(([, offset], i) => [i / one.offsets.length, offset]);
    }
    if (analysis.sensitivities) analysis.sensitivities = ['/model/nodes/0/x', '/model/loads/0/type'].slice(0, this.below(6) === 0 ? 2 : 1);
    if (analysis.geometry === 'linear') analysis.type = 'static';
    if (!['path', 'static'].includes(analysis.type)) delete analysis.output?.frequencies;
    delete analysis.step;
    const mayLower = !['buckling', 'vibration'].includes(analysis.type) && analysis.geometry !== 'linear' && !analysis.start;
    let worst = 0;
    if (model.imperfections) model.imperfections = model.imperfections.filter((one) => one.type !== 'worst' || (mayLower && ++worst === 1));
    const monitor = this.pick(model.monitors?.map((one) => one.id) ?? []);
    if (typeof analysis.control === 'object') analysis.control = monitor ? {displacement: monitor} : 'load';
    const {stop} = analysis;
    order(stop?.load_factor);
    if (stop?.monitor) {
      order(stop.monitor.range);
      if (monitor) stop.monitor.id = monitor; else delete stop.monitor;
    }
    const mesh = analysis.discretization;
    if (typeof mesh?.elements === 'object') mesh.elements = Object.fromEntries(model.members.map((one) => [one.id, 1 + this.below(100)]));
  }

  /** Changes one place of a document, so that it is probably none of the schema any more. */
  spoil(value) {
    const others = [1, 2.5, -1, 0, 1e200, 'a', '', null, true, [], {}, 'normal', [0, 0]];
    const keys = value !== null && typeof value === 'object' ? Object.keys(value) : [];
    if (keys.length === 0) return this.pick(others);
    const key = this.pick(keys);
    const chance = this.random();
    if (chance < 0.7) value[key] = this.spoil(value[key]);
    else if (chance < 0.8 && !Array.isArray(value)) delete value[key];
    else if (chance < 0.9 && !Array.isArray(value)) value[this.pick(['id', 'range', 'extra', 'E', 'side'])] = this.pick(others);
    else value[key] = this.pick(others);
    return value;
  }
}

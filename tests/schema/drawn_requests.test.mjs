// Random documents of the request's schema are given to the service's check: what it refuses must be of a rule that needs more than
// one field. And what the schema refuses is refused.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';

import {Drawer} from './support/draw.mjs';
import {startService} from './support/service.mjs';
import {validatorNamed} from './support/validator.mjs';

const seed = Number(process.env.SEED ?? Math.floor(Math.random() * 2 ** 32));
let service;
before(async () => { service = await startService(); });
after(async () => service.stop());

/** Codes of rules between several fields, and why the schema can't say them. */
const kBetweenFields = {
  unknown_reference: 'an id of another list',
  duplicate_id: 'ids of the same list',
  unreached_node: 'nodes and members',
  zero_length: 'positions of two nodes',
  coincident_points: 'positions of nodes and points',
  needs_one_sided: 'gap and reaction',
  needs_member: 'component and location of a monitor',
  not_fixed: 'fixed and displacement of a support',
  no_load: 'loads, displacements of supports and type of analysis',
  no_mass: 'masses of sections and points, and what the analysis gives',
  no_weight: 'cables and self weights of the model',
  mechanism: 'the whole model',
  unsupported: 'geometry and type of analysis',
  not_increasing: 'a fraction or a point and the one before it',
  invalid_pointer: 'a pointer, which is to something in /model',
  no_such_place: 'a pointer and the model',
  not_supported: 'a pointer and what the model has there; the reaction of a member and what is on it',
  too_many_findings: 'the number of findings',
  memory_limit: 'members, elements and order, against a setting of the service',
  enters_obstacle: 'a support, and a rigid foundation or its outline',
};
/** The same for codes that other rules have too: by pointer or text. */
const kBetweenFieldsAt = [
  ['out_of_range', /\/(range|load_factor)$/, 'lower and upper end'],
  ['out_of_range', /^\/analysis\/step$/, 'min, initial and max'],
  ['out_of_range', /^\/analysis\/start\/members\/.*\/(u|v|rotation|axial_force|shear_force|bending_moment)$/, 'as many as places'],
  ['out_of_range', /^\/model\/sections\/\d+$/, 'products E A, E I, G shear_area, density A'],
  ['out_of_range', /\/shape\/(thickness|web|flange|root_radius)$/, 'dimensions of a shape'],
  ['out_of_range', /\/curve\/direction$/, 'direction and positions of two nodes'],
  ['out_of_range', /^\/model\/sections\/\d+\/strength$/, 'products of strength with area and section modulus'],
  ['ambiguous', /^\/model\/sections\/\d+\/(density|nu)$/, 'mass and density; nu and G'],
  ['out_of_range', /^\/model\/load_cases\/\d+\/loads\/\d+\/(force|moment|value|axial|curvature|gravity|change|gradient)(\/|$)/, 'amount and factor of the case'],
  ['ambiguous', /^\/model\/load_cases\/\d+\/loads\/\d+\/pattern$/, 'grows of the case and pattern of a load'],
  ['missing_field', /^\/model\/sections\/\d+\/(mass|expansion)$/, 'sections and types of loads'],
  ['out_of_range', /^\/model\/foundations\/\d+\/(law\/)?(stiffness|capacity|factor)(\/along)?$/, 'all values along a member'],
  ['out_of_range', /\/law\/points\/\d+\/1$/, 'the first force of a table'],
  ['empty', /\/law\/points$/, 'points beside the origin'],
  ['out_of_range', /^\/model\/soils\/\d+\/layers\/\d+(\/(top|bottom|unit_weight))?$/, 'layers, water and what the member meets'],
  ['out_of_range', /^\/model\/soils\/\d+\/layers\/\d+\/Su$/, 'strengths of both faces'],
  ['out_of_range', /^\/model\/soils\/\d+\/scour\/general$/, 'scour and layers'],
  ['missing_field', /^\/model\/soils\/\d+\/(water_unit_weight|layers\/\d+\/axial)$/, 'water_table; Su of the layer'],
  ['missing_field', /^\/model\/foundations\/\d+$/, 'diameter and section'],
  ['out_of_range', /^\/model\/foundations\/\d+\/member$/, 'ground_level and nodes'],
  ['out_of_range', /^\/model\/foundations\/\d+\/pipe(\/depth|\/soil\/(total_)?unit_weight)?$/, 'depth and diameter; unit weights; the soil'],
  ['bad_id', /^\/model\/foundations\/\d+\/id$/, 'the ids that soil gives are longer'],
  ['ambiguous', /\/outline$/, 'outline and side, direction, gap or component'],
  ['out_of_range', /\/outline\/rounding$/, 'rounding and sides of a polyline'],
  ['ambiguous', /^\/model\/foundations\/\d+\/(component|side)$/, 'component, side and direction'],
  ['empty', /^\/model\/supports$/, 'supports, springs and foundations'],
  ['empty', /^\/model\/members$/, 'reactions of all members'],
  ['ambiguous', /^\/model\/springs\/\d+\/(to|displacement)$/, 'at, to and displacement'],
  ['too_many', /\/points_per_member$/, 'times members'],
  ['too_many', /\/elements$/, 'of all members'],
  ['too_many', /^\/model\/imperfections\/\d+$/, 'one of type worst'],
  ['missing_field', /\/elements$/, 'one for each member'],
];

const isBetweenFields = ({code, pointer}) =>
    code in kBetweenFields || kBetweenFieldsAt.some(([one, at]) => one === code && at.test(pointer));

async function check(document) {
  const response = await fetch(`${service.address}/v1/check`,
                               {method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify(document)});
  assert.equal(response.status, 200);
  return response.json();
}

test('2000 requests of the schema are refused for rules between fields only', async (t) => {
  t.diagnostic(`seed ${seed}`);
  const drawer = new Drawer(seed);
  const isRequest = validatorNamed('Request');
  const codes = {};
  let accepted = 0;
  for (let i = 0; i < 2000; ++i) {
    const request = i % 4 === 0 ? drawer.request() : drawer.repair(drawer.request());
    assert.ok(isRequest(request), `seed ${seed}, document ${i}: ${JSON.stringify(isRequest.errors)} ${JSON.stringify(request)}`);
    const {valid, errors} = await check(request);
    accepted += valid ? 1 : 0;
    for (const finding of errors) {
      codes[finding.code] = (codes[finding.code] ?? 0) + 1;
      assert.ok(isBetweenFields(finding), `seed ${seed}, document ${i}: ${JSON.stringify(finding)}\n${JSON.stringify(request)}`);
    }
  }
  t.diagnostic(`${accepted} accepted; findings ${JSON.stringify(codes)}`);
  assert.ok(accepted > 400, `${accepted} accepted`);
});

test('2000 spoilt requests are refused where the schema refuses them', async (t) => {
  const drawer = new Drawer(seed + 1);
  const isRequest = validatorNamed('Request');
  let refused = 0;
  for (let i = 0; i < 2000; ++i) {
    const request = drawer.spoil(drawer.repair(drawer.request()));
    if (isRequest(request)) continue;
    refused += 1;
    const {valid} = await check(request);
    assert.ok(!valid, `seed ${seed}, document ${i} is none of the schema and is accepted: ${
        JSON.stringify(isRequest.errors)}\n${JSON.stringify(request)}`);
  }
  t.diagnostic(`${refused} refused`);
  assert.ok(refused > 1000, `${refused} refused`);
});

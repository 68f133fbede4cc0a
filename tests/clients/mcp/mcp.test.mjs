// Problems in words, solved through the tools for language models by the protocol's own client.
//   SERVICE_EXECUTABLE=build/release/snapthrough node --test tests/clients/mcp
// What a model would do with the words is written here as calls; what is asked of the user is answered as a user would.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {resolve} from 'node:path';
import {after, before, describe, test} from 'node:test';

import {Client} from '@modelcontextprotocol/sdk/client/index.js';
import {StdioClientTransport} from '@modelcontextprotocol/sdk/client/stdio.js';
import {ElicitRequestSchema} from '@modelcontextprotocol/sdk/types.js';

import {command} from '../../schema/support/service.mjs';

const program = resolve(process.env.SERVICE_EXECUTABLE ?? 'build/release/snapthrough');
const example = (name) => JSON.parse(readFileSync(new URL(`../../../examples/${name}`, import.meta.url), 'utf8'));
const native = (request) => JSON.parse(command(['solve', '-'], JSON.stringify(request)).text);

/** A connected client, whose user answers questions by `answer`; without it the client cannot ask its user. */
async function connect(answer) {
  const client = new Client({name: 'test', version: '0'}, {capabilities: answer ? {elicitation: {}} : {}});
  if (answer) client.setRequestHandler(ElicitRequestSchema, ({params}) => answer(params));
  await client.connect(new StdioClientTransport({command: program, args: ['mcp']}));
  return client;
}

const document = (result) => JSON.parse(result.content[0].text);
const call = async (client, name, args, options) => client.callTool({name, arguments: args}, undefined, options);
async function answered(client, name, args, options) {
  const result = await call(client, name, args, options);
  assert.ok(!result.isError, result.content[0].text);
  return document(result);
}

/** A column in the ground; without `EI`, as somebody tells it who has not thought of that. */
function column(EI) {
  return {
    model: {
      nodes: [{id: 'foot', x: 0, y: 0}, {id: 'head', x: 0, y: 5}],
      sections: [{id: 'shaft', EA: 1e6, ...(EI === undefined ? {} : {EI})}],
      members: [{id: 'column', start: 'foot', end: 'head', section: 'shaft'}],
      supports: [{node: 'foot', fixed: ['x', 'y']}, {node: 'head', fixed: ['x']}],
      foundations: [{id: 'ground', member: 'column', stiffness: 10}],
      loads: [{type: 'point', at: {node: 'head'}, force: [0, -1]}],
    },
    analysis: {type: 'critical'},
  };
}

/** Twelve stiffnesses of the soil about an arch that snaps through. */
function stiffnesses(model) {
  return {
    model,
    analysis: {type: 'critical'},
    parameters: [{name: 'k', targets: [{pointer: '/model/foundations/0/stiffness'}], range: {from: 10, to: 1000, count: 12, spacing: 'log'}}],
    design: 'grid',
    outputs: ['/summary/critical_load_factor'],
  };
}

/** A pile that is pushed at its head, in the foundations that its soil became. */
function pushed(pile, foundations) {
  const top = -pile.head_depth;
  return {
    model: {
      nodes: [{id: 'tip', x: 0, y: top - pile.length}, {id: 'head', x: 0, y: top}],
      sections: [{id: 'tube', EA: 6e6, EI: 120000}],
      members: [{id: pile.member, start: 'tip', end: 'head', section: 'tube'}],
      supports: [{node: 'tip', fixed: ['y']}],
      foundations,
      loads: [{type: 'point', at: {node: 'head'}, force: [60, 0]}],
      monitors: [{id: 'head', at: {node: 'head'}, component: 'x'}],
    },
    analysis: {type: 'static'},
  };
}

/** A drawing of lines x0, y0, x1, y1, each on its layer. */
function drawing(lines) {
  const entities = Object.entries(lines).map(([layer, [x0, y0, x1, y1]]) =>
    `0\nLINE\n8\n${layer}\n10\n${x0}\n20\n${y0}\n11\n${x1}\n21\n${y1}\n`);
  return `0\nSECTION\n2\nENTITIES\n${entities.join('')}0\nENDSEC\n0\nEOF\n`;
}

describe('problems in words', () => {
  const asked = [];
  let client;
  before(async () => {
    client = await connect((question) => {
      asked.push(question);
      return {action: 'accept', content: {'/model/sections/0/EI': 100}};
    });
  });
  after(() => client.close());

  test('"A column 5 long on pins stands in ground of stiffness 10. What load does it carry?"', async () => {
    const found = await answered(client, 'solve', column());
    assert.equal(asked.length, 1, 'the missing stiffness is asked for');
    assert.deepEqual(asked[0].requestedSchema.required, ['/model/sections/0/EI']);
    assert.match(asked[0].requestedSchema.properties['/model/sections/0/EI'].description, /bending stiffness/iu);
    // inextensible: pi^2 EI / L^2 + K L^2 / pi^2; the axis shortens by P / EA
    const inextensible = Math.PI ** 2 * 100 / 25 + 10 * 25 / Math.PI ** 2;
    const load = found.summary.critical_load_factor;
    assert.ok(Math.abs(load - inextensible) < 2 * inextensible ** 2 / 1e6, `${load}`);
    assert.equal(load, native(column(100)).summary.critical_load_factor, 'all digits of the command line');
    assert.ok(found.summary.error_estimate > 0 && found.critical_points[0].confirmed);
    assert.match(found.program.build, /\w/u);
    assert.match(found.request_sha256, /^[0-9a-f]{64}$/u);
  });

  test('"How does the snap-through load of this arch depend on the stiffness of the soil? Draw it."', async () => {
    const {model} = example('arch_outside_base_k1e7.json');
    const sweep = stiffnesses(model);
    const checked = await answered(client, 'check', sweep);
    assert.equal(checked.size.points, 12);
    const table = await answered(client, 'sweep', sweep);
    assert.deepEqual(table.columns, ['k', '/summary/critical_load_factor', 'error']);
    assert.equal(table.row_count, 12);
    const first = structuredClone({model, analysis: {type: 'critical'}});
    first.model.foundations[0].stiffness = table.rows[0][0];
    assert.equal(table.rows[0][1], native(first).summary.critical_load_factor);
    const drawn = await call(client, 'plot', {id: table.id});
    assert.equal(drawn.content[0].type, 'image');
    assert.deepEqual([...Buffer.from(drawn.content[0].data, 'base64').subarray(1, 4)], [...Buffer.from('PNG')]);
  });

  test('"A pile 12 long in clay over sand, pushed at its head: what does the soil do, and how far does it move?"', async () => {
    const soil = example('convert/pile_soil.json');
    const parts = await answered(client, 'convert', {soil});
    const request = pushed(soil.pile, parts.foundations);
    const found = await answered(client, 'solve', request);
    const wanted = native(request);
    assert.ok(found.left_out.length > 0, 'long lists are left out, and named');
    for (const {pointer, items} of found.left_out) {
      const part = await answered(client, 'read', {id: found.id, pointer});
      assert.equal(part.items, items);
      const whole = pointer.split('/').slice(1).reduce((value, key) => value[key], wanted);
      assert.deepEqual(part.value, whole.slice(0, part.value.length));
    }
    const drawn = await call(client, 'plot', {id: found.id, kind: 'shape', svg: true});
    assert.match(drawn.content[0].resource.text, /^<\?xml|^<svg/u);
  });
});

describe('drawings', () => {
  let client;
  before(async () => {
    client = await connect(() => assert.fail('nothing can be asked'));
  });
  after(() => client.close());

  test('"A post stands under the middle of the beam that I drew. How far does the beam go down there?"', async () => {
    const text = drawing({beam: [0, 0, 6, 0], post: [3, 0, 3, -2]});
    const apart = await call(client, 'convert', {drawing: text});
    const {warnings} = JSON.parse(apart.content[1].text);
    assert.deepEqual(warnings.map((one) => one.code), ['tee_unjoined']);
    assert.match(warnings[0].detail, /\(3, 0\).*; join_tees divides the segments there$/u);
    assert.equal(document(apart).members.length, 2);
    const result = await call(client, 'convert', {drawing: text, join_tees: true});
    assert.equal(result.content.length, 1, 'nothing to warn of');
    const model = document(result);
    const at = (x, y) => model.nodes.find((node) => node.x === x && node.y === y).id;
    model.sections = [{id: 'beam', EA: 1e6, EI: 1000}, {id: 'post', EA: 1000, EI: 1}];
    model.supports = [{node: at(0, 0), fixed: ['x', 'y']}, {node: at(6, 0), fixed: ['y']}, {node: at(3, -2), fixed: ['x', 'y']}];
    model.loads = [{type: 'point', at: {node: at(3, 0)}, force: [0, -1]}];
    model.monitors = [{id: 'middle', at: {node: at(3, 0)}, component: 'y'}];
    const found = await answered(client, 'solve', {model, analysis: {type: 'static', geometry: 'linear'}});
    // beam on two supports and post side by side: 48 EI / L^3 + EA / h
    const down = 1 / (48 * 1000 / 6 ** 3 + 1000 / 2);
    const [moved] = found.static.monitors.middle;
    assert.ok(Math.abs(moved + down) < 1e-9 * down, `${moved}`);
  });
});

describe('what is missing or wrong', () => {
  test('without a way to ask, the missing value is an error with its place, and advice to ask', async () => {
    const client = await connect();
    const result = await call(client, 'solve', column());
    const told = document(result);
    assert.ok(result.isError);
    assert.deepEqual(told.errors.map((one) => [one.pointer, one.code]), [['/model/sections/0/EI', 'missing_field']]);
    assert.match(told.advice, /[Aa]sk the user/u);
    await client.close();
  });

  test('a user who refuses, or answers with something else, gets no number', async () => {
    for (const answer of [{action: 'decline'}, {action: 'cancel'}, {action: 'accept', content: {'/model/sections/0/EI': 'stiff'}}]) {
      const client = await connect(() => answer);
      const result = await call(client, 'solve', column());
      assert.ok(result.isError);
      assert.equal(document(result).summary, undefined);
      await client.close();
    }
  });

  test('other mistakes are told with their places, and an analysis that fails tells what it reached', async () => {
    const client = await connect(() => assert.fail('nothing can be asked'));
    const wrong = column(100);
    wrong.model.members[0].section = 'none';
    const refused = document(await call(client, 'solve', wrong));
    assert.deepEqual(refused.errors.map((one) => one.pointer), ['/model/members/0/section']);
    await assert.rejects(call(client, 'no such tool', {}), /no tool/u);
    assert.ok((await call(client, 'read', {id: 'result-9', pointer: ''})).isError);
    await client.close();
  });
});

describe('the protocol', () => {
  test('a call that is cancelled ends, and later calls are answered', async () => {
    const client = await connect();
    const long = column(100);
    long.analysis = {type: 'path', discretization: {elements: 20, order: 4}, step: {initial: 1e-6, max: 1e-6}, stop: {steps: 1000000}};
    const stop = new AbortController();
    // the first news of the path is a sign that it is computed
    const running = call(client, 'solve', long, {signal: stop.signal, onprogress: () => stop.abort()});
    await assert.rejects(running, /abort/iu);
    assert.ok((await answered(client, 'solve', column(100))).summary.critical_load_factor > 60);
    await client.close();
  });

  test('the list has the published schema of requests', async () => {
    const client = await connect();
    const {tools} = await client.listTools();
    assert.deepEqual(tools.map((tool) => tool.name), ['check', 'solve', 'sweep', 'read', 'plot', 'convert']);
    const published = JSON.parse(readFileSync(new URL('../../../api/openapi/openapi.json', import.meta.url), 'utf8')).components.schemas;
    const schema = tools[1].inputSchema;
    assert.deepEqual(Object.keys(schema.properties), Object.keys(published.Request.properties).sort());
    const references = JSON.stringify(tools).match(/"\$ref":\s*"[^"]*"/gu).map((one) => one.replace(/.*"#\/\$defs\/|"$/gu, ''));
    for (const tool of tools) {
      for (const one of JSON.stringify(tool.inputSchema).matchAll(/"\$ref":"#\/\$defs\/([^"]*)"/gu)) {
        assert.ok(tool.inputSchema.$defs[one[1]], `${tool.name} defines ${one[1]}`);
      }
    }
    assert.ok(references.length > 50);
    await client.close();
  });
});

// Responses of a running service, of every operation and kind, against the document. Each field of a result must be seen.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';

import {dereferenced, document, fieldsOf, schemas} from './support/document.mjs';
import {answerable, examples, failing, loose, sweeps, wrong} from './support/requests.mjs';
import {startService} from './support/service.mjs';
import {faults, validatorOf} from './support/validator.mjs';

let service;
let responses = 0;
const seen = new Set();        // operation and status
const seenFields = new Set();  // of results
const missing = '00000000-0000-7000-8000-000000000000';

before(async () => { service = await startService('--max-body-bytes', '2000000', '--max-job-memory-bytes', '200000000'); });
after(async () => service.stop());

/** Marks the places of a schema that a value has. */
function mark(schema, value, path) {
  const at = dereferenced(schema);
  if (value === null || value === undefined) return;
  for (const one of [...(at.anyOf ?? []), ...(at.oneOf ?? [])]) mark(one, value, path);
  if (Array.isArray(value)) {
    if (at.items) value.forEach((item) => mark(at.items, item, `${path}[]`));
    return;
  }
  if (typeof value !== 'object') return;
  for (const [key, one] of Object.entries(at.properties ?? {})) {
    if (key in value) {
      seenFields.add(`${path}.${key}`);
      mark(one, value[key], `${path}.${key}`);
    }
  }
  if (at.additionalProperties) Object.values(value).forEach((one) => mark(at.additionalProperties, one, `${path}.ID`));
}

/** Sends a request, and holds what comes back against the operation of the document. */
async function call(method, path, target, {body, headers = {}} = {}) {
  const sent = {method, headers: {...(body === undefined ? {} : {'Content-Type': 'application/json'}), ...headers}};
  if (body !== undefined) sent.body = typeof body === 'string' ? body : JSON.stringify(body);
  const response = await fetch(service.address + target, sent);
  const text = await response.text();
  const label = `${method} ${target} -> ${response.status} ${text.slice(0, 200)}`;
  const published = document.paths[path][method.toLowerCase()].responses[response.status];
  assert.ok(published, `not published: ${label}`);
  responses += 1;
  seen.add(`${method} ${path} ${response.status}`);
  const content = dereferenced(published).content;
  if (!content) {
    assert.equal(text, '', label);
    return {status: response.status, headers: response.headers};
  }
  const type = response.headers.get('Content-Type').split(';')[0];
  assert.ok(content[type], `${type} is not published: ${label}`);
  if (!type.endsWith('json') || type === 'application/x-ndjson') return {status: response.status, headers: response.headers, text};
  const json = JSON.parse(text);
  const schema = content[type].schema;
  assert.deepEqual(faults(validatorOf(schema), json), [], label);
  const result = [schema, ...(dereferenced(schema).oneOf ?? [])].find(({$ref}) => $ref?.endsWith('/Result'));
  if (result && json.kind === 'result') mark(result, json, '');
  return {status: response.status, headers: response.headers, json};
}

const submit = (body, headers) => call('POST', '/v1/jobs', '/v1/jobs', {body, headers});

/** The data of the events of a stream by name, each against its schema. */
async function events(path, target, kinds) {
  const response = await fetch(service.address + target);
  assert.equal(response.status, 200);
  responses += 1;
  seen.add(`GET ${path} 200`);
  const names = new Set();
  for (const block of (await response.text()).split('\n\n')) {
    const fields = Object.fromEntries(block.split('\n').filter((line) => line.includes(': ')).map(
        (line) => [line.slice(0, line.indexOf(': ')), line.slice(line.indexOf(': ') + 2)]));
    if (!fields.event) continue;
    names.add(fields.event);
    const schema = {$ref: `#/components/schemas/${kinds[fields.event]}`};
    assert.deepEqual(faults(validatorOf(schema), JSON.parse(fields.data)), [], `${fields.event} ${fields.data}`);
  }
  return names;
}

/** Submits a job, and waits longer for it than one request may: other work on the machine slows it down. */
async function solved(request) {
  const answer = await submit(request, {Prefer: 'wait=60'});
  if (answer.status !== 201) return answer;
  const job = `/v1/jobs/${answer.json.id}`;
  for (let minutes = 1; minutes < 6; ++minutes) {
    const {json} = await call('GET', '/v1/jobs/{id}', job, {headers: {Prefer: 'wait=60'}});
    if (!['accepted', 'running'].includes(json.status)) break;
  }
  return call('GET', '/v1/jobs/{id}/result', `${job}/result`);
}

test('results of every type of analysis and option', async (t) => {
  for (const [name, request] of Object.entries(answerable())) {
    await t.test(name, async () => {
      assert.deepEqual(faults(validatorOf({$ref: '#/components/schemas/Request'}), request), []);
      const {status, json} = await solved(request);
      assert.equal(status, 200, JSON.stringify(json).slice(0, 300));
    });
  }
});

test('failures of analyses', async (t) => {
  for (const [code, request] of Object.entries(failing())) {
    await t.test(code, async () => {
      const {status, json} = await submit(request, {Prefer: 'wait=60'});
      assert.equal(status, 422);
      assert.equal(json.code, code, json.detail);
      mark(schemas.Result, json.reached, '');
    });
  }
});

test('a motion without stiffness', async () => {
  const {status, json} = await submit(loose(), {Prefer: 'wait=60'});
  assert.ok([200, 422].includes(status));
  if (status === 422) mark(schemas.Result, json.reached, '');
});

test('the life of a job', async () => {
  const request = answerable()['path with contact'];
  const made = await submit(request, {Prefer: 'respond-async', 'Cache-Control': 'no-cache'});
  assert.equal(made.status, 201);
  const job = made.headers.get('Location');
  const kinds = {status: 'Job', progress: 'JobProgressEvent', points: 'PathPointsEvent', critical_point: 'CriticalPointEvent', end: 'Job'};
  await events('/v1/jobs/{id}/events', `${job}/events`, kinds);
  await call('GET', '/v1/jobs/{id}', job, {headers: {Prefer: 'wait=30'}});
  for (const query of ['', '?format=csv', '?format=json', '?format=xml', '?format=csv&table=states', '?format=csv&table=points']) {
    await call('GET', '/v1/jobs/{id}/result', `${job}/result${query}`);
  }
  for (const query of ['', '?table=states', '?table=static', '?format=csv']) {
    await call('GET', '/v1/jobs/{id}/table.csv', `${job}/table.csv${query}`);
  }
  const {headers} = await call('GET', '/v1/jobs/{id}/result', `${job}/result`);
  const again = await call('GET', '/v1/jobs/{id}/result', `${job}/result`, {headers: {'If-None-Match': headers.get('ETag')}});
  assert.equal(again.status, 304);
  await call('GET', '/v1/jobs/{id}/request', `${job}/request`);
  assert.equal((await call('POST', '/v1/jobs/{id}/dismiss', `${job}/dismiss`, {body: ''})).status, 409);
  const late = await events('/v1/jobs/{id}/events', `${job}/events`, kinds);
  assert.ok(late.has('end'));
  assert.equal((await call('DELETE', '/v1/jobs/{id}', job)).status, 204);
});

test('what is dismissed while it runs', async () => {
  const long = structuredClone(answerable()['path, every branch']);
  long.analysis.stop = {steps: 10_000_000};
  const made = await submit(long, {Prefer: 'respond-async'});
  const job = made.headers.get('Location');
  assert.equal((await call('POST', '/v1/jobs/{id}/dismiss', `${job}/dismiss`, {body: ''})).status, 200);
  assert.equal((await call('GET', '/v1/jobs/{id}/result', `${job}/result`)).status, 404);
  const [wide] = sweeps();
  wide.parameters[0].range.count = 20_000;
  const {headers} = await call('POST', '/v1/sweeps', '/v1/sweeps', {body: wide});
  const sweep = headers.get('Location');
  assert.equal((await call('POST', '/v1/sweeps/{id}/dismiss', `${sweep}/dismiss`, {body: ''})).status, 200);
  await call('GET', '/v1/sweeps/{id}/table', `${sweep}/table?count=5`);
  await call('POST', '/v1/sweeps/{id}/retry', `${sweep}/retry`, {body: ''});
  await call('DELETE', '/v1/sweeps/{id}', sweep);
});

test('jobs that are not there', async () => {
  for (const [path, operations] of Object.entries(document.paths)) {
    if (!path.startsWith('/v1/jobs/{id}')) continue;
    for (const method of ['get', 'post', 'delete'].filter((one) => operations[one])) {
      const options = method === 'post' ? {body: ''} : {};
      const status = path.endsWith('/key') ? 409 : 404;  // this service has no keys
      assert.equal((await call(method.toUpperCase(), path, path.replace('{id}', missing), options)).status, status);
    }
  }
});

test('refusals', async () => {
  for (const document of wrong()) {
    const {status, json} = await submit(document);
    assert.equal(status, 422);
    assert.ok(json.errors?.length > 0, JSON.stringify(json));
    assert.equal((await call('POST', '/v1/check', '/v1/check', {body: document})).json.valid, false);
    await call('POST', '/v1/sweeps', '/v1/sweeps', {body: {...sweeps()[0], outputs: document}});
  }
  for (const body of ['{', '', '{"a": 1, "a": 2}', `${'['.repeat(100)}${']'.repeat(100)}`]) {
    assert.equal((await submit(body)).status, 400);
    assert.equal((await call('POST', '/v1/check', '/v1/check', {body})).status, 400);
    assert.equal((await call('POST', '/v1/sweeps', '/v1/sweeps', {body})).status, 400);
  }
  const large = ' '.repeat(2_000_001);
  for (const path of ['/v1/jobs', '/v1/sweeps', '/v1/check']) {
    assert.equal((await call('POST', path, path, {body: large})).status, 413);
    assert.equal((await call('POST', path, path, {body: '{}', headers: {'Content-Type': 'text/plain'}})).status, 415);
  }
  for (const query of ['limit=0', 'limit=x', 'cursor=x', 'status=x', 'thing=1']) {
    assert.equal((await call('GET', '/v1/jobs', `/v1/jobs?${query}`)).status, 400);
    assert.equal((await call('GET', '/v1/sweeps', `/v1/sweeps?${query}`)).status, 400);
  }
});

test('keys of idempotency', async () => {
  const [first, second] = Object.values(examples);
  const headers = {'Idempotency-Key': 'one', Prefer: 'respond-async'};
  await submit(first, headers);
  await submit(first, headers);
  assert.equal((await submit(second, headers)).status, 422);
  assert.equal((await submit(first, {'Idempotency-Key': 'x'.repeat(1000)})).status, 400);
});

async function useSweep(sweep) {
  const checked = await call('POST', '/v1/check', '/v1/check', {body: sweep});
  assert.equal(checked.json.valid, true, JSON.stringify(checked.json));
  const made = await call('POST', '/v1/sweeps', '/v1/sweeps', {body: sweep});
  assert.equal(made.status, 201);
  const at = made.headers.get('Location');
  await call('GET', '/v1/sweeps/{id}', at);
  const names = await events('/v1/sweeps/{id}/events', `${at}/events`, {status: 'Sweep', progress: 'SweepProgressEvent', end: 'Sweep'});
  assert.ok(names.has('end'));
  await call('GET', '/v1/sweeps/{id}', at, {headers: {Prefer: 'wait=30'}});
  for (const query of ['', '?format=csv', '?format=csv&links=true', '?format=ndjson', '?status=failed', '?first=1&count=1',
                       '?format=xml', '?rows=1']) {
    await call('GET', '/v1/sweeps/{id}/table', `${at}/table${query}`);
  }
  for (const query of ['', '?first=1&count=1', '?format=csv']) {
    await call('GET', '/v1/sweeps/{id}/table.csv', `${at}/table.csv${query}`);
  }
  await call('GET', '/v1/sweeps/{id}/request', `${at}/request`);
  await call('GET', '/v1/sweeps/{id}/points/{n}/request', `${at}/points/1/request`);
  await call('GET', '/v1/sweeps/{id}/points/{n}/request', `${at}/points/1000/request`);
  await call('POST', '/v1/sweeps/{id}/points/{n}/job', `${at}/points/1/job`, {body: '', headers: {Prefer: 'wait=30'}});
  await call('POST', '/v1/sweeps/{id}/points/{n}/job', `${at}/points/0/job`, {body: '', headers: {Prefer: 'respond-async'}});
  await call('POST', '/v1/sweeps/{id}/dismiss', `${at}/dismiss`, {body: ''});
  await call('POST', '/v1/sweeps/{id}/retry', `${at}/retry?status=failed`, {body: ''});
  await call('POST', '/v1/sweeps/{id}/retry', `${at}/retry?status=all`, {body: ''});
  await call('GET', '/v1/sweeps/{id}', at, {headers: {Prefer: 'wait=30'}});
  await call('DELETE', '/v1/sweeps/{id}', at);
}

test('sweeps', async (t) => {
  const validate = validatorOf({$ref: '#/components/schemas/SweepDocument'});
  for (const [i, sweep] of sweeps().entries()) {
    await t.test(`sweep ${i}`, async () => {
      assert.deepEqual(faults(validate, sweep), []);
      await useSweep(sweep);
    });
  }
  for (const [path, operations] of Object.entries(document.paths)) {
    if (!path.startsWith('/v1/sweeps/{id}')) continue;
    for (const method of ['get', 'post', 'delete'].filter((one) => operations[one])) {
      const options = method === 'post' ? {body: ''} : {};
      const target = path.replace('{id}', missing).replace('{n}', '0');
      assert.equal((await call(method.toUpperCase(), path, target, options)).status, 404);
    }
  }
});

test('components of Grasshopper', async () => {
  const {json: components} = await call('GET', '/v1/hops', '/v1/hops');
  for (const {Name, Inputs} of components) {
    const values = Inputs.map(({Name: name, ResultType: type, Default: value}) => (
      {ParamName: name, InnerTree: {'{0}': [{type, data: JSON.stringify(value)}]}}));
    await call('GET', '/v1/hops/{id}', `/v1/hops/${Name}`);
    const body = {pointer: `v1/hops/${Name}`, algo: null, cachesolve: false, modelunits: 'Meters', values};
    assert.deepEqual(faults(validatorOf({$ref: '#/components/schemas/HopsCall'}), body), []);
    for (const [path, target] of [['/solve', '/solve'], ['/v1/hops/{id}', `/v1/hops/${Name}`]]) {
      assert.equal((await call('POST', path, target, {body})).status, 200);
      assert.equal((await call('POST', path, target, {body: {...body, values: []}})).status, 422);
      assert.equal((await call('POST', path, target, {body: '{'})).status, 400);
      assert.equal((await call('POST', path, target, {body: '{}', headers: {'Content-Type': 'text/plain'}})).status, 415);
      assert.equal((await call('POST', path, target, {body: ' '.repeat(2_000_001)})).status, 413);
    }
  }
  assert.equal((await call('GET', '/v1/hops/{id}', '/v1/hops/none')).status, 404);
  assert.equal((await call('POST', '/v1/hops/{id}', '/v1/hops/none', {body: {values: []}})).status, 404);
});

test('files and figures', async () => {
  const convert = (query, options) => call('POST', '/v1/convert', `/v1/convert${query}`, options);
  const plot = (query, options) => call('POST', '/v1/plot', `/v1/plot${query}`, options);
  const {content} = document.paths['/v1/convert'].post.requestBody;
  assert.equal((await convert('', {body: content['application/json'].example})).status, 200);
  for (const type of ['image/vnd.dxf', 'application/dxf']) {
    const options = {body: content['image/vnd.dxf'].example, headers: {'Content-Type': type}};
    const {json} = await convert('?layer=column', options);
    assert.equal((await plot('', {body: json})).status, 200);
    assert.equal((await convert('?layer=roof', options)).status, 422);
    assert.equal((await convert('?tolerance=0', options)).status, 400);
    assert.equal((await convert('?join_tees=1', options)).status, 400);
    // the line of the drawing a second time
    const twice = {...options, body: options.body.replace(/0\nLINE\n(?:.*\n)*?(?=0\nENDSEC)/u, '$&$&')};
    const told = JSON.parse((await convert('?join_tees=true', twice)).headers.get('X-Warnings'));
    const warnings = document.paths['/v1/convert'].post.responses['200'].headers['X-Warnings'].schema;
    assert.deepEqual(faults(validatorOf(warnings.contentSchema), told), []);
    assert.deepEqual(told.map((one) => one.code), ['duplicates_dropped']);
  }
  const form = Object.entries(content['multipart/form-data'].example).map(
      ([name, table]) => `--x\r\nContent-Disposition: form-data; name="${name}"\r\n\r\n${table}\r\n`).join('');
  const headers = {'Content-Type': 'multipart/form-data; boundary=x'};
  assert.equal((await convert('', {body: `${form}--x--`, headers})).status, 200);
  assert.equal((await convert('', {body: form, headers})).status, 400);
  const [request] = Object.values(examples);
  const {json: result} = await submit(request);
  for (const body of [document.paths['/v1/plot'].post.requestBody.content['application/json'].example, result, {result, request},
                      {model: request.model}, request.model]) {
    assert.deepEqual(faults(validatorOf({$ref: '#/components/schemas/FigureDocument'}), body), []);
    assert.match((await plot('?width=400&dark=true', {body})).text, /^<\?xml/);
  }
  assert.equal((await plot('?kind=model', {body: request})).status, 200);
  assert.equal((await plot('', {body: request})).status, 422);
  assert.equal((await plot('?kind=pie', {body: result})).status, 400);
  for (const one of [convert, plot]) {
    assert.equal((await one('', {body: '{'})).status, 400);
    assert.equal((await one('', {body: '{}'})).status, 422);
    assert.equal((await one('', {body: ' '.repeat(2_000_001)})).status, 413);
    assert.equal((await one('', {body: '{}', headers: {'Content-Type': 'text/plain'}})).status, 415);
  }
});

test('lists and the service itself', async () => {
  for (const list of ['/v1/jobs', '/v1/sweeps']) {
    for (const query of ['', '?limit=1', '?status=successful', '?status=failed&limit=2']) await call('GET', list, list + query);
  }
  for (const query of ['', '?label=none', '?format=csv', '?from=2026-01-01T00:00:00Z']) {
    assert.equal((await call('GET', '/v1/usage', `/v1/usage${query}`)).status, 200);
  }
  assert.equal((await call('GET', '/v1/usage', '/v1/usage?from=yesterday')).status, 400);
  const {json: audit} = await call('GET', '/v1/audit', '/v1/audit?limit=1');
  assert.equal((await call('GET', '/v1/audit', audit.links[0].href)).status, 200);
  assert.equal((await call('GET', '/v1/audit', '/v1/audit?limit=0')).status, 400);
  for (const path of ['/v1/limits', '/v1/openapi.json', '/v1/examples', '/livez', '/readyz', '/metrics']) await call('GET', path, path);
});

test('documents have a row for every field', async () => {
  for (const [page, schema] of [['requests', 'Request'], ['results', 'Result']]) {
    const text = await (await fetch(`${service.address}/docs/${page}.md`)).text();
    const rows = fieldsOf(schema).map(({path, forms, required}) => [`| \`${path}\`${required ? '' : ' ?'} | `, forms]);
    assert.ok(rows.length > 120, `${rows.length} fields`);
    const lines = text.split('\n').filter((line) => line.startsWith('| `'));
    const missing = rows.filter(([start, forms]) => !lines.some(
        (line) => line.startsWith(start) && forms.every(({description}) => line.includes(description))));
    assert.deepEqual(missing.map(([start]) => start), [], page);
  }
});

test('a service with keys', async () => {
  const plain = service;
  // SHA-256 of "alice", from sha256sum
  const {writeFileSync, mkdtempSync, rmSync} = await import('node:fs');
  const folder = mkdtempSync('/tmp/snapthrough-keys-');
  writeFileSync(`${folder}/keys.toml`,
                '[[keys]]\nowner = "ann"\nsha256 = "2bd806c97f0e00af1a1fc3328fa763a9269723c8db8fac4f93af71db186d6e90"\n');
  service = await startService('--config', `${folder}/keys.toml`);
  try {
    for (const [path, operations] of Object.entries(document.paths)) {
      for (const [method, operation] of Object.entries(operations)) {
        if (method === 'parameters' || operation.security) continue;
        const target = path.replace('{id}', missing).replace('{n}', '0');
        const options = method === 'post' ? {body: ''} : {};
        assert.equal((await call(method.toUpperCase(), path, target, options)).status, 401);
      }
    }
  } finally {
    await service.stop();
    rmSync(folder, {recursive: true});
    service = plain;
  }
});

test('at least 100 responses, of every operation, with every field of a result', (t) => {
  t.diagnostic(`${responses} responses, ${seen.size} pairs of operation and status`);
  assert.ok(responses >= 100);
  const unused = [];
  for (const [path, operations] of Object.entries(document.paths)) {
    for (const [method, operation] of Object.entries(operations)) {
      if (method === 'parameters' || path.endsWith('/key')) continue;  // this service has no keys
      const good = Object.keys(operation.responses).filter((status) => Number(status) < 300);
      if (!good.some((status) => seen.has(`${method.toUpperCase()} ${path} ${status}`))) unused.push(`${method} ${path}`);
    }
  }
  assert.deepEqual(unused, []);
  const all = new Set();
  const collect = (schema, path) => {
    const at = dereferenced(schema);
    for (const one of [...(at.anyOf ?? []), ...(at.oneOf ?? [])]) collect(one, path);
    for (const [key, one] of Object.entries(at.properties ?? {})) {
      all.add(`${path}.${key}`);
      collect(one, `${path}.${key}`);
    }
    if (at.items) collect(at.items, `${path}[]`);
    if (at.additionalProperties) collect(at.additionalProperties, `${path}.ID`);
  };
  collect(schemas.Result, '');
  assert.deepEqual([...all].filter((field) => !seenFields.has(field)), []);
});

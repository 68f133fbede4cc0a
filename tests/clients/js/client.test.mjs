// The JavaScript client in Node against the executable: the thirteen requests and the sweep that every client is given, bit for bit
// what the command line answers.
//   SERVICE_EXECUTABLE=build/release/snapthrough node --test tests/clients/js
import assert from 'node:assert/strict';
import {createHash} from 'node:crypto';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, describe, test} from 'node:test';
import {setTimeout as sleep} from 'node:timers/promises';

import {Client, isAbort, Refused, Unreachable} from '../../../clients/js/dist/index.js';
import {command, startService} from '../../schema/support/service.mjs';

const folder = new URL('../', import.meta.url);
const read = (name) => readFileSync(new URL(name, folder), 'utf8');
const expected = JSON.parse(read('expected.json'));
const request = (name) => JSON.parse(read(`requests/${name}.json`));

/** A result without what the clock says. */
function timeless(result) {
  const {diagnostics: {wall_time_s: _, ...diagnostics}, ...rest} = result;
  return {...rest, diagnostics};
}

/** What the command line answers; numbers are compared as the doubles that both texts are read to. */
const onCommandLine = (name) => timeless(JSON.parse(command(['solve', '-'], read(`requests/${name}.json`)).text));

let service;
before(async () => { service = await startService(); });
after(async () => service.stop());

const client = (options = {}) => new Client({url: service.address, ...options});

describe('the thirteen requests', () => {
  for (const [name, {outcome, code, errors, warnings = []}] of Object.entries(expected)) {
    test(name, async () => {
      const told = [];
      const calls = client({onWarning: (warning, job) => told.push([warning.code, typeof job])});
      if (outcome === 'done') {
        const {job, result} = await calls.solve(request(name));
        assert.deepEqual(timeless(result), onCommandLine(name));
        assert.deepEqual(await calls.jobRequest(job), request(name));
      } else if (outcome === 'failed') {
        const refusal = await calls.solve(request(name)).catch((error) => error);
        assert.ok(refusal instanceof Refused);
        assert.equal(refusal.kind, 'analysis-failed');
        assert.equal(refusal.problem.code, code);
        assert.match(refusal.message, new RegExp(`\\(${code}\\)`));
        assert.deepEqual(timeless(refusal.reached), onCommandLine(name));
        assert.equal((await calls.job(refusal.job)).status, 'failed');
      } else if (outcome === 'wrong') {
        const refusal = await calls.solve(request(name)).catch((error) => error);
        assert.deepEqual(refusal.findings.map((one) => [one.pointer, one.code]), errors);
        for (const [pointer] of errors) assert.ok(refusal.message.includes(`\n${pointer}: `), refusal.message);
        assert.deepEqual((await calls.check(request(name))).errors.map((one) => [one.pointer, one.code]), errors);
      } else {
        await isCancelled(calls, request(name));
      }
      assert.deepEqual(told, warnings.map((one) => [one, 'string']));
    });
  }
});

async function isCancelled(calls, long) {
  const control = new AbortController();
  let steps = 0;
  let points = 0;
  const error = await calls.solve(long, {
    label: 'cancelled', signal: control.signal,
    onPoints: ({load_factor: some}) => { points += some.length; },
    onProgress: ({step}) => {
      steps = step;
      if (step > 3 && points > 3) control.abort();
    },
  }).catch((one) => one);
  assert.ok(isAbort(error), String(error));
  assert.ok(steps > 3);
  const {jobs: [job]} = await calls.jobs('label=cancelled');
  assert.equal(job.status, 'dismissed');
}

test('warnings go to the console unless somebody takes them', async () => {
  const {warn} = console;
  const lines = [];
  console.warn = (line) => lines.push(line);
  try {
    await client().solve(request('warnings'));
  } finally {
    console.warn = warn;
  }
  assert.equal(lines.length, 1);
  assert.match(lines[0], /^snapthrough: nearly_unstable: /);
});

test('the critical points of a job come with its end', async () => {
  const final = [];
  const {result} = await client().solve(request('arch'), {
    fresh: true, onCriticalPoint: (point) => (point.final ? final.push(point.load_factor) : undefined),
  });
  assert.deepEqual(final, result.critical_points.map((point) => point.load_factor));
});

test('a stored result is told', async () => {
  const first = await client().solve(request('column'));
  const second = await client().solve(request('column'));
  assert.deepEqual([second.job, second.cached], [first.job, true]);
  assert.notEqual((await client().solve(request('column'), {fresh: true})).job, first.job);
});

test('a sweep of 500 points with its progress', async () => {
  const document = JSON.parse(read('sweep_500.json'));
  const done = [];
  const {sweep, table} = await client().sweep(document, {onProgress: (progress) => done.push(progress)});
  assert.deepEqual([sweep.points, sweep.counts.failed, table.rows.length], [500, 50, 500]);
  assert.deepEqual(table.rows.filter((row) => row.at(-1) !== null).length, 50);
  const csv = command(['sweep', '-'], read('sweep_500.json')).text;
  assert.deepEqual(table.rows, JSON.parse(csv).rows);
  assert.ok(done.length > 0);
});

test('a table that the service gives in parts', async () => {
  const small = await startService('--max-table-rows', '150');
  try {
    const {table} = await new Client({url: small.address}).sweep(JSON.parse(read('sweep_500.json')));
    assert.equal(table.rows.length, 500);
    assert.deepEqual(table.points, Array.from({length: 500}, (_, i) => i));
  } finally {
    await small.stop();
  }
});

test('a sweep that is aborted is dismissed', async () => {
  const document = JSON.parse(read('sweep_500.json'));
  document.parameters.push({name: 'many', targets: [{pointer: '/model/title'}], values: Array.from({length: 200}, (_, i) => `${i}`)});
  const control = new AbortController();
  const running = client().sweep(document, {label: 'aborted', signal: control.signal, onProgress: () => control.abort()});
  assert.ok(isAbort(await running.catch((error) => error)));
  const {sweeps: [sweep]} = await client().sweeps('label=aborted');
  assert.equal(sweep.status, 'dismissed');
});

test('a signal that was aborted before', async () => {
  const error = await client().solve(request('cancelled'), {signal: AbortSignal.abort()}).catch((one) => one);
  assert.ok(isAbort(error), String(error));
});

test('keys', async () => {
  const configs = mkdtempSync(join(tmpdir(), 'snapthrough-keys-'));
  const config = join(configs, 'keys.toml');
  writeFileSync(config, `[[keys]]\nowner = "ann"\nsha256 = "${createHash('sha256').update('secret').digest('hex')}"\n`);
  const locked = await startService('--config', config);
  try {
    const refusal = await new Client({url: locked.address}).limits().catch((error) => error);
    assert.deepEqual([refusal.problem.status, refusal.kind], [401, 'unauthorized']);
    assert.equal(typeof (await new Client({url: `${locked.address}/`, key: 'secret'}).limits()).queue, 'number');
    assert.equal((await new Client({url: locked.address, key: () => 'secret'}).solve(request('static'))).result.not_reached.length, 0);
  } finally {
    await locked.stop();
    rmSync(configs, {recursive: true});
  }
});

test('a service that is not there', async () => {
  const error = await new Client({url: 'http://127.0.0.1:9'}).limits().catch((one) => one);
  assert.ok(error instanceof Unreachable);
});

test('a service that goes away while a job is followed', async () => {
  const short = await startService();
  const control = new AbortController();
  const calls = new Client({url: short.address});
  const running = calls.solve(request('cancelled'), {signal: control.signal}).catch((error) => error);
  await sleep(500);
  await short.stop();
  assert.ok((await running) instanceof Unreachable);
});

// The solver as a WebAssembly module in Node, against the executable: the requests and the sweep that every client is given.
//   SERVICE_EXECUTABLE=build/release/snapthrough SOLVER_PACKAGE=build/wasm/package node --test tests/clients/wasm
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {after, before, describe, test} from 'node:test';
import {pathToFileURL} from 'node:url';

import {command} from '../../schema/support/service.mjs';

const folder = new URL('../', import.meta.url);
const read = (name) => readFileSync(new URL(name, folder), 'utf8');
const expected = JSON.parse(read('expected.json'));
const text = (name) => read(`requests/${name}.json`);
const native = (name) => JSON.parse(command(['solve', '-'], text(name)).text);

const home = resolve(process.env.SOLVER_PACKAGE ?? 'build/wasm/package');
const {Solver, SolverError} = await import(pathToFileURL(join(home, 'index.js')).href);

// Of loads; the two compilers order sums differently.
const SHARE = 1e-10;

/** All load factors of a result with what they belong to. Paths may have a row more; where a force is zero but for rounding, its
 * extremes are anywhere. */
function loads(value, place = '') {
  if (value === null || typeof value !== 'object') return /load_factors?(\/\d+)?$/u.test(place) ? [[place, value]] : [];
  return Object.entries(value).filter(([key]) => key !== 'branches' && key !== 'extremes').flatMap(([key, inner]) => loads(inner, `${place}/${key}`));
}

const isNear = (found, wanted) => Math.abs(found - wanted) <= SHARE * Math.abs(wanted);

function near(found, wanted) {
  assert.deepEqual(found.map(([place]) => place), wanted.map(([place]) => place));
  wanted.forEach(([place, number], i) => {
    const other = found[i][1];
    assert.ok(number === null ? other === null : isNear(other, number), `${place}: ${other}, not ${number}`);
  });
}

/** The same words; numbers in them to their share. */
function sameWords(found, wanted) {
  const number = /-?\d+\.\d+(?:e[-+]?\d+)?/gu;
  assert.equal(found.replace(number, '#'), wanted.replace(number, '#'));
  const others = found.match(number) ?? [];
  (wanted.match(number) ?? []).forEach((one, i) => assert.ok(isNear(Number(others[i]), Number(one)), `${found}\n${wanted}`));
}

const sameAs = (found, wanted) => {
  near(loads(found), loads(wanted));
  sameWords(JSON.stringify([found.failure, found.warnings, found.summary.message]),
            JSON.stringify([wanted.failure, wanted.warnings, wanted.summary.message]));
  assert.deepEqual(found.critical_points.map((one) => one.type), wanted.critical_points.map((one) => one.type));
  assert.equal(found.summary.termination, wanted.summary.termination);
};

let solver;
before(async () => { solver = await Solver.create({workers: 2}); });
after(() => solver.close());

describe('the thirteen requests', () => {
  for (const [name, {outcome, code, errors}] of Object.entries(expected)) {
    test(name, async () => {
      if (outcome === 'done') {
        sameAs(await solver.solve(text(name)), native(name));
      } else if (outcome === 'failed') {
        const error = await solver.solve(text(name)).catch((one) => one);
        assert.ok(error instanceof SolverError, error);
        assert.equal(error.problem.failure.code, code);
        assert.equal(error.message, error.problem.failure.detail);
        sameAs(error.reached, native(name));
      } else if (outcome === 'wrong') {
        const error = await solver.solve(text(name)).catch((one) => one);
        assert.deepEqual(error.findings.map((one) => [one.pointer, one.code]), errors);
        const told = error.findings.map((one) => `${one.pointer}: ${one.detail} [${one.code}]\n`).join('');
        assert.equal(told, command(['check', '-'], text(name)).errors);
        assert.deepEqual((await solver.check(text(name))).errors, error.findings);
      } else {
        const abort = new AbortController();
        const steps = [];
        const error = await solver.solve(text(name), {signal: abort.signal, onProgress: (now) => {
          steps.push(now.done);
          if (steps.length === 5) abort.abort();
        }}).catch((one) => one);
        assert.equal(error.name, 'AbortError');
        assert.deepEqual(steps.slice(0, 5), [...steps.slice(0, 5)].sort((a, b) => a - b));
        sameAs(await solver.solve(text('ring')), native('ring'));
      }
    });
  }
});

test('points of the growing path are those of the result', async () => {
  const told = new Map();
  const result = await solver.solve(text('arch'), {onProgress: ({arcLength, monitors}) => told.set(arcLength, monitors)});
  const [branch] = result.branches;
  const names = JSON.parse(text('arch')).model.monitors.map(({id}) => id);
  const common = branch.arc_length.map((length, i) => [told.get(length), i]).filter(([monitors]) => monitors !== undefined);
  assert.ok(common.length >= 3, `${common.length} of ${branch.arc_length.length}`);
  for (const [monitors, i] of common) assert.deepEqual(monitors, names.map((name) => branch.monitors[name][i]));
});

test('a sweep of 500 points over two workers has the rows of the executable', async () => {
  const sweep = read('sweep_500.json');
  const told = [];
  const table = await solver.sweep(sweep, {onProgress: (now) => told.push(now)});
  const wanted = JSON.parse(command(['sweep', '-'], sweep).text);
  assert.deepEqual(table.columns, wanted.columns);
  assert.deepEqual(table.points, wanted.points);
  assert.equal(table.rows.length, 500);
  table.rows.forEach((row, i) => sameWords(JSON.stringify(row), JSON.stringify(wanted.rows[i])));
  assert.deepEqual(told.at(-1), {done: 500, total: 500});
  assert.ok(told.every(({done}, i) => i === 0 || done >= told[i - 1].done));
});

test('a figure is that of the executable', async () => {
  const result = await solver.solve(text('arch'));
  const drawn = await solver.plot(result, {kind: 'path'});
  assert.match(drawn, /<svg [^]*<\/svg>\s*$/u);
  const error = await solver.plot(result, {kind: 'none'}).catch((one) => one);
  assert.match(error.findings[0].pointer, /^choices:/u);
});

test('a size that a request has', async () => {
  const {size, errors = []} = await solver.check(text('arch'));
  assert.deepEqual(errors, []);
  assert.ok(size.unknowns > 0);
});

test('a request does not wait for the parts of a sweep', async () => {
  const order = [];
  const run = solver.sweep(read('sweep_500.json')).then(() => order.push('sweep'));
  await solver.solve(text('column')).then(() => order.push('request'));
  await run;
  assert.deepEqual(order, ['request', 'sweep']);
});

test('a sweep that is aborted ends, and the solver goes on', async () => {
  const abort = new AbortController();
  const run = solver.sweep(read('sweep_500.json'), {signal: abort.signal, onProgress: ({done}) => done > 0 && abort.abort()});
  await assert.rejects(run, {name: 'AbortError'});
  sameAs(await solver.solve(text('column')), native('column'));
});

test('calls on a closed solver fail', async () => {
  const other = await Solver.create({workers: 1});
  const run = other.solve(text('cancelled'));
  setTimeout(() => other.close(), 50);
  await assert.rejects(run, /closed/u);
  await assert.rejects(other.solve(text('column')), /closed/u);
});

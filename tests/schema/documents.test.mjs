// The documents in docs/ against the published document and the sources.
import assert from 'node:assert/strict';
import {readFileSync, readdirSync} from 'node:fs';
import {test} from 'node:test';

import {root, schemas} from './support/document.mjs';

const read = (name) => readFileSync(new URL(name, root), 'utf8');

/** Text of every source in a folder, deep. */
function sources(folder) {
  return readdirSync(new URL(`${folder}/`, root), {withFileTypes: true}).map((entry) => {
    if (entry.isDirectory()) return sources(`${folder}/${entry.name}`);
    return /\.(cpp|h)$/.test(entry.name) ? read(`${folder}/${entry.name}`) : '';
  }).join('\n');
}

const all = (text, pattern) => new Set([...text.matchAll(pattern)].map((match) => match[1]));
const solver = sources('solver');
const api = sources('api');
const server = sources('server');

const kFailures = [/\b(?:fail|give_up)\(\s*\w+,\s*(?:\w+ \? )?"([a-z_]+)"/g, /\bfail\(\s*\w+,\s*\w+ \? "[a-z_]+" : "([a-z_]+)"/g,
                   /TraceEnd::\w+,\s*"([a-z_]+)"[^}]*?,\s*true\}/g];
const kEnds = [/TraceEnd::\w+,\s*"([a-z_]+)"/g, /termination = "([a-z_]+)"/g];
const kFindings = [/\breport\(\s*"([a-z_]+)"/g, /\breport\.add\([^"]*"([a-z_]+)"/g, /\.report\(\s*(?:\w+ \? )?"([a-z_]+)"/g];

const union = (text, patterns) => new Set(patterns.flatMap((pattern) => [...all(text, pattern)]));
const failures = union(solver, kFailures);
const ends = union(solver, kEnds);
const findings = union(solver + api, kFindings);
const problems = all(server, /\b[45]\d\d,\s*"([a-z-]+)",/g);

const missing = (codes, text) => [...codes].filter((code) => !text.includes(`\`${code}\``)).sort();
const unlisted = (codes, list) => [...codes].filter((code) => !list.includes(code)).sort();

test('codes were found in the sources', () => {
  for (const [codes, some] of [[failures, ['beyond_limit_point', 'no_buckling_mode', 'step_underflow', 'loose_part', 'no_start']],
                               [ends, ['critical_point', 'modes', 'load_bound']], [findings, ['bad_id', 'wrong_type', 'ambiguous']],
                               [problems, ['no-such-job', 'queue-full']]]) {
    for (const code of some) assert.ok(codes.has(code), `${code} of ${[...codes]}`);
  }
});

test('every code of a failure is in docs/requests.md and in the schema', () => {
  assert.deepEqual(missing(failures, read('docs/requests.md')), []);
  assert.deepEqual(missing(schemas.Failure.properties.code.enum, read('docs/requests.md')), []);
  assert.deepEqual(unlisted(failures, schemas.Failure.properties.code.enum), []);
});

test('every code of an end is in docs/requests.md and in the schema', () => {
  assert.deepEqual(missing(ends, read('docs/requests.md')), []);
  assert.deepEqual(missing(schemas.Summary.properties.termination.enum, read('docs/requests.md')), []);
  assert.deepEqual(unlisted(ends, schemas.Summary.properties.termination.enum), []);
});

test('every code of a finding is documented and in the schema', () => {
  const text = read('docs/requests.md') + read('docs/sweeps.md');
  assert.deepEqual(missing(findings, text), []);
  assert.deepEqual(missing(schemas.Finding.properties.code.enum, text), []);
  assert.deepEqual(unlisted(findings, schemas.Finding.properties.code.enum), []);
});

test('every problem is in docs/service.md and in the schema', () => {
  const kinds = schemas.Problem.properties.type.enum.map((type) => type.replace('urn:snapthrough:problem:', ''));
  assert.deepEqual(unlisted(problems, kinds), []);
  assert.deepEqual(missing(kinds, read('docs/service.md')), []);
});

test('requests that are quoted in docs/ are of the schema', async () => {
  const {faults, validatorNamed} = await import('./support/validator.mjs');
  let quoted = 0;
  for (const [, text] of read('docs/requests.md').matchAll(/```json\n([^]*?)```/g)) {
    const document = JSON.parse(text);
    if (!document.model) continue;
    quoted += 1;
    assert.deepEqual(faults(validatorNamed('Request'), document), []);
  }
  assert.ok(quoted >= 4, `${quoted} requests`);
});

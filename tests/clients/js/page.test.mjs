// The programs of docs/howto/use-from-javascript.md, run as they stand with the package installed beside them.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import {fileURLToPath} from 'node:url';

import {command, startService} from '../../schema/support/service.mjs';

const root = fileURLToPath(new URL('../../../', import.meta.url));
const page = readFileSync(join(root, 'docs/howto/use-from-javascript.md'), 'utf8');
const programs = [...page.matchAll(/```js\n(.*?)```/gs)].map(([, text]) => text);

let service;
let folder;
before(async () => {
  service = await startService();
  folder = mkdtempSync(join(tmpdir(), 'snapthrough-js-'));
  mkdirSync(join(folder, 'node_modules'));
  symlinkSync(join(root, 'clients/js'), join(folder, 'node_modules/snapthrough'));
  symlinkSync(join(root, 'examples'), join(folder, 'examples'));
});
after(async () => {
  await service.stop();
  rmSync(folder, {recursive: true});
});

/** Standard output of a program of the page. */
async function run(text) {
  assert.ok(text.includes('http://127.0.0.1:8080'));
  writeFileSync(join(folder, 'program.mjs'), text.replace('http://127.0.0.1:8080', service.address));
  const child = spawn(process.execPath, ['program.mjs'], {cwd: folder, stdio: ['ignore', 'pipe', 'inherit']});
  let output = '';
  child.stdout.on('data', (piece) => { output += piece; });
  assert.equal(await new Promise((resolve) => child.once('exit', resolve)), 0);
  return output.trimEnd().split('\n');
}

test('the first program solves, and shows a mistake with its pointer', async () => {
  const [load, points, mistake, ...more] = await run(programs[0]);
  const {summary, branches: [branch]} = JSON.parse(command(['solve', join(root, 'examples/tunnel_arch.json')]).text);
  assert.equal(load, `${summary.critical_load_factor} ${summary.critical_type}`);
  assert.equal(points, `${branch.load_factor.length} points of the path`);
  assert.match(mistake, /^\/analysis\/type /);
  assert.deepEqual(more, []);
});

test('the second program sweeps', async () => {
  const lines = await run(programs[1]);
  const table = JSON.parse(command(['sweep', join(root, 'examples/sweeps/lining_thickness.json')]).text);
  const rows = [table.columns, ...table.rows].map((row) => row.join());
  assert.deepEqual(lines.slice(-rows.length), rows);
  assert.equal(programs.length, 2);
});

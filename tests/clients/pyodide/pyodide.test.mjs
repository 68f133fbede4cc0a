// The Python package in Python that is compiled for WebAssembly (Pyodide), with the solver as the module that the page gives.
//   SOLVER_PACKAGE=build/wasm/package WHEEL=FILE node --test tests/clients/pyodide
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {before, describe, test} from 'node:test';
import {pathToFileURL} from 'node:url';

import {loadPyodide} from 'pyodide';

const home = resolve(process.env.SOLVER_PACKAGE ?? '../../../build/wasm/package');
const {Module} = await import(pathToFileURL(join(home, 'module.js')).href);
const readme = readFileSync(new URL('../../../README.md', import.meta.url), 'utf8');

/** The block of the README that begins with `import snapthrough`. */
const column = () => /```python\n(import snapthrough[\s\S]*?)```/u.exec(readme)[1];

/** A started module of the solver. */
const started = async () => Module.start(await WebAssembly.compile(readFileSync(join(home, 'snapthrough.wasm'))));

describe('the Python package in a browser', () => {
  let python;
  const said = [];
  before(async () => {
    python = await loadPyodide({stdout: (line) => said.push(line), stderr: (line) => said.push(line)});
    python.unpackArchive(new Uint8Array(readFileSync(process.env.WHEEL)), 'wheel');
  });

  test('without the solver the error says what the page must do', async () => {
    const told = await python.runPythonAsync(`
import snapthrough as st
try:
    st.solve({}, {})
    told = "solved"
except st.LibraryNotFound as error:
    told = str(error)
told`);
    assert.match(told, /registerJsModule/u);
  });

  test('the column of the README', async () => {
    python.registerJsModule('snapthrough_solver', await started());
    said.length = 0;
    await python.runPythonAsync(column());
    const [load, type] = said.at(-1).split(' ');
    const inextensible = Math.PI ** 2 * 100 / 25 + 10 * 25 / Math.PI ** 2;
    assert.ok(Math.abs(load - inextensible) < 2 * inextensible ** 2 / 1e6, said.join('\n'));
    assert.equal(type, 'bifurcation');
  });

  test('progress stops an analysis; a mistake has its place; a figure is drawn', async () => {
    const found = await python.runPythonAsync(`
import json
seen = []
try:
    st.solve(model, st.Path(), on_progress=lambda now: (seen.append(now.done), len(seen) < 3)[1])
    stopped = "not stopped"
except st.Cancelled as error:
    stopped = len(error.reached.branches[0].load_factor)
try:
    st.solve(st.Model().node("foot", 0, 0), st.Critical())
except st.InvalidRequest as error:
    pointer = error.findings[0].pointer
json.dumps({"stopped": stopped, "seen": len(seen), "pointer": pointer, "svg": st.Local().plot(result)[:5]})`);
    const {stopped, seen, pointer, svg} = JSON.parse(found);
    assert.equal(seen, 3);
    assert.ok(stopped >= 2, `${stopped}`);
    assert.match(pointer, /^\//u);
    assert.match(svg, /^<\?xml|^<svg/u);
  });

  test('a sweep of 500 points has the rows of the module', async () => {
    const sweep = readFileSync(new URL('../sweep_500.json', import.meta.url), 'utf8');
    python.globals.set('document', sweep);
    const rows = JSON.parse(await python.runPythonAsync('json.dumps(st.sweep(document).table().rows)'));
    const direct = JSON.parse((await started()).sweep(sweep, 0, 500).text).rows;
    assert.deepEqual(rows, direct);
  });
});

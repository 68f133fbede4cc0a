// The studio against the real service: sliders, walking, gallery, exports, mistakes.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { violations } from './support/axe.mjs';
import { downloaded, drawnPath, eventually, openPage, settled, slide, watchWalking } from './support/browser.mjs';
import { browser, close, service } from './support/stage.mjs';

const studio = (problem = 'buried_pipe') => openPage(browser, `${service.url}/#/studio?problem=${problem}`);

test('the first problem is drawn with its path, its sections and its critical load', async () => {
  const page = await openPage(browser, service.url);
  await settled(page);
  assert.equal(await page.getByRole('heading', { level: 1 }).innerText(), 'Buried flexible pipe');
  assert.match(await page.locator('.trust-card .headline').innerText(), /^8\.0989\s+confirmed$/);
  assert.ok((await page.locator('.drawing-card svg path.contact').count()) > 0);
  assert.ok((await page.locator('.sections-card svg path').count()) > 2);
  assert.match(await drawnPath(page), /^M/);
  await close(page);
});

test('the latest value of a slider wins, with at most two requests in flight and no jobs left behind', async () => {
  const page = await studio();
  await settled(page);
  const inFlight = new Set();
  let most = 0;
  const isSolve = (request) => request.method() === 'POST' && request.url().endsWith('/v1/jobs');
  page.on('request', (request) => {
    if (isSolve(request)) {
      inFlight.add(request);
      most = Math.max(most, inFlight.size);
    }
  });
  const ended = (request) => inFlight.delete(request);
  page.on('requestfinished', ended);
  page.on('requestfailed', ended);
  await page.waitForTimeout(600);  // states to walk through were asked for
  most = 0;
  const start = await drawnPath(page);
  const places = Array.from({ length: 61 }, (_, i) => 300 + 10 * i);
  for (let i = 0; i < places.length; i += 6) {
    await slide(page, 'Soil stiffness', ...places.slice(i, i + 6));
  }
  await slide(page, 'Soil stiffness', 900);
  await settled(page);
  assert.equal(most, 2);
  assert.notEqual(await drawnPath(page), start);
  const value = await page.getByLabel('Soil stiffness, value in kN/m²').inputValue();
  assert.equal(value.replace(/\s/g, ''), '126000');  // 2000 (200000 / 2000)^0.9
  const jobs = async () => (await (await fetch(`${service.url}/v1/jobs?label=studio`)).json()).jobs;
  await eventually(async () => (await jobs()).length <= 3, 'few jobs are left');
  await close(page);
});

test('the jobs of a tab go with it', async () => {
  const page = await studio('tunnel_arch');
  await slide(page, 'Ground stiffness', 300);
  await settled(page);
  await page.getByRole('button', { name: 'Pin this run' }).click();
  const listed = async () => (await (await fetch(`${service.url}/v1/jobs?label=studio`)).json()).jobs;
  const left = async () => (await listed()).map(({ id }) => id);
  const before = new Set(await left());
  const isWalking = watchWalking(page);
  await slide(page, 'Ground stiffness', 600, 900);
  await settled(page);
  await eventually(isWalking, 'the page knows all of its jobs');
  const added = async () => (await left()).filter((id) => !before.has(id));
  await eventually(async () => (await added()).length > 0, 'the tab has jobs');
  await eventually(async () => (await listed()).every(({ status }) => status === 'successful'), 'all are answered');
  await page.close({ runBeforeUnload: true });
  await eventually(async () => (await added()).length === 0, 'they are removed');
  await page.context().close();
});

test('the path before the last change stays as a shadow, and pinned ones until they are removed', async () => {
  const page = await studio('tunnel_arch');
  await settled(page);
  await page.getByRole('button', { name: 'Pin this run' }).click();
  await slide(page, 'Ground stiffness', 300);
  await settled(page);
  await page.locator('.path-card svg path.pinned').first().waitFor({ state: 'attached' });
  await page.waitForTimeout(600);
  await slide(page, 'Ground stiffness', 600);
  await settled(page);
  await page.locator('.path-card svg path.earlier').first().waitFor({ state: 'attached' });
  await page.getByRole('button', { name: /^Unpin/ }).click();
  assert.equal(await page.locator('.path-card svg path.pinned').count(), 0);
  await close(page);
});

test('a value can be typed, and the path can be walked with the keyboard alone', async () => {
  const page = await studio('tunnel_arch');
  await settled(page);
  const field = page.getByLabel("Ground stiffness, value in K R⁴/EI");
  await field.focus();
  await page.keyboard.type('1e6');
  await page.keyboard.press('Enter');
  await page.locator('.trust-card .headline', { hasText: /^7[0-9]/ }).waitFor();
  await page.waitForTimeout(1000);
  const caption = page.locator('.drawing-card svg .caption');
  await page.locator('.path-card .walkable').focus();
  await page.keyboard.press('Home');
  const first = await caption.textContent();
  const seen = new Set([first]);
  for (let i = 0; i < 8; ++i) {
    await page.keyboard.press('ArrowRight');
    seen.add(await caption.textContent());
  }
  assert.equal(seen.size, 9, 'each key goes on to another state');
  await page.keyboard.press('Home');
  assert.equal(await caption.textContent(), first);
  await close(page);
});

test('every problem of the gallery opens and is drawn', async () => {
  const page = await openPage(browser, service.url);
  await settled(page);
  await page.getByRole('button', { name: 'Gallery' }).click();
  const names = await page.locator('.gallery li strong').allInnerTexts();
  assert.ok(names.length >= 8);
  await page.keyboard.press('Escape');
  for (const name of names) {
    await page.getByRole('button', { name: 'Gallery' }).click();
    await page.locator('.gallery li button', { has: page.getByText(name, { exact: true }) }).click();
    await page.getByRole('heading', { level: 1, name, exact: true }).waitFor();
    await settled(page);
    assert.ok((await page.getByRole('slider').count()) >= 2, name);
    assert.ok((await page.locator('.drawing-card svg path').count()) > 1, name);
    assert.ok((await page.locator('.path-card svg path, .path-card svg line').count()) > 4, name);
    assert.equal(await page.locator('.trouble').count(), 0, name);
    assert.doesNotMatch(await page.locator('.trust-card').innerText(), /not confirmed|NaN|undefined/, name);
  }
  await close(page);
});

test('a structure that is nearly unstable says which load to use, and shows its softest motion', async () => {
  const page = await studio('frame_nearly_unstable');
  await settled(page);
  await page.waitForTimeout(1000);  // the states to walk through come
  const said = page.locator('.path-card').getByRole('status');
  assert.match(await said.innerText(), /^Nearly unstable at load factor 109\.91: use it, not 149\.14, unless displacements of 5\.46\sm are acceptable\./);
  await page.getByRole('button', { name: 'In full' }).click();
  assert.match(await said.innerText(), /^Nearly unstable: at load factor 109\.91 the least stiffness is 0\.0399 of the unloaded structure's/);
  await page.getByRole('button', { name: 'In short' }).click();
  const trust = page.locator('.trust-card');
  assert.match(await trust.locator('.headline').innerText(), /^109\.91\s+nearly unstable$/);
  assert.match(await trust.locator('.hint').first().innerText(), /^load factor to use, stiffness ratio 0\.0399; .* at 149\.14 \(confirmed\), relative error/);
  assert.match(await trust.innerText(), /Load to use\s+109\.91 × 1\skN\/m = 109\.9\skN\/m[^]*Moved at 149\.14\s+5\.46\d\sm, 27 % of the size/);
  assert.equal(await trust.locator('.warning').count(), 0, 'not said twice');
  assert.equal(await page.locator('.drawing-card svg .mode').count(), 0);
  const mark = await page.locator('.path-card svg .softest-mark .softest').boundingBox();
  await page.mouse.click(mark.x + mark.width / 2, mark.y + mark.height / 2);
  await page.locator('.drawing-card svg .mode').first().waitFor({ state: 'attached' });
  assert.match(await page.locator('.drawing-card svg .caption').textContent(), /109\.9/);
  await page.getByRole('button', { name: 'Hide the motion' }).click();
  assert.equal(await page.locator('.drawing-card svg .mode').count(), 0);
  await close(page);
});

test('the stiffness ratio is shown where it matters, and on request', async () => {
  const page = await studio('frame_nearly_unstable');
  await settled(page);
  const lines = page.locator('.path-card svg .plot-lines .ratio-line');
  const toggle = page.getByRole('button', { name: 'Stiffness', exact: true });
  assert.deepEqual([await lines.count(), await toggle.getAttribute('aria-pressed')], [1, 'true']);
  await toggle.click();
  assert.equal(await lines.count(), 0);
  await page.goto(`${service.url}/#/studio?problem=arch_no_base`);
  await page.reload();
  await settled(page);
  assert.deepEqual([await lines.count(), await toggle.getAttribute('aria-pressed')], [0, 'false']);
  await toggle.click();
  assert.equal(await lines.count(), 1);
  const { bytes } = await downloaded(page, async () => {
    await page.locator('.path-card summary').click();
    await page.getByRole('button', { name: 'CSV' }).click();
  });
  assert.match(bytes.toString().split('\r\n')[0], /negative eigenvalues,stiffness ratio$/);
  await close(page);
});

test('a bifurcation shows its mode and leads along its branch', async () => {
  const page = await studio('arch_no_base');
  await settled(page);
  const mark = page.locator('.path-card svg .mark.bifurcation').first();
  const box = await mark.boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await page.locator('.note', { hasText: 'bifurcation at 66.263' }).waitFor();
  await page.locator('.drawing-card svg path.mode').waitFor({ state: 'attached' });
  await page.getByRole('button', { name: 'Follow its branches' }).click();
  await page.locator('.path-card svg path.branch').first().waitFor({ state: 'attached' });
  await close(page);
});

test('pictures, tables, request and result can be taken away', async () => {
  const page = await studio();
  await settled(page);
  const blank = await page.context().newPage();  // its documents have no content security policy
  const take = (card, text) => downloaded(page, async () => {
    await page.locator(`${card} summary`, { hasText: 'Export' }).click();
    await page.locator(`${card} .menu-items button`, { hasText: text }).click();
  });
  for (const card of ['.drawing-card', '.path-card', '.sections-card']) {
    const svg = (await take(card, 'SVG')).bytes.toString();
    const sound = await blank.evaluate((text) => {
      const root = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
      return root.tagName === 'svg' && root.querySelector('style') !== null && root.querySelectorAll('path').length > 1;
    }, svg);
    assert.ok(sound, card);
    const png = (await take(card, 'PNG')).bytes;
    assert.equal(png.subarray(1, 4).toString(), 'PNG');
    assert.ok(png.length > 5000);
  }
  const csv = (await take('.path-card', 'CSV')).bytes.toString().trim().split('\r\n');
  assert.match(csv[0], /^branch,load factor,arc length,/);
  assert.ok(csv.length > 24);  // so many points the page asks for, and a header
  const request = JSON.parse((await downloaded(page, () => page.getByRole('button', { name: 'Request' }).click())).bytes);
  const { examples } = await (await fetch(`${service.url}/v1/examples`)).json();
  assert.deepEqual(request, examples.find((one) => one.name === 'buried_pipe').request);
  const result = JSON.parse((await downloaded(page, () => page.getByRole('button', { name: 'Result' }).click())).bytes);
  assert.ok(Math.abs(result.summary.critical_load_factor - 8.0986) < 1e-3);
  await close(page);
});

test('each of three mistakes in the JSON is told at its place, and a right text is solved', async () => {
  const page = await openPage(browser, `${service.url}/#/model`);
  await settled(page);
  const editor = page.locator('.cm-content');
  await editor.waitFor();
  const text = JSON.stringify({
    model: {
      nodes: [{ id: 'a', x: 0, y: 0 }, { id: 'b', x: 1, y: 0 }],
      sections: [{ id: 's', EA: 1e6, EI: -1 }],
      members: [{ id: 'm', start: 'a', end: 'c', section: 's', curv: 1 }],
      supports: [{ node: 'a', fixed: ['x', 'y'] }, { node: 'b', fixed: ['y'] }],
      loads: [{ type: 'point', at: { node: 'b' }, force: [-1, 0] }],
    },
    analysis: { type: 'buckling' },
  });
  const write = async (value) => {
    await editor.click();
    await page.keyboard.press('Control+a');
    await page.keyboard.insertText(value);
  };
  await write(text);
  await page.locator('.json .findings li').nth(2).waitFor();
  const findings = await page.locator('.json .findings').innerText();
  for (const pointer of ['/model/sections/0/EI', '/model/members/0/end', '/model/members/0/curv']) {
    assert.ok(findings.includes(pointer), pointer);
  }
  assert.ok((await page.locator('.cm-lintRange-error').count()) >= 3, 'each is marked in the text');
  await write(text.replace('-1}', '1}').replace('"c"', '"b"').replace(',"curv":1', ''));
  await page.locator('.trust-card .headline', { hasText: '9.8696' }).waitFor();  // pi^2 EI / L^2
  await close(page);
});

test('a vibration analysis has its frequencies in a chart and a table, and draws the motion that is chosen', async () => {
  const page = await openPage(browser, `${service.url}/#/model`, { reducedMotion: 'reduce' });
  await settled(page);
  const editor = page.locator('.cm-content');
  await editor.click();
  await page.keyboard.press('Control+a');
  await page.keyboard.insertText(await readFile(new URL('../clients/requests/vibration.json', import.meta.url), 'utf8'));
  const card = page.locator('.vibration-card');
  await card.locator('.motions tbody tr').nth(1).waitFor();
  assert.equal(await page.locator('.trust-card .headline strong').innerText(), '3.516');  // 1.8751^2
  const drawn = () => page.locator('.drawing-card .mode').first().getAttribute('d');
  const first = await drawn();
  await card.getByRole('button', { name: 'Draw motion 2' }).click();
  await page.waitForFunction((d) => document.querySelector('.drawing-card .mode')?.getAttribute('d') !== d, first);
  const second = await drawn();
  const animate = card.getByRole('button', { name: 'Animate' });
  assert.equal(await animate.getAttribute('aria-pressed'), 'false', 'nothing moves where less motion is preferred');
  await animate.press('Enter');
  await page.waitForFunction((d) => document.querySelector('.drawing-card .mode')?.getAttribute('d') !== d, second);
  await animate.press('Enter');
  await page.waitForFunction((d) => document.querySelector('.drawing-card .mode')?.getAttribute('d') === d, second);
  await card.getByRole('combobox').selectOption({ label: '25' });
  await card.locator('.motions td', { hasText: 'flutters' }).nth(1).waitFor();
  await page.getByRole('tab', { name: 'Model' }).click();
  await page.locator('.model-form summary', { hasText: 'Loads' }).click();
  await page.getByLabel('turns with its place').uncheck();
  await card.locator('.motions td', { hasText: 'diverges' }).first().waitFor();  // Euler's load is pi^2 / 4
  await card.getByRole('button', { name: 'Draw motion 1' }).click();
  await card.locator('button:disabled', { hasText: 'Animate' }).waitFor();  // a motion that diverges does not oscillate
  assert.deepEqual(await violations(page), []);
  await close(page);
});

test('a path with frequencies shows them beside it, and its flutter', async () => {
  const page = await openPage(browser, `${service.url}/#/model`, { viewport: { width: 1920, height: 1080 } });
  await settled(page);
  const request = JSON.parse(await readFile(new URL('../clients/requests/vibration.json', import.meta.url), 'utf8'));
  request.analysis = { type: 'path', stop: { load_factor: [0, 30] }, output: { frequencies: 2 } };
  await page.locator('.cm-content').click();
  await page.keyboard.press('Control+a');
  await page.keyboard.insertText(JSON.stringify(request));
  await page.locator('.trust-card .hint', { hasText: 'flutter' }).waitFor();
  await page.locator('.frequency-chart .marks .flutter').waitFor();
  assert.equal(await page.locator('.path-chart .marks .flutter').count(), 1);
  await page.getByRole('button', { name: 'Frequencies' }).click();
  await page.locator('.frequency-chart').waitFor({ state: 'detached' });
  await close(page);
});

test('a document of another title is another problem: the sliders of the one before go', async () => {
  const page = await studio();
  await settled(page);
  await page.getByLabel('Wall thickness, value in mm').waitFor();
  await page.getByRole('tab', { name: 'JSON' }).click();
  await page.locator('.cm-content').click();
  await page.keyboard.press('Control+a');
  await page.keyboard.insertText(JSON.stringify({
    model: {
      title: 'Own column',
      nodes: [{ id: 'a', x: 0, y: 0 }, { id: 'b', x: 1, y: 0 }],
      sections: [{ id: 's', EA: 1e6, EI: 1 }],
      members: [{ id: 'm', start: 'a', end: 'b', section: 's' }],
      supports: [{ node: 'a', fixed: ['x', 'y'] }, { node: 'b', fixed: ['y'] }],
      loads: [{ type: 'point', at: { node: 'b' }, force: [-1, 0] }],
    },
    analysis: { type: 'buckling' },
  }));
  await page.getByRole('heading', { level: 1, name: 'Own column' }).waitFor();
  assert.equal(await page.getByLabel('Wall thickness, value in mm').count(), 0);
  await close(page);
});

test('a mistake that the form makes is told at its field', async () => {
  const page = await studio();
  await settled(page);
  await page.locator('.model-form summary', { hasText: 'Sections' }).click();
  const field = page.locator('[id="field/model/sections/0/EI"]');
  await field.fill('-2');
  await field.press('Enter');
  await page.locator('.model-form .wrong', { hasText: 'EI must be positive' }).waitFor();
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  await close(page);
});

test('while the model has a mistake, the answer before is not passed off as its own', async () => {
  const page = await studio('tunnel_arch');
  await settled(page);
  await page.locator('.model-form summary', { hasText: 'Sections' }).click();
  await page.getByLabel('EI', { exact: true }).fill('-1');
  await page.keyboard.press('Enter');
  await page.locator('.trust-card .headline', { hasText: 'of an earlier model' }).waitFor();
  for (const name of ['Request', 'Result', 'Copy curl', 'Share', 'Pin this run']) {
    assert.equal(await page.getByRole('button', { name, exact: true }).isDisabled(), true, name);
  }
  await page.getByLabel('EI', { exact: true }).fill('1.4');
  await page.keyboard.press('Enter');
  await page.locator('.trust-card .headline', { hasText: /^93\.12\s*confirmed$/ }).waitFor();
  await close(page);
});

test('while an answer lets wait for itself, what is shown is said to be of an earlier model', async () => {
  const page = await studio('tunnel_arch');
  await settled(page);
  const headline = page.locator('.trust-card .headline');
  const before = await headline.innerText();
  await page.waitForTimeout(600);  // states to walk through were asked for
  let release = () => undefined;
  const slow = new Promise((resolve) => (release = resolve));
  await page.route('**/v1/jobs', async (route) => {
    await slow;
    await route.continue();
  });
  await slide(page, 'Ground stiffness', 300);
  await headline.filter({ hasText: 'of an earlier model' }).waitFor();
  assert.equal(await page.locator('.trust-card .badge.good').count(), 0, 'nothing green');
  assert.equal(await page.getByRole('button', { name: 'Pin this run' }).isDisabled(), true);
  release();
  await settled(page);
  await headline.filter({ hasText: 'confirmed' }).waitFor();
  assert.notEqual(await headline.innerText(), before);
  await close(page);
});

test('a number that may mean two is refused in words, and stays until it is one', async () => {
  const page = await studio('tunnel_arch');
  await settled(page);
  const field = page.getByLabel(/^Ground stiffness, value/);
  const before = await field.inputValue();
  await field.fill('50,000');
  await field.press('Enter');
  await page.getByRole('alert').filter({ hasText: '50,000 may be 50000 or 50.000' }).waitFor();
  assert.equal(await field.inputValue(), '50,000');
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  await field.press('Escape');
  assert.equal(await field.inputValue(), before);
  await close(page);
});

test('a static analysis leads with what its first monitor reads', async () => {
  const request = JSON.parse(await readFile(new URL('../clients/requests/static.json', import.meta.url)));
  request.model.monitors = [{ id: 'middle', at: { member: request.model.members[0].id, fraction: 0.5 }, component: 'y' }];
  request.analysis.output = { states: 'all' };
  const answer = await fetch(`${service.url}/v1/jobs`, {
    method: 'POST', headers: { 'Content-Type': 'application/json', Prefer: 'wait=60' }, body: JSON.stringify(request),
  });
  const { static: table } = await answer.json();
  const page = await openPage(browser, `${service.url}${answer.headers.get('Location').replace('/v1', '/#')}`);
  const card = page.locator('.trust-card');
  await card.locator('h2', { hasText: 'Result' }).waitFor();
  const shown = Number((await card.locator('.headline strong').innerText()).replace('−', '-').split(/\s/)[0]);
  const value = table.monitors.middle.at(-1);
  assert.ok(Math.abs(shown - value) <= 1e-3 * Math.abs(value), `${shown} for ${value}`);
  assert.match(await card.locator('.hint').first().innerText(), /^middle at load factor .*, no loss of stability on this path$/);
  await close(page);
});

test('what a tab works on outlives its reloading', async () => {
  const page = await studio('tunnel_arch');
  await settled(page);
  await slide(page, 'Ground stiffness', 300);
  await settled(page);
  await page.waitForTimeout(1000);
  const headline = page.locator('.trust-card .headline');
  const before = await headline.innerText();
  assert.doesNotMatch(before, /^93\.12/);
  await page.reload();
  await settled(page);
  assert.equal(await headline.innerText(), before);
  assert.equal(await page.getByRole('heading', { level: 1 }).innerText(), 'Tunnel arch in the ground');
  await page.getByRole('button', { name: 'Gallery' }).click();
  await page.locator('.gallery li', { hasText: 'Tunnel arch in the ground' }).locator('button').click();
  await page.locator('.trust-card .headline', { hasText: '93.12' }).waitFor();
  await close(page);
});

test('any number of the model can be given a slider', async () => {
  const page = await studio('arch_no_base');
  await settled(page);
  const before = await page.getByRole('slider').count();
  await page.locator('.model-form summary', { hasText: 'Loads' }).click();
  await page.getByRole('button', { name: 'Give force y a slider' }).click();
  assert.equal(await page.getByRole('slider').count(), before + 1);
  await close(page);
});

test('the curve of a law is beside its fields, follows them, and has a table', async () => {
  const page = await studio('pile_in_soil');
  await settled(page);
  await page.locator('.model-form summary', { hasText: 'Foundations' }).click();
  const law = page.getByRole('region', { name: 'Law of clay', exact: true });
  const named = (text) => law.getByRole('img', { name: `Law of clay: tanh; reaction p (kN/m) against displacement w (m), up to ${text}` });
  await named('13.63').waitFor();  // 14.4 tanh 1.8 at the tip
  assert.equal(await law.locator('svg path.series-line').count(), 3);
  const drawn = () => law.locator('svg path.series-line').evaluateAll((paths) => paths.map((path) => path.getAttribute('d')).join());
  const before = await drawn();
  const field = page.locator('[id="field/model/foundations/0/law/capacity/along/0/1"]');
  await field.fill('7.2');
  await field.press('Enter');
  await named('7.189').waitFor();
  assert.notEqual(await drawn(), before);
  await field.fill('-1');
  await field.press('Enter');
  await page.locator('.model-form .wrong').first().waitFor();
  assert.equal(await law.count(), 0, 'no curve of a law that is wrong');
  await field.fill('14.4');
  await field.press('Enter');
  await page.locator('.trust-card .headline', { hasText: /^1\.361\s*confirmed$/ }).waitFor();
  assert.equal(await law.count(), 1, 'the fields that were put right stay open');
  await law.locator('summary').focus();
  await page.keyboard.press('Enter');
  await law.getByRole('button', { name: 'Show as table' }).press('Enter');
  await law.locator('table').waitFor();
  assert.deepEqual(await law.locator('th').allTextContents(), [
    'displacement w (m)', 'reaction p (kN/m) at 0\u00a0L', 'reaction p (kN/m) at 0.5\u00a0L', 'reaction p (kN/m) at 1\u00a0L']);
  assert.ok((await law.locator('tbody tr').count()) > 10);
  await close(page);
});

test('supports without a law have no curve', async () => {
  const page = await studio();
  await settled(page);
  await page.locator('.model-form summary', { hasText: 'Foundations' }).click();
  await page.locator('[id="field/model/foundations/0/stiffness"]').waitFor();
  assert.equal(await page.locator('.law-figure').count(), 0);
  await close(page);
});

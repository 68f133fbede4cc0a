// The page with the keyboard alone; axe-core where something is wrong or is asked for (access.test.mjs has the plain views); a
// title that would be a script; the security policy.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { violations } from './support/axe.mjs';
import { downloaded, drawnPath, openPage, settled, slide } from './support/browser.mjs';
import { startService } from './support/service.mjs';
import { browser, close, example, service } from './support/stage.mjs';

const kHostile = '<script>alert(1)</script>';

async function post(path, body) {
  const answer = await fetch(service.url + path, {
    method: 'POST', headers: { 'Content-Type': 'application/json', Prefer: 'wait=20, return=minimal' }, body: JSON.stringify(body),
  });
  return answer.headers.get('Location').split('/').pop();
}

async function failingJob() {
  const request = await example('tunnel_arch');
  request.analysis = { type: 'static', load_factors: [20, 60, 200] };
  return post('/v1/jobs', request);
}

async function hostileSweep() {
  const request = await example('tunnel_arch');
  request.model.title = kHostile;
  return post('/v1/sweeps', {
    ...request, analysis: { type: 'critical' }, design: 'grid', outputs: ['/summary/critical_load_factor'],
    parameters: [{ name: kHostile, targets: [{ pointer: '/model/foundations/0/stiffness' }], range: { from: 0.01, to: 1, count: 4 } }],
  });
}

/** The focused element: its role or tag, its name, and whether its focus is seen. */
function focused(page) {
  return page.evaluate(() => {
    const one = document.activeElement;
    const style = getComputedStyle(one);
    const label = one.getAttribute('aria-label') ?? one.labels?.[0]?.textContent ?? one.textContent ?? '';
    return {
      tag: one.tagName.toLowerCase(), name: label.trim(), body: one === document.body,
      seen: style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2,
    };
  });
}

/** Presses Tab until an element of this name has the focus. */
async function tabTo(page, name, most = 80) {
  for (let i = 0; i < most; ++i) {
    await page.keyboard.press('Tab');
    if ((await focused(page)).name.startsWith(name)) {
      return;
    }
  }
  assert.fail(`"${name}" is not reached by Tab`);
}

test('every stop of the Tab key has a name and a focus that is seen, in the order of the page', async () => {
  const page = await openPage(browser, `${service.url}/#/studio?problem=buried_pipe`);
  await settled(page);
  const stops = [];
  for (let i = 0; i < 80; ++i) {
    await page.keyboard.press('Tab');
    const stop = await focused(page);
    if (stop.body || (i > 0 && stop.name === stops[0].name)) {
      break;
    }
    assert.notEqual(stop.name, '', `stop ${i}, a ${stop.tag}`);
    assert.ok(stop.seen, `the focus of "${stop.name}" is not seen`);
    stops.push(stop);
  }
  const names = stops.map((stop) => stop.name);
  const order = ['Skip to the content', 'snapthrough', 'Studio', 'Gallery', 'Soil stiffness, value in kN/m²', 'Soil stiffness',
                 'Model', 'Pin this run', 'Drawing.', 'Equilibrium path.', 'Copy curl'];
  let last = -1;
  for (const name of order) {
    const place = names.findIndex((one, i) => i > last && one.startsWith(name));
    assert.ok(place > last, `${name} comes after ${names[last] ?? 'the start'}: ${names.join(' | ')}`);
    last = place;
  }
  await close(page);
});

test('the keyboard alone skips to the content, moves a slider, walks the path and zooms the drawing', async () => {
  const page = await openPage(browser, `${service.url}/#/studio?problem=tunnel_arch`);
  await settled(page);
  await page.waitForTimeout(1000);
  await page.keyboard.press('Tab');
  await page.keyboard.press('Enter');
  assert.ok(await page.evaluate(() => document.querySelector('main').contains(document.activeElement)), 'skipped into main');
  await page.getByRole('slider').first().focus();
  const start = await drawnPath(page);
  const text = await page.getByRole('slider').first().getAttribute('aria-valuetext');
  await page.keyboard.press('PageUp');
  await page.waitForFunction((old) =>
    [...document.querySelectorAll('.path-card svg path.path')].map((path) => path.getAttribute('d')).join() !== old, start);
  assert.notEqual(await page.getByRole('slider').first().getAttribute('aria-valuetext'), text, 'the value is told');
  await settled(page);
  await page.waitForTimeout(1000);
  await tabTo(page, 'Drawing.');
  const member = page.locator('.drawing-card svg path.member').first();
  const width = (await member.boundingBox()).width;
  await page.keyboard.press('+');
  assert.ok((await member.boundingBox()).width > 1.1 * width);
  await page.keyboard.press('0');
  assert.ok(Math.abs((await member.boundingBox()).width - width) < 2);
  await tabTo(page, 'Equilibrium path.');
  const caption = page.locator('.drawing-card svg .caption');
  await page.keyboard.press('Home');
  const first = await caption.textContent();
  await page.keyboard.press('ArrowRight');
  assert.notEqual(await caption.textContent(), first);
  await close(page);
});

test('the keyboard alone opens a problem, closes the gallery, and takes a table', async () => {
  const page = await openPage(browser, `${service.url}/#/studio?problem=buried_pipe`);
  await settled(page);
  await tabTo(page, 'Gallery');
  await page.keyboard.press('Enter');
  await page.getByRole('dialog', { name: 'Gallery' }).waitFor();
  for (let i = 0; i < 15; ++i) {
    await page.keyboard.press('Tab');
    assert.ok(await page.evaluate(() => document.activeElement === document.body || document.activeElement.closest('dialog') !== null),
              'the focus stays in the dialog');
  }
  await page.keyboard.press('Escape');
  await page.getByRole('dialog', { name: 'Gallery' }).waitFor({ state: 'hidden' });
  assert.equal((await focused(page)).name, 'Gallery', 'the focus is back where it was');
  await page.keyboard.press('Enter');
  await tabTo(page, 'Tunnel arch in the ground');
  await page.keyboard.press('Enter');
  await page.getByRole('heading', { level: 1, name: 'Tunnel arch in the ground' }).waitFor();
  await settled(page);
  await page.locator('.path-card summary').focus();
  await page.keyboard.press('Enter');
  await tabTo(page, 'CSV', 6);
  const { name, bytes } = await downloaded(page, () => page.keyboard.press('Enter'));
  assert.match(name, /\.csv$/);
  assert.match(bytes.toString(), /^branch,load factor/);
  await page.locator('.path-card summary').focus();
  await page.keyboard.press('Enter');
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.path-card .menu').getAttribute('open'), null);
  await close(page);
});

test('the gallery opens again at once after the browser has closed it, before the page is told', async () => {
  const page = await openPage(browser, `${service.url}/#/studio?problem=buried_pipe`);
  await settled(page);
  await page.getByRole('button', { name: 'Gallery' }).click();
  const gallery = page.getByRole('dialog', { name: 'Gallery' });
  await gallery.waitFor();
  await page.evaluate(async () => {
    const told = new Promise((done) => document.querySelector('dialog.gallery').addEventListener('close', done, { once: true }));
    document.querySelector('dialog.gallery').close();
    [...document.querySelectorAll('.controls button')].find((one) => one.textContent === 'Gallery').click();
    await told;
  });
  await page.waitForTimeout(100);
  assert.ok(await gallery.isVisible());
  await gallery.getByRole('button', { name: 'Tunnel arch in the ground' }).click();
  await page.getByRole('heading', { level: 1, name: 'Tunnel arch in the ground' }).waitFor();
  await close(page);
});

for (const colorScheme of ['light', 'dark']) {
  test(`no violation where something is wrong or asked for (${colorScheme})`, async () => {
    const page = await openPage(browser, service.url, { colorScheme });
    await settled(page);
    const right = async (what) => assert.deepEqual(await violations(page), [], what);
    await page.getByRole('button', { name: 'Pin this run' }).click();
    await slide(page, 'Soil stiffness', 800);
    await settled(page);
    await right('a pinned run');
    await page.locator('.model-form summary', { hasText: 'Sections' }).click();
    const field = page.locator('[id="field/model/sections/0/EI"]');
    await field.fill('-2');
    await field.press('Enter');
    await page.locator('.model-form .wrong').first().waitFor();
    await right('a mistake in the form');
    await page.goto(`${service.url}/#/studio?problem=arch_no_base`);
    await page.getByRole('heading', { level: 1, name: 'Shallow arch, bare' }).waitFor();
    await settled(page);
    const mark = await page.locator('.path-card svg .mark.bifurcation').first().boundingBox();
    await page.mouse.click(mark.x + mark.width / 2, mark.y + mark.height / 2);
    await page.locator('div.note').waitFor();
    await right('the mode of a bifurcation');
    await page.goto(`${service.url}/#/studio?problem=frame_nearly_unstable`);
    await page.getByRole('button', { name: 'Show the motion' }).click();
    await right('a structure that is nearly unstable');
    await page.goto(`${service.url}/#/model`);
    await page.locator('.cm-content').click();
    await page.keyboard.press('Control+a');
    await page.keyboard.insertText('{"model": {"nodes": 3}, "analysis": {}}');
    await page.locator('.json .findings li').first().waitFor();
    await page.waitForTimeout(300);
    await right('mistakes in the JSON');
    await page.goto(`${service.url}/#/jobs/${await failingJob()}`);
    await page.locator('.trouble').waitFor();
    await right('a failed job');
    await page.goto(`${service.url}/#/jobs/none`);
    await page.locator('.trouble').waitFor();
    await right('a job that is not there');
    await close(page);
  });

  test(`no violation beside the curve of a law, nor of its table (${colorScheme})`, async () => {
    const page = await openPage(browser, `${service.url}/#/studio?problem=pile_in_soil`, { colorScheme });
    await settled(page);
    await page.locator('.model-form summary', { hasText: 'Foundations' }).click();
    const law = page.getByRole('region', { name: 'Law of clay', exact: true });
    await law.locator('svg').waitFor();
    assert.deepEqual(await violations(page), [], 'the curve');
    await law.locator('summary').click();
    assert.deepEqual(await violations(page), [], 'its menu');
    await law.getByRole('button', { name: 'Show as table' }).click();
    await law.locator('table').waitFor();
    assert.deepEqual(await violations(page), [], 'its table');
    await close(page);
  });

  test(`no violation while a key is asked for, and when the service is gone (${colorScheme})`, async () => {
    const mortal = await startService();
    const config = join(mortal.folder, 'keys.toml');
    await writeFile(config, `[[keys]]\nowner = "ann"\nsha256 = "${createHash('sha256').update('a key').digest('hex')}"\n`);
    const locked = await startService(['--config', config]);
    const asked = await openPage(browser, locked.url, { colorScheme });
    await asked.getByRole('dialog', { name: 'This service needs a key' }).waitFor();
    assert.deepEqual(await violations(asked), [], 'the key');
    await close(asked);
    await locked.stop();
    const page = await openPage(browser, mortal.url, { colorScheme });
    await settled(page);
    await mortal.stop();
    await slide(page, 'Soil stiffness', 800);
    await page.locator('.gone-banner').waitFor();
    assert.deepEqual(await violations(page), [], 'the service gone');
    await close(page);
  });

  test(`no violation on a phone (${colorScheme})`, async () => {
    const page = await openPage(browser, service.url, { colorScheme, viewport: { width: 390, height: 844 }, hasTouch: true });
    await settled(page);
    assert.deepEqual(await violations(page), [], 'the studio');
    await page.getByRole('button', { name: 'Gallery' }).click();
    assert.deepEqual(await violations(page), [], 'the gallery');
    await close(page);
  });
}

test('a title that is a script stays text in every view and in every file', async () => {
  const request = await example('tunnel_arch');
  request.model.title = kHostile;
  request.model.members[0].id = kHostile;
  request.model.loads[0].at.member = kHostile;
  request.model.foundations[0].member = kHostile;
  request.model.monitors[0] = { ...request.model.monitors[0], id: kHostile, at: { member: kHostile, fraction: 0.5 } };
  const job = await post('/v1/jobs', { label: kHostile, request });
  const sweep = await hostileSweep();
  const page = await openPage(browser, 'about:blank');
  page.on('dialog', (dialog) => {
    page.troubles.push(`a dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  const visit = async (hash, ready) => {
    await page.goto(`${service.url}/${hash}`);
    await page.locator(ready).first().waitFor();
    await page.waitForTimeout(300);
    assert.equal(await page.locator('body script').count(), 0, hash);
    assert.ok((await page.locator('#page').innerText()).includes(kHostile), `${hash} shows the text`);
  };
  await visit('#/jobs', 'tbody tr');
  await visit('#/sweeps', 'tbody tr');
  await visit(`#/sweeps/${sweep}`, '.sweep-chart svg');
  await visit(`#/jobs/${job}`, '.trust-card .headline');
  await visit(`#/studio?job=${job}`, '.trust-card .headline');
  await page.getByRole('button', { name: 'Pin this run' }).click();
  assert.ok((await page.title()).startsWith(kHostile), 'the title of the tab');
  await page.locator('.drawing-card summary').click();
  const svg = (await downloaded(page, () => page.locator('.drawing-card .menu-items button', { hasText: 'SVG' }).click())).bytes.toString();
  assert.ok(!svg.includes('<script'), 'the SVG file');
  assert.ok(svg.includes('&lt;script&gt;'), 'the SVG file has it as text');
  await close(page);
});

test('the security policy trusts nothing that is inline, and the browser finds nothing against it', async () => {
  const address = await fetch(`${service.url}/`);
  const text = await address.text();
  const policy = address.headers.get('Content-Security-Policy');
  assert.match(policy, /default-src 'self'/);
  assert.doesNotMatch(policy, /unsafe-|\*|data:.*script/);
  assert.equal(address.headers.get('X-Content-Type-Options'), 'nosniff');
  assert.doesNotMatch(text, /<script>|<style|\son[a-z]+=|\sstyle=/);
  for (const [, path] of text.matchAll(/(?:src|href)="(\/[^"]+)"/g)) {
    assert.equal((await fetch(service.url + path)).status, 200, path);
  }
});

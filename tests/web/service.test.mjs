// The page and what can become of the service, of jobs and of sweeps.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { drawnPath, eventually, openPage, settled, slide } from './support/browser.mjs';
import { startService } from './support/service.mjs';
import { browser, close, example, service } from './support/stage.mjs';

async function submit(request, prefer = 'wait=20') {
  const answer = await fetch(`${service.url}/v1/jobs`, {
    method: 'POST', headers: { 'Content-Type': 'application/json', Prefer: prefer }, body: JSON.stringify(request),
  });
  return answer.headers.get('Location').split('/').pop();
}

const kHostile = '<script>document.title = "taken"</script><img src=x onerror="document.title=1">';

test('an analysis that fails shows its code and what it reached; a title stays text', async () => {
  const request = await example('tunnel_arch');
  request.model.title = kHostile;
  request.analysis = { type: 'static', load_factors: [20, 60, 200] };
  const page = await openPage(browser, `${service.url}/#/jobs/${await submit(request)}`);
  await page.locator('.trouble', { hasText: 'beyond limit point' }).waitFor();
  assert.ok((await page.locator('.drawing-card svg path.member').count()) > 0, 'what was reached is drawn');
  assert.equal(await page.getByRole('heading', { level: 1 }).innerText(), kHostile);
  assert.doesNotMatch(await page.title(), /taken/);
  assert.equal(await page.locator('main script, main img').count(), 0);
  await close(page);
});

test('jobs are listed live, filtered, opened and deleted', async () => {
  const request = await example('arch_no_base');
  const page = await openPage(browser, `${service.url}/#/jobs`);
  await page.getByRole('heading', { name: 'Jobs' }).waitFor();
  request.model.title = 'a job that comes later';
  await submit(request);
  const row = page.locator('tbody tr', { hasText: 'a job that comes later' });
  await row.waitFor();
  await row.locator('td', { hasText: '66.263' }).waitFor();
  await page.getByLabel('Analysis').selectOption('buckling');
  await row.waitFor({ state: 'detached' });
  await page.getByLabel('Analysis').selectOption('');
  await row.getByRole('link').click();
  await page.locator('.trust-card .headline', { hasText: '66.263' }).waitFor();
  await page.getByRole('button', { name: 'Open in the studio' }).click();
  await page.locator('.tabs').waitFor();
  await page.goto(`${service.url}/#/jobs`);
  await row.nth(1).waitFor();  // the studio asked for it once more
  await row.last().getByRole('button', { name: /^Delete/ }).click();
  await row.nth(1).waitFor({ state: 'detached' });
  await close(page);
});

test('a sweep of static analyses has what the monitors read', async () => {
  const request = JSON.parse(await readFile(new URL('../clients/requests/static.json', import.meta.url)));
  request.model.monitors = [{ id: 'middle', at: { member: request.model.members[0].id, fraction: 0.5 }, component: 'y' }];
  const job = await submit(request);
  const page = await openPage(browser, `${service.url}/#/studio?job=${job}`);
  await page.locator('.trust-card h2', { hasText: 'Result' }).waitFor();
  await page.locator('.model-form summary', { hasText: 'Sections' }).click();
  await page.getByRole('button', { name: 'Give EI a slider' }).click();
  await page.getByRole('tab', { name: 'Sweep' }).click();
  await page.getByLabel('More values where the curve needs them').uncheck();
  await page.getByRole('button', { name: 'Start the sweep' }).click();
  await page.waitForURL(/#\/sweeps\//);
  const sweep = page.url().split('/').at(-1);
  const read = async (path) => (await fetch(`${service.url}/v1/sweeps/${sweep}${path}`)).json();
  await eventually(async () => (await read('')).status === 'successful', 'the sweep ends');
  const { rows, columns } = await read('/table');
  const middle = columns.findIndex((name) => JSON.stringify(name).includes('/static/monitors/middle/'));
  assert.equal(rows.length, 41);
  assert.ok(middle >= 0 && rows.every((row) => row[middle] < 0), JSON.stringify({ columns, row: rows[0] }));
  await close(page);
});

test('a sweep over two sliders becomes a map, and each of its points can be opened', async () => {
  const page = await openPage(browser, `${service.url}/#/studio?problem=tunnel_arch`);
  await settled(page);
  await page.getByRole('tab', { name: 'Sweep' }).click();
  await page.getByRole('button', { name: 'Add a second parameter' }).click();
  for (const field of await page.getByLabel('count').all()) {
    await field.fill('5');
  }
  await page.getByLabel('More values where the curve needs them').uncheck();
  await page.getByRole('button', { name: 'Start the sweep' }).click();
  await page.locator('.badge', { hasText: 'successful' }).waitFor();
  await page.locator('.card-head', { hasText: 'Table of 25 rows' }).waitFor();
  const chart = await page.locator('.sweep-chart .walkable').boundingBox();
  await page.mouse.move(chart.x + chart.width / 2, chart.y + chart.height / 2);
  await page.locator('.note strong').first().waitFor();
  const load = await page.locator('.note span', { hasText: 'critical load factor' }).locator('strong').innerText();
  await page.mouse.click(chart.x + chart.width / 2, chart.y + chart.height / 2);
  await page.locator('.trust-card .headline', { hasText: load }).waitFor();
  await close(page);
});

test('a sweep of the page has more rows where its curve needs them, and its chart names where the kind changes', async () => {
  const page = await openPage(browser, `${service.url}/#/studio?problem=tunnel_arch`);
  await settled(page);
  await page.getByRole('tab', { name: 'Sweep' }).click();
  await page.getByRole('button', { name: 'Start the sweep' }).click();
  await page.locator('.badge', { hasText: 'successful' }).waitFor();
  await page.locator('.sweep-chart svg').first().waitFor();
  const sweep = page.url().split('/').at(-1);
  const read = async (path) => (await fetch(`${service.url}/v1/sweeps/${sweep}${path}`)).json();
  assert.deepEqual((await read('/request')).refine, { output: '/summary/critical_load_factor', within: 0.01 });
  const { rows, columns } = await read('/table');
  assert.deepEqual(columns.slice(-3), ['piece', 'change', 'error']);
  assert.ok(rows.length > 41, String(rows.length));
  await page.locator('.sweep-chart .break-text', { hasText: 'bifurcation to limit point' }).waitFor();
  assert.ok((await page.locator('.sweep-chart .break-mark').count()) >= 1);
  assert.match(await page.locator('.unseen li').first().textContent(), /^Ground stiffness .*: bifurcation to limit point$/);
  assert.deepEqual(await page.getByLabel('Output').locator('option').evaluateAll((all) =>
    all.map((one) => one.value).filter((name) => !name.startsWith('/'))), []);
  await close(page);
});

test('the page says that the service is gone, and goes on when it is back', async () => {
  const mortal = await startService();
  const page = await openPage(browser, `${mortal.url}/#/studio?problem=tunnel_arch`);
  await settled(page);
  await mortal.kill();
  await slide(page, 'Ground stiffness', 200);
  await page.locator('.gone-banner').waitFor();
  const old = await drawnPath(page);
  assert.match(old, /^M/, 'what was drawn stays');
  const reborn = await startService([], { port: mortal.port, folder: mortal.folder });
  await page.locator('.gone-banner').waitFor({ state: 'detached' });
  await settled(page);
  await page.waitForFunction((before) =>
    [...document.querySelectorAll('.path-card svg path.path')].map((path) => path.getAttribute('d')).join() !== before, old);
  await close(page);
  await reborn.stop();
});

test('a service with keys is asked for one, which is kept until the tab is closed', async () => {
  const folder = await mkdtemp(join(tmpdir(), 'snapthrough-keys-'));
  const config = join(folder, 'config.toml');
  const digest = createHash('sha256').update('the right key').digest('hex');
  await writeFile(config, `[[keys]]\nowner = "ann"\nsha256 = "${digest}"\n`);
  const locked = await startService(['--config', config]);
  const page = await openPage(browser, locked.url);
  const give = async (key) => {
    await page.getByRole('textbox', { name: 'Key' }).fill(key);
    await page.getByRole('button', { name: 'Go on' }).click();
  };
  await page.getByRole('dialog', { name: 'This service needs a key' }).waitFor();
  await give('a wrong key');
  await page.locator('.key', { hasText: 'not known here' }).waitFor();
  await give('the right key');
  await settled(page);
  await page.reload();
  await settled(page);
  assert.equal(await page.evaluate(() => localStorage.length), 0);
  await page.getByRole('button', { name: 'Forget key' }).click();
  await page.getByRole('dialog', { name: 'This service needs a key' }).waitFor();
  await close(page);
  await locked.stop();
  await rm(folder, { recursive: true, force: true });
});

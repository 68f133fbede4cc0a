// The page without a service: the folder that scripts/site.sh writes, on a file server below a path.
//   SITE=FOLDER node --test static.test.mjs
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { eventually, openPage, settled, slide, startBrowser } from './support/browser.mjs';

const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json', '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml', '.md': 'text/markdown' };
const site = process.env.SITE;
const missing = [];
let server;
let browser;
let url;

before(async () => {
  server = createServer(async (request, response) => {
    const name = new URL(request.url, 'http://local').pathname.replace(/^\/below\//u, '') || 'index.html';
    const content = await readFile(join(site, name)).catch(() => null);
    if (content === null) missing.push(request.url);
    response.writeHead(content === null ? 404 : 200, { 'Content-Type': kTypes[extname(name)] ?? 'application/octet-stream' }).end(content);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  url = `http://127.0.0.1:${server.address().port}/below/`;
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  server?.closeAllConnections();
  server?.close();
});

async function close(page) {
  assert.deepEqual(page.troubles, []);
  assert.deepEqual(missing, []);
  await page.context().close();
}

const headline = (page) => page.locator('.trust-card .headline strong').innerText();

test('every example is solved in the page', async () => {
  const page = await openPage(browser, url);
  await settled(page);
  const { examples } = JSON.parse(await readFile(join(site, 'v1/examples.json'), 'utf8'));
  assert.ok(examples.length >= 8, `${examples.length} examples`);
  for (const { name } of examples) {
    await page.goto(`${url}#/studio?example=${name}`);
    await settled(page);
    assert.match(await headline(page), /\d/u, name);
  }
  await close(page);
});

test('every problem of practice opens from the gallery and is solved in the page', async () => {
  const page = await openPage(browser, url);
  await settled(page);
  const openGallery = () => page.getByRole('button', { name: 'Gallery' }).click();
  await openGallery();
  const names = await page.locator('.gallery li:has(img) strong').allInnerTexts();
  assert.equal(names.length, 16);
  await page.keyboard.press('Escape');
  for (const name of names) {
    await openGallery();
    await page.locator('.gallery li', { has: page.getByText(name, { exact: true }) }).locator('button').click();
    await page.getByRole('heading', { level: 1, name, exact: true }).waitFor();
    await settled(page);
    assert.match(await headline(page), /\d|none/u, name);
    assert.equal(await page.locator('.trouble').count(), 0, name);
    assert.ok(await page.locator('.drawing-card svg').count() > 0, name);
  }
  await close(page);
});

test('a slider moves the path while it is dragged', async () => {
  const page = await openPage(browser, `${url}#/studio?problem=tunnel_arch`);
  await settled(page);
  const first = await headline(page);
  await slide(page, 'Ground stiffness', 300);
  await page.waitForFunction((old) => document.querySelector('.trust-card .headline strong').textContent !== old, first);
  await settled(page);
  await close(page);
});

test('jobs are listed with their loads, and a sweep is computed by the workers of the page', async () => {
  const page = await openPage(browser, `${url}#/studio?problem=buried_pipe`);
  await settled(page);
  const load = (await headline(page)).replace(/\s/gu, '');
  await page.goto(`${url}#/jobs`);
  await page.getByText(load.slice(0, 5)).first().waitFor();
  const sweep = await readFile(new URL('../clients/sweep_500.json', import.meta.url), 'utf8');
  const found = await page.evaluate(async (body) => {
    const { Solver } = await import(new URL('solver/index.js', document.baseURI).href);
    const { LocalService } = await import(new URL('solver/service.js', document.baseURI).href);
    const service = new LocalService(Solver.create({ workers: 2 }), document.baseURI);
    const made = await (await service.fetch('/v1/sweeps', { method: 'POST', body })).json();
    const events = await (await service.fetch(`/v1/sweeps/${made.id}/events`)).text();
    const table = await (await service.fetch(`/v1/sweeps/${made.id}/table`)).json();
    const point = await (await service.fetch(`/v1/sweeps/${made.id}/points/7/request`)).json();
    return { end: events.includes('event: end'), rows: table.rows.length, point: typeof point.model };
  }, sweep);
  assert.deepEqual(found, { end: true, rows: 500, point: 'object' });
  const [right, failing] = await Promise.all(['arch', 'failing'].map((name) => readFile(new URL(`../clients/requests/${name}.json`, import.meta.url), 'utf8')));
  const waited = await page.evaluate(async ([body, other]) => {
    const { Solver } = await import(new URL('solver/index.js', document.baseURI).href);
    const { LocalService } = await import(new URL('solver/service.js', document.baseURI).href);
    const service = new LocalService(Solver.create({ workers: 1 }), document.baseURI);
    const post = (text, Prefer) => service.fetch('/v1/jobs', { method: 'POST', body: text, headers: { Prefer } });
    const { id, status } = await (await post(body, 'return=minimal')).json();
    const ended = await (await service.fetch(`/v1/jobs/${id}`, { headers: { Prefer: 'wait=60' } })).json();
    const failed = await post(other, 'wait=60');
    const reached = await failed.json();
    return { status, ended: ended.status, code: failed.status, named: failed.headers.get('Location').startsWith('/v1/jobs/'), reached: typeof reached.reached };
  }, [right, failing]);
  assert.deepEqual(waited, { status: 'running', ended: 'successful', code: 422, named: true, reached: 'object' });
  await close(page);
});

test('documents are read, pictures included', async () => {
  const page = await openPage(browser, `${url}#/docs/theory`);
  await page.getByRole('heading', { name: 'Theory', exact: true }).waitFor();
  await page.waitForFunction(() => document.images.length > 0);
  const answers = await page.evaluate(() => Promise.all([...document.images].map(async (image) => (await fetch(image.src)).ok)));
  assert.ok(answers.every(Boolean), `${answers}`);
  await page.goto(`${url}#/docs/interface`);
  await page.getByText('/v1/check').first().waitFor();
  await close(page);
});

test('once loaded it works without a network', async () => {
  const page = await openPage(browser, `${url}#/studio?problem=tunnel_arch`);
  await settled(page);
  await eventually(() => page.evaluate(async () => (await navigator.serviceWorker.getRegistration())?.active?.state === 'activated'), 'kept');
  await page.context().setOffline(true);
  await page.reload();
  await settled(page);
  assert.match(await headline(page), /\d/u);
  await page.context().setOffline(false);
  await close(page);
});

// Each view by axe-core, light and dark; and what the page's own source must not have.
import assert from 'node:assert/strict';
import { readdir, readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { violations } from './support/axe.mjs';
import { openPage, settled } from './support/browser.mjs';
import { browser, example, service } from './support/stage.mjs';

async function aJob() {
  const request = await example('tunnel_arch');
  const post = (path, body) => fetch(service.url + path, {
    method: 'POST', headers: { 'Content-Type': 'application/json', Prefer: 'wait=20' }, body: JSON.stringify(body),
  });
  const job = (await post('/v1/jobs', request)).headers.get('Location').split('/').pop();
  const sweep = (await post('/v1/sweeps', {
    ...request, analysis: { type: 'critical' }, design: 'grid', outputs: ['/summary/critical_load_factor'],
    parameters: [{ name: 'k', targets: [{ pointer: '/model/foundations/0/stiffness' }], range: { from: 0.01, to: 1, count: 5 } }],
  })).headers.get('Location').split('/').pop();
  return { job, sweep };
}

for (const colorScheme of ['light', 'dark']) {
  test(`no view has a violation (${colorScheme})`, async () => {
    const { job, sweep } = await aJob();
    const page = await openPage(browser, service.url, { colorScheme });
    await settled(page);
    const visit = async (hash, ready) => {
      await page.goto(`${service.url}/${hash}`);
      await page.locator(ready).first().waitFor();
      await page.waitForTimeout(400);
      assert.deepEqual(await violations(page), [], hash);
    };
    await visit('#/studio?problem=tunnel_arch', '.trust-card .headline');
    await page.locator('.model-form summary').nth(1).click();
    assert.deepEqual(await violations(page), [], 'an open form');
    await page.locator('.path-card summary').click();
    await page.getByRole('button', { name: 'Show as table' }).click();
    assert.deepEqual(await violations(page), [], 'a table twin');
    await visit('#/model', '.cm-content');
    await page.getByRole('tab', { name: 'Sweep' }).click();
    assert.deepEqual(await violations(page), [], 'the sweep builder');
    await page.getByRole('button', { name: 'Gallery' }).click();
    assert.deepEqual(await violations(page), [], 'the gallery');
    await page.keyboard.press('Escape');
    await visit('#/jobs', 'tbody tr');
    await visit(`#/jobs/${job}`, '.trust-card .headline');
    await visit('#/sweeps', 'tbody tr');
    await visit(`#/sweeps/${sweep}`, '.sweep-chart svg');
    await visit('#/docs', '.contents dt');
    await visit('#/docs/requests', '.document h1');
    await visit('#/docs/theory', '.document h1');
    await visit('#/nowhere', 'h1');
    await page.context().close();
  });
}

test('nothing of the page scrolls sideways on a phone', async () => {
  const page = await openPage(browser, service.url, { viewport: { width: 390, height: 844 }, hasTouch: true });
  for (const hash of ['#/studio', '#/model', '#/jobs', '#/sweeps', '#/docs', '#/docs/requests']) {
    await page.goto(`${service.url}/${hash}`);
    await page.waitForTimeout(700);
    const { wide, room } = await page.evaluate(() => ({ wide: document.documentElement.scrollWidth, room: innerWidth }));
    assert.ok(wide <= room, `${hash} is ${wide} px wide`);
  }
  await page.context().close();
});

test('the source writes no markup from text, evaluates nothing and has no styles inside', async () => {
  const root = new URL('../../web/src/', import.meta.url);
  const files = (await readdir(root, { recursive: true })).filter((name) => /\.tsx?$/.test(name));
  assert.ok(files.length > 30);
  for (const name of files) {
    const text = await readFile(new URL(name, root), 'utf8');
    assert.doesNotMatch(text, /innerHTML|outerHTML|insertAdjacentHTML|\beval\(|new Function|document\.write|\bstyle=/, name);
  }
});

// The page where things are not as usual: no network, a result of many members, paper.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { downloaded, drawnPath, openPage, settled, slide } from './support/browser.mjs';
import { browser, close, service } from './support/stage.mjs';

test('without a network what was drawn stays and can be taken away, and the page goes on by itself', async () => {
  const page = await openPage(browser, `${service.url}/#/studio?problem=tunnel_arch`);
  await settled(page);
  const headline = page.locator('.trust-card .headline strong');
  const before = await headline.innerText();
  await page.context().setOffline(true);
  await slide(page, 'Ground stiffness', 300);
  await page.locator('.gone-banner').waitFor();
  assert.equal(await headline.innerText(), before);
  assert.match(await drawnPath(page), /^M/);
  await page.locator('.path-card summary').click();
  const { bytes } = await downloaded(page, () => page.locator('.path-card').getByRole('button', { name: 'SVG' }).click());
  assert.ok(/^<\?xml[\s\S]*<path class="path stable"[\s\S]*<\/svg>\s*$/.test(bytes.toString()));
  await page.context().setOffline(false);
  await page.locator('.gone-banner').waitFor({ state: 'detached' });
  await settled(page);
  await page.waitForFunction((old) => document.querySelector('.trust-card .headline strong').textContent !== old, before);
  await close(page);
});

/** A frame of `storeys` and three bays, loaded at its top: 7 members a storey. */
function tallFrame(storeys) {
  const nodes = [];
  const members = [];
  for (let floor = 0; floor <= storeys; ++floor) {
    for (let line = 0; line < 4; ++line) {
      nodes.push({ id: `n${floor}-${line}`, x: 5 * line, y: 3.5 * floor });
      if (floor > 0) members.push({ id: `c${floor}-${line}`, start: `n${floor - 1}-${line}`, end: `n${floor}-${line}`, section: 's' });
      if (floor > 0 && line > 0) members.push({ id: `b${floor}-${line}`, start: `n${floor}-${line - 1}`, end: `n${floor}-${line}`, section: 's' });
    }
  }
  return {
    model: {
      title: 'tall frame', units: { length: 'm', force: 'kN' }, nodes, members, sections: [{ id: 's', EA: 2e6, EI: 2e4 }],
      supports: [0, 1, 2, 3].map((line) => ({ node: `n0-${line}`, fixed: ['x', 'y', 'rotation'] })),
      loads: [0, 1, 2, 3].map((line) => ({ type: 'point', at: { node: `n${storeys}-${line}` }, force: [0.01, -1] })),
      monitors: [{ id: 'top', at: { node: `n${storeys}-0` }, component: 'x' }],
    },
    analysis: { type: 'path', stop: { limit_points: 1 }, output: { states: 'all', points_per_member: 9 } },
  };
}

test('a result of 105 members is drawn whole, walked along, and read member by member', async () => {
  const request = tallFrame(15);
  const answer = await fetch(`${service.url}/v1/jobs`, {
    method: 'POST', headers: { 'Content-Type': 'application/json', Prefer: 'wait=60, return=minimal' }, body: JSON.stringify(request),
  });
  assert.equal(answer.status, 201, await answer.clone().text());
  const page = await openPage(browser, `${service.url}${answer.headers.get('Location').replace('/v1', '/#')}`);
  await page.locator('.trust-card .headline').waitFor();
  assert.equal(request.model.members.length, 105);
  await page.waitForFunction((count) => document.querySelectorAll('.drawing-card svg path.member').length >= count, 105);
  const shape = () => page.locator('.drawing-card svg path.member').evaluateAll((paths) => paths.map((path) => path.getAttribute('d')).join());
  const before = await shape();
  const chart = page.locator('.path-card .walkable');
  await chart.focus();
  for (let i = 0; i < 5; ++i) await page.keyboard.press('ArrowLeft');
  assert.notEqual(await shape(), before, 'the drawing follows the state');
  const box = await page.locator('.drawing-card svg path.member').last().boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.locator('.drawing-card .told').waitFor();
  await close(page);
});

test('on paper there are the pictures and the figures, and nothing to press', async () => {
  const page = await openPage(browser, `${service.url}/#/studio?problem=buried_pipe`);
  await settled(page);
  await page.emulateMedia({ media: 'print' });
  for (const part of ['.top nav', '.tabs', '.buttons', '.tools']) {
    assert.equal(await page.locator(part).first().isVisible(), false, part);
  }
  for (const part of ['h1', '.drawing-card svg', '.path-card svg', '.sections-card svg', '.trust-card .headline']) {
    assert.equal(await page.locator(part).first().isVisible(), true, part);
  }
  const paper = await page.pdf({ format: 'A4' });
  const pages = paper.toString('latin1').match(/\/Type\s*\/Page[^s]/g).length;
  assert.ok(pages >= 1 && pages <= 3, `${pages} pages`);
  await close(page);
});

// The JavaScript client in a page of another origin, which the service allows or does not.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { after, before, test } from 'node:test';
import { openPage, startBrowser } from './support/browser.mjs';
import { exampleOf, startService } from './support/service.mjs';

const kClient = new URL('../../clients/js/dist/', import.meta.url);
const kPage = '<!doctype html><title>elsewhere</title><p id="place">a page of another origin</p>';

let browser;
let site;
let origin;
before(async () => {
  browser = await startBrowser();
  site = createServer(async ({ url }, response) => {
    const module = url.match(/^\/client\/(\w+\.js)$/);
    response.setHeader('Content-Type', module ? 'text/javascript' : 'text/html');
    response.end(module ? await readFile(new URL(module[1], kClient)) : kPage);
  });
  await new Promise((resolve) => { site.listen(0, '127.0.0.1', resolve); });
  origin = `http://127.0.0.1:${site.address().port}`;
});
after(async () => {
  await browser.close();
  site.close();
});

/** What the client makes of a request in a page of the other origin. */
async function solveElsewhere(service, request) {
  const page = await openPage(browser, origin);
  const answer = await page.evaluate(async ({ url, asked }) => {
    const { Client, isAbort, Unreachable } = await import('/client/index.js');
    const warnings = [];
    const client = new Client({ url, onWarning: ({ code }) => warnings.push(code) });
    try {
      const control = new AbortController();
      let points = 0;
      const { result } = await client.solve(asked, { fresh: true, signal: control.signal, onCriticalPoint: () => { points += 1; } });
      const long = { ...asked, analysis: { type: 'path', stop: { steps: 1e7 }, step: { max: 1e-6 } } };
      const aborted = await client.solve(long, { signal: control.signal, onProgress: () => control.abort() }).catch(isAbort);
      return { load: result.summary.critical_load_factor, points, aborted, warnings };
    } catch (error) {
      return { unreachable: error instanceof Unreachable, message: error.message };
    }
  }, { url: service.url, asked: request });
  await page.context().close();
  return answer;
}

test('an origin that is allowed can solve, follow and abort', async () => {
  const service = await startService(['--allowed-origins', origin]);
  try {
    const request = await exampleOf(service.url, 'arch_no_base');
    const { load, points, aborted, ...rest } = await solveElsewhere(service, request);
    assert.ok(Math.abs(load) > 0, JSON.stringify(rest));
    assert.ok(points > 0);
    assert.equal(aborted, true);
  } finally {
    await service.stop();
  }
});

test('another origin gets no answer', async () => {
  const service = await startService();
  try {
    const request = await exampleOf(service.url, 'arch_no_base');
    assert.deepEqual(await solveElsewhere(service, request), { unreachable: true, message: 'The service does not answer.' });
  } finally {
    await service.stop();
  }
});

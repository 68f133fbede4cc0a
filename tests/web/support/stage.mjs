// What a file of tests plays on: a service and a browser of its own. Node runs each file in a process of its own.
import assert from 'node:assert/strict';
import { after, before } from 'node:test';
import { startBrowser } from './browser.mjs';
import { exampleOf, startService } from './service.mjs';

export let service;
export let browser;

before(async () => {
  service = await startService();
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

/** Closes a page on which nothing must have happened that must not. */
export async function close(page) {
  assert.deepEqual(page.troubles, []);
  await page.context().close();
}

/** The request of an example. */
export function example(name) {
  return exampleOf(service.url, name);
}

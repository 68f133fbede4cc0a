// Chromium of the system, driven by playwright-core.
import { existsSync } from 'node:fs';
import { chromium } from 'playwright-core';

const kPlaces = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];

export async function startBrowser() {
  const executablePath = kPlaces.find((path) => path && existsSync(path));
  if (!executablePath) {
    throw new Error('no Chromium: apt-get install chromium, or name it in CHROMIUM');
  }
  return chromium.launch({ executablePath, args: ['--no-sandbox'] });
}

/**
 * A page of its own context. `page.troubles` collects what must not happen: exceptions, and everything the content security
 * policy refused.
 */
export async function openPage(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(100_000);
  page.troubles = [];
  page.on('pageerror', (error) => page.troubles.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error' && /Content Security Policy/.test(message.text())) {
      page.troubles.push(message.text());
    }
  });
  await page.goto(url);
  return page;
}

/** Waits until a condition, which may be asynchronous, holds; fails after the time that a busy machine may need. */
export async function eventually(condition, told) {
  const end = Date.now() + 100_000;
  while (!await condition()) {
    if (Date.now() > end) {
      throw new Error(`does not become so: ${told}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Waits until the studio has an answer and nothing is asked for. */
export async function settled(page) {
  await page.locator('.trust-card .headline').waitFor();
  await page.locator('.dot.there').waitFor();
}

/**
 * Watches what a page hands in. The function that it gives tells whether the last request was the one for states to walk
 * through, which ends a series of changes, and whether the page knows its job: it has asked for it, or removed it.
 */
export function watchWalking(page) {
  let last = null;
  const known = new Set();
  page.on('request', (request) => {
    const { pathname } = new URL(request.url());
    if (request.method() === 'POST' && pathname === '/v1/jobs') last = request;
    else known.add(pathname);
  });
  return async () => {
    const asked = last;
    if ((await asked?.headerValue('prefer')) !== 'return=minimal') return false;  // others wait for their result
    const response = await asked.response();
    return asked === last && known.has(await response?.headerValue('location'));
  };
}

/** The path that is drawn, as text: changes when another one is drawn. */
export function drawnPath(page) {
  return page.locator('.path-card svg path.path').evaluateAll((paths) => paths.map((path) => path.getAttribute('d')).join());
}

/** Moves a range input over places of its way, as dragging does. */
export async function slide(page, name, ...places) {
  await page.getByRole('slider', { name }).evaluate((input, values) => {
    const set = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set;
    for (const value of values) {
      set.call(input, String(value));
      input.dispatchEvent(new Event('input', { bubbles: true }));
    }
  }, places);
}

/** What a click makes the browser download: its name and bytes. */
export async function downloaded(page, click) {
  const [download] = await Promise.all([page.waitForEvent('download'), click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) {
    chunks.push(chunk);
  }
  return { name: download.suggestedFilename(), bytes: Buffer.concat(chunks) };
}

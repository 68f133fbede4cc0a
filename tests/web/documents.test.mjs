// The documents inside the page.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { openPage } from './support/browser.mjs';
import { browser, close, service } from './support/stage.mjs';

/** Goes to a place in the documents and says what is there. */
async function read(page, address) {
  await page.goto(`${service.url}/${address}`);
  await page.locator('.document h1').first().waitFor();
  return page.evaluate(() => ({
    titles: [...document.querySelectorAll('.document h1')].map((title) => title.textContent),
    sections: [...document.querySelectorAll('.document [id]')].map(({ id }) => id),
    links: [...document.querySelectorAll('main a')].map((link) => link.getAttribute('href')),
    pictures: [...document.querySelectorAll('.document img')].map((image) => image.getAttribute('src')),
    raw: document.querySelector('.document').textContent.match(/\]\(|<!--|```/g) ?? [],
  }));
}

test('every document is there, and every link in them leads to something', async () => {
  const page = await openPage(browser, `${service.url}/#/docs`);
  await page.locator('.contents dt').first().waitFor();
  const waiting = await page.locator('.contents a').evaluateAll((links) => links.map((link) => link.getAttribute('href')));
  assert.ok(waiting.length >= 9);
  const found = new Map();  // sections of a document
  const wanted = [];
  const files = new Set();
  const take = (link, from) => {
    if (!link.startsWith('#/docs/')) {
      if (/^(\/|docs\/)/u.test(link)) files.add(link);
      return;
    }
    const [document, section] = link.split('?at=');
    wanted.push({ document, section, from });
    if (!waiting.includes(document)) waiting.push(document);
  };
  for (const address of waiting) {
    if (!address.startsWith('#/docs/')) {
      files.add(address);
      continue;
    }
    const { titles, sections, links, pictures, raw } = await read(page, address);
    assert.equal(titles.length, 1, address);
    assert.deepEqual(raw, [], `${address} shows marks of its source`);
    found.set(address, sections);
    links.forEach((link) => take(link, address));
    pictures.forEach((picture) => files.add(picture));
  }
  for (const { document, section, from } of wanted) {
    assert.ok(section === undefined || found.get(document).includes(decodeURIComponent(section)), `${from}: ${document} has no ${section}`);
  }
  assert.ok(files.size > 10, 'pictures, and the interface');
  for (const file of files) {
    assert.equal((await fetch(new URL(file, service.url))).status, 200, file);
  }
  await close(page);
});

test('each problem of the gallery has its section, and an example in a document opens', async () => {
  const page = await openPage(browser, `${service.url}/#/studio`);
  await page.getByRole('button', { name: 'Gallery' }).click();
  const names = await page.locator('.gallery li strong').allInnerTexts();
  assert.ok(names.length >= 22, `${names.length} problems`);
  await page.keyboard.press('Escape');
  for (const name of names) {
    await page.goto(`${service.url}/#/studio`);
    await page.getByRole('button', { name: 'Gallery' }).click();
    await page.locator('.gallery li', { has: page.getByText(name, { exact: true }) }).locator('button').click();
    await page.getByRole('heading', { level: 1, name, exact: true }).waitFor();
    await page.getByRole('link', { name: 'More about it' }).click();
    await page.waitForFunction((text) => [document.activeElement, document.querySelector('.document h1')].some(
      (element) => element?.textContent === text), name);
  }
  await page.goto(`${service.url}/#/docs/gallery`);
  await page.getByRole('link', { name: 'tunnel_arch', exact: true }).click();
  await page.getByRole('heading', { level: 1, name: 'Tunnel arch in the ground' }).waitFor();
  await page.goto(`${service.url}/#/docs/gallery/liner`);
  await page.getByRole('link', { name: 'liner.json' }).first().click();
  await page.getByRole('heading', { level: 1, name: 'Liner in a host pipe', exact: true }).waitFor();
  await close(page);
});

test('a document that is not there is said to be missing', async () => {
  const page = await openPage(browser, `${service.url}/#/docs/none`);
  await page.locator('.docs .wrong').waitFor();
  await page.getByRole('link', { name: 'All documents' }).click();
  await page.getByRole('heading', { level: 1, name: 'Documents' }).waitFor();
  await close(page);
});

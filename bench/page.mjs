// Times of the page in Chromium against the executable: from moving a slider to a new path drawn, first view, bytes, long paths
// and tables, memory. Prints a table.
//   SERVICE_EXECUTABLE=build/release/snapthrough node bench/page.mjs [--moves 10000] [--rows 50000] [--only NAME]
// NAME: slider, load, path, sweep, memory. An otherwise idle machine of 2 cores is meant; the first lines say how busy it was.
import { cpus, loadavg } from 'node:os';
import { openPage, settled, startBrowser } from '../tests/web/support/browser.mjs';
import { startService } from '../tests/web/support/service.mjs';

const kMoves = 60;      // of a slider whose times are taken
const kLoads = 9;
const kInputs = 60;     // keys, pointer moves or turns of a wheel
const kPace = 16;       // ms between moves of the memory test
const kRest = 1200;     // ms in which states to walk through come

function option(name, otherwise) {
  const at = process.argv.indexOf(`--${name}`);
  return at < 0 ? otherwise : process.argv[at + 1];
}

const rows = [];

function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.ceil(share * sorted.length) - 1)];
}

function addTimes(what, times, goal) {
  const p95 = quantile(times, 0.95);
  rows.push([what, `${quantile(times, 0.5).toFixed(0)} ms`, `${p95.toFixed(0)} ms`, `${goal} ms`, p95 <= goal ? 'yes' : 'no']);
}

function addValue(what, value, goal, met) {
  rows.push([what, value, '', goal, met ? 'yes' : 'no']);
}

/** Runs in the page before its scripts: counts requests in flight, notes when a path is first drawn, and times inputs. */
function instruments() {
  const drawn = () => [...document.querySelectorAll('.path-card svg path.path')].map((one) => one.getAttribute('d')).join();
  const painted = () => new Promise((resolve) => requestAnimationFrame(() => {
    const channel = new MessageChannel();
    channel.port1.onmessage = () => resolve(performance.now());
    channel.port2.postMessage(null);
  }));
  const bench = { inFlight: 0, most: 0, first: null, answers: [] };
  const own = window.fetch;
  window.fetch = async (...given) => {
    const solves = String(given[0]).endsWith('/v1/jobs') && given[1]?.method === 'POST';
    if (!solves) {
      return own(...given);
    }
    bench.inFlight += 1;
    bench.most = Math.max(bench.most, bench.inFlight);
    const start = performance.now();
    try {
      return await own(...given);
    } finally {
      bench.inFlight -= 1;
      bench.answers.push(performance.now() - start);
    }
  };
  const observer = new MutationObserver(() => {
    if (drawn() !== '') {
      observer.disconnect();
      void painted().then((time) => { bench.first = time; });
    }
  });
  observer.observe(document, { childList: true, subtree: true });
  bench.move = (input, place) => {
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set.call(input, String(place));
    input.dispatchEvent(new Event('input', { bubbles: true }));
  };
  /** Moves a slider and waits until another path is on the screen. */
  bench.timeMove = (input, place) => new Promise((resolve, reject) => {
    const before = drawn();
    const card = document.querySelector('.path-card');
    const start = performance.now();
    const late = setTimeout(() => reject(new Error('no other path within 10 s')), 10_000);
    const watch = new MutationObserver(() => {
      const now = drawn();
      if (now !== before && now !== '') {
        watch.disconnect();
        clearTimeout(late);
        void painted().then((time) => resolve(time - start));
      }
    });
    watch.observe(card, { subtree: true, childList: true, attributes: true });
    bench.move(input, place);
  });
  bench.timeInput = async (act) => {
    const start = performance.now();
    act();
    return (await painted()) - start;
  };
  window.bench = bench;
}

async function open(browser, url, hash) {
  const page = await openPage(browser, 'about:blank');
  await page.addInitScript(instruments);
  await page.goto(`${url}/${hash}`);
  return page;
}

async function json(url, path, init) {
  const answer = await fetch(url + path, init);
  return { body: await answer.json(), id: (answer.headers.get('Location') ?? '').split('/').pop() };
}

async function exampleOf(url, name) {
  const { body } = await json(url, '/v1/examples');
  return structuredClone(body.examples.find((one) => one.name === name).request);
}

function post(url, path, body) {
  return json(url, path, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) });
}

/** Half a ring under its weight in a medium that only pushes, as in bench/cases.cpp. */
function ring(k) {
  const held = (node) => ({ node, fixed: ['x', 'rotation'] });
  return {
    model: {
      title: `ring k ${k}`,
      nodes: [{ id: 'bottom', x: 0, y: -10 }, { id: 'top', x: 0, y: 10 }],
      sections: [{ id: 's', EA: 36e6, EI: 30e3 }],
      members: [{ id: 'm', start: 'bottom', end: 'top', section: 's', curve: { type: 'arc', sweep_degrees: 180 } }],
      supports: [held('bottom'), held('top')],
      foundations: [{ id: 'soil', member: 'm', stiffness: 3 * k, reaction: 'compression_only', side: 'right' }],
      loads: [{ type: 'distributed', member: 'm', force: [0, -30] }],
      monitors: [{ id: 'crown', at: { node: 'top' }, component: 'y' }],
    },
    analysis: { type: 'path', stop: { limit_points: 1 } },
  };
}

/** Times of a slider that goes to and fro within a tenth of its way about where it stands. */
async function timeSlider(page) {
  const slider = page.getByRole('slider').first();
  await page.waitForTimeout(kRest);
  const times = await slider.evaluate(async (input, count) => {
    const start = Number(input.value);
    const taken = [];
    for (let i = 1; i <= count; ++i) {
      taken.push(await window.bench.timeMove(input, start + (i % 2 === 0 ? i : -i)));
    }
    return taken;
  }, kMoves);
  const { answers, most } = await page.evaluate(() => ({ answers: window.bench.answers, most: window.bench.most }));
  console.error(`  answers of the service: median ${quantile(answers, 0.5).toFixed(0)} ms`);
  await page.context().close();
  return { times: times.slice(5), most };
}

async function sliders(browser, url) {
  let most = 0;
  const arch = await open(browser, url, '#/studio?problem=tunnel_arch');
  await settled(arch);
  const first = await timeSlider(arch);
  addTimes('slider to path drawn, tunnel arch', first.times, 60);
  most = Math.max(most, first.most);
  for (const [k, goal] of [[1200, 80], [180000, 120]]) {
    const { id } = await post(url, '/v1/jobs', { request: ring(k) });
    const page = await open(browser, url, `#/studio?job=${id}`);
    await settled(page);
    await page.locator('.model-form summary', { hasText: 'Foundations' }).click();
    await page.getByRole('button', { name: 'Give stiffness a slider' }).click();
    const taken = await timeSlider(page);
    addTimes(`slider to path drawn, ring k = ${k}`, taken.times, goal);
    most = Math.max(most, taken.most);
  }
  addValue('most requests of one slider in flight', String(most), '2', most <= 2);
}

async function firstViews(browser, url) {
  const times = [];
  const bytes = { first: 0, all: 0 };
  for (let i = 0; i < kLoads; ++i) {
    const page = await openPage(browser, 'about:blank');
    await page.addInitScript(instruments);
    const network = await page.context().newCDPSession(page);
    await network.send('Network.enable');
    const files = new Map();
    let sum = 0;
    network.on('Network.responseReceived', ({ requestId, response }) => files.set(requestId, new URL(response.url).pathname));
    network.on('Network.loadingFinished', ({ requestId, encodedDataLength }) => {
      const path = files.get(requestId) ?? '';
      sum += path === '/' || path.startsWith('/assets/') ? encodedDataLength : 0;
    });
    await page.goto(`${url}/`);
    await page.waitForFunction(() => window.bench.first !== null);
    times.push(await page.evaluate(() => window.bench.first));
    bytes.first = sum;
    if (i === 0) {
      await page.getByRole('tab', { name: 'JSON' }).click();
      await page.locator('.cm-content').waitFor();
      await page.waitForTimeout(500);
      bytes.all = sum;
    }
    await page.context().close();
  }
  addTimes('first view after a cold load', times, 1000);
  addValue('bytes transferred for the first view', `${(bytes.first / 1000).toFixed(1)} kB`, '120 kB', bytes.first <= 120_000);
  addValue('bytes transferred with the editor', `${(bytes.all / 1000).toFixed(1)} kB`, '260 kB', bytes.all <= 260_000);
}

/** Times of inputs that `act` makes in the page, given their number. */
async function timeInputs(page, selector, act) {
  const times = await page.locator(selector).first().evaluate(async (element, { code, count }) => {
    const make = window[code];
    const taken = [];
    for (let i = 0; i < count; ++i) {
      taken.push(await window.bench.timeInput(() => make(element, i)));
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
    return taken;
  }, { code: act, count: kInputs });
  return times.slice(3);
}

async function longPath(browser, url) {
  const request = await exampleOf(url, 'tunnel_arch');
  request.analysis.output = { ...request.analysis.output, path_points: 20000, states: { every: 2 } };
  const { id } = await post(url, '/v1/jobs', { request });
  const page = await open(browser, url, `#/jobs/${id}`);
  await page.locator('.trust-card .headline').waitFor();
  await page.waitForTimeout(kRest);
  await page.evaluate(() => {
    window.pressKey = (element, i) =>
      element.dispatchEvent(new KeyboardEvent('keydown', { key: i % 20 < 10 ? 'ArrowRight' : 'ArrowLeft', bubbles: true, cancelable: true }));
    window.pointAt = (element, i) => {
      const box = element.getBoundingClientRect();
      const at = { clientX: box.left + ((i % 30) + 1) / 32 * box.width, clientY: box.top + box.height / 2, bubbles: true, pointerId: 1 };
      element.dispatchEvent(new PointerEvent('pointermove', at));
    };
    window.pickAt = (element, i) => {
      const box = element.getBoundingClientRect();
      const at = { clientX: box.left + ((i % 30) + 1) / 32 * box.width, clientY: box.top + box.height / 2, bubbles: true };
      element.setPointerCapture = () => undefined;
      element.dispatchEvent(new PointerEvent('pointerdown', at));
      element.dispatchEvent(new PointerEvent('pointerup', at));
    };
  });
  addTimes('path of 20 000 points: key to paint', await timeInputs(page, '.path-card .walkable', 'pressKey'), 100);
  addTimes('path of 20 000 points: pointer to paint', await timeInputs(page, '.path-card .walkable', 'pickAt'), 100);
  addTimes('drawing of its state: pointer to paint', await timeInputs(page, '.drawing-card .picture', 'pointAt'), 100);
  await page.context().close();
}

async function longSweep(browser, url, count) {
  const request = await exampleOf(url, 'column_winkler');
  const side = Math.ceil(Math.sqrt(count));
  const along = (name, pointer, from, to) => ({ name, targets: [{ pointer }], range: { from, to, count: side, spacing: 'log' } });
  const { id } = await post(url, '/v1/sweeps', {
    ...request, design: 'grid', outputs: ['/buckling/load_factors/0'], analysis: { type: 'buckling' },
    parameters: [along('k', '/model/foundations/0/stiffness', 1, 1000), along('EI', '/model/sections/0/EI', 0.5, 2)],
  });
  const start = performance.now();
  for (;;) {
    const { body } = await json(url, `/v1/sweeps/${id}`);
    if (body.status !== 'accepted' && body.status !== 'running') {
      console.error(`  ${body.points} rows, ${body.status}, ${((performance.now() - start) / 1000).toFixed(0)} s`);
      break;
    }
    await new Promise((resolve) => setTimeout(resolve, 500));
  }
  const page = await open(browser, url, `#/sweeps/${id}`);
  await page.locator('.sweep-chart svg').waitFor({ timeout: 60_000 });
  await page.waitForTimeout(3 * kRest);
  await page.evaluate(() => {
    window.pointAt = (element, i) => {
      const box = element.getBoundingClientRect();
      element.dispatchEvent(new PointerEvent('pointermove', {
        clientX: box.left + 70 + (i % 40) * 8, clientY: box.top + 40 + (i % 25) * 8, bubbles: true, pointerId: 1,
      }));
    };
    window.scrollOn = (element, i) => {
      element.scrollTop = (i * 7919 * 28) % (element.scrollHeight - element.clientHeight);
    };
  });
  addTimes(`sweep of ${side * side} rows: pointer to paint`, await timeInputs(page, '.sweep-chart .walkable', 'pointAt'), 100);
  addTimes(`sweep of ${side * side} rows: scroll to paint`, await timeInputs(page, '.sweep-chart .twin', 'scrollOn'), 100);
  await page.evaluate(() => {
    window.pressOn = (element) => element.click();
  });
  addTimes(`sweep of ${side * side} rows: click "As lines" to paint`, await timeInputs(page, '.sweep-chart button[aria-pressed]', 'pressOn'), 100);
  if (await page.locator('.sweep-chart button[aria-pressed="false"]').count() > 0) await page.locator('.sweep-chart button[aria-pressed]').click();
  addTimes(`sweep of ${side * side} rows, lines: pointer to paint`, await timeInputs(page, '.sweep-chart .walkable', 'pointAt'), 100);
  await page.context().close();
}

async function memory(browser, url, moves) {
  const page = await open(browser, url, '#/studio?problem=tunnel_arch');
  await settled(page);
  const tools = await page.context().newCDPSession(page);
  await tools.send('Performance.enable');
  const drag = (count) => page.getByRole('slider').first().evaluate(async (input, { all, pace }) => {
    for (let i = 0; i < all; ++i) {
      window.bench.move(input, 500 + Math.round(300 * Math.sin(i / 40)));
      await new Promise((resolve) => setTimeout(resolve, pace));
    }
  }, { all: count, pace: kPace });
  const used = async () => {
    await page.waitForTimeout(4 * kRest);
    await tools.send('HeapProfiler.collectGarbage');
    const { metrics } = await tools.send('Performance.getMetrics');
    return metrics.find((one) => one.name === 'JSHeapUsedSize').value / 1e6;
  };
  await drag(100);
  const before = await used();
  await drag(moves - 100);
  const after = await used();
  const most = await page.evaluate(() => window.bench.most);
  const solved = await page.evaluate(() => window.bench.answers.length);
  const { body } = await json(url, '/v1/jobs?label=studio&limit=100');
  console.error(`  ${solved} of ${moves} moves were solved; ${body.jobs.length} jobs are left`);
  addValue(`memory after ${moves} moves, after 100: ${before.toFixed(1)} MB`, `${after.toFixed(1)} MB`, '+ 20 %', after <= 1.2 * before);
  addValue(`most requests in flight in ${moves} moves`, String(most), '2', most <= 2);
  await page.context().close();
}

async function main() {
  const only = option('only', '');
  const service = await startService();
  const browser = await startBrowser();
  const parts = {
    load: () => firstViews(browser, service.url),
    slider: () => sliders(browser, service.url),
    path: () => longPath(browser, service.url),
    sweep: () => longSweep(browser, service.url, Number(option('rows', '50000'))),
    memory: () => memory(browser, service.url, Number(option('moves', '10000'))),
  };
  console.log(`${cpus().length} cores, load average ${loadavg()[0].toFixed(1)} at the start; Chromium ${browser.version()}\n`);
  try {
    for (const [name, run] of Object.entries(parts)) {
      if (only === '' || only === name) {
        console.error(name);
        await run();
      }
    }
  } finally {
    await browser.close();
    await service.stop();
  }
  console.log('| | median | p95 | goal | met |\n| --- | --- | --- | --- | --- |');
  console.log(rows.map((cells) => `| ${cells.join(' | ')} |`).join('\n'));
  console.log(`\nload average ${loadavg()[0].toFixed(1)} at the end`);
}

await main();

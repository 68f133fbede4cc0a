// Answers what a client asks of the service, in the page: jobs and sweeps run in its workers, are kept in memory and are gone with
// the page. Documents of the service come as files from the page's own folder.
import { SolverError } from './index.js';
import { Status } from './module.js';

const kProblem = 'urn:snapthrough:problem:';
const kJobs = 50;  // finished ones that are kept
const kMonitors = 100;  // whose values are told with the points of a growing path, as by the service
const MESSAGES = { running: 'runs', successful: 'the result is ready', dismissed: 'the owner dismissed it' };

const json = (status, body, headers = {}) =>
  new Response(typeof body === 'string' ? body : JSON.stringify(body), {
    status, headers: { 'Content-Type': status >= 400 ? 'application/problem+json' : 'application/json', ...headers },
  });

function problem(status, kind, title, detail, more = {}, headers = {}) {
  return json(status, { type: kProblem + kind, title, status, detail, instance: '', request_id: '', ...more }, headers);
}

const notHere = (path) =>
  problem(404, 'not-found', 'Not found', `${path} is not here: the page works without a service, and keeps what it computes in memory.`);

/** What the body of a POST hands in: the document alone, or in an envelope. */
function unwrapped(body, member) {
  const given = JSON.parse(body);
  return given !== null && typeof given === 'object' && member in given && ('label' in given || 'metadata' in given) ?
    { document: given[member], label: given.label } : { document: given };
}

const now = () => new Date().toISOString();

/** A job or a sweep: its public document, what it was given, and who follows it. */
class Task {
  followers = new Set();
  abort = new AbortController();

  constructor(kind, document, label) {
    this.document = document;
    const request = kind === 'job' ? document : document.request ?? document;
    this.status = {
      id: crypto.randomUUID(), kind, status: 'running', progress: 0, message: MESSAGES.running,
      title: String(document?.model?.title ?? document?.title ?? request?.model?.title ?? ''),
      analysis: String(document?.analysis?.type ?? request?.analysis?.type ?? ''),
      ...(label === undefined ? {} : { label }), ...(kind === 'job' ? { attempt: 1 } : {}), created: now(), started: now(), finished: null, program: null,
      request_sha256: null, usage: null, links: [],
    };
    this.ended = new Promise((resolve) => { this.end = resolve; });
  }

  change(part) {
    Object.assign(this.status, part);
  }
  tell(event, data) {
    for (const follower of this.followers) follower(event, data);
  }
  /** Waits for its end, at most as long as a header Prefer says. */
  async wait(prefer) {
    const seconds = Number(/wait=(\d+)/u.exec(prefer)?.[1] ?? 0);
    if (seconds > 0) await Promise.race([this.ended, new Promise((resolve) => setTimeout(resolve, 1000 * seconds))]);
  }
  finish(status, message = MESSAGES[status]) {
    this.change({ status, message, progress: 100, finished: now() });
    this.tell('end', this.status);
    this.end();
  }
  get isActive() {
    return this.status.status === 'running';
  }
}

export class LocalService {
  #solver;
  #files;
  #jobs = new Map();
  #sweeps = new Map();

  /**
   * @param solver a Solver, or a promise of one
   * @param files address of the folder with v1/examples.json, v1/limits.json, v1/openapi.json and docs/
   */
  constructor(solver, files) {
    this.#solver = Promise.resolve(solver);
    this.#files = files;
  }

  /** Answers as fetch() would. */
  fetch = async (address, { method = 'GET', body = '', headers = {} } = {}) => {
    const url = new URL(address, 'http://local');
    const [, version, kind, id, part, number, last] = url.pathname.split('/');
    const prefer = new Headers(headers).get('Prefer') ?? '';
    try {
      if (url.pathname === '/livez') return json(200, {});
      if (version === 'docs') return await this.#file(url.pathname.slice(1));
      if (version !== 'v1') return notHere(url.pathname);
      if (['examples', 'limits', 'openapi.json'].includes(kind)) return await this.#file(`v1/${kind.replace(/\.json$/u, '')}.json`);
      if (kind === 'check' && method === 'POST') return json(200, await (await this.#solver).check(body));
      const tasks = { jobs: this.#jobs, sweeps: this.#sweeps }[kind];
      if (!tasks) return notHere(url.pathname);
      if (!id && method === 'GET') return this.#list(kind, tasks, url);
      if (!id) return await (kind === 'jobs' ? this.#newJob(body, prefer) : this.#newSweep(body));
      const task = tasks.get(id);
      if (!task) return notHere(url.pathname);
      return await this.#common(tasks, method, task, part, prefer) ??
        (method !== 'GET' ? notHere(url.pathname) : kind === 'jobs' ? this.#ofJob(task, part, url) : await this.#ofSweep(task, part, url, number, last));
    } catch (error) {
      if (error instanceof SyntaxError) return problem(400, 'malformed-json', 'Malformed JSON', error.message);
      throw error;
    }
  };

  async #file(name) {
    const response = await fetch(new URL(name, this.#files));
    return response.ok ? response : notHere(`/${name}`);
  }

  // --- jobs

  async #newJob(body, prefer) {
    const made = await this.#checked('job', unwrapped(body, 'request'));
    if (made.refusal) return made.refusal;
    const job = made.task;
    this.#keep(this.#jobs, job);
    void this.#solve(job);
    const location = { Location: `/v1/jobs/${job.status.id}` };
    if (/return=minimal|respond-async/u.test(prefer)) return json(201, job.status, location);
    await job.wait(prefer);
    if (job.isActive) return json(201, job.status, location);
    return job.result ? json(200, job.result, location) : this.#failure(job, location);
  }

  #failure(job, location) {
    return problem(422, 'analysis-failed', 'The analysis could not be completed', job.failure?.detail ?? job.status.message, {
      code: job.failure?.code ?? job.status.status, ...(job.reached ? { reached: job.reached } : {}),
    }, location);
  }

  async #solve(job) {
    try {
      const result = await (await this.#solver).solve(job.document, {
        signal: job.abort.signal,
        onProgress: (now) => {
          job.tell('points', pointsOf(job.document, now));
          job.tell('progress', {
            attempt: 1, step: now.done, load_factor: now.loadFactor, branch: now.branch, negative_eigenvalues: now.negativeEigenvalues,
          });
        },
      });
      job.result = result;
      job.change({ program: result.program, request_sha256: result.request_sha256 });
      for (const { branch, type, load_factor, arc_length, negative_before, negative_after, error_estimate } of result.critical_points) {
        job.tell('critical_point', { branch, type, load_factor, arc_length, negative_before, negative_after, error_estimate, final: true });
      }
      job.finish('successful');
    } catch (error) {
      if (error.name === 'AbortError') return job.finish('dismissed');
      job.failure = error instanceof SolverError && error.reached ? error.reached.failure : { code: 'out_of_memory', detail: error.message };
      job.reached = error instanceof SolverError && error.status === Status.NOT_COMPLETED ? error.reached : null;
      job.finish('failed', job.failure.detail);
    }
    return undefined;
  }

  #ofJob(job, part, url) {
    if (part !== 'result') return notHere(url.pathname);
    if (!job.result) return job.isActive ? problem(404, 'not-found', 'Not found', 'The result is not ready.') : this.#failure(job, {});
    if (url.searchParams.get('format') !== 'csv') return json(200, job.result);
    const name = url.searchParams.get('table');
    const table = name === 'buckling' ? job.result.buckling?.load_factors.map((load) => ({ load_factor: load })) : job.result[name];
    return Array.isArray(table) ? csv(flatTable(table)) : notHere(url.pathname);
  }

  // --- sweeps

  async #newSweep(body) {
    const made = await this.#checked('sweep', unwrapped(body, 'sweep'));
    if (made.refusal) return made.refusal;
    const sweep = made.task;
    const points = made.size?.points ?? 0;
    sweep.change({ points, counts: { successful: 0, failed: 0, reused: 0, remaining: points } });
    this.#keep(this.#sweeps, sweep);
    void this.#sweep(sweep);
    return json(201, sweep.status, { Location: `/v1/sweeps/${sweep.status.id}` });
  }

  async #sweep(sweep) {
    sweep.rows = new Map();
    const take = (table) => {
      sweep.head = { ...table, points: [], rows: [] };
      const error = table.columns.indexOf('error');
      table.points.forEach((point, i) => sweep.rows.set(point, table.rows[i]));
      const failed = [...sweep.rows.values()].filter((row) => row[error] !== null).length;
      const { points } = sweep.status;
      sweep.change({
        progress: Math.floor(100 * sweep.rows.size / points), program: table.program, request_sha256: table.request_sha256,
        counts: { successful: sweep.rows.size - failed, failed, reused: 0, remaining: points - sweep.rows.size },
      });
      sweep.tell('progress', { ...sweep.status.counts, progress: sweep.status.progress });
    };
    try {
      await (await this.#solver).sweep(sweep.document, { signal: sweep.abort.signal, onRows: take });
      const { failed } = sweep.status.counts;
      sweep.finish(failed > 0 ? 'failed' : 'successful',
                   failed > 0 ? `the table is complete; ${failed} of ${sweep.status.points} points failed` : 'the table is complete');
    } catch (error) {
      sweep.finish(error.name === 'AbortError' ? 'dismissed' : 'failed', error.name === 'AbortError' ? MESSAGES.dismissed : error.message);
    }
  }

  async #ofSweep(sweep, part, url, number, last) {
    if (part === 'points' && last === 'request') return json(200, await (await this.#solver).point(sweep.document, Number(number)));
    if (part === 'table') return this.#table(sweep, url.searchParams);
    return notHere(url.pathname);
  }

  #table(sweep, query) {
    const [first, count] = [Number(query.get('first') ?? 0), Number(query.get('count') ?? Infinity)];
    const numbers = [...(sweep.rows?.keys() ?? [])].filter((point) => point >= first && point < first + count).sort((a, b) => a - b);
    const table = { kind: 'table', columns: [], ...sweep.head, points: numbers, rows: numbers.map((point) => sweep.rows.get(point)) };
    return query.get('format') === 'csv' ? csv(table) : json(200, table);
  }

  // --- both

  /** A task for a document, or the refusal of one with mistakes. */
  async #checked(kind, { document, label }) {
    const { errors = [], size } = await (await this.#solver).check(document);
    if (errors.length === 0) return { task: new Task(kind, document, label), size };
    const detail = `The document has ${errors.length} ${errors.length === 1 ? 'mistake' : 'mistakes'}.`;
    return { refusal: problem(422, 'invalid-request', 'Invalid request', detail, { errors }) };
  }

  #keep(tasks, task) {
    tasks.set(task.status.id, task);
    for (const [id, one] of tasks) {
      if (tasks.size <= kJobs) break;
      if (!one.isActive) tasks.delete(id);
    }
  }

  #list(name, tasks, url) {
    const [status, label] = [url.searchParams.get('status'), url.searchParams.get('label')];
    const all = [...tasks.values()].map((task) => task.status).reverse()
      .filter((one) => (!status || one.status === status) && (!label || one.label === label));
    return json(200, { [name]: all.slice(0, Number(url.searchParams.get('limit') ?? 100)), links: [] });
  }

  /** What jobs and sweeps have in common; null for what they have not. */
  async #common(tasks, method, task, part, prefer) {
    if (!part && method === 'GET') {
      await task.wait(prefer);
      return json(200, task.status);
    }
    if (!part && method === 'DELETE') {
      task.abort.abort();
      tasks.delete(task.status.id);
      return new Response(null, { status: 204 });
    }
    if (part === 'request') return json(200, task.document);
    if (part === 'events') return this.#events(task);
    if (part === 'dismiss') {
      task.abort.abort();
      return json(200, { ...task.status, status: 'dismissed', message: MESSAGES.dismissed });
    }
    return null;
  }

  #events(task) {
    const encoder = new TextEncoder();
    let follower = null;
    const stream = new ReadableStream({
      start(controller) {
        let number = 0;
        follower = (event, data) => {
          controller.enqueue(encoder.encode(`id: ${++number}\nevent: ${event}\ndata: ${JSON.stringify(data)}\n\n`));
          if (event === 'end') {
            task.followers.delete(follower);
            controller.close();
          }
        };
        if (!task.isActive) follower('end', task.status);
        else task.followers.add(follower);
      },
      cancel() {
        task.followers.delete(follower);
      },
    });
    return new Response(stream, { headers: { 'Content-Type': 'text/event-stream' } });
  }
}

/** The point of a path that an analysis has come to, as data of a points event. */
function pointsOf({ model }, now) {
  return {
    branch: [now.branch], step: [now.done], load_factor: [now.loadFactor], arc_length: [now.arcLength],
    negative_eigenvalues: [now.negativeEigenvalues],
    monitors: now.monitors.slice(0, kMonitors).map((value, i) => ({ id: model.monitors[i].id, values: [value] })),
  };
}

/** Rows of objects, with those members as columns that are no lists and no objects. */
function flatTable(objects) {
  const columns = Object.keys(objects[0] ?? {}).filter((key) => objects.every((one) => one[key] === null || typeof one[key] !== 'object'));
  return { columns, rows: objects.map((one) => columns.map((key) => one[key])) };
}

const csv = (table) => new Response(csvOf(table), { headers: { 'Content-Type': 'text/csv' } });

/** RFC 4180; texts that a spreadsheet would take for formulas begin with an apostrophe, as those of the service. */
function csvOf({ columns, rows }) {
  const cell = (value) => {
    if (value === null) return '';
    if (typeof value === 'number') return String(value);
    const text = typeof value === 'string' ? value : JSON.stringify(value);
    const safe = /^\s*[=+\-@]/u.test(text) ? `'${text}` : text;
    return /[",\r\n]/u.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
  };
  return [columns, ...rows].map((row) => row.map(cell).join(',')).join('\r\n') + '\r\n';
}

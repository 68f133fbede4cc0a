// The solver in workers: calls take and give documents as objects, and do not block the caller.
import { Status } from './module.js';

const inNode = typeof process !== 'undefined' && process.versions?.node !== undefined;

/** The document is wrong, or the analysis was not completed. */
export class SolverError extends Error {
  /** @param problem document of RFC 9457, or the result as far as the analysis got */
  constructor(status, problem) {
    const findings = problem.errors ?? [];
    const reasons = findings.map(({ pointer, detail }) => `${pointer}: ${detail}`);
    super([problem.failure?.detail ?? problem.detail, ...reasons].join('\n'));
    this.name = 'SolverError';
    this.status = status;
    this.problem = problem;
    /** Mistakes of the document, each with pointer, code and detail. */
    this.findings = findings;
    /** The result as far as an analysis got that was not completed. */
    this.reached = status === Status.NOT_COMPLETED ? problem : null;
  }
}

async function compiledFrom(source) {
  if (source instanceof WebAssembly.Module) return source;
  const url = new URL(source ?? 'snapthrough.wasm', import.meta.url);
  if (url.protocol === 'file:' && inNode) {
    const { readFile } = await import('node:fs/promises');
    return WebAssembly.compile(await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url} was answered with ${response.status}.`);
  if (response.headers.get('Content-Type')?.startsWith('application/wasm')) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

async function newWorker() {
  const url = new URL('worker.js', import.meta.url);
  if (!inNode) return new Worker(url, { type: 'module' });
  const { Worker: NodeWorker } = await import('node:worker_threads');
  return new NodeWorker(url);
}

/** One worker, which works on one call at a time. */
class Helper {
  #worker;
  #waiting = new Map();
  #next = 0;

  static async start(compiled) {
    const helper = new Helper();
    helper.#worker = await newWorker();
    const take = (message) => helper.#take(message);
    const fail = (error) => helper.#fail(error);
    if (inNode) {
      helper.#worker.on('message', take);
      helper.#worker.on('error', fail);
    } else {
      helper.#worker.addEventListener('message', ({ data }) => take(data));
      helper.#worker.addEventListener('error', fail);
    }
    helper.version = await helper.send({ start: compiled });
    return helper;
  }

  send(message, onProgress = null) {
    const id = ++this.#next;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject, onProgress });
      this.#worker.postMessage({ id, watched: onProgress !== null, ...message });
    });
  }

  /** Ends the worker; what waits for it fails with the reason. */
  end(reason) {
    this.#worker.terminate();
    this.#fail(reason);
  }

  #take({ id, answer, progress, error }) {
    const waiting = this.#waiting.get(id);
    if (waiting === undefined) return;
    if (progress) {
      waiting.onProgress?.(progress);
      return;
    }
    this.#waiting.delete(id);
    if (error === undefined) waiting.resolve(answer);
    else waiting.reject(new Error(error));
  }

  #fail(error) {
    for (const { reject } of this.#waiting.values()) reject(error);
    this.#waiting.clear();
  }
}

const textOf = (document) => (typeof document === 'string' ? document : JSON.stringify(document));
const reasonOf = (signal) => signal.reason ?? new DOMException('The call was aborted.', 'AbortError');

/** Solves in workers of this process or page. Calls of one solver may run at the same time; each has a worker. */
export class Solver {
  #compiled;
  #idle = [];
  #busy = new Set();
  #queue = [];
  #workers;
  #closed = false;

  /**
   * Compiles the module and starts a worker.
   * @param source place of snapthrough.wasm, or a WebAssembly.Module; default: beside this file
   * @param workers most workers at a time; default: one less than the processors, at least one
   */
  static async create({ source, workers } = {}) {
    const solver = new Solver();
    solver.#workers = workers ?? Math.max(1, (globalThis.navigator?.hardwareConcurrency ?? (await processors())) - 1);
    solver.#compiled = await compiledFrom(source);
    const first = await Helper.start(solver.#compiled);
    solver.version = first.version;
    solver.#idle.push(first);
    return solver;
  }

  get workers() {
    return this.#workers;
  }

  /** The result of a request (object or JSON text). Aborting the signal ends the call at once. */
  async solve(request, { signal, onProgress } = {}) {
    return JSON.parse(this.#taken(await this.#run('solve', [textOf(request)], signal, onProgress)));
  }

  /** Mistakes of a request or a sweep as `findings`, or its size. */
  async check(document, { signal } = {}) {
    const { text } = await this.#run('check', [textOf(document)], signal);
    return JSON.parse(text);
  }

  /** The request of a point of a sweep, counted from 0. */
  async point(document, number, { signal } = {}) {
    const { status, text } = await this.#run('point', [textOf(document), number], signal);
    if (status !== Status.DONE) throw new RangeError(`The sweep has no point ${number}.`);
    return JSON.parse(text);
  }

  /** A figure (SVG) of a result, a request or a table. @param choices as of POST /v1/plot, without the document */
  async plot(document, choices = {}, { signal } = {}) {
    return this.#taken(await this.#run('plot', [textOf(document), JSON.stringify(choices)], signal));
  }

  /** All rows of a sweep, computed by all workers. `onProgress` is told {done, total}, `onRows` each part of the table. */
  async sweep(document, { signal, onProgress, onRows } = {}) {
    const text = textOf(document);
    const head = JSON.parse(this.#taken(await this.#run('sweep', [text, 0, 0], signal)));  // no rows
    const { total, unit } = head;
    const parts = [];
    const size = unit * Math.max(1, Math.min(32, Math.ceil(total / unit / this.#workers / 4)));
    for (let first = 0; first < total; first += size) parts.push([first, Math.min(size, total - first)]);
    let done = 0;
    const tables = await Promise.all(parts.map(async ([first, count]) => {
      const table = JSON.parse(this.#taken(await this.#run('sweep', [text, first, count], signal)));
      done += count;
      onRows?.(table);
      onProgress?.({ done, total });
      return table;
    }));
    return { ...head, points: tables.flatMap((table) => table.points), rows: tables.flatMap((table) => table.rows) };
  }

  /** Ends all workers; calls that run fail. */
  close() {
    this.#closed = true;
    const reason = new Error('The solver was closed.');
    for (const helper of [...this.#idle, ...this.#busy]) helper.end(reason);
    for (const { reject } of this.#queue) reject(reason);
    this.#idle = [];
    this.#busy.clear();
    this.#queue = [];
  }

  #taken({ status, text }) {
    if (status === Status.DONE) return text;
    throw new SolverError(status, text === '' ? { detail: 'There is not enough memory.' } : JSON.parse(text));
  }

  async #run(call, given, signal, onProgress = null) {
    if (signal?.aborted) throw reasonOf(signal);
    const helper = await this.#worker(signal, call === 'sweep');
    const abort = () => {
      helper.end(reasonOf(signal));
      this.#busy.delete(helper);
      this.#serve();
    };
    signal?.addEventListener('abort', abort, { once: true });
    try {
      return await helper.send({ call, given }, onProgress);
    } finally {
      signal?.removeEventListener('abort', abort);
      if (this.#busy.delete(helper)) {
        this.#idle.push(helper);
        this.#serve();
      }
    }
  }

  /** A worker for one call; parts of sweeps wait behind all other calls. */
  #worker(signal, isPart) {
    if (this.#closed) throw new Error('The solver was closed.');
    return new Promise((resolve, reject) => {
      const waiting = { resolve, reject, isPart };
      const place = isPart ? -1 : this.#queue.findIndex((one) => one.isPart);
      this.#queue.splice(place < 0 ? this.#queue.length : place, 0, waiting);
      signal?.addEventListener('abort', () => {
        this.#queue = this.#queue.filter((one) => one !== waiting);
        reject(reasonOf(signal));
      }, { once: true });
      this.#serve();
    });
  }

  async #serve() {
    if (this.#queue.length === 0 || this.#closed) return;
    const idle = this.#idle.pop();
    if (idle) {
      this.#busy.add(idle);
      this.#queue.shift().resolve(idle);
      return;
    }
    if (this.#busy.size + this.#starting >= this.#workers) return;
    ++this.#starting;
    try {
      this.#idle.push(await Helper.start(this.#compiled));
    } catch (error) {
      this.#queue.shift()?.reject(error);
    } finally {
      --this.#starting;
    }
    this.#serve();
  }

  #starting = 0;
}

async function processors() {
  return inNode ? (await import('node:os')).availableParallelism() : 2;
}

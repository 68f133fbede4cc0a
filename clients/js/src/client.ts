// The client of the service: what the page at its address uses, and any program in a browser or in Node.

import type {
  Check, CriticalPointEvent, Description, Job, JobList, JobProgressEvent, Limits, PathPointsEvent, Problem, RequestDocument, Result,
  Sweep, SweepDocument, SweepList, SweepProgressEvent, Table, Warning,
} from "./documents.js";
import { idOf, isAbort, Refused, Unreachable } from "./errors.js";
import { follow, type ServerEvent } from "./events.js";

const kJson = { "Content-Type": "application/json" };
const kLongestWait = 60;  // seconds that one request waits for the end of a job: the service's own limit by default

/** Whether a job or a sweep with this status has not ended. */
export function isActive(status: string): boolean {
  return status === "accepted" || status === "running";
}

export interface ClientOptions {
  /** Address of the service, such as http://127.0.0.1:8080; without it that of the page the program runs in. */
  url?: string;
  /** The bearer key, or what gives it at each request; empty: none. */
  key?: string | (() => string);
  /** What answers in place of fetch(), such as a solver in the page. */
  fetch?: (address: string, request: RequestInit) => Promise<Response>;
  /** Is told each warning of each result that `solve` gives. By default warnings go to the console. */
  onWarning?: (warning: Warning, job: string) => void;
}

/** How a request or a sweep is handed in. */
export interface SubmitOptions {
  label?: string;
  metadata?: Record<string, string>;
  /** Computes anew what is stored already. */
  fresh?: boolean;
}

export interface SolveOptions extends SubmitOptions {
  /** Aborting it dismisses the job and ends the call with an AbortError. */
  signal?: AbortSignal;
  /** Where the analysis stands. */
  onProgress?: (progress: JobProgressEvent) => void;
  /** Points of the path as they are traced. */
  onPoints?: (points: PathPointsEvent) => void;
  /** Critical points as they are found, and again as the result has them (`final`). */
  onCriticalPoint?: (point: CriticalPointEvent) => void;
}

export interface SweepOptions extends SubmitOptions {
  /** Aborting it dismisses the sweep and ends the call with an AbortError. */
  signal?: AbortSignal;
  onProgress?: (progress: SweepProgressEvent) => void;
}

/** What became of a request within a wait: its result, or the job that still works on it. */
export type Answer = { job: string; result: Result; cached: boolean } | { job: string; result: null };

/** A result, and the job that has it. */
export interface Solution {
  job: string;
  result: Result;
  /** Whether the result was stored already. */
  cached: boolean;
}

function init(method: string, body: unknown, headers: Record<string, string>, signal?: AbortSignal): RequestInit {
  const text = typeof body === "string" ? body : JSON.stringify(body);
  return { method, headers: { ...kJson, ...headers }, body: text, ...(signal ? { signal } : {}) };
}

function envelope(member: "request" | "sweep", document: unknown, { label, metadata }: SubmitOptions): unknown {
  if (label === undefined && metadata === undefined) return document;
  return { ...(label === undefined ? {} : { label }), ...(metadata === undefined ? {} : { metadata }), [member]: document };
}

async function problemOf(response: Response): Promise<Problem> {
  const text = await response.text();
  try {
    return JSON.parse(text) as Problem;
  } catch {
    return {
      type: "urn:snapthrough:problem:internal-error", title: response.statusText, status: response.status, detail: text.slice(0, 500), instance: "",
      request_id: "",
    };
  }
}

function warnOnConsole(warning: Warning): void {
  console.warn(`snapthrough: ${warning.code}: ${warning.detail}`);
}

/** Calls throw `Refused`, `Unreachable`, or the AbortError of their signal. Several calls may run at the same time. */
export class Client {
  private readonly url: string;
  private readonly key: () => string;
  private readonly send: (address: string, request: RequestInit) => Promise<Response>;
  private readonly onWarning: (warning: Warning, job: string) => void;

  constructor(options: ClientOptions = {}) {
    const { url = "", key = "", onWarning = warnOnConsole } = options;
    this.url = url.replace(/\/+$/, "");
    this.key = typeof key === "function" ? key : () => key;
    this.send = options.fetch ?? ((address, request) => fetch(address, request));
    this.onWarning = onWarning;
  }

  /** The result of a request, however long it takes. */
  async solve(request: RequestDocument, options: SolveOptions = {}): Promise<Solution> {
    const watched = options.onProgress ?? options.onPoints ?? options.onCriticalPoint ?? options.signal;
    const solution = watched ? await this.solveWatched(request, options) : await this.solveUnwatched(request, options);
    for (const warning of solution.result.warnings) this.onWarning(warning, solution.job);
    return solution;
  }

  /** The result of a request if it is there within `wait` seconds (at most `longest_wait_s` of the limits). */
  async ask(request: RequestDocument, wait: number, options: SubmitOptions = {}): Promise<Answer> {
    const response = await this.call("/v1/jobs", init("POST", envelope("request", request, options), {
      Prefer: `wait=${wait}, return=representation`, ...(options.fresh ? { "Cache-Control": "no-cache" } : {}),
    }));
    const job = idOf(response.headers.get("Location") ?? "");
    if (response.status !== 200) return { job, result: null };
    const result = (await response.json()) as Result;
    return { job, result, cached: response.headers.get("X-Cache") === "hit" };
  }

  /** Hands a request in without waiting. */
  submit(request: RequestDocument, options: SubmitOptions = {}): Promise<Job> {
    return this.read<Job>("/v1/jobs", init("POST", envelope("request", request, options), {
      Prefer: "return=minimal", ...(options.fresh ? { "Cache-Control": "no-cache" } : {}),
    }));
  }

  /** Every mistake of a request or a sweep, or its size. @param document an object, or its JSON text */
  check(document: RequestDocument | SweepDocument | string, signal?: AbortSignal): Promise<Check> {
    return this.read<Check>("/v1/check", init("POST", document, {}, signal));
  }

  /** Every row of a sweep, however long it takes; rows of points that failed have their code in the column `error`. */
  async sweep(document: SweepDocument, options: SweepOptions = {}): Promise<{ sweep: Sweep; table: Table }> {
    const submitted = await this.submitSweep(document, options);
    await this.ended(`/v1/sweeps/${submitted.id}`, options.signal, (event) => {
      if (event.type === "progress") options.onProgress?.(event.data as SweepProgressEvent);
    });
    return { sweep: await this.sweepStatus(submitted.id), table: await this.wholeTable(submitted.id) };
  }

  /** Hands a sweep in without waiting. */
  submitSweep(document: SweepDocument, options: SubmitOptions = {}): Promise<Sweep> {
    return this.read<Sweep>("/v1/sweeps", init("POST", envelope("sweep", document, options),
                                               options.fresh ? { "Cache-Control": "no-cache" } : {}));
  }

  /**
   * Calls `take` with each event of a job or sweep until its end, or until `signal` stops it.
   * @param path /v1/jobs/ID or /v1/sweeps/ID
   */
  follow(path: string, take: (event: ServerEvent) => void, signal: AbortSignal): Promise<void> {
    return follow((request) => this.call(`${path}/events`, request), take, signal);
  }

  limits(): Promise<Limits> {
    return this.read<Limits>("/v1/limits");
  }
  description(): Promise<Description> {
    return this.read<Description>("/v1/openapi.json");
  }
  examples(): Promise<{ examples: { name: string; request: RequestDocument }[] }> {
    return this.read("/v1/examples");
  }

  /** @param query as /v1/jobs has it, such as `limit=10&status=failed` */
  jobs(query = ""): Promise<JobList> {
    return this.read<JobList>(`/v1/jobs?${query}`);
  }
  /** @param wait seconds to wait for its end */
  job(id: string, wait = 0): Promise<Job> {
    return this.read<Job>(`/v1/jobs/${id}`, wait > 0 ? { headers: { Prefer: `wait=${wait}` } } : {});
  }
  jobRequest(id: string): Promise<RequestDocument> {
    return this.read<RequestDocument>(`/v1/jobs/${id}/request`);
  }
  jobResult(id: string): Promise<Result> {
    return this.read<Result>(`/v1/jobs/${id}/result`);
  }
  dismissJob(id: string): Promise<Job> {
    return this.read<Job>(`/v1/jobs/${id}/dismiss`, { method: "POST", body: "" });
  }
  /** @param leaving the page is being left, and nobody waits for the answer */
  async deleteJob(id: string, leaving = false): Promise<void> {
    await this.call(`/v1/jobs/${id}`, { method: "DELETE", keepalive: leaving });
  }

  /** @param query as /v1/sweeps has it */
  sweeps(query = ""): Promise<SweepList> {
    return this.read<SweepList>(`/v1/sweeps?${query}`);
  }
  sweepStatus(id: string): Promise<Sweep> {
    return this.read<Sweep>(`/v1/sweeps/${id}`);
  }
  sweepRequest(id: string): Promise<SweepDocument> {
    return this.read<SweepDocument>(`/v1/sweeps/${id}/request`);
  }
  /** The rows that are there. @param query as the table has it, with its question mark: `?status=failed` */
  sweepTable(id: string, query = ""): Promise<Table> {
    return this.read<Table>(`/v1/sweeps/${id}/table${query}`);
  }
  dismissSweep(id: string): Promise<Sweep> {
    return this.read<Sweep>(`/v1/sweeps/${id}/dismiss`, { method: "POST", body: "" });
  }
  async deleteSweep(id: string): Promise<void> {
    await this.call(`/v1/sweeps/${id}`, { method: "DELETE" });
  }
  pointRequest(id: string, point: number): Promise<RequestDocument> {
    return this.read<RequestDocument>(`/v1/sweeps/${id}/points/${point}/request`);
  }

  /** The response to any request, if it is no error. */
  async call(path: string, request: RequestInit = {}): Promise<Response> {
    const headers = new Headers(request.headers);
    const key = this.key();
    if (key !== "") headers.set("Authorization", `Bearer ${key}`);
    let response: Response;
    try {
      response = await this.send(this.url + path, { ...request, headers });
    } catch (error) {
      if (isAbort(error)) throw error;
      throw new Unreachable("The service does not answer.", { cause: error });
    }
    if (response.ok) return response;
    throw new Refused(await problemOf(response), response.headers.get("Location"));
  }

  /** The JSON document that is the body of the response. */
  async read<T>(path: string, request?: RequestInit): Promise<T> {
    const response = await this.call(path, request);
    try {
      return (await response.json()) as T;
    } catch (error) {
      if (isAbort(error)) throw error;
      throw new Unreachable("The answer broke off.", { cause: error });
    }
  }

  private async solveUnwatched(request: RequestDocument, options: SolveOptions): Promise<Solution> {
    const answer = await this.ask(request, kLongestWait, options);
    if (answer.result) return answer;
    while (isActive((await this.job(answer.job, kLongestWait)).status));
    return { job: answer.job, result: await this.jobResult(answer.job), cached: false };
  }

  /** Events are told however fast the analysis is: the job is handed in, and followed, before its result is asked for. */
  private async solveWatched(request: RequestDocument, options: SolveOptions): Promise<Solution> {
    const { id, status } = await this.submit(request, options);
    await this.ended(`/v1/jobs/${id}`, options.signal, (event) => {
      if (event.type === "progress") options.onProgress?.(event.data as JobProgressEvent);
      if (event.type === "points") options.onPoints?.(event.data as PathPointsEvent);
      if (event.type === "critical_point") options.onCriticalPoint?.(event.data as CriticalPointEvent);
    });
    return { job: id, result: await this.jobResult(id), cached: status === "successful" };
  }

  /** Follows a job or sweep to its end; when the signal aborts, it is dismissed. */
  private async ended(path: string, signal: AbortSignal | undefined, take: (event: ServerEvent) => void): Promise<void> {
    const never = new AbortController().signal;
    try {
      await this.follow(path, take, signal ?? never);
      signal?.throwIfAborted();
    } catch (error) {
      if (signal?.aborted) await this.call(`${path}/dismiss`, { method: "POST", body: "" }).catch(() => undefined);
      throw error;
    }
  }

  /** All rows of a sweep, in as many parts as the service wants. */
  private async wholeTable(id: string): Promise<Table> {
    const most = (await this.limits()).table_rows;
    const table = await this.sweepTable(id, `?first=0&count=${most}`);
    const { points } = await this.sweepStatus(id);
    for (let first = most; first < points; first += most) {
      const part = await this.sweepTable(id, `?first=${first}&count=${most}`);
      table.rows.push(...part.rows);
      table.points?.push(...(part.points ?? []));
    }
    return table;
  }
}

// Requests to the service: the key, problem documents, and whether the service is there at all.

import { makeStore } from "../store";
import type {
  Check, Description, Job, JobList, Limits, Problem, RequestDocument, Result, Sweep, SweepDocument, SweepList, Table,
} from "./documents";

const kKeyName = "snapthrough-key";
const kAskAgain = 1000;  // ms between questions whether a service that was gone is back
const kJson = { "Content-Type": "application/json" };
export const kStudioLabel = "studio";

/** How the service is doing. `visits` counts how often it came back after it was gone. */
export const connection = makeStore<{ state: "there" | "gone" | "key"; visits: number }>({ state: "there", visits: 0 });

/** The service refused, or an analysis failed: a problem document (docs/service.md, Errors). */
export class Refused extends Error {
  constructor(readonly problem: Problem, readonly location: string | null) {
    super(problem.detail);
  }
  get kind(): string {
    return this.problem.type.replace("urn:snapthrough:problem:", "");
  }
}

/** No answer came. */
export class Unreachable extends Error {}

export function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

let key = sessionStorage.getItem(kKeyName) ?? "";

export function setKey(text: string): void {
  key = text;
  sessionStorage.setItem(kKeyName, text);
  const { visits } = connection.get();
  connection.set({ state: "there", visits: visits + 1 });
}

export function forgetKey(): void {
  key = "";
  sessionStorage.removeItem(kKeyName);
  connection.change({ state: "key" });
}

export function hasKey(): boolean {
  return key !== "";
}

async function waitForService(): Promise<void> {
  for (;;) {
    await new Promise((resolve) => setTimeout(resolve, kAskAgain));
    const alive = await fetch("/livez", { cache: "no-store" }).catch(() => null);
    if (alive?.ok) break;
  }
  connection.set({ state: "there", visits: connection.get().visits + 1 });
}

function serviceIsGone(): void {
  if (connection.get().state === "gone") return;
  connection.change({ state: "gone" });
  void waitForService();
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

/** A response that is no error. Throws Refused, Unreachable, or an AbortError. */
export async function call(path: string, init: RequestInit = {}): Promise<Response> {
  const headers = new Headers(init.headers);
  if (key !== "") headers.set("Authorization", `Bearer ${key}`);
  let response: Response;
  try {
    response = await fetch(path, { ...init, headers });
  } catch (error) {
    if (isAbort(error)) throw error;
    serviceIsGone();
    throw new Unreachable("The service does not answer.");
  }
  if (response.ok) return response;
  const problem = await problemOf(response);
  if (response.status === 401) connection.change({ state: "key" });
  throw new Refused(problem, response.headers.get("Location"));
}

async function read<T>(path: string, init?: RequestInit): Promise<T> {
  const response = await call(path, init);
  try {
    return (await response.json()) as T;
  } catch (error) {
    if (isAbort(error)) throw error;
    serviceIsGone();
    throw new Unreachable("The answer broke off.");
  }
}

async function readText(path: string): Promise<string> {
  return (await call(path)).text();
}

function post(body: unknown, headers: Record<string, string> = {}): RequestInit {
  return { method: "POST", headers: { ...kJson, ...headers }, body: JSON.stringify(body) };
}

/** What became of a request within the wait: its result, or the job that still works on it. */
export type Answer = { job: string; result: Result; cached: boolean } | { job: string; result: null };

/** @param wait seconds */
export async function solve(request: RequestDocument, wait: number): Promise<Answer> {
  const response = await call("/v1/jobs", post({ label: kStudioLabel, request },
                                               { Prefer: `wait=${wait}, return=representation` }));
  const job = idOf(response.headers.get("Location") ?? "");
  if (response.status !== 200) return { job, result: null };
  const result = (await response.json()) as Result;
  return { job, result, cached: response.headers.get("X-Cache") === "hit" };
}

/** The last segment of /v1/jobs/ID or /v1/sweeps/ID. */
export function idOf(location: string): string {
  return location.split("/")[3] ?? "";
}

export const service = {
  check: (text: string, signal?: AbortSignal) =>
    read<Check>("/v1/check", { method: "POST", headers: kJson, body: text, ...(signal ? { signal } : {}) }),
  limits: () => read<Limits>("/v1/limits"),
  document: (name: string) => readText(`/docs/${name}.md`),
  description: () => read<Description>("/v1/openapi.json"),
  examples: () => read<{ examples: { name: string; request: RequestDocument }[] }>("/v1/examples"),
  jobs: (query: string) => read<JobList>(`/v1/jobs?${query}`),
  job: (id: string, wait = 0) => read<Job>(`/v1/jobs/${id}`, wait > 0 ? { headers: { Prefer: `wait=${wait}` } } : {}),
  jobRequest: (id: string) => read<RequestDocument>(`/v1/jobs/${id}/request`),
  jobResult: (id: string) => read<Result>(`/v1/jobs/${id}/result`),
  dismissJob: (id: string) => read<Job>(`/v1/jobs/${id}/dismiss`, { method: "POST", body: "" }),
  /** `leaving`: the page is being left, and nobody waits for the answer. */
  deleteJob: (id: string, leaving = false) => call(`/v1/jobs/${id}`, { method: "DELETE", keepalive: leaving }),
  submitJob: (request: RequestDocument, label: string) =>
    read<Job>("/v1/jobs", post({ label, request }, { Prefer: "return=minimal" })),
  sweeps: (query: string) => read<SweepList>(`/v1/sweeps?${query}`),
  sweep: (id: string) => read<Sweep>(`/v1/sweeps/${id}`),
  sweepRequest: (id: string) => read<SweepDocument>(`/v1/sweeps/${id}/request`),
  sweepTable: (id: string, query = "") => read<Table>(`/v1/sweeps/${id}/table${query}`),
  submitSweep: (sweep: SweepDocument) => read<Sweep>("/v1/sweeps", post(sweep)),
  dismissSweep: (id: string) => read<Sweep>(`/v1/sweeps/${id}/dismiss`, { method: "POST", body: "" }),
  deleteSweep: (id: string) => call(`/v1/sweeps/${id}`, { method: "DELETE" }),
  pointRequest: (id: string, point: number) => read<RequestDocument>(`/v1/sweeps/${id}/points/${point}/request`),
};

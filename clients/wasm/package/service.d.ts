import type { Solver } from './index.js';

/** Answers what a client asks of the service; jobs and sweeps are kept in memory. */
export class LocalService {
  /** @param files address of the folder with v1/examples.json, v1/limits.json, v1/openapi.json and docs/ */
  constructor(solver: Solver | Promise<Solver>, files: string | URL);
  readonly fetch: (address: string, request?: RequestInit) => Promise<Response>;
}

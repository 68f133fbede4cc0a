/** A finding about a document. */
export interface Finding {
  pointer: string;
  code: string;
  detail: string;
}

/** Documents follow the service's interface (api/openapi/openapi.json); types of each are generated from it. */
export type Document = Record<string, any>;

export interface Progress {
  /** Steps of an analysis so far. */
  done: number;
  /** 0: not known. */
  total: number;
  loadFactor: number;
  branch: number;
  negativeEigenvalues: number;
  /** Arc length of the path up to its last point. */
  arcLength: number;
  /** Values of the monitors at that point, in the order of the model. */
  monitors: number[];
}

export interface SweepProgress {
  done: number;
  total: number;
}

export interface Table extends Document {
  columns: string[];
  points: number[];
  rows: unknown[][];
}

/** The document is wrong, or the analysis was not completed. */
export class SolverError extends Error {
  constructor(status: number, problem: Document);
  status: number;
  problem: Document;
  findings: Finding[];
  reached: Document | null;
}

export class Solver {
  static create(options?: { source?: string | URL | WebAssembly.Module; workers?: number }): Promise<Solver>;
  readonly version: string;
  readonly workers: number;
  solve(request: Document | string, options?: { signal?: AbortSignal; onProgress?: (now: Progress) => void }): Promise<Document>;
  check(document: Document | string, options?: { signal?: AbortSignal }): Promise<Document>;
  plot(document: Document | string, choices?: Document, options?: { signal?: AbortSignal }): Promise<string>;
  sweep(document: Document | string, options?: { signal?: AbortSignal; onProgress?: (now: SweepProgress) => void; onRows?: (part: Table) => void }): Promise<Table>;
  point(document: Document | string, number: number, options?: { signal?: AbortSignal }): Promise<Document>;
  close(): void;
}

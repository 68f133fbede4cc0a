import type { Check, CriticalPointEvent, Description, Job, JobList, JobProgressEvent, Limits, PathPointsEvent, RequestDocument, Result, Sweep, SweepDocument, SweepList, SweepProgressEvent, Table, Warning } from "./documents.js";
import { type ServerEvent } from "./events.js";
/** Whether a job or a sweep with this status has not ended. */
export declare function isActive(status: string): boolean;
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
export type Answer = {
    job: string;
    result: Result;
    cached: boolean;
} | {
    job: string;
    result: null;
};
/** A result, and the job that has it. */
export interface Solution {
    job: string;
    result: Result;
    /** Whether the result was stored already. */
    cached: boolean;
}
/** Calls throw `Refused`, `Unreachable`, or the AbortError of their signal. Several calls may run at the same time. */
export declare class Client {
    private readonly url;
    private readonly key;
    private readonly send;
    private readonly onWarning;
    constructor(options?: ClientOptions);
    /** The result of a request, however long it takes. */
    solve(request: RequestDocument, options?: SolveOptions): Promise<Solution>;
    /** The result of a request if it is there within `wait` seconds (at most `longest_wait_s` of the limits). */
    ask(request: RequestDocument, wait: number, options?: SubmitOptions): Promise<Answer>;
    /** Hands a request in without waiting. */
    submit(request: RequestDocument, options?: SubmitOptions): Promise<Job>;
    /** Every mistake of a request or a sweep, or its size. @param document an object, or its JSON text */
    check(document: RequestDocument | SweepDocument | string, signal?: AbortSignal): Promise<Check>;
    /** Every row of a sweep, however long it takes; rows of points that failed have their code in the column `error`. */
    sweep(document: SweepDocument, options?: SweepOptions): Promise<{
        sweep: Sweep;
        table: Table;
    }>;
    /** Hands a sweep in without waiting. */
    submitSweep(document: SweepDocument, options?: SubmitOptions): Promise<Sweep>;
    /**
     * Calls `take` with each event of a job or sweep until its end, or until `signal` stops it.
     * @param path /v1/jobs/ID or /v1/sweeps/ID
     */
    follow(path: string, take: (event: ServerEvent) => void, signal: AbortSignal): Promise<void>;
    limits(): Promise<Limits>;
    description(): Promise<Description>;
    examples(): Promise<{
        examples: {
            name: string;
            request: RequestDocument;
        }[];
    }>;
    /** @param query as /v1/jobs has it, such as `limit=10&status=failed` */
    jobs(query?: string): Promise<JobList>;
    /** @param wait seconds to wait for its end */
    job(id: string, wait?: number): Promise<Job>;
    jobRequest(id: string): Promise<RequestDocument>;
    jobResult(id: string): Promise<Result>;
    dismissJob(id: string): Promise<Job>;
    /** @param leaving the page is being left, and nobody waits for the answer */
    deleteJob(id: string, leaving?: boolean): Promise<void>;
    /** @param query as /v1/sweeps has it */
    sweeps(query?: string): Promise<SweepList>;
    sweepStatus(id: string): Promise<Sweep>;
    sweepRequest(id: string): Promise<SweepDocument>;
    /** The rows that are there. @param query as the table has it, with its question mark: `?status=failed` */
    sweepTable(id: string, query?: string): Promise<Table>;
    dismissSweep(id: string): Promise<Sweep>;
    deleteSweep(id: string): Promise<void>;
    pointRequest(id: string, point: number): Promise<RequestDocument>;
    /** The response to any request, if it is no error. */
    call(path: string, request?: RequestInit): Promise<Response>;
    /** The JSON document that is the body of the response. */
    read<T>(path: string, request?: RequestInit): Promise<T>;
    private solveUnwatched;
    /** Events are told however fast the analysis is: the job is handed in, and followed, before its result is asked for. */
    private solveWatched;
    /** Follows a job or sweep to its end; when the signal aborts, it is dismissed. */
    private ended;
    /** All rows of a sweep, in as many parts as the service wants. */
    private wholeTable;
}

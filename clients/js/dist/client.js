// The client of the service: what the page at its address uses, and any program in a browser or in Node.
import { idOf, isAbort, Refused, Unreachable } from "./errors.js";
import { follow } from "./events.js";
const kJson = { "Content-Type": "application/json" };
const kLongestWait = 60; // seconds that one request waits for the end of a job: the service's own limit by default
/** Whether a job or a sweep with this status has not ended. */
export function isActive(status) {
    return status === "accepted" || status === "running";
}
function init(method, body, headers, signal) {
    const text = typeof body === "string" ? body : JSON.stringify(body);
    return { method, headers: { ...kJson, ...headers }, body: text, ...(signal ? { signal } : {}) };
}
function envelope(member, document, { label, metadata }) {
    if (label === undefined && metadata === undefined)
        return document;
    return { ...(label === undefined ? {} : { label }), ...(metadata === undefined ? {} : { metadata }), [member]: document };
}
async function problemOf(response) {
    const text = await response.text();
    try {
        return JSON.parse(text);
    }
    catch {
        return {
            type: "urn:snapthrough:problem:internal-error", title: response.statusText, status: response.status, detail: text.slice(0, 500), instance: "",
            request_id: "",
        };
    }
}
function warnOnConsole(warning) {
    console.warn(`snapthrough: ${warning.code}: ${warning.detail}`);
}
/** Calls throw `Refused`, `Unreachable`, or the AbortError of their signal. Several calls may run at the same time. */
export class Client {
    url;
    key;
    send;
    onWarning;
    constructor(options = {}) {
        const { url = "", key = "", onWarning = warnOnConsole } = options;
        this.url = url.replace(/\/+$/, "");
        this.key = typeof key === "function" ? key : () => key;
        this.send = options.fetch ?? ((address, request) => fetch(address, request));
        this.onWarning = onWarning;
    }
    /** The result of a request, however long it takes. */
    async solve(request, options = {}) {
        const watched = options.onProgress ?? options.onPoints ?? options.onCriticalPoint ?? options.signal;
        const solution = watched ? await this.solveWatched(request, options) : await this.solveUnwatched(request, options);
        for (const warning of solution.result.warnings)
            this.onWarning(warning, solution.job);
        return solution;
    }
    /** The result of a request if it is there within `wait` seconds (at most `longest_wait_s` of the limits). */
    async ask(request, wait, options = {}) {
        const response = await this.call("/v1/jobs", init("POST", envelope("request", request, options), {
            Prefer: `wait=${wait}, return=representation`, ...(options.fresh ? { "Cache-Control": "no-cache" } : {}),
        }));
        const job = idOf(response.headers.get("Location") ?? "");
        if (response.status !== 200)
            return { job, result: null };
        const result = (await response.json());
        return { job, result, cached: response.headers.get("X-Cache") === "hit" };
    }
    /** Hands a request in without waiting. */
    submit(request, options = {}) {
        return this.read("/v1/jobs", init("POST", envelope("request", request, options), {
            Prefer: "return=minimal", ...(options.fresh ? { "Cache-Control": "no-cache" } : {}),
        }));
    }
    /** Every mistake of a request or a sweep, or its size. @param document an object, or its JSON text */
    check(document, signal) {
        return this.read("/v1/check", init("POST", document, {}, signal));
    }
    /** Every row of a sweep, however long it takes; rows of points that failed have their code in the column `error`. */
    async sweep(document, options = {}) {
        const submitted = await this.submitSweep(document, options);
        await this.ended(`/v1/sweeps/${submitted.id}`, options.signal, (event) => {
            if (event.type === "progress")
                options.onProgress?.(event.data);
        });
        return { sweep: await this.sweepStatus(submitted.id), table: await this.wholeTable(submitted.id) };
    }
    /** Hands a sweep in without waiting. */
    submitSweep(document, options = {}) {
        return this.read("/v1/sweeps", init("POST", envelope("sweep", document, options), options.fresh ? { "Cache-Control": "no-cache" } : {}));
    }
    /**
     * Calls `take` with each event of a job or sweep until its end, or until `signal` stops it.
     * @param path /v1/jobs/ID or /v1/sweeps/ID
     */
    follow(path, take, signal) {
        return follow((request) => this.call(`${path}/events`, request), take, signal);
    }
    limits() {
        return this.read("/v1/limits");
    }
    description() {
        return this.read("/v1/openapi.json");
    }
    examples() {
        return this.read("/v1/examples");
    }
    /** @param query as /v1/jobs has it, such as `limit=10&status=failed` */
    jobs(query = "") {
        return this.read(`/v1/jobs?${query}`);
    }
    /** @param wait seconds to wait for its end */
    job(id, wait = 0) {
        return this.read(`/v1/jobs/${id}`, wait > 0 ? { headers: { Prefer: `wait=${wait}` } } : {});
    }
    jobRequest(id) {
        return this.read(`/v1/jobs/${id}/request`);
    }
    jobResult(id) {
        return this.read(`/v1/jobs/${id}/result`);
    }
    dismissJob(id) {
        return this.read(`/v1/jobs/${id}/dismiss`, { method: "POST", body: "" });
    }
    /** @param leaving the page is being left, and nobody waits for the answer */
    async deleteJob(id, leaving = false) {
        await this.call(`/v1/jobs/${id}`, { method: "DELETE", keepalive: leaving });
    }
    /** @param query as /v1/sweeps has it */
    sweeps(query = "") {
        return this.read(`/v1/sweeps?${query}`);
    }
    sweepStatus(id) {
        return this.read(`/v1/sweeps/${id}`);
    }
    sweepRequest(id) {
        return this.read(`/v1/sweeps/${id}/request`);
    }
    /** The rows that are there. @param query as the table has it, with its question mark: `?status=failed` */
    sweepTable(id, query = "") {
        return this.read(`/v1/sweeps/${id}/table${query}`);
    }
    dismissSweep(id) {
        return this.read(`/v1/sweeps/${id}/dismiss`, { method: "POST", body: "" });
    }
    async deleteSweep(id) {
        await this.call(`/v1/sweeps/${id}`, { method: "DELETE" });
    }
    pointRequest(id, point) {
        return this.read(`/v1/sweeps/${id}/points/${point}/request`);
    }
    /** The response to any request, if it is no error. */
    async call(path, request = {}) {
        const headers = new Headers(request.headers);
        const key = this.key();
        if (key !== "")
            headers.set("Authorization", `Bearer ${key}`);
        let response;
        try {
            response = await this.send(this.url + path, { ...request, headers });
        }
        catch (error) {
            if (isAbort(error))
                throw error;
            throw new Unreachable("The service does not answer.", { cause: error });
        }
        if (response.ok)
            return response;
        throw new Refused(await problemOf(response), response.headers.get("Location"));
    }
    /** The JSON document that is the body of the response. */
    async read(path, request) {
        const response = await this.call(path, request);
        try {
            return (await response.json());
        }
        catch (error) {
            if (isAbort(error))
                throw error;
            throw new Unreachable("The answer broke off.", { cause: error });
        }
    }
    async solveUnwatched(request, options) {
        const answer = await this.ask(request, kLongestWait, options);
        if (answer.result)
            return answer;
        while (isActive((await this.job(answer.job, kLongestWait)).status))
            ;
        return { job: answer.job, result: await this.jobResult(answer.job), cached: false };
    }
    /** Events are told however fast the analysis is: the job is handed in, and followed, before its result is asked for. */
    async solveWatched(request, options) {
        const { id, status } = await this.submit(request, options);
        await this.ended(`/v1/jobs/${id}`, options.signal, (event) => {
            if (event.type === "progress")
                options.onProgress?.(event.data);
            if (event.type === "points")
                options.onPoints?.(event.data);
            if (event.type === "critical_point")
                options.onCriticalPoint?.(event.data);
        });
        return { job: id, result: await this.jobResult(id), cached: status === "successful" };
    }
    /** Follows a job or sweep to its end; when the signal aborts, it is dismissed. */
    async ended(path, signal, take) {
        const never = new AbortController().signal;
        try {
            await this.follow(path, take, signal ?? never);
            signal?.throwIfAborted();
        }
        catch (error) {
            if (signal?.aborted)
                await this.call(`${path}/dismiss`, { method: "POST", body: "" }).catch(() => undefined);
            throw error;
        }
    }
    /** All rows of a sweep, in as many parts as the service wants. */
    async wholeTable(id) {
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

export interface ServerEvent {
    id: string;
    type: string;
    data: unknown;
}
/** The event of one block of lines, or nothing for a comment. */
export declare function parseEvent(block: string): ServerEvent | null;
/**
 * Calls `take` with each event until the stream ends or `signal` stops it. Throws as `open` does; a stream that breaks off is taken
 * up where it was left.
 * @param open the response of the stream to a request with these headers
 */
export declare function follow(open: (init: RequestInit) => Promise<Response>, take: (event: ServerEvent) => void, signal: AbortSignal): Promise<void>;

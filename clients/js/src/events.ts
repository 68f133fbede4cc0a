// Server-sent events read by fetch, since an EventSource cannot send a key.

export interface ServerEvent {
  id: string;
  type: string;
  data: unknown;
}

/** The event of one block of lines, or nothing for a comment. */
export function parseEvent(block: string): ServerEvent | null {
  const event = { id: "", type: "message", data: "" };
  for (const line of block.split("\n")) {
    const colon = line.indexOf(":");
    const field = colon < 0 ? line : line.slice(0, colon);
    const value = colon < 0 ? "" : line.slice(colon + 1).replace(/^ /, "");
    if (field === "id") event.id = value;
    if (field === "event") event.type = value;
    if (field === "data") event.data += (event.data === "" ? "" : "\n") + value;
  }
  return event.data === "" ? null : { ...event, data: JSON.parse(event.data) as unknown };
}

/**
 * Calls `take` with each event until the stream ends or `signal` stops it. Throws as `open` does; a stream that breaks off is taken
 * up where it was left.
 * @param open the response of the stream to a request with these headers
 */
export async function follow(open: (init: RequestInit) => Promise<Response>, take: (event: ServerEvent) => void,
                             signal: AbortSignal): Promise<void> {
  let seen = "";
  for (let ended = false; !ended && !signal.aborted;) {
    const headers: Record<string, string> = seen === "" ? {} : { "Last-Event-ID": seen };
    const response = await open({ headers, signal });
    if (response.status === 204 || !response.body) return;
    ended = await readStream(response.body, (event) => {
      seen = event.id === "" ? seen : event.id;
      take(event);
    });
  }
}

/** Whether the stream came to its `end` event. */
async function readStream(body: ReadableStream<Uint8Array>, take: (event: ServerEvent) => void): Promise<boolean> {
  const reader = body.getReader();
  const decoder = new TextDecoder();
  let text = "";
  let ended = false;
  for (;;) {
    const { done, value } = await reader.read().catch(() => ({ done: true, value: undefined }));
    if (done) return ended;
    text += decoder.decode(value, { stream: true });
    const blocks = text.split("\n\n");
    text = blocks.pop() ?? "";
    for (const block of blocks) {
      const event = parseEvent(block);
      if (event) take(event);
      ended ||= event?.type === "end";
    }
  }
}

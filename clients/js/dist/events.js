// Server-sent events read by fetch, since an EventSource cannot send a key.
/** The event of one block of lines, or nothing for a comment. */
export function parseEvent(block) {
    const event = { id: "", type: "message", data: "" };
    for (const line of block.split("\n")) {
        const colon = line.indexOf(":");
        const field = colon < 0 ? line : line.slice(0, colon);
        const value = colon < 0 ? "" : line.slice(colon + 1).replace(/^ /, "");
        if (field === "id")
            event.id = value;
        if (field === "event")
            event.type = value;
        if (field === "data")
            event.data += (event.data === "" ? "" : "\n") + value;
    }
    return event.data === "" ? null : { ...event, data: JSON.parse(event.data) };
}
/**
 * Calls `take` with each event until the stream ends or `signal` stops it. Throws as `open` does; a stream that breaks off is taken
 * up where it was left.
 * @param open the response of the stream to a request with these headers
 */
export async function follow(open, take, signal) {
    let seen = "";
    for (let ended = false; !ended && !signal.aborted;) {
        const headers = seen === "" ? {} : { "Last-Event-ID": seen };
        const response = await open({ headers, signal });
        if (response.status === 204 || !response.body)
            return;
        ended = await readStream(response.body, (event) => {
            seen = event.id === "" ? seen : event.id;
            take(event);
        });
    }
}
/** Whether the stream came to its `end` event. */
async function readStream(body, take) {
    const reader = body.getReader();
    const decoder = new TextDecoder();
    let text = "";
    let ended = false;
    for (;;) {
        const { done, value } = await reader.read().catch(() => ({ done: true, value: undefined }));
        if (done)
            return ended;
        text += decoder.decode(value, { stream: true });
        const blocks = text.split("\n\n");
        text = blocks.pop() ?? "";
        for (const block of blocks) {
            const event = parseEvent(block);
            if (event)
                take(event);
            ended ||= event?.type === "end";
        }
    }
}

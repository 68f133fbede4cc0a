// The service for the page: its client with the key of this browser tab, and whether the service is there at all.

import { Client, type Answer } from "../../../clients/js/src/client.js";
import { Refused, Unreachable } from "../../../clients/js/src/errors.js";
import { makeStore } from "../store";
import type { Job, RequestDocument } from "./documents";
import { isLocal, send } from "./local";

export { isActive, type Answer } from "../../../clients/js/src/client.js";
export { idOf, isAbort, Refused, Unreachable } from "../../../clients/js/src/errors.js";

const kKeyName = "snapthrough-key";
const kAskAgain = 1000;  // ms between questions whether a service that was gone is back
const kStudioLabel = "studio";

/** How the service is doing. `visits` counts how often it came back after it was gone. */
export const connection = makeStore<{ state: "there" | "gone" | "key"; visits: number }>({ state: "there", visits: 0 });

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
    const alive = await send("/livez", { cache: "no-store" }).catch(() => null);
    if (alive?.ok) break;
  }
  connection.set({ state: "there", visits: connection.get().visits + 1 });
}

function serviceIsGone(): void {
  if (connection.get().state === "gone") return;
  connection.change({ state: "gone" });
  void waitForService();
}

/** Notes when no answer came, or when a key is asked for. */
async function noted<T>(work: Promise<T>): Promise<T> {
  try {
    return await work;
  } catch (error) {
    if (error instanceof Unreachable) serviceIsGone();
    if (error instanceof Refused && error.problem.status === 401) connection.change({ state: "key" });
    throw error;
  }
}

class PageClient extends Client {
  override call(path: string, request: RequestInit = {}): Promise<Response> {
    return noted(super.call(path, request));
  }
  override read<T>(path: string, request?: RequestInit): Promise<T> {
    return noted(super.read<T>(path, request));
  }
  async interface(): Promise<string> {
    return (await this.call("/v1/openapi.json")).text();
  }
  async document(name: string): Promise<string> {
    return (await this.call(`/docs/${name}.md`)).text();
  }
  /** A request that lies beside the documents. @param name such as gallery/liner */
  requestOfDocument(name: string): Promise<RequestDocument> {
    return this.read<RequestDocument>(`/docs/${name}.json`);
  }
}

/** Warnings are shown with the result. */
export const service = new PageClient({ key: () => key, onWarning: () => undefined, ...(isLocal ? { fetch: send } : {}) });

/** Hands in for the studio without waiting: the job is known at once. */
export function submit(request: RequestDocument): Promise<Job> {
  return service.submit(request, { label: kStudioLabel });
}

/** Asks for the studio. @param wait seconds */
export function solve(request: RequestDocument, wait: number): Promise<Answer> {
  return service.ask(request, wait, { label: kStudioLabel });
}

// The request as JSON: an editor that is loaded when it is opened, with every mistake at its place. A text without mistakes
// is the request at once.

import { useEffect, useRef, useState } from "preact/hooks";
import type { Finding, RequestDocument } from "../api/documents";
import { service } from "../api/client";
import type { Editor } from "../editor/editor";
import { findingsOf } from "./trouble";
import { saveJson } from "../export/files";

interface JsonProps {
  request: RequestDocument;
  onChange: (request: RequestDocument) => void;
}

const kLine = 76;  // characters

function flatJson(value: unknown): string {
  if (typeof value !== "object" || value === null) return JSON.stringify(value);
  if (Array.isArray(value)) return `[${(value as unknown[]).map(flatJson).join(", ")}]`;
  return `{${Object.entries(value).map(([name, one]) => `${JSON.stringify(name)}: ${flatJson(one)}`).join(", ")}}`;
}

/** JSON with what is short on one line, as people write it. */
export function prettyJson(value: unknown, indent = ""): string {
  const flat = flatJson(value);
  if (typeof value !== "object" || value === null || (indent !== "" && flat.length + indent.length <= kLine)) return flat;
  const inner = `${indent}  `;
  const [open, close] = Array.isArray(value) ? "[]" : "{}";
  const parts = Array.isArray(value)
    ? (value as unknown[]).map((one) => inner + prettyJson(one, inner))
    : Object.entries(value).map(([name, one]) => `${inner}${JSON.stringify(name)}: ${prettyJson(one, inner)}`);
  return `${open ?? ""}\n${parts.join(",\n")}\n${indent}${close ?? ""}`;
}

async function readFile(file: File | undefined, editor: Editor | null, take: (text: string) => void): Promise<void> {
  if (!file) return;
  const text = await file.text();
  editor?.setText(text);
  take(text);
}

export function JsonPanel({ request, onChange }: JsonProps) {
  const place = useRef<HTMLDivElement>(null);
  const editor = useRef<Editor | null>(null);
  const own = useRef<RequestDocument>(request);  // what the text says
  const [findings, setFindings] = useState<readonly Finding[]>([]);
  const [trouble, setTrouble] = useState("");
  const check = async (text: string): Promise<readonly Finding[]> => {
    const answer = await service.check(text).catch((error: unknown) => ({ valid: false, errors: [...findingsOf(error)] }));
    setFindings(answer.errors);
    if (answer.valid && text !== prettyJson(own.current)) {
      own.current = JSON.parse(text) as RequestDocument;
      onChange(own.current);
    }
    return answer.errors;
  };
  useEffect(() => {
    let ended = false;
    import("../editor/editor").then(({ makeEditor }) => {
      if (ended || !place.current) return;
      editor.current = makeEditor(place.current, {
        text: prettyJson(own.current), check, description: service.description(), onText: () => undefined,
      });
    }, () => setTrouble("The editor could not be loaded."));
    return () => {
      ended = true;
      editor.current?.destroy();
      editor.current = null;
    };
  }, []);
  useEffect(() => {
    if (request === own.current) return;
    own.current = request;
    editor.current?.setText(prettyJson(request));
  }, [request]);
  return (
    <div class="json" onDragOver={(event) => event.preventDefault()} onDrop={(event) => {
      event.preventDefault();
      void readFile(event.dataTransfer?.files[0], editor.current, (text) => void check(text));
    }}>
      {trouble ? <p class="wrong">{trouble}</p> : null}
      <p class={findings.length > 0 ? "wrong" : "hint"} role="status">
        {findings.length === 0 ? "No mistakes. What is typed is solved at once; a file can be dropped here."
          : `${findings.length} ${findings.length === 1 ? "mistake, marked at its place." : "mistakes, each marked at its place."}`}</p>
      {findings.length > 0
        ? <ul class="findings">{findings.slice(0, 8).map((one, i) => <li key={i}><code>{one.pointer || "/"}</code> {one.detail}</li>)}</ul> : null}
      <div class="editor" ref={place} />
      <div class="buttons"><button type="button" onClick={() => saveJson("request.json", request)}>Save as a file</button></div>
    </div>
  );
}

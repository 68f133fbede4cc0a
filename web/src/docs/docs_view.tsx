// The documents inside the page: the list of them, or one, with its reader loaded when it is opened.

import { useEffect, useState } from "preact/hooks";
import { service } from "../api/client";
import { documentAddress, kContents } from "./contents";
import type { MarkdownView } from "./document";

function Contents() {
  return (
    <main id="main" tabIndex={-1} class="plain">
      <section class="card contents">
        <h1>Documents</h1>
        <dl>
          {kContents.map(({ name, heading, text }) => (
            <div key={name}><dt><a href={documentAddress(name)}>{heading}</a></dt><dd>{text}</dd></div>
          ))}
          <div><dt><a href="/v1/openapi.json">The interface</a></dt><dd>Every address and every field, as an OpenAPI document.</dd></div>
        </dl>
      </section>
    </main>
  );
}

interface Loaded {
  name: string;
  text: string;
  View: typeof MarkdownView;
}

export function DocsView({ name, section }: { name: string | null; section: string }) {
  const [loaded, setLoaded] = useState<Loaded | null>(null);
  const [trouble, setTrouble] = useState("");
  useEffect(() => {
    if (name === null) return;
    let left = false;
    setTrouble("");
    Promise.all([service.document(name), import("./document")]).then(([text, module]) => {
      if (!left) setLoaded({ name, text, View: module.MarkdownView });
    }, (error: unknown) => {
      if (!left) setTrouble(error instanceof Error ? error.message : "The document could not be loaded.");
    });
    return () => { left = true; };
  }, [name]);
  if (name === null) return <Contents />;
  return (
    <main id="main" tabIndex={-1} class="plain docs">
      {loaded?.name === name ? <loaded.View name={name} text={loaded.text} section={section} />
        : <section class="card"><p class={trouble ? "wrong" : "hint"}>{trouble || "Loading…"}</p>
            {trouble ? <p><a href="#/docs">All documents</a></p> : null}</section>}
    </main>
  );
}

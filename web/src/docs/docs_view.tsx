// The documents inside the page: the list of them, or one, with its reader loaded when it is opened.

import type { ComponentType } from "preact";
import { useEffect, useState } from "preact/hooks";
import { service } from "../api/client";
import { documentAddress, kContents } from "./contents";

function Contents() {
  return (
    <main id="main" tabIndex={-1} class="plain">
      <section class="card contents">
        <h1>Documents</h1>
        <dl>
          {kContents.map(({ name, heading, text }) => (
            <div key={name}><dt><a href={documentAddress(name)}>{heading}</a></dt><dd>{text}</dd></div>
          ))}
        </dl>
      </section>
    </main>
  );
}

interface Loaded {
  name: string;
  text: string;
  View: ComponentType<{ name: string; text: string; section: string }>;
}

/** The text of a document, and what shows it. */
async function load(name: string): Promise<Loaded> {
  if (name === "interface") {
    const [text, module] = await Promise.all([service.interface(), import("./interface")]);
    return { name, text, View: module.InterfaceView };
  }
  const [text, module] = await Promise.all([service.document(name), import("./document")]);
  return { name, text, View: module.MarkdownView };
}

export function DocsView({ name, section }: { name: string | null; section: string }) {
  const [loaded, setLoaded] = useState<Loaded | null>(null);
  const [trouble, setTrouble] = useState("");
  useEffect(() => {
    if (name === null) return;
    let left = false;
    setTrouble("");
    load(name).then((document) => {
      if (!left) setLoaded(document);
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

// A white card with a title, and a menu of what can be taken from it.

import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";

interface CardProps {
  title: string;
  class?: string;
  /** Controls at the right of the title. */
  tools?: ComponentChildren;
  children: ComponentChildren;
}

export function Card({ title, tools, children, class: name = "" }: CardProps) {
  return (
    <section class={`card ${name}`} aria-label={title}>
      <header class="card-head">
        <h2>{title}</h2>
        {tools ? <div class="tools">{tools}</div> : null}
      </header>
      {children}
    </section>
  );
}

export interface MenuItem {
  text: string;
  act: () => void;
}

/** A small menu that closes when something is chosen, on Escape, and when the focus leaves it. */
export function Menu({ label, items }: { label: string; items: MenuItem[] }) {
  const place = useRef<HTMLDetailsElement>(null);
  const close = (): void => {
    if (place.current) place.current.open = false;
  };
  useEffect(() => {
    const outside = (event: Event): void => {
      if (place.current && !place.current.contains(event.target as Node)) close();
    };
    document.addEventListener("pointerdown", outside);
    return () => document.removeEventListener("pointerdown", outside);
  }, []);
  return (
    <details class="menu" ref={place} onKeyDown={(event) => {
      if (event.key === "Escape") {
        close();
        place.current?.querySelector("summary")?.focus();
      }
    }}>
      <summary>{label}</summary>
      <div class="menu-items">
        {items.map(({ text, act }) => (
          <button type="button" key={text} onClick={() => {
            close();
            act();
          }}>{text}</button>
        ))}
      </div>
    </details>
  );
}

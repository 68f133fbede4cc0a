// The frame of every view: where one can go, how the service is doing, and the key when it asks for one.

import { useEffect, useRef, useState } from "preact/hooks";
import { connection, forgetKey, hasKey, setKey } from "../api/client";
import { DocsView } from "../docs/docs_view";
import { formatNumber } from "../figures";
import { JobView } from "../jobs/job_view";
import { JobsView } from "../jobs/jobs_view";
import { useStore } from "../store";
import { studio } from "../studio/session";
import { StudioView, titleOf } from "../studio/studio";
import { SweepView } from "../sweeps/sweep_view";
import { SweepsView } from "../sweeps/sweeps_view";
import { useRoute, type Route } from "./router";

const kViews: [string, string][] = [["studio", "Studio"], ["sweeps", "Sweeps"], ["jobs", "Jobs"], ["docs", "Documents"]];

function ServiceState() {
  const { state } = useStore(connection);
  const { run, busy } = useStore(studio);
  if (state === "gone") return <span class="state"><span class="dot gone" aria-hidden="true" />no answer</span>;
  const time = run && run.milliseconds > 0 ? `${formatNumber(run.milliseconds, 2)} ms` : "ready";
  return (
    <span class="state" title="From asking to having the last answer">
      <span class={`dot ${busy ? "busy" : "there"}`} aria-hidden="true" />{time}
    </span>
  );
}

function Header({ route }: { route: Route }) {
  const here = route.view === "model" ? "studio" : route.view;
  return (
    <header class="top">
      <a class="name" href="#/studio">snapthrough</a>
      <nav aria-label="Views">
        {kViews.map(([view, text]) => (
          <a key={view} href={`#/${view}`} aria-current={here === view ? "page" : undefined}>{text}</a>
        ))}
      </nav>
      {hasKey() ? <button type="button" class="quiet" onClick={forgetKey}>Forget key</button> : null}
      <ServiceState />
    </header>
  );
}

/** Asks for the key while the service wants one that it has not been given. */
function KeyDialog() {
  const { state } = useStore(connection);
  const dialog = useRef<HTMLDialogElement>(null);
  const [text, setText] = useState("");
  useEffect(() => {
    if (state === "key" && !dialog.current?.open) dialog.current?.showModal();
    if (state !== "key") dialog.current?.close();
  }, [state]);
  return (
    <dialog ref={dialog} class="key" aria-labelledby="key-title" onCancel={(event) => event.preventDefault()}>
      <form onSubmit={(event) => {
        event.preventDefault();
        setKey(text.trim());
        setText("");
      }}>
        <h2 id="key-title">This service needs a key</h2>
        <p class="hint">
          {hasKey() ? "The key that was given is not known here. " : ""}It is kept until this tab is closed, and sent to this
          service only.
        </p>
        <input type="password" autocomplete="off" aria-label="Key" required value={text}
               onInput={(event) => setText(event.currentTarget.value)} />
        <button type="submit" class="main">Go on</button>
      </form>
    </dialog>
  );
}

function Gone() {
  const { state } = useStore(connection);
  return state === "gone"
    ? (
      <div class="gone-banner" role="alert">
        The service does not answer. This page asks again every second and goes on when it is back.
      </div>
    )
    : null;
}

function Nowhere() {
  return (
    <main id="main" tabIndex={-1} class="plain">
      <section class="card"><h1>There is nothing at this address</h1><p><a href="#/studio">Go to the studio</a></p></section>
    </main>
  );
}

function View({ route }: { route: Route }) {
  switch (route.view) {
    case "jobs": return route.id ? <JobView key={route.id} id={route.id} /> : <JobsView />;
    case "sweeps": return route.id ? <SweepView key={route.id} id={route.id} /> : <SweepsView />;
    case "docs": return <DocsView name={route.id} section={route.query.get("at") ?? ""} />;
    case "studio":
    case "model": return <StudioView view={route.view} query={route.query} />;
    default: return <Nowhere />;
  }
}

export function Shell() {
  const route = useRoute();
  const state = useStore(studio);
  useEffect(() => {
    const title = route.view === "studio" || route.view === "model" ? titleOf(state) : [route.view, route.id].filter(Boolean).join(" ");
    document.title = title === "" ? "snapthrough" : `${title} – snapthrough`;
  }, [route, state.problem, state.request]);
  return (
    <>
      <a class="skip" href="#main" onClick={(event) => {
        event.preventDefault();
        document.getElementById("main")?.focus();
      }}>Skip to the content</a>
      <Header route={route} />
      <Gone />
      <View route={route} />
      <KeyDialog />
    </>
  );
}

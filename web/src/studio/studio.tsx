// The studio: a model and its sliders at the left; its drawing, path, sections and trust at the right.

import { useEffect, useMemo, useState } from "preact/hooks";
import { service } from "../api/client";
import { go } from "../app/router";
import { useNarrow } from "../app/size";
import { documentAddress, sectionName } from "../docs/contents";
import { formatNumber, type PathShadow } from "../figures";
import type { Problem } from "../model/gallery";
import { kProblems } from "../model/problems";
import type { Run } from "../model/run";
import { sliderFor, valueOf, type Slider } from "../model/sliders";
import { withValue } from "../model/pointer";
import { useStore } from "../store";
import { Card } from "../views/card";
import { ResultViews } from "../views/result_views";
import { useGallery } from "./gallery_dialog";
import { JsonPanel } from "./json_panel";
import { ModelForm } from "./model_form";
import { isStale, keep, openAny, openExample, openFirst, openProblem, pin, restore, setRequest, setSlider, setSliders, studio, takeDocument, unpin, type Studio } from "./session";
import { SliderRow } from "./slider_row";
import { SweepBuilder } from "../sweeps/sweep_builder";
import { findingsOf, Trouble } from "./trouble";

type Panel = "model" | "json" | "sweep";
const kPanels: [Panel, string][] = [["model", "Model"], ["json", "JSON"], ["sweep", "Sweep"]];

function Sliders({ state }: { state: Studio }) {
  const { request, sliders, problem } = state;
  if (!request) return null;
  return (
    <div class="sliders">
      {sliders.map((slider, i) => (
        <SliderRow key={slider.targets[0]?.pointer ?? i} slider={slider} request={request}
                   onValue={(value) => setSlider(slider, value)}
                   onRemove={problem?.sliders.includes(slider) ? null : () => setSliders(sliders.filter((one) => one !== slider))} />
      ))}
    </div>
  );
}

/** Pinned runs, each of which can be taken off the chart. */
function Pins({ state }: { state: Studio }) {
  if (state.pins.length === 0) return null;
  return (
    <ul class="pins" aria-label="Pinned runs">
      {state.pins.map((run) => (
        <li key={run.job}><span>{run.label || "pinned run"}</span>
          <button type="button" class="quiet" aria-label={`Unpin ${run.label}`} onClick={() => unpin(run)}>Unpin</button></li>
      ))}
    </ul>
  );
}

function Actions({ state }: { state: Studio }) {
  const [said, say] = useState("");
  const share = async (): Promise<void> => {
    const { run } = studio.get();
    if (!run) return;
    keep();
    const address = `${location.origin}/#/jobs/${run.job}`;
    const here = /^(localhost|127\.|\[::1\])/.test(location.hostname) ? ", for this computer only: others need the request" : "";
    await navigator.clipboard.writeText(address).then(() => say(`Address copied${here}`), () => say(`${address}${here}`));
    setTimeout(() => say(""), 4000);
  };
  const ready = state.run !== null && !isStale(state);
  return (
    <div class="buttons">
      <button type="button" disabled={!ready} onClick={pin}>Pin this run</button>
      <button type="button" disabled={!ready} onClick={() => void share()}>Share</button>
      <span class="said" role="status">{said}</span>
    </div>
  );
}

/** Where a document says more about a problem. */
function addressOfDocument({ document: own, heading }: Problem): string {
  return own ? documentAddress(own.name) : documentAddress("gallery", sectionName(heading));
}

function PanelOf({ panel, state }: { panel: Panel; state: Studio }) {
  const { request, sliders, trouble } = state;
  const slid = useMemo(() => new Set(sliders.flatMap((slider) => slider.targets.map((target) => target.pointer))), [sliders]);
  if (!request) return null;
  switch (panel) {
    case "model":
      return <ModelForm request={request} findings={findingsOf(trouble)} slid={slid} onChange={setRequest}
                        onSlider={(pointer) => {
                          const slider = sliderFor(request, pointer);
                          if (slider) setSliders([...sliders, slider]);
                        }} />;
    case "json":
      return <JsonPanel request={request} onChange={takeDocument} />;
    case "sweep":
      return <SweepBuilder request={request} sliders={sliders} />;
  }
}

function Editing({ panel, onPanel, state }: { panel: Panel; onPanel: (panel: Panel) => void; state: Studio }) {
  return (
    <>
      <div class="tabs" role="tablist" aria-label="Edit">
        {kPanels.map(([name, text]) => (
          <button type="button" role="tab" key={name} id={`tab-${name}`} aria-selected={panel === name} aria-controls="panel"
                  onClick={() => onPanel(name)}>{text}</button>
        ))}
      </div>
      <div id="panel" role="tabpanel" aria-labelledby={`tab-${panel}`}><PanelOf panel={panel} state={state} /></div>
    </>
  );
}

/** How a run differs from the one that is shown: values of the sliders, and its critical load. */
function differenceOf(one: Run, shown: Run | null, sliders: readonly Slider[]): string {
  const values = sliders.flatMap((slider) => {
    const value = valueOf(slider, one.request);
    const same = shown !== null && value === valueOf(slider, shown.request);
    return value === null || same ? [] : [`${slider.name} ${formatNumber(value, 3)}`];
  });
  const other = shown && JSON.stringify(one.request.model) !== JSON.stringify(shown.request.model) ? "another model" : one.label;
  const load = one.result.summary.critical_load_factor;
  return `${values.length > 0 ? values.join(", ") : other}${load === null ? "" : `: ${formatNumber(load)}`}`;
}

function shadowsOf({ shadow, pins, run, sliders }: Studio): PathShadow[] {
  const shadows: PathShadow[] = [];
  const pinned = pins.filter((one) => one.job !== run?.job);
  if (shadow && shadow.job !== run?.job && !pinned.some((one) => one.job === shadow.job)) {
    shadows.push({ label: `before: ${differenceOf(shadow, run, sliders)}`, result: shadow.result, kind: "earlier" });
  }
  return [...shadows, ...pinned.map((one): PathShadow => ({ label: `pinned: ${differenceOf(one, run, sliders)}`, result: one.result, kind: "pinned" }))];
}

/** Which panel is open: the address says it for the model, so that it can be shared. */
function usePanel(view: string): [Panel, (panel: Panel) => void] {
  const [panel, setPanel] = useState<Panel>(view === "model" ? "json" : "model");
  useEffect(() => {
    if (view === "model") setPanel("json");
  }, [view]);
  return [panel, (next) => {
    setPanel(next);
    go(next === "json" ? "#/model" : "#/studio");
  }];
}

export function StudioView({ view, query }: { view: string; query: URLSearchParams }) {
  const state = useStore(studio);
  const [panel, setPanel] = usePanel(view);
  const wanted = query.get("problem");
  const example = query.get("example");
  const job = query.get("job");
  useEffect(() => {
    const problem = kProblems.find((one) => one.example === wanted);
    if (studio.get().request === null && !job && !example && restore(problem ?? null)) return;
    if (problem && studio.get().problem !== problem) void openProblem(problem);
    else if (job) void service.jobRequest(job).then(openAny, () => openFirst());
    else if (example) void openExample(example);
    else openFirst();
  }, [wanted, job, example]);
  const shadows = useMemo(() => shadowsOf(state), [state.shadow, state.pins, state.run, state.sliders]);
  const { request, problem } = state;
  const gallery = useGallery(problem, (next) => {
    go(`#/studio?problem=${next.example}`);
    if (studio.get().problem === next) void openProblem(next);
  });
  const narrow = useNarrow();
  const editing = <Editing panel={panel} onPanel={setPanel} state={state} />;
  return (
    <main id="main" tabIndex={-1} class={`studio ${panel === "json" ? "wide" : ""} ${isStale(state) ? "stale" : ""}`}>
      <Card title="Model" class="controls" tools={<button type="button" onClick={gallery.open}>Gallery</button>}>
        <div class="scroll">
          <h1 class={problem ? "" : "long"}>{problem?.heading ?? request?.model.title ?? "Model"}</h1>
          {problem ? <p class="text">{problem.text} <a href={addressOfDocument(problem)}>More about it</a></p> : null}
          <Sliders state={state} />
          <Trouble error={state.trouble} />
          {narrow ? null : editing}
          <Pins state={state} />
        </div>
        <Actions state={state} />
      </Card>
      {request ? (
        <ResultViews request={request} run={state.run} growing={state.growing} shadows={shadows} choice={state.choice}
                     stale={isStale(state)} onChoice={(choice) => studio.change({ choice })}
                     onFollow={request.analysis.type === "path"
                       ? () => setRequest(withValue(request, "/analysis/branches/follow", "first")) : undefined} />
      ) : <Card title="Drawing" class="drawing-card"><p class="hint">Loading…</p></Card>}
      {narrow ? <Card title="Edit" class="editing">{editing}</Card> : null}
      {gallery.dialog}
    </main>
  );
}

/** Values of the sliders in words, for the title of the tab. */
export function titleOf({ problem, request, sliders }: Studio): string {
  const first = sliders[0];
  const value = first && request ? valueOf(first, request) : null;
  const name = problem?.heading ?? request?.model.title ?? "";
  return first && value !== null ? `${name}, ${first.name} ${formatNumber(value, 3)}` : name;
}

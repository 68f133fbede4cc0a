// Jobs, newest first: live, filtered by state, analysis and label.

import { useEffect, useState } from "preact/hooks";
import type { Job } from "../api/documents";
import { isActive, service } from "../api/client";
import { usePolled } from "../app/polled";
import { ago, badgeOf, duration, kStatuses } from "../app/words";
import { formatNumber } from "../figures";
import { Trouble } from "../studio/trouble";
import { kindOf } from "../views/trust_card";

const kEvery = 2000;  // ms
const kPage = 25;
const kAnalyses = ["critical", "path", "buckling", "static", "vibration"] as const;

interface Critical {
  load: number | null;
  kind: string;
}

const known = new Map<string, Promise<Critical>>();  // results never change
const kMostKnown = 500;

/** The first row of a small CSV table, by column. */
function firstRow(csv: string): Record<string, string> {
  const [head = "", row = ""] = csv.split(/\r?\n/);
  const cells = row.split(",");
  return row === "" ? {} : Object.fromEntries(head.split(",").map((name, i) => [name, cells[i] ?? ""]));
}

async function readCritical(job: Job): Promise<Critical> {
  const table = job.analysis === "buckling" ? "buckling" : "critical_points";
  const row = firstRow(await (await service.call(`/v1/jobs/${job.id}/result?format=csv&table=${table}`)).text());
  const load = Number(row["load_factor"] ?? "");
  const there = row["load_factor"] !== undefined && row["confirmed"] !== "0" && row["confirmed"] !== "false";
  return { load: there && Number.isFinite(load) ? load : null, kind: row["type"] ?? (table === "buckling" ? "buckling" : "") };
}

function criticalOf(job: Job): Promise<Critical> {
  const found = known.get(job.id);
  if (found) return found;
  if (known.size > kMostKnown) known.clear();
  const asked = readCritical(job);
  known.set(job.id, asked);
  asked.catch(() => known.delete(job.id));
  return asked;
}

function CriticalCells({ job }: { job: Job }) {
  const [critical, setCritical] = useState<Critical | null>(null);
  useEffect(() => {
    let current = true;
    if (job.status === "successful" && job.analysis !== "static" && job.analysis !== "vibration") {
      criticalOf(job).then((value) => (current ? setCritical(value) : undefined), () => undefined);
    }
    return () => {
      current = false;
    };
  }, [job.id, job.status]);
  return (
    <>
      <td>{critical?.load == null ? "" : formatNumber(critical.load, 5)}</td>
      <td class="left minor">{critical?.load == null ? "" : kindOf(critical.kind)}</td>
    </>
  );
}

function Row({ job, onChanged }: { job: Job; onChanged: () => void }) {
  const busy = isActive(job.status);
  const act = (work: Promise<unknown>): void => {
    void work.catch(() => undefined).then(onChanged);
  };
  return (
    <tr>
      <td><span class={badgeOf(job.status)}>{job.status}</span></td>
      <td class="left wide"><a href={`#/jobs/${job.id}`}>{job.title === "" ? job.id : job.title}</a>
        {job.error ? <span class="wrong">{job.error.code.replace(/_/g, " ")}</span> : null}</td>
      <td class="left minor">{job.label ?? ""}</td>
      <td class="left minor">{job.analysis}</td>
      <CriticalCells job={job} />
      <td class="minor">{duration(job.started, job.finished)}</td>
      <td class="minor">{ago(job.created)}</td>
      <td class="minor">
        {busy
          ? <button type="button" class="quiet" aria-label={`Dismiss ${job.title}`}
                    onClick={() => act(service.dismissJob(job.id))}>Dismiss</button>
          : <button type="button" class="quiet" aria-label={`Delete ${job.title}`}
                    onClick={() => act(service.deleteJob(job.id))}>Delete</button>}
      </td>
    </tr>
  );
}

export function JobsView() {
  const [filter, setFilter] = useState({ status: "", analysis: "", label: "" });
  const [cursors, setCursors] = useState<string[]>([]);
  const query = new URLSearchParams({ limit: String(kPage) });
  for (const [name, value] of Object.entries(filter)) if (value !== "") query.set(name, value);
  const cursor = cursors[cursors.length - 1];
  if (cursor !== undefined) query.set("cursor", cursor);
  const [list, trouble, again] = usePolled(() => service.jobs(query.toString()), query.toString(), kEvery);
  const set = (part: Partial<typeof filter>): void => {
    setFilter({ ...filter, ...part });
    setCursors([]);
  };
  const next = list?.links.find((link) => link.rel === "next");
  const nextCursor = next ? new URL(next.href, location.href).searchParams.get("cursor") : null;
  return (
    <main id="main" tabIndex={-1} class="plain">
      <section class="card" aria-labelledby="jobs-title">
        <h1 id="jobs-title">Jobs</h1>
        <div class="filters">
          <label>State <select value={filter.status} onChange={(event) => set({ status: event.currentTarget.value })}>
            <option value="">all</option>{kStatuses.map((one) => <option key={one}>{one}</option>)}</select></label>
          <label>Analysis <select value={filter.analysis} onChange={(event) => set({ analysis: event.currentTarget.value })}>
            <option value="">all</option>{kAnalyses.map((one) => <option key={one}>{one}</option>)}</select></label>
          <label>Label <input type="search" value={filter.label} onChange={(event) => set({ label: event.currentTarget.value.trim() })} /></label>
        </div>
        <Trouble error={trouble} />
        <div class="scroller" tabIndex={0} role="region" aria-label="Table of jobs">
          <table class="list">
            <thead><tr><th scope="col">State</th><th scope="col" class="left">Model</th><th scope="col" class="left minor">Label</th>
              <th scope="col" class="left minor">Analysis</th><th scope="col">Critical load</th><th scope="col" class="left minor">Kind</th>
              <th scope="col" class="minor">Time</th><th scope="col" class="minor">Submitted</th><th scope="col" class="minor"><span class="unseen">Actions</span></th></tr></thead>
            <tbody>{list?.jobs.map((job) => <Row key={job.id} job={job} onChanged={again} />)}</tbody>
          </table>
        </div>
        {list && list.jobs.length === 0
          ? <p class="hint">No jobs. Change a slider in the <a href="#/studio">studio</a>, or send one with curl.</p> : null}
        <div class="buttons">
          <button type="button" disabled={cursors.length === 0} onClick={() => setCursors(cursors.slice(0, -1))}>Newer</button>
          <button type="button" disabled={nextCursor === null}
                  onClick={() => nextCursor !== null && setCursors([...cursors, nextCursor])}>Older</button>
        </div>
      </section>
    </main>
  );
}

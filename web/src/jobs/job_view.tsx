// One job: what is shown of a run, while it is computed and after, whatever became of it.

import { useEffect, useState } from "preact/hooks";
import type { Branch, Job, PathPointsEvent, RequestDocument, Result } from "../api/documents";
import { isActive, isAbort, Refused, service } from "../api/client";
import { go } from "../app/router";
import { badgeOf, duration } from "../app/words";
import type { Choice } from "../model/gallery";
import { stationsOf, type Run } from "../model/run";
import { addPoints, openAny } from "../studio/session";
import { Trouble } from "../studio/trouble";
import { Card } from "../views/card";
import { ResultViews } from "../views/result_views";

interface Shown {
  job: Job | null;
  request: RequestDocument | null;
  run: Run | null;
  growing: Branch[] | null;
  trouble: unknown;
}

const kNothing: Shown = { job: null, request: null, run: null, growing: null, trouble: null };

function makeRun(id: string, request: RequestDocument, result: Result): Run {
  return {
    job: id, asked: request, request, result, stations: stationsOf(request.model, result), label: "",
    milliseconds: 1000 * result.diagnostics.wall_time_s, cached: false, kept: true,
  };
}

/** Follows a job from where it stands to its end. */
async function watch(id: string, signal: AbortSignal, show: (part: Partial<Shown>) => void): Promise<void> {
  let job = await service.job(id);
  const request = await service.jobRequest(id);
  show({ job, request });
  if (isActive(job.status)) {
    const branches: Branch[] = [];
    await service.follow(`/v1/jobs/${id}`, (event) => {
      if (event.type === "status") show({ job: event.data as Job });
      if (event.type !== "points") return;
      addPoints(branches, event.data as PathPointsEvent);
      show({ growing: [...branches] });
    }, signal);
    job = await service.job(id);
    show({ job, growing: null });
  }
  try {
    show({ run: makeRun(id, request, await service.jobResult(id)) });
  } catch (error) {
    const reached = error instanceof Refused ? error.problem.reached : undefined;
    show({ trouble: error, run: reached ? makeRun(id, request, reached) : null });
  }
}

function useJob(id: string): [Shown, () => void] {
  const [shown, setShown] = useState(kNothing);
  const [turn, setTurn] = useState(0);
  useEffect(() => {
    const control = new AbortController();
    const show = (part: Partial<Shown>): void => {
      if (!control.signal.aborted) setShown((old) => ({ ...old, ...part }));
    };
    watch(id, control.signal, show).catch((error: unknown) => (isAbort(error) ? undefined : show({ trouble: error })));
    return () => control.abort();
  }, [id, turn]);
  return [shown, () => {
    setShown(kNothing);
    setTurn(turn + 1);
  }];
}

function Facts({ job }: { job: Job }) {
  const rows: [string, string][] = [
    ["Analysis", job.analysis], ["Submitted", new Date(job.created).toLocaleString()], ["Time", duration(job.started, job.finished)],
    ["Attempt", String(job.attempt)], ["Label", job.label ?? ""], ...Object.entries(job.metadata ?? {}),
  ];
  return <dl class="rows">{rows.filter(([, value]) => value !== "").map(([term, value]) => (
    <div key={term}><dt>{term}</dt><dd>{value}</dd></div>))}</dl>;
}

export function JobView({ id }: { id: string }) {
  const [{ job, request, run, growing, trouble }, again] = useJob(id);
  const [choice, setChoice] = useState<Choice>({ kind: "critical" });
  const busy = job !== null && isActive(job.status);
  return (
    <main id="main" tabIndex={-1} class="studio">
      <Card title="Job" class="controls">
        <div class="scroll">
          <h1 class="long">{job && job.title !== "" ? job.title : "Job"}</h1>
          <p class="headline">{job ? <span class={badgeOf(job.status)}>{job.status}</span> : null}</p>
          {trouble ? null : <p class="text">{job?.message ?? "Loading…"}</p>}
          <Trouble error={trouble} />
          {job ? <Facts job={job} /> : null}
        </div>
        <div class="buttons">
          {request ? <button type="button" class="main" onClick={() => {
            void openAny(request).then(() => go("#/studio"));
          }}>Open in the studio</button> : null}
          {busy ? <button type="button" onClick={() => void service.dismissJob(id).then(again, again)}>Dismiss</button> : null}
          {job && !busy ? <button type="button" onClick={() => void service.deleteJob(id).then(() => go("#/jobs"), again)}>Delete</button> : null}
        </div>
      </Card>
      {request ? <ResultViews request={request} run={run} growing={growing} shadows={[]} choice={choice} onChoice={setChoice} /> : null}
    </main>
  );
}

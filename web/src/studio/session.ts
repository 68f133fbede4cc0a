// What the studio holds: the request, its sliders, the run that answers it, and what else is on the chart.

import type { Branch, PathPointsEvent, RequestDocument, Result } from "../api/documents";
import { connection, idOf, isAbort, Refused, service, type Answer } from "../api/client";
import { Latest, type Question } from "../api/latest";
import type { Choice, Problem } from "../model/gallery";
import { forPictures, forWalking } from "../model/prepare";
import { kProblems } from "../model/problems";
import { merged, stationsOf, type Run } from "../model/run";
import { fits, valueOf, withSlider, type Slider } from "../model/sliders";
import { formatNumber } from "../figures/numbers";
import { makeStore } from "../store";

const kWalkWait = 10;  // seconds
const kBehind = 250;  // ms of waiting for an answer after which what is shown is said to be of an earlier model
const kRest = 250;  // ms without a change after which states to walk through are asked for

export interface Studio {
  request: RequestDocument | null;
  sliders: Slider[];
  problem: Problem | null;
  run: Run | null;
  /** The run before the last change, a shadow on the chart. */
  shadow: Run | null;
  pins: Run[];
  choice: Choice;
  /** The path of an analysis that is still running. */
  growing: Branch[] | null;
  busy: boolean;
  /** The answer to the request lets wait for itself. */
  behind: boolean;
  trouble: unknown;
}

export const studio = makeStore<Studio>({
  request: null, sliders: [], problem: null, run: null, shadow: null, pins: [], choice: { kind: "critical" },
  growing: null, busy: false, behind: false, trouble: null,
});

const latest = new Latest({ answered, failed, isWanted });
let leaving: Run[] = [];  // runs of the model before, until the next one is shown
let rest: ReturnType<typeof setTimeout> | undefined;
let waiting: ReturnType<typeof setTimeout> | undefined;
let opened = 0;  // models
let dragStart: Run | null = null;  // what the chart showed before the first of a series of changes
let following: AbortController | null = null;

/** Whether what is shown is not of the request, and no answer to that will come, or none has come for a while. */
export function isStale({ request, run, behind, trouble }: Studio): boolean {
  return (behind || trouble !== null) && run !== null && run.asked !== request;
}

/** Says after a while that what is shown is of an earlier model, unless an answer comes first. */
function awaitAnswer(): void {
  waiting ??= setTimeout(() => studio.change({ behind: true }), kBehind);
}

function endWaiting(): void {
  clearTimeout(waiting);
  waiting = undefined;
}

/** The most requests that were ever in flight, for tests. */
export function mostInFlight(): number {
  return latest.most;
}

/** Values of the sliders, as a run's label says them. */
function labelOf(request: RequestDocument, sliders: readonly Slider[]): string {
  const first = sliders[0];
  const value = first ? valueOf(first, request) : null;
  return first && value !== null ? `${first.name} ${formatNumber(value, 3)}` : "";
}

function makeRun(question: Question, job: string, result: Result, milliseconds: number, cached: boolean): Run {
  const { asked, request } = question;
  return {
    job, asked, request, result, stations: stationsOf(request.model, result), label: labelOf(request, studio.get().sliders),
    milliseconds, cached, kept: false,
  };
}

function isWanted(job: string): boolean {
  const { run, shadow, pins } = studio.get();
  return [run, shadow, ...pins].some((one) => one?.job === job);
}

/** Removes the job of a run that is not on the chart any more. */
function release(run: Run | null): void {
  if (run && !run.kept && !isWanted(run.job)) latest.discard(run.job);
}

function show(run: Run): void {
  const before = studio.get();
  following?.abort();
  endWaiting();
  studio.change({ run, growing: null, busy: false, behind: false, trouble: null, shadow: dragStart ?? before.shadow });
  if (run.asked !== before.request) awaitAnswer();
  for (const old of [before.run, before.shadow, ...leaving]) release(old);
  leaving = [];
  clearTimeout(rest);
  rest = setTimeout(() => void atRest(run), kRest);
}

function answered(question: Question, answer: Answer, milliseconds: number): void {
  if (question.model !== opened) {
    latest.discard(answer.job);
  } else if (answer.result) {
    show(makeRun(question, answer.job, answer.result, milliseconds, answer.cached));
  } else {
    void followJob(question, answer.job);
  }
}

/** What a failed analysis reached is shown as well. */
function failed(question: Question, error: unknown): void {
  if (isAbort(error) || question.model !== opened) return;
  const before = studio.get().run;
  endWaiting();
  studio.change({ busy: false, behind: false, trouble: error, growing: null });
  if (!(error instanceof Refused) || !error.problem.reached) return;
  const job = idOf(error.location ?? "");
  studio.change({ run: makeRun(question, job, error.problem.reached, 0, false) });
  release(before);
}

/** Draws the path of an analysis that takes longer, as its points come. It is dismissed when it was overtaken. */
async function followJob(question: Question, job: string): Promise<void> {
  following?.abort();
  const control = new AbortController();
  following = control;
  control.signal.addEventListener("abort", () => latest.discard(job));
  const branches: Branch[] = [];
  const start = performance.now();
  try {
    await service.follow(`/v1/jobs/${job}`, (event) => {
      if (event.type !== "points" || control.signal.aborted) return;
      addPoints(branches, event.data as PathPointsEvent);
      studio.change({ growing: [...branches] });
    }, control.signal);
    const result = await service.jobResult(job);
    if (control.signal.aborted) return;
    following = null;
    show(makeRun(question, job, result, performance.now() - start, false));
  } catch (error) {
    if (!control.signal.aborted) failed(question, error);
  }
}

/** Points of a path as they are traced; a step that comes again takes the place of what came before. */
export function addPoints(branches: Branch[], points: PathPointsEvent): void {
  points.branch.forEach((number, i) => {
    const branch = (branches[number] ??= {
      id: number, parent: number === 0 ? null : 0, load_factor: [], arc_length: [], monitors: {}, negative_eigenvalues: [],
      stiffness_ratio: [], contact_fraction: {}, termination: "steps",
    });
    const arc = points.arc_length[i] ?? 0;
    let keep = branch.arc_length.length;
    while (keep > 0 && (branch.arc_length[keep - 1] ?? 0) >= arc) keep -= 1;
    const put = (list: number[], value: number): void => {
      list.length = keep;
      list.push(value);
    };
    put(branch.load_factor, points.load_factor[i] ?? 0);
    put(branch.arc_length, arc);
    put(branch.negative_eigenvalues, Math.max(0, points.negative_eigenvalues[i] ?? 0));
    for (const { id, values } of points.monitors) put((branch.monitors[id] ??= []), values[i] ?? 0);
  });
}

const kKept = "snapthrough-studio";

/** What a tab works on outlives its reloading. */
function remember(): void {
  const { request, problem, sliders } = studio.get();
  sessionStorage.setItem(kKept, JSON.stringify({ request, problem: problem?.example ?? null, sliders }));
}

/** Opens what the tab worked on before it was loaded again; false when that was nothing, or another problem. */
export function restore(wanted: Problem | null): boolean {
  const text = sessionStorage.getItem(kKept);
  if (text === null) return false;
  const { request, problem, sliders } = JSON.parse(text) as { request: RequestDocument; problem: string | null; sliders: Slider[] };
  if (wanted !== null && wanted.example !== problem) return false;
  openRequest(request, kProblems.find(({ example }) => example === problem) ?? null);
  const own = studio.get().sliders;  // those of the gallery, which can't be taken away
  setSliders([...own, ...sliders.slice(own.length)]);
  return true;
}

/** The sliders rest: asks for states all along the paths, so that they can be walked. */
async function atRest(run: Run): Promise<void> {
  dragStart = null;
  remember();
  const request = forWalking(run.request, run.result);
  if (!request || studio.get().run !== run) return;
  try {
    const result = await latest.aside(request, kWalkWait);
    if (!result || studio.get().run !== run) return;
    const finer = stationsOf(request.model, run.result, result.states);
    studio.change({ run: { ...run, stations: merged(run, finer) } });
  } catch (error) {
    if (error instanceof Refused) latest.discard(idOf(error.location ?? ""));
  }
}

function askFor(request: RequestDocument, live: boolean): void {
  dragStart ??= studio.get().run;
  studio.change({ request, busy: true });
  awaitAnswer();
  const steps = studio.get().run?.result.diagnostics.steps ?? null;
  latest.ask({ asked: request, request: forPictures(request, steps, live), live, model: opened });
}

/** Another value of a slider. */
export function setSlider(slider: Slider, value: number): void {
  const { request } = studio.get();
  if (request) askFor(withSlider(slider, request, value), true);
}

/** Another request, such as an edited one: sliders that it has no place for go. */
export function setRequest(request: RequestDocument): void {
  const sliders = studio.get().sliders.filter((slider) => fits(slider, request));
  studio.change({ sliders });
  askFor(request, false);
}

export function setSliders(sliders: Slider[]): void {
  studio.change({ sliders });
}

/** Opens a request that has nothing to do with what was there. */
export function openRequest(request: RequestDocument, problem: Problem | null): void {
  const { run: shown, shadow, pins } = studio.get();
  opened += 1;
  leaving = [...leaving, shown, shadow, ...pins].filter((one): one is Run => one !== null);
  dragStart = null;
  following?.abort();
  studio.change({
    request, problem, sliders: (problem?.sliders ?? []).filter((slider) => fits(slider, request)), run: null, shadow: null,
    pins: [], choice: problem?.choice ?? { kind: "critical" }, growing: null, trouble: null,
  });
  askFor(request, false);
}

export function pin(): void {
  const { run, pins } = studio.get();
  if (run && !pins.some((one) => one.job === run.job)) studio.change({ pins: [...pins, run] });
}

export function unpin(run: Run): void {
  studio.change({ pins: studio.get().pins.filter((one) => one.job !== run.job) });
  release(run);
}

/** Keeps the job of the run that is shown: somebody has its address. */
export function keep(): void {
  const { run } = studio.get();
  if (run) studio.change({ run: { ...run, kept: true } });
}

let examples: Promise<Map<string, RequestDocument>> | null = null;

/** The examples of the service by name. */
export function loadExamples(): Promise<Map<string, RequestDocument>> {
  examples ??= service.examples().then(({ examples: list }) => new Map(list.map((one) => [one.name, one.request])));
  examples.catch(() => {
    examples = null;
  });
  return examples;
}

/** Opens a request from elsewhere, with the sliders of the gallery's problem that it is a variation of. */
export async function openAny(request: RequestDocument): Promise<void> {
  const known = await loadExamples().catch(() => null);
  const same = kProblems.find(({ example }) => {
    const title = known?.get(example)?.model.title;
    return title !== undefined && title === request.model.title;
  });
  openRequest(request, same ?? null);
}

/** Takes a request that was typed or dropped: one of another title is another problem, without the sliders of this one. */
export function takeDocument(request: RequestDocument): void {
  if (request.model.title === studio.get().request?.model.title) setRequest(request);
  else void openAny(request);
}

/** Opens an example of the service, or a request beside a document (gallery/NAME), with the sliders of the gallery where it is
 *  there. */
export async function openExample(name: string): Promise<void> {
  try {
    const request = name.includes("/") ? await service.requestOfDocument(name) : (await loadExamples()).get(name);
    if (request) openRequest(request, kProblems.find(({ example }) => example === name) ?? null);
    else openFirst();
  } catch (error) {
    studio.change({ trouble: error });
  }
}

export async function openProblem(problem: Problem): Promise<void> {
  await openExample(problem.example);
}

export function openFirst(): void {
  const [first] = kProblems;
  if (first && !studio.get().request) void openProblem(first);
}

// The runs of a tab go with it, but for those that were shared. A job whose first answer is still on its way is not known to the
// tab, and stays until the service's own time.
addEventListener("pagehide", ({ persisted }) => {
  if (persisted) return;
  const { run, shadow, pins } = studio.get();
  const jobs = new Set([run, shadow, ...pins, ...leaving].flatMap((one) => (one && !one.kept ? [one.job] : [])));
  for (const job of [...jobs, ...latest.passing]) void service.deleteJob(job, true).catch(() => undefined);
});

let visits = 0;
connection.subscribe(() => {
  const now = connection.get();
  if (now.state !== "there" || now.visits === visits) return;
  visits = now.visits;
  const { request } = studio.get();
  if (request) askFor(request, false);
  else openFirst();
});

// Solving again while something is dragged: only the latest value counts. At most two requests are in flight; of the values
// that come meanwhile the last one waits and the others are never asked for. An answer that is older than the one that is
// shown is dropped. Jobs that were overtaken are dismissed or removed, so that a thousand moves don't leave a thousand jobs.

import type { RequestDocument, Result } from "./documents";
import { type Answer, isActive, service, solve, submit } from "./client";

const kInFlight = 2;
const kMostUnwanted = 100;  // overtaken jobs that wait for a pause before they are removed
const kWait = 1;  // seconds; an analysis that takes longer is followed by its events

/** What is asked for; `live` while it is still being changed. */
export interface Question {
  /** What the user asks. */
  asked: RequestDocument;
  /** The same with the output that pictures need. */
  request: RequestDocument;
  live: boolean;
  /** Counts the models that were opened: an answer to a question about another one is dropped. */
  model: number;
}

export interface Takers {
  /** A question's answer: its result, or the job that will have it. `milliseconds` from asking to having it. */
  answered(question: Question, answer: Answer, milliseconds: number): void;
  failed(question: Question, error: unknown): void;
  /** Whether a job is shown, or may be: a question that was asked before is answered with the job of that time. */
  isWanted(job: string): boolean;
}

/** A stored answer whose job is removed while it is sent breaks off: asked again, it is computed. */
async function solveAgain(request: RequestDocument, wait: number): Promise<Answer> {
  try {
    return await solve(request, wait);
  } catch (error) {
    if (!(error instanceof TypeError)) throw error;
    return solve(request, wait);
  }
}

export class Latest {
  private inFlight = 0;
  private asked = 0;
  private shown = 0;
  private waiting: Question | null = null;
  private readonly unwanted: string[] = [];
  private removing = false;
  private beside = "";  // job of what is asked aside
  /** The most requests that were ever in flight, for tests. */
  most = 0;

  constructor(private readonly takers: Takers) {}

  ask(question: Question): void {
    if (this.inFlight >= kInFlight) {
      this.waiting = question;
      return;
    }
    void this.send(question);
  }

  /** Asks for something else while nothing is asked for; nothing otherwise. Its job is removed. */
  async aside(request: RequestDocument, wait: number): Promise<Result | null> {
    if (this.inFlight > 0) return null;
    this.inFlight += 1;
    try {
      const { id, status } = await submit(request);
      this.beside = id;
      const ended = !isActive(status) || !isActive((await service.job(id, wait)).status);
      return ended ? await service.jobResult(id) : null;
    } finally {
      this.discard(this.beside);
      this.beside = "";
      this.ended();
    }
  }

  /** Jobs that are removed sooner or later. */
  get passing(): string[] {
    return [this.beside, ...this.unwanted].filter((job) => job !== "" && !this.takers.isWanted(job));
  }

  /** Removes a job that nobody needs any more. */
  discard(job: string): void {
    if (job !== "" && !this.unwanted.includes(job)) this.unwanted.push(job);
    void this.removeUnwanted();
  }

  private async send(question: Question): Promise<void> {
    const number = ++this.asked;
    this.inFlight += 1;
    this.most = Math.max(this.most, this.inFlight);
    const start = performance.now();
    try {
      const answer = await solveAgain(question.request, kWait);
      if (number < this.shown) {
        this.discard(answer.job);
      } else {
        this.shown = number;
        this.takers.answered(question, answer, performance.now() - start);
      }
    } catch (error) {
      if (number >= this.shown) {
        this.shown = number;
        this.takers.failed(question, error);
      }
    } finally {
      this.ended();
    }
  }

  private ended(): void {
    this.inFlight -= 1;
    const next = this.waiting;
    this.waiting = null;
    if (next) this.ask(next);
    else void this.removeUnwanted();
  }

  /** Removes jobs while nothing is asked for, or when many have come together. */
  private async removeUnwanted(): Promise<void> {
    if (this.removing) return;
    this.removing = true;
    while (this.unwanted.length > (this.inFlight > 0 ? kMostUnwanted : 0)) {
      const job = this.unwanted[0];
      if (job !== undefined && !this.takers.isWanted(job)) await service.deleteJob(job).catch(() => undefined);
      this.unwanted.shift();
    }
    this.removing = false;
  }
}

// Requests to the server of the lab: of each kind only the latest counts.

import { decoded } from "./response";

export interface Refusal {
  given: string;
  expected: string;
  advice: string;
}

export class RefusedError extends Error {
  constructor(readonly refusal: Refusal) {
    const { given, expected, advice } = refusal;
    super([given, expected && `expected ${expected}`, advice].filter(Boolean).join("; "));
  }
}

export async function ask<T>(task: string, question: object, signal?: AbortSignal): Promise<T> {
  return (await post(task, question, signal)).json() as Promise<T>;
}

/** A response with binary numbers. */
export async function requestNumbers<T>(task: string, question: object, signal?: AbortSignal): Promise<T> {
  return decoded<T>(await (await post(task, question, signal)).arrayBuffer());
}

export async function post(task: string, question: object, signal?: AbortSignal): Promise<Response> {
  const response = await fetch(`/api/${task}`, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(question),
    signal,
  });
  if (response.ok) return response;
  throw new RefusedError((await response.json()) as Refusal);
}

const PATIENCE = 1000; // ms that a newer question waits for an older one's answer

/** Sends one request at a time, and then the latest of those that came in the meantime. */
export class LatestRequest<T> {
  private next: object | null = null;
  private waiting = 0;
  private under: AbortController | null = null;

  constructor(
    private readonly put: (question: object, signal: AbortSignal) => Promise<T>,
    private readonly delay: number,
    private readonly answer: (answer: T, question: object, signal: AbortSignal) => Promise<void> | void,
    private readonly refused: (message: string) => void,
    private readonly busy: (busy: boolean) => void = () => {},
  ) {}

  ask(question: object): void {
    this.next = question;
    this.busy(true);
    clearTimeout(this.waiting);
    this.waiting = window.setTimeout(() => this.begin(), this.delay);
  }

  /** Cancel the pending requests. */
  forget(): void {
    this.next = null;
    this.under?.abort();
  }

  private begin(): void {
    const { under } = this;
    if (under) setTimeout(() => under.abort(), PATIENCE);
    else void this.work();
  }

  private async work(): Promise<void> {
    while (this.next) {
      const question = this.next;
      this.next = null;
      this.under = new AbortController();
      await this.send(question, this.under.signal);
    }
    this.under = null;
    this.busy(false);
  }

  private async send(question: object, signal: AbortSignal): Promise<void> {
    try {
      const answer = await this.put(question, signal);
      if (!signal.aborted) await this.answer(answer, question, signal);
    } catch (error) {
      if (!signal.aborted) this.refused(error instanceof RefusedError ? error.message : "The lab's server does not answer; is polhode lab still running?");
    }
  }
}

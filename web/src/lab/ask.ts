// Questions to the lab's server: the newest of a kind counts, older ones are called off.

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

/** Asks a little after the last change, and hands on the newest answer alone. */
export class Asker<T> {
  private number = 0;
  private waiting = 0;
  private under = new AbortController();

  constructor(
    private readonly task: string,
    private readonly delay: number,
    private readonly answer: (answer: T) => void,
    private readonly refused: (message: string) => void,
    private readonly busy: (busy: boolean) => void = () => {},
  ) {}

  ask(question: object): void {
    const number = ++this.number;
    clearTimeout(this.waiting);
    this.under.abort();
    this.under = new AbortController();
    const { signal } = this.under;
    this.busy(true);
    this.waiting = window.setTimeout(() => void this.send(number, question, signal), this.delay);
  }

  private async send(number: number, question: object, signal: AbortSignal): Promise<void> {
    try {
      const answer = await ask<T>(this.task, question, signal);
      if (number === this.number) this.answer(answer);
    } catch (error) {
      if (number !== this.number || signal.aborted) return;
      this.refused(error instanceof RefusedError ? error.message : "The lab's server does not answer; is polhode lab still running?");
    } finally {
      if (number === this.number) this.busy(false);
    }
  }
}

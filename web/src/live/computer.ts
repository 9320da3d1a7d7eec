// Computes motions away from the page, in a worker; where a host forbids one, in the page itself.

import type { LiveData, Numbers } from "./model";
import { Engine } from "./motion";
import { type Answer, replyTo } from "./answer";
import type { Hand, Handled } from "./hand";

export interface Request {
  id: number;
  numbers: Numbers;
  frames: number;
  /** Whether a table is wanted in place of a picture. */
  table: boolean;
  /** Where only another start is wanted. */
  hand?: Hand;
}

export type Reply = { id: number; answer: Answer | Handled } | { id: number; error: string };

type Waiting = { done: (answer: Answer & Handled) => void; failed: (reason: Error) => void };

/** Answers the latest of many requests. */
export class Computer {
  private count = 0;
  private readonly waiting = new Map<number, Waiting>();

  private constructor(private readonly send: (request: Request) => void) {}

  /** @param code of the worker. Throws where WebAssembly is forbidden. */
  static async of(live: LiveData, code: string): Promise<Computer> {
    try {
      return await Computer.apart(live, code);
    } catch {
      return Computer.here(await Engine.of(live), live);
    }
  }

  private static apart(live: LiveData, code: string): Promise<Computer> {
    const address = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
    return new Promise((ready, failed) => {
      const worker = new Worker(address);
      const computer = new Computer((request) => worker.postMessage(request));
      worker.onerror = () => failed(new Error("no worker"));
      worker.onmessage = ({ data }: MessageEvent<"ready" | "none" | Reply>) => {
        if (data === "ready") ready(computer);
        else if (data === "none") failed(new Error("no WebAssembly in a worker"));
        else computer.receive(data);
      };
      worker.postMessage(live);
    });
  }

  private static here(engine: Engine, live: LiveData): Computer {
    const computer: Computer = new Computer((request) => {
      setTimeout(() => computer.receive(replyTo(engine, live, request)));
    });
    return computer;
  }

  ask(numbers: Numbers, frames: number, table = false): Promise<Answer> {
    return this.sent({ numbers, frames, table });
  }

  /** The start of a motion, as a hand changes it. */
  handle(numbers: Numbers, hand: Hand): Promise<Handled> {
    return this.sent({ numbers, frames: 0, table: false, hand });
  }

  private sent(request: Omit<Request, "id">): Promise<Answer & Handled> {
    const id = (this.count += 1);
    return new Promise((done, failed) => {
      this.waiting.set(id, { done, failed });
      this.send({ id, ...request });
    });
  }

  private receive(reply: Reply): void {
    const waiting = this.waiting.get(reply.id);
    this.waiting.delete(reply.id);
    if ("answer" in reply) waiting?.done(reply.answer as Answer & Handled);
    else waiting?.failed(new Error(reply.error));
  }
}

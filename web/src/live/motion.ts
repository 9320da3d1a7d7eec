// One motion: integrated in the contact mode that it starts in, and everything shown along it.

import { BROKEN, FALL, GOING, Kernel } from "./kernel";
import type { LiveData, Numbers } from "./model";

const MOST = 400_000; // steps
const PATIENCE = 8000; // ms
const SLIP = 1e-5; // of the slip at the start, below which it has come to rest
const CHECKED = 64; // calls between two looks at the clock

/** Why a motion ends. */
export interface Ending {
  kind: "goal" | "event" | "broken" | "long";
  what: string;
  contact: string;
}

/** A motion at equally spaced instants from 0 to its end. */
export class Motion {
  private readonly width: number;

  constructor(
    readonly end: number,
    readonly ending: Ending,
    readonly frames: number,
    /** All outputs at one instant after the other. */
    readonly values: Float64Array,
    /** All states likewise. */
    readonly states: Float64Array,
    private readonly stateCount: number,
  ) {
    this.width = values.length / frames;
  }

  /** An output along the motion. */
  column(output: number): Float64Array {
    return Float64Array.from({ length: this.frames }, (_, i) => this.values[i * this.width + output]);
  }

  /** Several outputs, row by row. */
  rows(outputs: number[]): Float64Array {
    const found = new Float64Array(this.frames * outputs.length);
    for (let i = 0; i < this.frames; i++) {
      for (let k = 0; k < outputs.length; k++) found[i * outputs.length + k] = this.values[i * this.width + outputs[k]];
    }
    return found;
  }

  /** Outputs that depend on parameters alone. */
  constants(outputs: number[]): number[] {
    return outputs.map((output) => this.values[output]);
  }

  state(index: number): Float64Array {
    return Float64Array.from({ length: this.frames }, (_, i) => this.states[i * this.stateCount + index]);
  }

  time(frame: number): number {
    return this.frames > 1 ? (frame / (this.frames - 1)) * this.end : 0;
  }
}

export class Engine {
  private constructor(
    private readonly live: LiveData,
    private readonly integrator: Kernel,
    private readonly viewer: Kernel,
  ) {}

  static async of(live: LiveData): Promise<Engine> {
    return new Engine(live, await Kernel.of(live.integrator), await Kernel.of(live.viewer));
  }

  /** The motion with some numbers, at so many instants. */
  follow(numbers: Numbers, frames: number): Motion {
    const { live } = this;
    const [start, parameters] = this.begun(numbers);
    const count = start.length;
    const width = live.viewer.outputs.length;
    const steps = this.steps(parameters, start, numbers.duration);
    const states = new Float64Array(frames * count);
    const values = new Float64Array(frames * width);
    this.viewer.start(parameters, start, 0);
    const now = new Float64Array(count);
    let step = 0;
    for (let i = 0; i < frames; i++) {
      const time = frames > 1 ? (i / (frames - 1)) * steps.end : 0;
      while (step + 1 < steps.begins.length && time >= steps.begins[step + 1]) step += 1;
      if (steps.begins.length) this.stateAt(steps.series[step], (time - steps.begins[step]) / steps.lengths[step], now);
      else now.set(start);
      states.set(now, i * count);
      this.viewer.valuesAt(now, time, values, i * width);
    }
    return new Motion(steps.end, steps.ending, frames, values, states, count);
  }

  /** Outputs at values of two states, for the parameters of the last motion; row by row. */
  pointsAt([u, v]: [number, number], [us, vs]: [number[], number[]], outputs: number[]): number[] {
    const state = new Float64Array(this.live.viewer.states[1]);
    const values = new Float64Array(this.live.viewer.outputs.length);
    return us.flatMap((value, i) => {
      [state[u], state[v]] = [value, vs[i]];
      this.viewer.valuesAt(state, 0, values, 0);
      return outputs.map((output) => values[output]);
    });
  }

  /** The whole state at the start, and all parameters. */
  private begun(numbers: Numbers): [number[], number[]] {
    const { live } = this;
    const start = [...numbers.start, ...live.begin.map(() => 0)];
    const values = new Float64Array(live.viewer.outputs.length);
    this.viewer.start([...numbers.parameters, 0], start, 0);
    this.viewer.valuesAt(start, 0, values, 0);
    live.begin.forEach((output, i) => {
      start[numbers.start.length + i] = values[output];
    });
    const slip = live.slips.reduce((sum, state) => sum + start[state] ** 2, 0);
    return [start, [...numbers.parameters, SLIP ** 2 * slip]];
  }

  private steps(parameters: number[], start: number[], duration: number): { begins: number[]; lengths: number[]; series: Float64Array[]; end: number; ending: Ending } {
    const { live, integrator } = this;
    const begins: number[] = [];
    const lengths: number[] = [];
    const series: Float64Array[] = [];
    const since = performance.now();
    integrator.start(parameters, start, 0);
    for (let call = 0; ; call++) {
      const found = integrator.advance(duration, duration / live.fewest);
      begins.push(...found.begins);
      lengths.push(...found.lengths);
      series.push(...found.series);
      const ended = (kind: Ending["kind"], guard = -1): Ending => ({ kind, what: live.watched[guard]?.kind ?? "", contact: live.watched[guard]?.contact ?? "" });
      const done = { begins, lengths, series, end: found.end };
      if (found.status === FALL) return { ...done, ending: ended("event", found.fallen) };
      if (found.status === BROKEN) return { ...done, ending: ended("broken") };
      if (found.status !== GOING) return { ...done, ending: ended("goal") };
      const late = call % CHECKED === 0 && performance.now() - since > PATIENCE;
      if (late || begins.length > MOST) return { ...done, ending: ended("long") };
    }
  }

  /** A state from its series, by Horner's rule. */
  private stateAt(series: Float64Array, share: number, out: Float64Array): void {
    const length = this.live.integrator.order + 1;
    for (let i = 0; i < out.length; i++) {
      let sum = 0;
      for (let k = length - 1; k >= 0; k--) sum = sum * share + series[i * length + k];
      out[i] = sum;
    }
  }
}

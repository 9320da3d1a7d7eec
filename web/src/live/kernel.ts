// Kernels in memory: the WebAssembly module that all share, and what polhode made of the equations of one contact mode.

import type { KernelData } from "./model";

export const GOING = 0;
export const BROKEN = 2;
export const FALL = 3;

/** Consecutive steps: their beginnings and lengths in s, and the states as series of the share passed. */
export interface Steps {
  status: number;
  begins: number[];
  lengths: number[];
  series: Float64Array[];
  end: number;
  /** The states there. */
  state: number[];
  /** The guard that has fallen. */
  fallen: number;
}

interface Exports {
  memory: WebAssembly.Memory;
  start(): void;
  advance(most: number): number;
  values(): void;
}

const PAGE = 65536; // bytes

/** Compile the module. Fails where a page may not run WebAssembly. */
export function compiled(code: string): Promise<WebAssembly.Module> {
  return WebAssembly.compile(bytesOf(code));
}

export class Kernel {
  private readonly run: Exports;
  private readonly doubles: Float64Array;
  private readonly integers: Int32Array;

  constructor(
    readonly data: KernelData,
    module: WebAssembly.Module,
  ) {
    this.run = new WebAssembly.Instance(module).exports as unknown as Exports;
    const { memory } = this.run;
    memory.grow(Math.max(0, Math.ceil((data.size - memory.buffer.byteLength) / PAGE)));
    const bytes = new Uint8Array(memory.buffer);
    for (const [place, content] of data.image) bytes.set(bytesOf(content), place);
    this.doubles = new Float64Array(memory.buffer);
    this.integers = new Int32Array(memory.buffer);
  }

  /** Begin a motion at a time, in s. */
  start(parameters: ArrayLike<number>, state: ArrayLike<number>, time: number): void {
    this.write(this.data.parameters, parameters);
    this.write(this.data.states, state);
    this.set("time", time);
    this.run.start();
  }

  /** Take so many steps of at most so many seconds towards a time. */
  advance(goal: number, longest: number, most = this.data.steps): Steps {
    const { data } = this;
    this.set("goal", goal);
    this.set("longest", longest);
    const status = this.run.advance(Math.min(most, data.steps));
    const done = this.integers[data.fields.done / 4];
    const found: Steps = { status, begins: [], lengths: [], series: [], end: this.get("time"), state: this.state(), fallen: -1 };
    const size = data.states[1] * (data.order + 1);
    for (let i = 0; i < done; i++) {
      const place = (data.records + i * data.record) / 8;
      found.begins.push(this.doubles[place] + this.doubles[place + 1]);
      found.lengths.push(this.doubles[place + 2]);
      found.series.push(this.doubles.slice(place + data.head / 8, place + data.head / 8 + size));
    }
    if (status === FALL) {
      const falls = this.doubles.subarray(data.falls / 8, data.falls / 8 + data.guards);
      found.fallen = falls.indexOf(falls.reduce((a, b) => Math.min(a, b)));
    }
    return found;
  }

  /** All outputs at a state, into part of an array; not a number where they are not defined in this mode. */
  valuesAt(state: ArrayLike<number>, time: number, out: Float64Array, place = 0, count = this.data.outputs.length): void {
    this.write(this.data.states, state);
    this.set("time", time);
    this.set("rest", 0);
    this.run.values();
    const { outputs } = this.data;
    for (let i = 0; i < count; i++) out[place + i] = outputs[i] ? this.doubles[outputs[i] / 8] : NaN;
  }

  /** Rates of the states at a state. */
  rates(state: ArrayLike<number>, time: number): number[] {
    this.write(this.data.states, state);
    this.set("time", time);
    this.set("rest", 0);
    this.run.values();
    return this.data.rates.map((place) => this.doubles[place / 8]);
  }

  private state(): number[] {
    const [first, count] = this.data.states;
    return Array.from({ length: count }, (_, i) => this.doubles[(first + i * this.data.row) / 8]);
  }

  private write([first, count]: [number, number], values: ArrayLike<number>): void {
    for (let i = 0; i < count; i++) this.doubles[(first + i * this.data.row) / 8] = values[i];
  }

  private set(field: "time" | "rest" | "goal" | "longest", value: number): void {
    this.doubles[this.data.fields[field] / 8] = value;
  }

  private get(field: "time" | "rest"): number {
    return this.doubles[this.data.fields[field] / 8];
  }
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

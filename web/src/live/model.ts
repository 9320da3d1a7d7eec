// What polhode writes into a live page besides the scene of the motion that it opens with;
// documented at live_document in polhode.view.

import type { Control } from "../sliders";

/** A kernel in base64, and the addresses in its memory, in bytes. */
export interface KernelData {
  wasm: string;
  order: number;
  row: number;
  states: [number, number];
  parameters: [number, number];
  outputs: number[];
  fields: { time: number; rest: number; goal: number; longest: number; done: number };
  steps: number;
  records: number;
  record: number;
  head: number;
  guards: number;
  falls: number;
  weights: number;
}

/** Numbers of outputs of the kernel that computes what is shown. */
export type Outputs = number[];

export interface DrawnBody {
  name: string;
  rule: string;
  numbers: Outputs;
  position: number;
  place: Outputs;
  turn: Outputs | null;
  turning: Outputs | null;
  spin: number | null;
  axis: Outputs | null;
  arms: Outputs[];
}

export interface DrawnContact {
  name: string;
  /** Of its support; null where an earlier contact has the same. */
  kind: string | null;
  support: number;
  place: Outputs;
  turn: Outputs;
  turning: number;
  point: Outputs | null;
  touched: Outputs | null;
  edge: number | null;
  grid: Grid | null;
}

/** Points of a curved support: as they were drawn, or to be computed at u and v. */
export interface Grid {
  shape: [number, number];
  points?: number[];
  uv?: [number, number];
  values?: [number[], number[]];
  foot?: Outputs;
  normal?: Outputs;
}

export interface DrawnArrow {
  kind: string;
  name: string;
  symbol: string;
  body: number;
  unit: string;
  foot: Outputs | null;
  along: Outputs | null;
}

export interface Drawn {
  up: Outputs;
  bodies: DrawnBody[];
  joints: { kind: string; name: string; body: number; place: Outputs; axis: Outputs | null }[];
  links: { kind: string; name: string; start: Outputs; end: Outputs }[];
  contacts: DrawnContact[];
  arrows: DrawnArrow[];
  panels: { unit: string; series: { name: string; symbol: string; value: number }[] }[];
  energy: Outputs;
}

export interface LiveData {
  system: string;
  duration: number;
  mode: string;
  integrator: KernelData;
  viewer: KernelData;
  fewest: number;
  watched: { kind: string; contact: string }[];
  /** Of each slider the value in its unit, unrounded. */
  parameters: Control[];
  formulas: { name: string; symbol: string; formula: string }[];
  start: Control[];
  begin: Outputs;
  slips: number[];
  work: number;
  drawn: Drawn;
}

/** Numbers of a motion, in SI units. */
export interface Numbers {
  parameters: number[];
  start: number[];
  duration: number;
}

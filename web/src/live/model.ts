// What polhode writes into a live page besides the scene of the motion that it opens with;
// documented at live_document in polhode.view.

import type { Triple } from "../scene";
import type { Control } from "../sliders";

/** What the memory of a kernel holds at first, in base64 by address, and where to find what, in bytes. */
export interface KernelData {
  image: [number, string][];
  size: number;
  order: number;
  row: number;
  states: [number, number];
  parameters: [number, number];
  rates: number[];
  /** Addresses; 0 for what is not defined in a mode. */
  outputs: number[];
  fields: { time: number; rest: number; goal: number; longest: number; done: number };
  steps: number;
  records: number;
  record: number;
  head: number;
  guards: number;
  falls: number;
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
  /** Of the centre of mass, and of the rotation. */
  velocity: Outputs;
  rotation: Outputs;
  arms: Outputs[];
  labels: string[];
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
  normal: Outputs | null;
  friction: Outputs | null;
}

export interface DrawnAngles {
  name: string;
  body: number;
  vertex: Outputs;
  rotations: { symbol: string; angle: number; axis: Outputs; begin: Outputs; offset: number; coordinate: string; sign: number }[];
}

export interface Drawn {
  up: Outputs;
  bodies: DrawnBody[];
  joints: { kind: string; name: string; body: number; place: Outputs; axis: Outputs | null }[];
  links: { kind: string; name: string; start: Outputs; end: Outputs }[];
  contacts: DrawnContact[];
  arrows: DrawnArrow[];
  angles: DrawnAngles[];
  panels: { unit: string; series: { name: string; symbol: string; value: number }[]; kind: string }[];
  portraits: { kind: string; title: string; names: string[]; symbols: string[]; units: string[]; values: Outputs; body: number; axis: Triple }[];
  energy: Outputs;
}

export interface ModeData {
  name: string;
  /** Of the only contact; empty where there is none, or several. */
  phase: string;
  beyond: boolean;
  coordinates: string[];
  speeds: string[];
  /** Places of states: the work done, velocities of slip, the height, the distance to an edge. */
  work: number;
  slips: number[];
  gap: number;
  edge: number;
  integrator: KernelData;
  viewer: KernelData;
  fewest: number;
  watched: { kind: string; ends: boolean }[];
  /** Outputs for the changes of mode, documented at _transition in polhode.simulate. */
  joined: Record<string, Outputs>;
}

/** Collocation at Radau's points, documented at _slip_onset in polhode.simulate. */
export interface RadauData {
  points: number[];
  slopes: number[][];
  series: number[][];
  weights: number[];
}

export interface LiveData {
  system: string;
  duration: number;
  /** Of a smooth picture. */
  frames: number;
  /** Of each slider the value in its unit, unrounded. */
  parameters: Control[];
  /** Names of those that are assumed to be positive. */
  positive: string[];
  formulas: { name: string; symbol: string; formula: string }[];
  start: Control[];
  /** Further motions, as texts with units. */
  presets: { title: string; parameters: Record<string, string>; start: Record<string, string>; duration: string }[];
  /** Outputs of the coordinates and speeds of `start`, and of the work done. */
  states: Outputs;
  work: number;
  /** Whether a motion that starts later is another one. */
  timed: boolean;
  /** Coefficients of prescribed motions that are given piece by piece, from certain times on; jerks are jumps of a velocity. */
  schedule: { times: number[]; values: number[][]; jerks: boolean[] };
  /** Name of the contact by whose rules modes follow each other; null where there is one mode only. */
  contact: string | null;
  law: Record<string, number>;
  /** The parameter that bounds static friction; empty where none does by itself. */
  friction: string;
  /** Closed loops: outputs that are zero, places in `start` of coordinates that they determine, derivatives by these. */
  loops: { gaps: Outputs; solved: number[]; slopes: Outputs };
  radau: RadauData | null;
  drawn: Drawn;
  code: string;
  /** How many outputs are shown. */
  outputs: number;
  modes: ModeData[];
}

/** Numbers of a motion, in SI units. */
export interface Numbers {
  parameters: number[];
  start: number[];
  /** In place of `start`: coordinates and speeds of flight, also of a body that touches and slips. */
  begin?: number[] | null;
  duration: number;
}

// The scene as polhode writes it; the fields are documented at Scene in polhode.view.

import { summed } from "./packed";

/** In a page the numbers are packed (`packed.ts`); in the lab, and in what a page has computed, they are as they are. */
export interface Packed {
  shape: number[];
  float32?: Float32Array;
  steps?: string;
}

/** Rows of numbers; a single row if nothing changes. */
export class Rows {
  readonly data: Float32Array;
  readonly count: number;
  readonly width: number;

  constructor(packed: Packed) {
    this.count = packed.shape[0];
    this.width = packed.shape.slice(1).reduce((size, length) => size * length, 1);
    this.data = packed.float32 ??= summed(packed.steps ?? "", this.count, this.width);
  }

  /** Linear interpolation between rows; `frame` need not be an integer. */
  at(frame: number, out: number[]): number[] {
    const first = Math.min(Math.floor(frame), this.count - 1);
    const second = Math.min(first + 1, this.count - 1);
    const share = this.count > 1 ? frame - first : 0;
    for (let i = 0; i < this.width; i++) {
      const a = this.data[first * this.width + i];
      out[i] = a + share * (this.data[second * this.width + i] - a);
    }
    return out;
  }
}

export type Triple = [number, number, number];

export interface PoseData {
  place: Packed;
  turn: Packed;
  spin: Packed;
  axis: Triple;
}

export interface ShapeData {
  kind: string;
  size: number[];
  axis: Triple;
  across: Triple;
  centre: Triple;
}

export interface BodyData {
  name: string;
  shape: ShapeData;
  pose: PoseData;
  arms: Triple[];
  labels: string[];
}

export interface JointData {
  kind: string;
  name: string;
  body: number;
  place: Triple;
  axis: Triple;
}

export interface LinkData {
  kind: string;
  name: string;
  start: Packed;
  end: Packed;
  thick: number;
}

export interface SupportData {
  name: string;
  kind: string;
  pose: PoseData;
  middle: [number, number];
  reach: [number, number];
  points: Packed;
}

export type ArrowKind = "force" | "load" | "torque" | "omega" | "momentum";

export interface ArrowData {
  kind: ArrowKind;
  name: string;
  symbol: string;
  body: number;
  unit: string;
  foot: Packed;
  along: Packed;
  usual: number;
  largest: number;
  normal: Packed;
  friction: number;
}

export interface RotationData {
  symbol: string;
  angle: Packed;
  axis: Triple;
  begin: Triple;
  offset: number;
  coordinate: string;
  sign: number;
}

export interface AnglesData {
  name: string;
  body: number;
  vertex: Packed;
  rotations: RotationData[];
}

export interface TraceData {
  kind: string;
  name: string;
  points: Packed;
  support: number;
}

export interface PanelData {
  unit: string;
  series: { name: string; symbol: string; values: Packed }[];
  kind: string;
}

export interface FormulaData {
  name: string;
  pieces: string[];
  spoken: string;
}

export interface NumberData {
  name: string;
  symbol: string;
  value: number;
  unit: string;
  meaning: string;
}

export interface JudgementData {
  claim: string;
  verdict: string;
  reason: string;
  formula: string;
  correction: string;
  notes: NoteData[];
  convention: string;
}

/** A line on how a claim was read; a formula is MathML. */
export interface NoteData {
  label: string;
  text: string;
  formula: string;
}

export interface PortraitData {
  kind: string;
  title: string;
  names: string[];
  symbols: string[];
  units: string[];
  columns: Packed[];
  curve: Packed[];
  level: number;
  body: number;
  axis: Triple;
}

/** A stay in a contact mode. */
export interface ModeSpan {
  name: string;
  begin: number;
  end: number;
}

/** The readable part of a motion: curves, formulas and numbers. */
export interface AccountData {
  panels: PanelData[];
  portraits: PortraitData[];
  motion: FormulaData[];
  reactions: FormulaData[];
  parameters: NumberData[];
  start: NumberData[];
  evidence: NumberData[];
  happenings: { time: number; what: string }[];
  modes: ModeSpan[];
  doubt: string;
}

export interface SceneData extends AccountData {
  title: string;
  about: string;
  duration: number;
  frames: number;
  up: Triple;
  floor: number | null;
  directions: string[];
  bodies: BodyData[];
  joints: JointData[];
  links: LinkData[];
  supports: SupportData[];
  arrows: ArrowData[];
  angles: AnglesData[];
  traces: TraceData[];
  judgements: JudgementData[];
  origin: { versions?: Record<string, string | null>; integrator?: string };
}

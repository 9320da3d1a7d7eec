// The scene as polhode writes it; the fields are documented at Scene in polhode.view.

/** In a page the numbers are in base64; in the lab they are binary. */
export interface Packed {
  shape: number[];
  float32: string | Float32Array;
}

/** Rows of numbers; a single row if nothing changes. */
export class Rows {
  readonly data: Float32Array;
  readonly count: number;
  readonly width: number;

  constructor(packed: Packed) {
    const { float32 } = packed;
    this.data = typeof float32 === "string" ? decoded(float32) : float32;
    this.count = packed.shape[0];
    this.width = packed.shape.slice(1).reduce((size, length) => size * length, 1);
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

function decoded(base64: string): Float32Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return new Float32Array(bytes.buffer);
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

/** A stay in a contact mode. */
export interface ModeSpan {
  name: string;
  begin: number;
  end: number;
}

/** The readable part of a motion: curves, formulas and numbers. */
export interface AccountData {
  panels: PanelData[];
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
  traces: TraceData[];
  judgements: JudgementData[];
  origin: { versions?: Record<string, string | null>; integrator?: string };
}

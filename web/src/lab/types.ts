// Requests to and responses from the server of the lab, polhode.lab.

import type { AccountData, NoteData } from "../scene";
import type { Control } from "../sliders";

export interface Offer {
  name: string;
  title: string;
}

export interface Description {
  name: string;
  title: string;
  about: string;
  contact: string;
  declared: string;
  contacts: string[];
  duration: string;
  parameters: Control[];
  start: Control[];
  forcing: { name: string; symbol: string; text: string; unit: string }[];
  sheet: boolean;
}

export interface Outcome {
  name: string;
  symbol: string;
  start: number;
  end: number;
}

/** Requested once the picture is shown. */
export interface Reading {
  account: AccountData;
  outcome: Outcome[];
}

export interface Valued {
  formula: string;
  value: number | null;
  on?: boolean;
}

export interface Family {
  formula: string;
  spoken: string;
  on: number | null;
  here: boolean;
  broken: string;
  startable: boolean;
  verdict: string;
  branches: (Valued & { name: string; unit: string; startable: boolean })[];
  set: Record<string, number>;
  undecided?: string;
  stable?: string;
  conditions: { formula: string; spoken: string; holds?: boolean; ratio: number | null }[];
  frequencies: Valued[];
  growth?: Valued[];
  loss?: string;
}

export interface Standing {
  families: Family[];
  invariants: { name: string; meaning: string; pieces: string[]; spoken: string }[];
}

export interface Stated {
  id: string;
  formula: string;
  printed: string;
  words: string;
  context: string;
  notes: NoteData[];
  part: string;
  convention: string;
}

export interface Verdict {
  verdict: string;
  reason: string;
  formula?: string;
  correction: { what: string; formula: string } | null;
  residuals: string[];
  counterexample: { values: Record<string, string>; left: string; right: string } | null;
  remarks: string[];
}

export interface MarkedLine {
  line: number;
  latex: string;
  formula: string;
  mark: string;
  sign: string;
  title: string;
  told: string;
  context: string;
  part: string;
  of: number | null;
  final: boolean;
  correction: { what: string; formula: string } | null;
  counterexample: { values: Record<string, string>; left: string; right: string } | null;
}

export interface Marks {
  lines: MarkedLine[];
  counts: Record<string, number>;
}

export type Row = [number, number, number];

/** A request; only what differs from the defaults is kept. */
export interface State {
  system: string;
  contact: string;
  settings: Record<string, string>;
  start: Record<string, string>;
  duration: string;
  sheet: Row[];
}

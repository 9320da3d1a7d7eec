// The beginning of a slip, as _slip_onset.py in polhode.simulate describes it: with the slip ρ (cos ψ, sin ψ) the
// equations ρ̇ = ṡ·ŝ and ρ ψ̇ = ṡ·ŝ' are regular at ρ = 0 if ψ starts where ṡ·ŝ' vanishes, but infinitely stiff there.
// They are solved by collocation at Radau's points, which do not include the beginning of a step.

import { bisected, eliminated, type Matrix, plus, type Vector } from "./linear";
import type { RadauData } from "./model";
import { NoModeError } from "./errors";
import { BARELY, type Entry, type Modes } from "./modes";

const RESOLVED = 1e-14; // last Legendre coefficients of a converged step, relative to the largest
const ROUNDED = 1e-11; // the same, accepted if a shorter step does not reduce them: they are rounding
const TURN = 10; // rad: scale of the rounding of angles
const NOISE = 1e-15; // of the largest slip of a step
const ENDED = 1e-12; // of its largest size: a slip that has ended
const NEWTON = 12; // iterations; a step that needs more is too long
const SHIFT = 1e-7; // of the scale of a state: for differences in place of derivatives
const FIRST = 1e-3; // s
const SHORTEST = 1e-13; // of the duration and the time
const STIFF = 100; // an explicit method takes over once friction changes the slip by less than so many times its size
const PARTS = 60; // places of a step at which the sign of the slip is looked at

/** A step of a motion: how long it takes, and the states at a share of it. */
export interface Step {
  begin: number;
  length: number;
  at: (share: number) => Float64Array;
}

/** The steps while a slip begins, where they end, and whether the slip has ended there. */
export interface Begun {
  steps: Step[];
  state: Vector;
  time: number;
  hasEnded: boolean;
}

export class Onset {
  private readonly own: number[]; // places of the other states
  private readonly count: number; // of these, with ρ and ψ behind them

  constructor(
    private readonly modes: Modes,
    private readonly radau: RadauData,
    private readonly entry: Entry,
  ) {
    const { slips } = modes.data(entry.mode);
    this.own = entry.state.map((_, i) => i).filter((i) => !slips.includes(i));
    this.count = this.own.length + 2;
  }

  /** Follow the slip until it is large enough to go on without an implicit method. */
  follow(end: number): Begun {
    const { entry } = this;
    const [friction, acceleration] = this.modes.accelerations(entry);
    let state: Vector = [...this.own.map((i) => entry.state[i]), 0, entry.onset ?? 0];
    let time = entry.time;
    let length = Math.min(end - time, FIRST);
    let unresolved = Infinity;
    const steps: Step[] = [];
    let largest = 0;
    const shortest = Math.min(SHORTEST * Math.max(end - time, time), end - time);
    for (;;) {
      length = Math.min(length, end - time);
      if (!(length >= shortest)) throw new NoModeError("A slip that begins there cannot be followed.");
      const found = this.step(time, length, state, acceleration);
      const resolved = found && (found.tail <= RESOLVED || (unresolved / 4 <= found.tail && found.tail <= ROUNDED));
      if (!found || !resolved) {
        unresolved = found ? found.tail : Infinity;
        length /= 4;
        continue;
      }
      unresolved = Infinity;
      const share = this.vanishing(found.whole);
      if (share !== null && share < 0.2 && length > 4 * shortest) {
        length *= Math.max(share, 0.01);
        continue;
      }
      const { whole } = found;
      const passed = share ?? 1;
      const over = length;
      steps.push({ begin: time, length: over * passed, at: (part) => Float64Array.from(this.full(this.between(whole, part * passed))) });
      state = this.between(whole, passed);
      time += over * passed;
      largest = Math.max(largest, ...whole.map((row) => row[this.count - 2]));
      if (share !== null || state[this.count - 2] <= ENDED * largest) return { steps, state: this.full(state), time, hasEnded: true };
      if (time >= end || friction * (time - entry.time) < STIFF * state[this.count - 2]) return { steps, state: this.full(state), time, hasEnded: false };
      length *= 2;
    }
  }

  /** All states of the mode from those here. */
  private full(state: Vector): Vector {
    const { slips } = this.modes.data(this.entry.mode);
    const whole = new Array<number>(this.count).fill(0);
    this.own.forEach((place, i) => {
      whole[place] = state[i];
    });
    const [size, angle] = state.slice(-2);
    [whole[slips[0]], whole[slips[1]]] = [Math.max(size, BARELY) * Math.cos(angle), Math.max(size, BARELY) * Math.sin(angle)];
    return whole;
  }

  /** Rates of the states here, that of ψ times ρ. */
  private rates(state: Vector, time: number): Vector {
    const { slips } = this.modes.data(this.entry.mode);
    const found = this.modes.rates(this.entry.mode, this.full(state), time);
    const [x, y] = slips.map((place) => found[place]);
    const [c, s] = [Math.cos(state[this.count - 1]), Math.sin(state[this.count - 1])];
    return [...this.own.map((place) => found[place]), x * c + y * s, y * c - x * s];
  }

  /** One step: states at its beginning and at Radau's points; null if it is too long for its equations to be solved. */
  private step(begin: number, length: number, start: Vector, acceleration: number): { whole: Matrix; tail: number } | null {
    const { count, radau } = this;
    const stages = radau.points.length - 1;
    const least = start.map((_, k) => (k === count - 1 ? TURN : acceleration * length));
    const times = radau.points.slice(1).map((point) => begin + length * point);
    let whole: Matrix = Array.from({ length: stages + 1 }, () => [...start]);
    let last = Infinity;
    for (let iteration = 0; ; iteration++) {
      if (iteration === NEWTON) return null;
      const { residual, slope } = this.system(whole, times, length, least);
      const change = Array.from(eliminated(slope, residual));
      if (!change.every(Number.isFinite)) return null;
      whole = whole.map((row, i) => (i ? plus(row, change.slice((i - 1) * count, i * count)) : row));
      const sizes = least.map((size, k) => Math.max(size, ...whole.map((row) => Math.abs(row[k]))));
      const size = Math.max(...change.map((part, i) => Math.abs(part) / sizes[i % count]));
      if (size < 1e-14 || (size < 1e-11 && size >= last)) break;
      last = size;
    }
    const tails = start.map((_, k) => {
      const series = radau.series.map((row) => row.reduce((sum, part, i) => sum + part * whole[i][k], 0));
      const size = Math.max(least[k], ...series.map(Math.abs));
      return Math.max(...series.slice(-2).map(Math.abs)) / size;
    });
    return { whole, tail: Math.max(...tails) };
  }

  /** Rates less D·states/length (with ρ D·ψ), and the derivatives of their negative. */
  private system(whole: Matrix, times: Vector, length: number, least: Vector): { residual: Float64Array; slope: Float64Array[] } {
    const { count, radau } = this;
    const stages = times.length;
    const [size, angle] = [count - 2, count - 1];
    const residual = new Float64Array(stages * count);
    const slope = Array.from({ length: stages * count }, () => new Float64Array(stages * count));
    for (let i = 1; i <= stages; i++) {
      const state = whole[i];
      const rates = this.rates(state, times[i - 1]);
      for (let k = 0; k < count; k++) {
        const row = (i - 1) * count + k;
        const leading = k === angle ? state[size] : 1;
        const derivative = whole.reduce((sum, other, j) => sum + radau.slopes[i][j] * other[k], 0) / length;
        residual[row] = rates[k] - leading * derivative;
        for (let j = 1; j <= stages; j++) slope[row][(j - 1) * count + k] += (leading * radau.slopes[i][j]) / length;
        if (k === angle) slope[row][(i - 1) * count + size] += derivative;
      }
      for (let k = 0; k < count; k++) {
        const by = SHIFT * Math.max(Math.abs(state[k]), least[k]);
        const moved = [...state];
        moved[k] += by;
        const there = this.rates(moved, times[i - 1]);
        for (let row = 0; row < count; row++) slope[(i - 1) * count + row][(i - 1) * count + k] -= (there[row] - rates[row]) / (moved[k] - state[k]);
      }
    }
    return { residual, slope };
  }

  /** States at a share of a step, by interpolation (Berrut and Trefethen). */
  private between(whole: Matrix, share: number): Vector {
    const { points, weights } = this.radau;
    const at = points.indexOf(share);
    if (at >= 0) return [...whole[at]];
    const factors = points.map((point, i) => weights[i] / (share - point));
    const total = factors.reduce((sum, factor) => sum + factor, 0);
    return whole[0].map((_, k) => factors.reduce((sum, factor, i) => sum + factor * whole[i][k], 0) / total);
  }

  /** The share of a step after which the slip vanishes, after it has grown from zero; null if it does not. */
  private vanishing(whole: Matrix): number | null {
    const size = (share: number): number => this.between(whole, share)[this.count - 2];
    const noise = NOISE * Math.max(...whole.map((row) => Math.abs(row[this.count - 2])));
    let before = 0;
    for (let i = 1; i <= PARTS; i++) {
      const share = (i / PARTS) ** 2;
      const now = size(share);
      if (now < -noise) return bisected(size, before, share);
      if (now > 0) before = share;
    }
    return null;
  }
}

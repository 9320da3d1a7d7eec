// Impacts at a contact: without friction, without slip, and with friction by Routh's process with
// Stronge's restitution, as _impact.py in polhode.simulate describes them.

import { NoModeError } from "./errors";
import { bisected, dot, type Matrix, plus, scaled, solved, times, transposed, type Vector, zerosAround } from "./linear";

/** The outcome of an impact: impulse in N s and velocity in m/s, along the support twice and away from it. */
export interface Impact {
  impulse: Vector;
  velocity: Vector;
  sticks: boolean;
}

const STICKS = 1e-13; // slip, relative to the velocity before, that has vanished
const STRAIGHT = 1e-14; // of the largest effect of an impulse: less than this across the slip is rounding
const PHASES = 100; // changes between slip, stick, compression and restitution
const ANGLES = 72; // directions between which those of a slip that resumes are bracketed

export function smoothImpact(inverseMass: Matrix, velocity: Vector, restitution: number): Impact {
  const impulse = [0, 0, (-(1 + restitution) * velocity[2]) / inverseMass[2][2]];
  return { impulse, velocity: plus(velocity, times(inverseMass, impulse)), sticks: false };
}

/** On a support that allows no slip at all, or that reverses it. */
export function roughImpact(inverseMass: Matrix, velocity: Vector, restitution: number, along: number): Impact {
  const inertia = inverseOf(inverseMass);
  const product = (a: Vector, b: Vector): number => dot(a, times(inertia, b));
  const brought = product(velocity, velocity);
  const up = [0, 0, Math.min(restitution * -velocity[2], Math.sqrt(brought / inertia[2][2]))];
  const back = [-along * velocity[0], -along * velocity[1], 0];
  const [square, mixed, left] = [product(back, back), product(back, up), brought - product(up, up)];
  let share = 1;
  if (square + 2 * mixed > left) share = Math.max(Math.sqrt(mixed ** 2 + square * left) - mixed, 0) / square;
  const after = plus(up, back, share);
  return { impulse: times(inertia, plus(after, velocity, -1)), velocity: after, sticks: !along };
}

export function coulombImpact(inverseMass: Matrix, velocity: Vector, kinetic: number, limit: number, restitution: number): Impact {
  const course = new Course(inverseMass, velocity, kinetic, limit, restitution);
  for (let phase = 0; !course.done; phase++) {
    if (phase > PHASES) throw new NoModeError("An impact does not end: friction is too strong.");
    course.advance();
  }
  return { impulse: course.impulse, velocity: course.velocity, sticks: course.sticks };
}

function inverseOf(m: Matrix): Matrix {
  return transposed([0, 1, 2].map((i) => solved(m, [0, 1, 2].map((k) => (k === i ? 1 : 0)))));
}

/** The course of an impact over the normal impulse, phase by phase. */
class Course {
  impulse: Vector = [0, 0, 0];
  sticks = false;
  done = false;
  private readonly scale: number;
  private stored = 0; // work of compression that restitution has yet to return, before the factor e²
  private compressing = true;

  constructor(
    private readonly inverseMass: Matrix,
    public velocity: Vector,
    private readonly kinetic: number,
    private readonly limit: number,
    private readonly restitution: number,
  ) {
    this.scale = Math.hypot(...velocity);
  }

  advance(): void {
    const slip = Math.hypot(this.velocity[0], this.velocity[1]);
    if (this.sticks || slip <= STICKS * this.scale) this.hold();
    else this.slide(slip);
  }

  /** Without slip: it sticks if static friction suffices, else slip resumes. */
  private hold(): void {
    const inertia = inverseOf(this.inverseMass);
    const needed = [0, 1, 2].map((i) => inertia[i][2] / inertia[2][2]);
    this.velocity = [0, 0, this.velocity[2]];
    if (Math.hypot(needed[0], needed[1]) <= this.limit) {
      this.sticks = true;
      this.straight(needed);
      return;
    }
    const angle = this.onset();
    this.straight([-this.kinetic * Math.cos(angle), -this.kinetic * Math.sin(angle), 1]);
  }

  /** A constant force per normal impulse, until compression or restitution ends. */
  private straight(force: Vector): void {
    const rate = times(this.inverseMass, force);
    const start = this.velocity[2];
    let length = -start / rate[2];
    if (this.compressing) this.stored += start ** 2 / (2 * rate[2]);
    else length = (Math.sqrt(Math.max(start ** 2 + 2 * rate[2] * this.restitution ** 2 * this.stored, 0)) - start) / rate[2];
    this.pass(force, rate, length);
    this.turn();
  }

  private pass(force: Vector, rate: Vector, length: number): void {
    this.impulse = plus(this.impulse, force, length);
    this.velocity = plus(this.velocity, rate, length);
  }

  private turn(): void {
    const goesOn = this.compressing && this.restitution > 0;
    if (this.compressing) this.velocity[2] = 0;
    if (goesOn) this.compressing = false;
    else this.done = true;
  }

  /** Slip, whose direction friction may turn, up to the next change. */
  private slide(slip: number): void {
    const [x, y] = [this.velocity[0] / slip, this.velocity[1] / slip];
    const force = [-this.kinetic * x, -this.kinetic * y, 1];
    const rate = times(this.inverseMass, force);
    const largest = Math.max(...this.inverseMass.flat().map(Math.abs));
    if (Math.abs(rate[1] * x - rate[0] * y) > STRAIGHT * largest) this.slideTurning(1 / largest);
    else this.slideStraight(slip, force, rate, -(rate[0] * x + rate[1] * y));
  }

  private slideStraight(slip: number, force: Vector, rate: Vector, slowing: number): void {
    const toStick = slowing > 0 ? slip / slowing : Infinity;
    const toTurn = this.toTurn(rate[2]);
    const length = Math.min(toStick, toTurn);
    const work = this.velocity[2] * length + (rate[2] * length ** 2) / 2;
    this.stored -= this.compressing ? work : work / this.restitution ** 2;
    this.pass(force, rate, length);
    if (toStick < toTurn) this.velocity = [0, 0, this.velocity[2]];
    else this.turn();
  }

  private toTurn(rate: number): number {
    const start = this.velocity[2];
    if (this.compressing) return rate > 0 ? -start / rate : Infinity;
    const left = this.restitution ** 2 * this.stored;
    const square = start ** 2 + 2 * rate * left;
    if (square < 0) return Infinity;
    return rate ? (Math.sqrt(square) - start) / rate : left / start;
  }

  /** With dp = ρ dτ, log ρ and ψ of the slip change at rates that depend on ψ alone. */
  private slideTurning(mass: number): void {
    const speed = this.scale;
    const w = this.inverseMass.map((row) => scaled(row, mass));
    const budget = this.compressing ? null : (this.restitution ** 2 * this.stored) / (mass * speed ** 2);
    const [x, y, z] = scaled(this.velocity, 1 / speed);
    const rates = (s: Vector): Vector => {
      const [size, c, n] = [Math.exp(s[0]), Math.cos(s[1]), Math.sin(s[1])];
      const force = [-this.kinetic * c, -this.kinetic * n, 1];
      const [a, b, up] = times(w, force);
      return [a * c + b * n, b * c - a * n, size * up, size * force[0], size * force[1], size, size * s[2]];
    };
    const ended = (s: Vector): number => (budget === null ? s[2] : s[6] - budget);
    const stuck = (s: Vector): number => Math.log(STICKS) - s[0];
    const last = followed(rates, [Math.log(Math.hypot(x, y)), Math.atan2(y, x), z, 0, 0, 0, 0], (s) => Math.max(ended(s), stuck(s)));
    const over = ended(last) >= stuck(last);
    const size = over ? Math.exp(last[0]) : 0;
    this.velocity = scaled([size * Math.cos(last[1]), size * Math.sin(last[1]), last[2]], speed);
    this.impulse = plus(this.impulse, last.slice(3, 6), mass * speed);
    const work = mass * speed ** 2 * last[6];
    this.stored -= this.compressing ? work : work / this.restitution ** 2;
    if (over) this.turn();
  }

  /** The direction in which slip resumes. */
  private onset(): number {
    const rate = (angle: number): Vector => {
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const [x, y] = times(this.inverseMass, [-this.kinetic * c, -this.kinetic * s, 1]);
      return [x * c + y * s, y * c - x * s];
    };
    const growing = zerosAround((angle) => rate(angle)[1], ANGLES, 0).filter((angle) => rate(angle)[0] > 0);
    if (growing.length !== 1) throw new NoModeError(`Slip can begin in ${growing.length} directions in an impact: friction is too strong.`);
    return growing[0];
  }
}

const LENGTH = 0.05; // of the first step
const COLUMNS = 9; // of the extrapolation
const TOLERANCE = 2e-14; // relative

/** States from some start until a value rises through zero, by extrapolated midpoint steps (Gragg, Bulirsch and Stoer). */
function followed(rates: (state: Vector) => Vector, start: Vector, over: (state: Vector) => number): Vector {
  let state = start;
  let length = LENGTH;
  for (;;) {
    const { end, error } = extrapolated(rates, state, length);
    if (error > TOLERANCE) {
      length /= 2;
      if (length < 1e-12) throw new NoModeError("An impact cannot be followed.");
      continue;
    }
    if (over(end) >= 0) {
      const from = state;
      const share = bisected((part) => over(extrapolated(rates, from, part * length).end), 0, 1);
      return extrapolated(rates, from, share * length).end;
    }
    state = end;
    length *= 1.5;
  }
}

function extrapolated(rates: (state: Vector) => Vector, start: Vector, length: number): { end: Vector; error: number } {
  let row: Vector[] = [];
  let error = Infinity;
  for (let k = 1; k <= COLUMNS; k++) {
    const next = [midpoint(rates, start, length, 2 * k)];
    for (let j = 1; j < k; j++) {
      const ratio = (k / (k - j)) ** 2 - 1;
      next.push(plus(next[j - 1], plus(next[j - 1], row[j - 1], -1), 1 / ratio));
    }
    if (k > 1) error = Math.max(...plus(next[k - 1], row[k - 2], -1).map((part, i) => Math.abs(part) / Math.max(1, Math.abs(next[k - 1][i]))));
    row = next;
    if (error <= TOLERANCE / 10) break;
  }
  return { end: row[row.length - 1], error };
}

function midpoint(rates: (state: Vector) => Vector, start: Vector, length: number, count: number): Vector {
  const step = length / count;
  let before = start;
  let now = plus(start, rates(start), step);
  for (let i = 1; i < count; i++) [before, now] = [now, plus(before, rates(now), 2 * step)];
  return scaled(plus(plus(before, now), rates(now), step), 0.5);
}

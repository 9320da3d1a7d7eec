// The contact modes of a system with one contact, and the rules by which they follow each other.
//
// The forces, slips, mass matrices and maps between modes are compiled from the equations of each mode; the rules are
// those of polhode.simulate: no contact pulls (Signorini), friction stays within its limit (Coulomb), impulses of
// constraints do no work on any motion that they allow.

import { NoModeError } from "./errors";
import { coulombImpact, type Impact, roughImpact, smoothImpact } from "./impact";
import { Kernel } from "./kernel";
import { determinant, dot, inRows, type Matrix, plus, scaled, solved, times, transposed, type Vector, zerosAround } from "./linear";
import type { LiveData, ModeData } from "./model";

const NO_SLIP = 1e-12; // slip that counts as none, relative to the velocities that it is the difference of
const NO_NORMAL_SPEED = 1e-14; // likewise of the normal velocity
const TOLERANCE = 1e-11; // by which a force may exceed its limit where the mode before ended at its own
const ANGLES = 72; // directions of slip, 5° apart, between which roots are bracketed
const PULLS = 1e-9; // a normal force further below zero, of the largest force, pulls
const TURNED = 0.0123; // rad: roots in symmetric directions fall between the points of the grid
export const BARELY = 1e-150; // m/s, for a slip with a direction but no speed
const EDGE = 16; // units in the last place of a distance from an edge that are rounding
const GAP = 1e-12; // of the distance from the origin of the support: a height that counts as zero
const REBOUND = 1e-13; // of the hardest landing: a slower rebound ends the bounces
const INSTANT = 32; // units in the last place of the time: a shorter hop does

/** Coordinates and speeds of the mode in which nothing touches, and the work done. */
export interface Shared {
  time: number;
  coordinates: Vector;
  speeds: Vector;
  work: number;
}

/** How a mode is entered. */
export interface Entry {
  mode: number;
  time: number;
  state: Vector;
  /** The direction in which a slip begins, rad. */
  onset?: number;
}

/** What is known of the contact at an event. */
export interface Status {
  separated?: boolean;
  stuck?: boolean;
  slipping?: boolean;
  beyond?: boolean;
}

interface Kinematics {
  gap: number;
  reserve: number;
  drift: number;
  support: Vector;
  extent: number;
  velocity: Vector;
  jacobian: Matrix;
  scale: number;
}

export class Modes {
  private readonly kernels = new Map<string, Kernel>();
  private readonly buffers = new Map<number, Float64Array>();
  private chosen: number[] = [];
  private parameters: number[] = [];
  private hardest = 0;

  constructor(
    private readonly live: LiveData,
    private readonly module: WebAssembly.Module,
  ) {}

  data(mode: number): ModeData {
    return this.live.modes[mode];
  }

  /** Take the parameters of a motion. */
  begin(parameters: number[]): void {
    this.chosen = parameters;
    this.hardest = 0;
    this.hold(0);
  }

  /** Take the coefficients of prescribed motions that hold from a place of the schedule on. */
  hold(place: number): void {
    this.parameters = [...this.chosen, ...(this.live.schedule.values[place] ?? []), 0];
    this.live.modes.forEach((_, i) => {
      for (const kind of ["viewer", "rates"]) this.kernels.get(`${i} ${kind}`)?.start(this.parameters, this.filled(i), 0);
    });
  }

  integrator(mode: number): Kernel {
    return this.kernel(mode, "integrator");
  }

  viewer(mode: number): Kernel {
    return this.kernel(mode, "viewer");
  }

  private kernel(mode: number, kind: "integrator" | "viewer" | "rates"): Kernel {
    const key = `${mode} ${kind}`;
    const known = this.kernels.get(key);
    if (known) return known;
    const made = new Kernel(this.data(mode)[kind === "viewer" ? kind : "integrator"], this.module);
    made.start(this.parameters, this.filled(mode), 0);
    this.kernels.set(key, made);
    return made;
  }

  /** The parameters with the least slip squared. */
  bounded(least: number): number[] {
    return [...this.parameters.slice(0, -1), least];
  }

  // -- expressions of a mode ----------------------------------------------------------------------

  private values(mode: number, state: Vector, time: number): Float64Array {
    const viewer = this.viewer(mode);
    const out = this.buffers.get(mode) ?? new Float64Array(viewer.data.outputs.length);
    this.buffers.set(mode, out);
    viewer.valuesAt(state, time, out);
    return out;
  }

  /** Outputs of the first mode at its coordinates and speeds. */
  shownAtStart(own: Vector, outputs: number[]): Vector {
    const values = this.values(0, this.filled(0, own), 0);
    return outputs.map((output) => values[output]);
  }

  private joined(mode: number, name: string, state: Vector, time: number): Vector {
    const outputs = this.data(mode).joined[name];
    if (!outputs) return [];
    const values = this.values(mode, state, time);
    return outputs.map((output) => values[output]);
  }

  private law(name: string): number | undefined {
    const output = this.live.law[name];
    if (output === undefined) return undefined;
    return this.values(0, this.filled(0), 0)[output];
  }

  private find(phase: string, beyond: boolean): number {
    return this.live.modes.findIndex((mode) => mode.phase === phase && mode.beyond === beyond);
  }

  flight(beyond: boolean): number {
    const found = this.find("flight", beyond);
    return found < 0 ? this.find("flight", false) : found;
  }

  /** All states of a mode from its coordinates and speeds. */
  whole(mode: number, own: Vector, time: number): Vector {
    const { joined } = this.data(mode);
    const state = this.filled(mode, own);
    if (joined.begin) state.splice(own.length, joined.begin.length, ...this.joined(mode, "begin", state, time));
    return state;
  }

  /** The shared state of a state of one mode. */
  shared(mode: number, state: Vector, time: number): Shared {
    const values = this.joined(mode, "shared", state, time);
    const flight = this.data(this.flight(false));
    const count = flight.coordinates.length;
    return { time, coordinates: values.slice(0, count), speeds: values.slice(count), work: state[this.data(mode).work] };
  }

  private inFlight(shared: Shared, beyond: boolean): [number, Vector] {
    const mode = this.flight(beyond);
    return [mode, this.filled(mode, [...shared.coordinates, ...shared.speeds])];
  }

  private kinematics(shared: Shared, beyond: boolean): Kinematics {
    const [mode, state] = this.inFlight(shared, beyond);
    const found = this.joined(mode, "kinematics", state, shared.time);
    const [gap, reserve, drift] = found;
    const position = found.slice(6, 9);
    const rest = found.slice(9, 12);
    const jacobian = inRows(found.slice(12), shared.speeds.length);
    const sizes = jacobian.map((row, i) => Math.abs(rest[i]) + dot(row.map(Math.abs), shared.speeds.map(Math.abs)));
    return {
      gap,
      reserve,
      drift,
      support: found.slice(3, 6),
      extent: Math.max(...position.map(Math.abs), Math.abs(position[2] - gap)),
      velocity: plus(rest, times(jacobian, shared.speeds)),
      jacobian,
      scale: Math.max(...sizes),
    };
  }

  private masses(mode: number, state: Vector, time: number): Matrix {
    const entries = this.joined(mode, "masses", state, time);
    return inRows(entries, Math.sqrt(entries.length));
  }

  private massInFlight(shared: Shared): Matrix {
    const [mode, state] = this.inFlight(shared, false);
    return this.masses(mode, state, shared.time);
  }

  private isBeyond(shared: Shared): boolean {
    if (this.find("flight", true) < 0) return false;
    const { reserve, drift, extent } = this.kinematics(shared, false);
    return Math.abs(reserve) <= EDGE * spacing(extent) ? drift <= 0 : reserve < 0;
  }

  // -- the choice of a mode -----------------------------------------------------------------------

  /** Refuse masses, moments of inertia and lengths that are impossible. Sliding friction makes the mass matrix unsymmetric. */
  refuseImpossibleMasses(mode: number, state: Vector): void {
    const wrong = this.live.parameters.find(({ name }, i) => this.live.positive.includes(name) && !(this.chosen[i] > 0));
    if (wrong) throw new NoModeError(`${wrong.name} = ${this.chosen[this.live.parameters.indexOf(wrong)] / wrong.size} is impossible: it is assumed to be positive.`);
    const masses = this.masses(mode, state, 0);
    const isSymmetric = masses.every((row, i) => row.every((entry, k) => entry === masses[k][i]));
    const minors = masses.map((_, i) => determinant(masses.slice(0, i + 1).map((row) => row.slice(0, i + 1))));
    if (isSymmetric && minors.some((minor) => minor <= 0)) throw new NoModeError("The mass matrix is not positive definite at the start: masses, moments of inertia and lengths have to be positive.");
  }

  /** Refuse a start that is beyond what ends a mode which has no other. */
  refuseEnded(mode: number, state: Vector): void {
    const values = this.joined(mode, "watched", state, 0);
    const size = Math.max(...values.map(Math.abs));
    const ended = values.findIndex((value) => value < -TOLERANCE * size);
    if (ended >= 0) throw new NoModeError(`${this.data(mode).watched[ended].kind} at the start.`);
  }

  /** Refuse coefficients that no contact has. */
  private refuseImpossible(): void {
    const { mu = 0, mu_static: limit = mu, restitution = 0 } = Object.fromEntries(Object.keys(this.live.law).map((name) => [name, this.law(name)]));
    if (!(mu >= 0)) throw new NoModeError(`A coefficient of friction of ${mu} is impossible.`);
    if (!(limit >= mu)) throw new NoModeError(`The coefficient of static friction is ${limit}, less than ${mu}, that of kinetic friction.`);
    if (!(restitution >= 0 && restitution <= 1)) throw new NoModeError(`A restitution of ${restitution} is impossible: it is between 0 and 1.`);
  }

  /** The first mode of a motion, from the state of the mode that the sliders are for. */
  initial(own: Vector): Entry {
    this.refuseImpossible();
    const state = this.whole(0, own, 0);
    this.refuseImpossibleMasses(0, state);
    const shared = this.shared(0, state, 0);
    return this.data(0).phase === "flight" ? this.begun(shared) : this.select(shared, {});
  }

  /** The first mode of a motion, from coordinates and speeds of flight. */
  resumed(begin: Vector): Entry {
    this.refuseImpossible();
    const { coordinates } = this.data(this.flight(false));
    const shared = { time: 0, coordinates: begin.slice(0, coordinates.length), speeds: begin.slice(coordinates.length), work: 0 };
    this.refuseImpossibleMasses(...this.inFlight(shared, false));
    return this.begun(shared);
  }

  private begun(shared: Shared): Entry {
    const point = this.kinematics(shared, this.isBeyond(shared));
    if (point.gap < -GAP * point.extent) throw new NoModeError("The body starts below its support.");
    const meets = point.gap <= GAP * point.extent;
    const rests = meets && Math.abs(point.velocity[2]) <= NO_NORMAL_SPEED * point.scale;
    return this.select(shared, { separated: !rests }, meets ? 0 : undefined);
  }

  /** The first mode, in the order of trial, whose contact can exert the forces that it needs. */
  private select(shared: Shared, known: Status, gap?: number): Entry {
    const beyond = known.beyond ?? this.isBeyond(shared);
    const point = this.kinematics(shared, beyond);
    const slip = Math.hypot(point.velocity[0], point.velocity[1]);
    const still = Boolean(known.stuck || known.slipping) || slip <= NO_SLIP * point.scale;
    const sticks = still && !known.slipping;
    const closed = ["rolling", "sliding", "frictionless"].filter((phase) => this.find(phase, beyond) >= 0 && (phase !== "rolling" || sticks || this.find("sliding", beyond) < 0));
    for (const phase of [...(known.separated ? [] : closed), "flight"]) {
      const mode = this.find(phase, beyond);
      if (mode < 0) continue;
      const entry = this.enter(shared, mode, point, still, gap);
      if (entry && this.isPossible(entry)) return entry;
    }
    throw new NoModeError("No contact mode is possible: friction or normal forces have no solution there.");
  }

  /** Enter a mode: its constraints project the speeds. Undefined where slip would begin in directions that pull alone. */
  private enter(shared: Shared, mode: number, point: Kinematics, still: boolean, gap?: number): Entry | undefined {
    const data = this.data(mode);
    const { time } = shared;
    const flight = this.data(this.flight(false));
    const coordinates = data.coordinates.map((name) => shared.coordinates[flight.coordinates.indexOf(name)]);
    const blank = this.filled(mode, coordinates);
    const rest = this.joined(mode, "rest", blank, time);
    const columns = inRows(this.joined(mode, "columns", blank, time), data.speeds.length);
    const mass = this.massInFlight(shared);
    const allowed = transposed(columns);
    // momentum along the motions that are allowed is kept: Pᵀ M P u = Pᵀ M (u − rest)
    const momentum = times(mass, plus(shared.speeds, rest, -1));
    const reduced = allowed.map((row) => allowed.map((other) => dot(row, times(mass, other))));
    const speeds = solved(reduced, times(allowed, momentum));
    const own = [...coordinates, ...speeds];
    const state = this.whole(mode, own, time);
    const after = this.joined(mode, "shared", state, time).slice(shared.coordinates.length);
    state[data.work] = shared.work + (data.phase === "flight" ? 0 : workOf(plus(after, shared.speeds, -1), mass, point));
    if (data.gap >= 0) state[data.gap] = gap ?? Math.max(point.gap, 0);
    if (data.edge >= 0) state[data.edge] = Math.max(data.beyond ? -point.reserve : point.reserve, 0);
    if (data.slips.length) {
      if (still) {
        const onset = this.onset(mode, state, time);
        if (onset === undefined) return undefined;
        this.slipAt(mode, state, BARELY, onset);
        return { mode, time, state, onset };
      } else [state[data.slips[0]], state[data.slips[1]]] = point.velocity;
    }
    return { mode, time, state };
  }

  /** All states of a mode, of which the first are given and the others zero. */
  private filled(mode: number, first: Vector = []): Vector {
    return [...first, ...new Array<number>(this.data(mode).viewer.states[1] - first.length).fill(0)];
  }

  private slipAt(mode: number, state: Vector, size: number, angle: number): void {
    const [x, y] = this.data(mode).slips;
    [state[x], state[y]] = [size * Math.cos(angle), size * Math.sin(angle)];
  }

  /** Rates of a slip that begins in a direction. */
  private slipRates(mode: number, state: Vector, time: number, angle: number): Vector {
    const trial = [...state];
    this.slipAt(mode, trial, BARELY, angle);
    return this.joined(mode, "slip rates", trial, time);
  }

  /** Whether the contact need not pull where slip begins in a direction; where sliding jams, N < 0 says nothing. */
  private presses(mode: number, state: Vector, time: number, angle: number): boolean {
    const trial = [...state];
    this.slipAt(mode, trial, BARELY, angle);
    const force = this.joined(mode, "forces", trial, time);
    const pulls = force[2] < -PULLS * Math.max(...force.map(Math.abs));
    return !pulls || this.freedom(mode, trial, time) <= 0;
  }

  /** The direction in which slip begins: ṡ(ŝ) × ŝ = 0 and ṡ(ŝ) · ŝ ≥ 0; undefined where the contact opens. */
  private onset(mode: number, state: Vector, time: number): number | undefined {
    const rates = (angle: number): Vector => this.slipRates(mode, state, time, angle);
    const across = (angle: number): number => {
      const [x, y] = rates(angle);
      return y * Math.cos(angle) - x * Math.sin(angle);
    };
    const along = (angle: number): number => {
      const [x, y] = rates(angle);
      return x * Math.cos(angle) + y * Math.sin(angle);
    };
    const size = Math.max(...Array.from({ length: ANGLES }, (_, i) => Math.hypot(...rates((2 * Math.PI * i) / ANGLES))));
    const growing = zerosAround(across, ANGLES, TURNED - Math.PI).filter((angle) => along(angle) > -1e-9 * size);
    const pressed = growing.filter((angle) => this.presses(mode, state, time, angle));
    if (growing.length && !pressed.length) return undefined; // it would have to pull in every direction
    if (pressed.length !== 1) throw new NoModeError(`Slip can begin there in ${pressed.length ? "several directions" : "no direction"}: a rigid body with this friction has no unique motion.`);
    return pressed[0];
  }

  /** The largest rate of a slip that its friction alone brings about, and the largest of all, m/s². */
  accelerations({ mode, state, time, onset = 0 }: Entry): [number, number] {
    const rates = (angle: number): Vector => this.slipRates(mode, state, time, angle);
    const [ahead, back] = [rates(onset), rates(onset + Math.PI)];
    const half = (sign: number): number => Math.hypot(...plus(ahead, back, sign)) / 2;
    return [half(-1), Math.max(half(-1), half(1))];
  }

  /** Rates of all states. */
  rates(mode: number, state: Vector, time: number): Vector {
    return this.kernel(mode, "rates").rates(state, time);
  }

  /** Whether the forces in a mode can be: N ≥ 0, and while sticking |T| ≤ μ_s N. */
  private isPossible({ mode, state, time }: Entry): boolean {
    const { phase } = this.data(mode);
    if (phase === "flight") return true;
    if (phase === "sliding" && this.freedom(mode, state, time) <= 0) throw new NoModeError("Sliding jams there (Painlevé's paradox).");
    const force = this.joined(mode, "forces", state, time);
    if (!force.every(Number.isFinite)) return false;
    const largest = Math.max(...force.map(Math.abs));
    if (force[2] < -TOLERANCE * largest) return false;
    const limit = this.law("mu_static");
    if (phase === "rolling" && limit !== undefined) return Math.hypot(force[0], force[1]) <= limit * force[2] * (1 + TOLERANCE);
    return true;
  }

  /** How much friction a contact needs that rolls, against its normal force. */
  friction(mode: number, state: Vector, time: number): number {
    const [x, y, normal] = this.joined(mode, "forces", state, time);
    return Math.hypot(x, y) / normal;
  }

  /** The determinant of the mass matrix of sliding, over that for both directions of slip; sliding jams where it is not positive. */
  freedom(mode: number, state: Vector, time: number): number {
    const { slips } = this.data(mode);
    if (!slips.length) return 1;
    const here = this.masses(mode, state, time);
    const other = [...state];
    for (const place of slips) other[place] *= -1;
    const there = this.masses(mode, other, time);
    const mean = here.map((row, i) => row.map((entry, k) => (entry + there[i][k]) / 2));
    return determinant(here) / determinant(mean);
  }

  // -- changes of mode ----------------------------------------------------------------------------

  /** How the motion goes on where the velocity of a support jumps: the coefficients from there on are taken. */
  jerk(mode: number, state: Vector, time: number, place: number): Entry {
    const shared = this.shared(mode, state, time);
    this.hold(place);
    return this.select(shared, { separated: this.data(mode).phase === "flight" });
  }

  /** What happens where a guard falls, and how the next mode is entered. */
  next(kind: string, mode: number, state: Vector, time: number): { kind: string; entry: Entry } {
    const data = this.data(mode);
    const shared = this.shared(mode, state, time);
    const { beyond } = data;
    if (kind === "touches down") return this.land(shared);
    if (kind === "lifts off") return { kind, entry: this.select(shared, { separated: true, beyond }, 0) };
    if (kind === "slips") return { kind, entry: this.select(shared, { slipping: true, beyond }) };
    if (kind === "crosses the edge") {
      const entry = this.select(shared, { separated: data.phase === "flight", beyond: !beyond });
      const { edge } = this.data(entry.mode);
      if (edge >= 0) entry.state[edge] = 0;
      return { kind, entry };
    }
    const entry = this.select(shared, { stuck: true, beyond });
    return { kind: this.data(entry.mode).phase === "sliding" ? "turns round" : kind, entry };
  }

  /** An impact, if it approaches; then contact, or flight again if it rebounds. */
  private land(shared: Shared): { kind: string; entry: Entry } {
    const beyond = this.isBeyond(shared);
    const point = this.kinematics(shared, beyond);
    const slow = NO_NORMAL_SPEED * point.scale;
    const kind = "touches down";
    if (point.velocity[2] > slow) return { kind, entry: this.select(shared, { separated: true, beyond }, 0) };
    if (point.velocity[2] >= -slow) return { kind, entry: this.select(shared, { beyond }) };
    const mass = this.massInFlight(shared);
    const back = point.jacobian.map((row) => solved(mass, row)); // M⁻¹ Jᵀ, column by column
    const inverseMass = point.jacobian.map((row) => back.map((column) => dot(row, column)));
    const impact = this.impact(inverseMass, point.velocity);
    const work = dot(impact.impulse, plus(point.support, scaled(plus(point.velocity, impact.velocity), 0.5)));
    const change = times(transposed(back), impact.impulse);
    const after: Shared = { ...shared, speeds: plus(shared.speeds, change), work: shared.work + work };
    this.hardest = Math.max(this.hardest, -point.velocity[2]);
    if (impact.velocity[2] > REBOUND * this.hardest) {
      const entry = this.select(after, { separated: true, beyond }, 0);
      const [fall] = this.joined(entry.mode, "closing", entry.state, entry.time);
      const hop = fall < 0 ? (2 * impact.velocity[2]) / -fall : Infinity;
      if (hop > INSTANT * spacing(entry.time)) return { kind: "bounces", entry };
    }
    return { kind, entry: this.select(after, { stuck: impact.sticks, beyond }) };
  }

  private impact(inverseMass: Matrix, velocity: Vector): Impact {
    const restitution = this.law("restitution") ?? 0;
    const kinetic = this.law("mu");
    if (kinetic !== undefined) return coulombImpact(inverseMass, velocity, kinetic, this.law("mu_static") ?? kinetic, restitution);
    if (this.live.modes.some(({ phase }) => phase === "rolling")) return roughImpact(inverseMass, velocity, restitution, this.law("tangential") ?? 0);
    return smoothImpact(inverseMass, velocity, restitution);
  }
}

/** Work of the impulse of a constraint: it follows from the change of momentum, Jᵀ p = M Δu. */
function workOf(change: Vector, mass: Matrix, point: Kinematics): number {
  if (change.every((part) => part === 0)) return 0;
  const { jacobian } = point;
  const normal = jacobian.map((row) => jacobian.map((other) => dot(row, other)));
  const impulse = solved(normal, times(jacobian, times(mass, change)));
  return dot(impulse, plus(plus(point.velocity, point.support), times(jacobian, change), 0.5));
}

/** The distance of a number to the next. */
function spacing(value: number): number {
  const size = Math.abs(value);
  return size < 2 ** -1022 ? 2 ** -1074 : 2 ** (Math.floor(Math.log2(size)) - 52);
}

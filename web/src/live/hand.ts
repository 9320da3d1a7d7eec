// What a hand does to a body: it moves it to another start, or pushes it.

import { cross, dot, type Matrix, plus, scaled, solved, transposed, type Vector } from "./linear";
import { NoModeError } from "./errors";
import type { LiveData, Numbers } from "./model";
import type { Engine } from "./motion";
import { ANGLES } from "./units";

/** A line of sight, from a point along a unit vector. */
export interface Sight {
  origin: Vector;
  direction: Vector;
}

const STEP = 1e-6; // of a coordinate, in its scale, for differences
const LONGEST = 0.3; // of a step towards the line of sight, in scales
const SHORTEST = 1e-3; // part of a step: none is nearer
const MOST = 40; // steps
const CLOSE = 1e-4; // scales from the line of sight
const DAMPING = 1e-10; // of the largest entry: what no coordinate moves is left where it is
const ROUNDING = 1e-9; // of the largest change of a speed, by energy
const NOTHING = 1e-12; // of the largest mobility: a point that is held does not follow a push

/**
 * Coordinates with which a point comes under a line of sight, or as near as it can; changed as little as possible.
 *
 * @param point rows of which the first three are its place, m; others are to stay zero.
 * @param groups places of coordinates that may change: of the next group only where those before do not suffice.
 * @param scales what counts as much as a radian, of each coordinate.
 */
export function moved(point: (coordinates: Vector) => Vector, start: Vector, groups: number[][], scales: Vector, sight: Sight, size: number): Vector {
  let nearest = start;
  for (const places of groups) {
    const { found, left } = approached(point, nearest, places, scales, sight, size);
    nearest = found;
    if (left < CLOSE) break;
  }
  return nearest;
}

/** By Gauss and Newton. */
function approached(point: (coordinates: Vector) => Vector, start: Vector, places: number[], scales: Vector, sight: Sight, size: number): { found: Vector; left: number } {
  const missed = (coordinates: Vector): Vector => {
    const [x, y, z, ...rest] = point(coordinates);
    const from = plus([x, y, z], sight.origin, -1);
    return scaled([...plus(from, sight.direction, -dot(from, sight.direction)), ...rest], 1 / size);
  };
  const shifted = (from: Vector, by: Vector): Vector => from.map((value, i) => value + scales[i] * (by[places.indexOf(i)] ?? 0));
  let found = start;
  let left = missed(found);
  for (let i = 0; i < MOST; i++) {
    const slopes: Matrix = places.map((_, k) => {
      const by = (step: number): Vector => missed(shifted(found, places.map((_, j) => (j === k ? step : 0))));
      return scaled(plus(by(STEP), by(-STEP), -1), 1 / (2 * STEP));
    });
    const square = transposed(slopes).map((row) => transposed(slopes).map((other) => dot(row, other)));
    const damping = DAMPING * Math.max(...square.flat().map(Math.abs));
    const share = solved(square.map((row, k) => row.map((entry, j) => entry + (j === k ? damping : 0))), left);
    const step = slopes.map((row) => -dot(row, share));
    let part = Math.min(1, LONGEST / Math.hypot(...step));
    let after = missed(shifted(found, scaled(step, part)));
    // also where something is not a number
    while (!(Math.hypot(...after) < Math.hypot(...left)) && part > SHORTEST) after = missed(shifted(found, scaled(step, (part /= 2))));
    if (part <= SHORTEST) break;
    [found, left] = [shifted(found, scaled(step, part)), after];
  }
  return { found, left: Math.hypot(...left) };
}

/** Of a system at some coordinates. */
export interface Inertia {
  masses: Matrix;
  /** Velocity of a point for each of the speeds. */
  mobility: Matrix;
}

/** Energy is quadratic in the speeds. */
export function inertiaOf(energy: (speeds: Vector) => number, velocity: (speeds: Vector) => Vector, speeds: Vector): Inertia {
  const raised = (...places: number[]): Vector => speeds.map((value, i) => value + places.filter((place) => place === i).length);
  const none = energy(speeds);
  const single = speeds.map((_, i) => energy(raised(i)));
  const masses = speeds.map((_, i) => speeds.map((_, k) => energy(raised(i, k)) - single[i] - single[k] + none));
  const still = velocity(speeds);
  return { masses, mobility: speeds.map((_, i) => plus(velocity(raised(i)), still, -1)) };
}

/**
 * Speeds after an impulse at a point, given the change of its velocity along itself, m/s; and the impulse, N s.
 *
 * Constraints react with impulses of their own: M Δu = Jᵀ p.
 */
export function pushed(speeds: Vector, { masses, mobility }: Inertia, change: Vector): { speeds: Vector; impulse: number } {
  const size = Math.hypot(...change);
  if (!size) return { speeds, impulse: 0 };
  const force = mobility.map((row) => dot(row, change) / size);
  const answer = solved(masses, force);
  const yields = dot(force, answer); // change of velocity by a unit impulse
  const largest = Math.max(...mobility.map((row, i) => dot(row, row) / masses[i][i]));
  if (!(yields > NOTHING * largest)) return { speeds, impulse: 0 };
  const shares = answer.map((part, i) => Math.abs(part) * Math.sqrt(masses[i][i]));
  const seen = answer.map((part, i) => (shares[i] > ROUNDING * Math.max(...shares) ? part : 0));
  return { speeds: plus(speeds, seen, size / yields), impulse: size / yields };
}

// -- in the system of a page ------------------------------------------------------------------------

/** What is done: from an instant of a motion on, to a body that is to be seen somewhere, or to a point of it. */
export type Hand =
  | { kind: "take"; time: number }
  | { kind: "move"; body: number; sight: Sight; size: number }
  | { kind: "push"; body: number; point: Vector; change: Vector };

/** Another start: what the sliders show of it, and all of it where that is not enough. */
export interface Handled {
  start: number[];
  begin: number[] | null;
  /** Of a push, N s. */
  impulse: number;
}

const TOUCHES = 1e-9; // sizes of a body: a lower height is none

/** Throws, in words, where that cannot be. */
export function handled(engine: Engine, live: LiveData, numbers: Numbers, hand: Hand): Handled {
  const before = engine.takenAt(numbers, hand.kind === "take" ? hand.time : 0);
  engine.begin(numbers.parameters);
  const { begin, impulse } = changed(engine, live, before, hand);
  return { start: engine.startOf(begin), begin: live.contact === null ? null : begin, impulse };
}

function changed(engine: Engine, live: LiveData, before: Vector, hand: Hand): { begin: Vector; impulse: number } {
  if (hand.kind === "take") return { begin: before, impulse: 0 };
  if (hand.kind === "push" && live.contact === null && live.modes[0].phase) throw new NoModeError("This page follows one mode of several contacts, which a push may end.");
  const { coordinates, joined } = live.modes[engine.widest];
  const body = live.drawn.bodies[hand.body];
  const outputs = (places: number[], at: Vector): Vector => {
    const values = engine.outputsAt(at);
    return places.map((place) => values[place]);
  };
  if (hand.kind === "move") {
    const { sight, size } = hand;
    const height = joined.kinematics?.slice(0, 1) ?? [];
    const rests = height.some((place) => Math.abs(outputs([place], before)[0]) < TOUCHES * size);
    const held = [...(rests ? height : []), ...live.loops.gaps];
    const isAngle = (name: string): boolean => live.start.some((slider) => slider.name === name && (!slider.unit || slider.unit in ANGLES));
    const all = coordinates.map((_, i) => i);
    const lengths = all.filter((i) => !isAngle(coordinates[i]));
    const scales = before.map((_, i) => (lengths.includes(i) ? size : 1));
    const shown = [...body.place, ...held];
    return { begin: moved((at) => outputs(shown, at), before, lengths.length ? [lengths, all] : [all], scales, sight, size), impulse: 0 };
  }
  const [where, speeds] = [before.slice(0, coordinates.length), before.slice(coordinates.length)];
  const from = plus(hand.point, outputs(body.place, before), -1);
  const velocity = (changed: Vector): Vector => {
    const found = outputs([...body.velocity, ...body.rotation], [...where, ...changed]);
    return plus(found.slice(0, 3), cross(found.slice(3), from));
  };
  const energy = (changed: Vector): number => outputs(live.drawn.energy.slice(0, 1), [...where, ...changed])[0];
  const after = pushed(speeds, inertiaOf(energy, velocity, speeds), hand.change);
  return { begin: [...where, ...after.speeds], impulse: after.impulse };
}

// The scene of a motion that the page has computed: what polhode.view makes of one in Python.

import { digits } from "../dom";
import { reach } from "../reach";
import type { AnglesData, ArrowKind, ArrowData, BodyData, LinkData, NumberData, Packed, PanelData, PortraitData, PoseData, SceneData, SupportData, TraceData, Triple } from "../scene";
import type { DrawnArrow, DrawnBody, DrawnContact, Grid, LiveData } from "./model";
import type { Engine, Motion } from "./motion";
import { shapeOf } from "./shape_rules";
import { product, quaternions, rolled, turned } from "./turns";
import { scaleFor } from "./units";

/** What a computed motion replaces in the scene that the page opens with. */
export type Computed = Pick<SceneData, "duration" | "frames" | "up" | "floor" | "bodies" | "joints" | "links" | "supports" | "arrows" | "angles" | "traces" | "panels" | "portraits" | "evidence" | "happenings" | "modes" | "doubt">;

const STILL = 1e-9; // relative spread below which rows count as equal
const POINT = 0.07; // radius of a particle against the reach of the whole
const THICKNESS: Record<string, number> = { spring: 0.035, damper: 0.022, rope: 0.006 };
const UNSEEN = 1e-9; // an arrow shorter than this share of the longest of its kind is not drawn
const USUAL = 0.9; // share of the motion for which an arrow is shorter than its usual length
const ROUNDING = 1e-14; // of the largest value in a unit: less is zero
const BEYOND = 1.1; // distance of the end of an axis that leaves a trace, in reaches of its body
const BELOW = 1.15; // depth of the floor where no support is, in reaches of the body above
const ROOM = 2.6; // margin of a support around the path of the contact, in reaches of a body
const LOST = 1e7; // roundings allowed for cancellation
const PER_STEP = 100; // roundings allowed for every step
const EVENTS = 40; // listed at most
const UPRIGHT: Triple = [0, 0, 1];

export function pictured(live: LiveData, engine: Engine, motion: Motion): Computed {
  const { drawn } = live;
  const up = motion.constants(drawn.up) as Triple;
  const links = drawn.links.map((link) => linked(link, motion));
  const bodies = sized(drawn.bodies.map((body) => bodied(body, motion)), links);
  const reaches = Math.max(...bodies.map(reach));
  const contacts = drawn.contacts.map((contact) => new Contact(contact, motion));
  const imbalance = balance(live, motion);
  const gaps = loopsOf(live, motion);
  const supports = contacts.filter(({ drawn: { kind } }) => kind !== null).map((contact) => supported(contact, motion, engine, reaches));
  return {
    duration: motion.end,
    frames: motion.frames,
    up,
    floor: supports.length ? null : floorOf(bodies, links, up),
    bodies,
    joints: drawn.joints.map(({ kind, name, body, place, axis }) => ({ kind, name, body, place: motion.constants(place) as Triple, axis: axis ? (motion.constants(axis) as Triple) : UPRIGHT })),
    links,
    supports,
    arrows: arrowsOf(drawn.arrows, motion),
    angles: drawn.angles.map((angles) => angled(angles, motion)),
    traces: [...contacts.flatMap((contact) => contact.traces()), ...bodies.flatMap(pathsOf)],
    panels: drawn.panels.map((panel) => panelled(panel, motion)),
    portraits: drawn.portraits.map((portrait) => portrayed(portrait, motion)),
    evidence: [imbalance, ...gaps],
    doubt: doubtAbout(imbalance.value, motion.steps),
    modes: motion.modes,
    happenings: motion.happenings.slice(0, EVENTS).map(({ time, kind, mode }) => ({ time, what: `${kind}: ${mode}` })),
  };
}

// -- arrays ---------------------------------------------------------------------------------------

function packed(rows: Float64Array, width: number): Packed {
  return { shape: width === 1 ? [rows.length] : [rows.length / width, width], float32: Float32Array.from(rows) };
}

/** A single row if all are equal to rounding. */
function collapsed(rows: Float64Array, width: number): Packed {
  const size = rows.reduce((a, b) => Math.max(a, Math.abs(b)), 0);
  const low = Array.from(rows.subarray(0, width));
  const high = [...low];
  rows.forEach((value, i) => {
    low[i % width] = Math.min(low[i % width], value);
    high[i % width] = Math.max(high[i % width], value);
  });
  const still = high.every((value, k) => value - low[k] <= STILL * size);
  return packed(still ? rows.slice(0, width) : rows, width);
}

function lengthsOf(rows: Float64Array): Float64Array {
  return Float64Array.from({ length: rows.length / 3 }, (_, i) => Math.hypot(rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]));
}

const largestOf = (values: Float64Array): number => values.reduce((a, b) => (Number.isFinite(b) ? Math.max(a, Math.abs(b)) : a), 0);

function row(data: Packed, frame: number): Float32Array {
  const [count, width] = data.shape;
  const first = Math.min(frame, count - 1) * width;
  return (data.float32 as Float32Array).subarray(first, first + width);
}

// -- bodies and links -----------------------------------------------------------------------------

function bodied(body: DrawnBody, motion: Motion): BodyData {
  const shape = shapeOf(body.rule, motion.constants(body.numbers), body.position);
  const arms = body.arms.map((arm) => motion.constants(arm) as Triple);
  return { name: body.name, shape, pose: posed(body, motion), arms, labels: body.labels };
}

function posed(body: DrawnBody, motion: Motion): PoseData {
  const place = collapsed(motion.rows(body.place), 3);
  const none: Packed = { shape: [0], float32: new Float32Array(0) };
  if (body.turning) {
    return { place, turn: collapsed(rolled(motion.rows(body.turning), motion.time(1)), 4), spin: none, axis: UPRIGHT };
  }
  const turn = collapsed(quaternions(motion.rows(body.turn ?? [])), 4);
  if (body.spin === null) return { place, turn, spin: none, axis: UPRIGHT };
  return { place, turn, spin: packed(motion.column(body.spin), 1), axis: motion.constants(body.axis ?? []) as Triple };
}

/** Bodies of which particles have a radius that can be seen. */
function sized(bodies: BodyData[], links: LinkData[]): BodyData[] {
  const lengths = [...bodies.map(reach), ...links.map(({ kind, thick }) => thick / THICKNESS[kind])];
  const size = [POINT * (Math.max(...lengths) || 1)];
  return bodies.map((body) => (body.shape.size.some((length) => length) ? body : { ...body, shape: { ...body.shape, size } }));
}

function linked({ kind, name, start, end }: LiveData["drawn"]["links"][number], motion: Motion): LinkData {
  const ends = [start, end].map((point) => motion.rows(point));
  const longest = largestOf(lengthsOf(ends[0].map((value, i) => value - ends[1][i])));
  return { kind, name, start: collapsed(ends[0], 3), end: collapsed(ends[1], 3), thick: THICKNESS[kind] * longest };
}

/** Paths of centres of mass that move, and of the ends of axes about those that do not. */
function pathsOf({ name, shape, pose }: BodyData): TraceData[] {
  if (pose.place.shape[0] > 1) return [{ kind: "centre", name: `centre of ${name}`, points: pose.place, support: -1 }];
  const frames = pose.turn.shape[0];
  if (frames < 2 || shape.kind === "ball") return [];
  const far = BEYOND * reach({ shape, arms: [] });
  const tip = shape.axis.map((part) => far * part);
  const points = new Float64Array(3 * frames);
  for (let i = 0; i < frames; i++) points.set(turned(tip, row(pose.turn, i)).map((part, k) => part + row(pose.place, 0)[k]), 3 * i);
  return [{ kind: "axis", name: `axis of ${name}`, points: packed(points, 3), support: -1 }];
}

/** A height below all bodies and links. */
function floorOf(bodies: BodyData[], links: LinkData[], up: Triple): number {
  const height = (data: Packed): number => {
    const values = Array.from({ length: data.shape[0] }, (_, i) => row(data, i).reduce((sum, part, k) => sum + part * up[k], 0));
    return values.reduce((a, b) => Math.min(a, b), Infinity);
  };
  return Math.min(...links.flatMap(({ start, end }) => [height(start), height(end)]), ...bodies.map((body) => height(body.pose.place) - BELOW * reach(body)));
}

// -- supports -------------------------------------------------------------------------------------

class Contact {
  readonly pose: PoseData;
  /** The path of the contact along the axes of the support. */
  readonly onIt: Float64Array;
  private readonly moves: boolean;

  constructor(
    readonly drawn: DrawnContact,
    private readonly motion: Motion,
  ) {
    this.pose = supportPose(drawn, motion);
    this.moves = this.pose.place.shape[0] > 1 || this.pose.turn.shape[0] > 1;
    const touched = drawn.touched ? motion.rows(drawn.touched) : new Float64Array(3 * motion.frames).fill(NaN);
    this.onIt = new Float64Array(touched.length);
    for (let i = 0; i < motion.frames; i++) {
      const place = row(this.pose.place, i);
      const from = [0, 1, 2].map((k) => touched[3 * i + k] - place[k]);
      this.onIt.set(turned(from, row(this.pose.turn, i), true), 3 * i);
    }
  }

  traces(): TraceData[] {
    const { drawn, motion } = this;
    const points = drawn.point ? motion.rows(drawn.point) : new Float64Array(3 * motion.frames).fill(NaN);
    const found = [{ kind: "contact", name: `path of ${drawn.name}`, points: packed(points, 3), support: -1 }];
    if (this.moves) found.push({ kind: "contact", name: `trace on ${drawn.name}`, points: packed(this.onIt, 3), support: drawn.support });
    return found;
  }

  /** The least and the greatest coordinate of the path along a direction of the support. */
  range(direction: number): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (let i = direction; i < this.onIt.length; i += 3) {
      low = Math.min(low, this.onIt[i]);
      high = Math.max(high, this.onIt[i]);
    }
    return low <= high ? [low, high] : [0, 0];
  }

  farthest(): number {
    let far = 0;
    for (let i = 0; i < this.onIt.length; i += 3) far = Math.max(far, Math.hypot(this.onIt[i], this.onIt[i + 1]) || 0);
    return far;
  }
}

function supportPose(drawn: DrawnContact, motion: Motion): PoseData {
  let turn = quaternions(motion.rows(drawn.turn));
  const rate = motion.column(drawn.turning);
  const angle = new Float64Array(rate.length);
  for (let i = 1; i < rate.length; i++) angle[i] = angle[i - 1] + ((rate[i] + rate[i - 1]) / 2) * motion.time(1);
  const turns = largestOf(angle) > STILL;
  if (turns) {
    const whole = new Float64Array(turn.length);
    angle.forEach((by, i) => whole.set(product(turn.subarray(4 * i, 4 * i + 4), [0, 0, Math.sin(by / 2), Math.cos(by / 2)]), 4 * i));
    turn = whole;
  }
  return {
    place: collapsed(motion.rows(drawn.place), 3),
    turn: turns ? packed(turn, 4) : collapsed(turn, 4),
    spin: { shape: [0], float32: new Float32Array(0) },
    axis: UPRIGHT,
  };
}

function supported(contact: Contact, motion: Motion, engine: Engine, reaches: number): SupportData {
  const { drawn, pose } = contact;
  const base = { name: drawn.name, kind: drawn.kind ?? "plane", pose };
  const none: Packed = { shape: [0, 0, 3], float32: new Float32Array(0) };
  if (drawn.grid) return { ...base, middle: [0, 0], reach: [0, 0], points: gridded(drawn.grid, engine) };
  const ends = [0, 1].map((direction) => contact.range(direction)).map(([low, high]) => [low - ROOM * reaches, high + ROOM * reaches]);
  if (drawn.kind === "turntable") {
    const radius = 1.08 * (contact.farthest() + reaches);
    for (const end of ends) [end[0], end[1]] = [-radius, radius];
  }
  if (drawn.edge !== null) {
    [ends[0][1]] = motion.constants([drawn.edge]);
    ends[0][0] = Math.min(ends[0][0], ends[0][1] - ROOM * reaches);
  }
  const middle = ends.map(([low, high]) => (low + high) / 2) as [number, number];
  const half = ends.map(([low, high]) => (high - low) / 2) as [number, number];
  return { ...base, middle, reach: half, points: none };
}

/** Points of a curved support, seen from the side of the bodies. */
function gridded(grid: Grid, engine: Engine): Packed {
  const [rows, columns] = grid.shape;
  const shape = [rows, columns, 3];
  const { uv, values, foot, normal } = grid;
  if (!uv || !values || !foot || !normal) return { shape, float32: Float32Array.from(grid.points ?? []) };
  const found = engine.pointsAt(uv, values, [...foot, ...normal]);
  const at = (i: number, j: number): number[] => found.slice(6 * (i * columns + j), 6 * (i * columns + j) + 6);
  const [i, j] = [Math.floor(rows / 2), Math.floor(columns / 2)];
  const less = (a: number[], b: number[]): number[] => [0, 1, 2].map((k) => a[k] - b[k]);
  const [a, b] = [less(at(i + 1, j), at(i, j)), less(at(i, j + 1), at(i, j))];
  const cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const backwards = cross.reduce((sum, part, k) => sum + part * at(i, j)[3 + k], 0) < 0;
  const points = new Float32Array(3 * rows * columns);
  for (let r = 0; r < rows; r++) {
    for (let c = 0; c < columns; c++) points.set(at(r, backwards ? columns - 1 - c : c).slice(0, 3), 3 * (r * columns + c));
  }
  return { shape, float32: points };
}

// -- arrows, plots, evidence ----------------------------------------------------------------------

function arrowsOf(arrows: DrawnArrow[], motion: Motion): ArrowData[] {
  const rows = arrows.map(({ along }) => {
    const vectors = along ? motion.rows(along) : new Float64Array(3 * motion.frames);
    return vectors.map((part) => (Number.isFinite(part) ? part : 0));
  });
  const sizes: Record<string, number> = {};
  arrows.forEach(({ unit }, i) => {
    sizes[unit] = Math.max(sizes[unit] ?? 0, largestOf(rows[i]));
  });
  const found = arrows.map(({ kind, name, symbol, body, unit, foot, normal, friction }, i): ArrowData => {
    const shown = rows[i].map((part) => (Math.abs(part) < ROUNDING * sizes[unit] ? 0 : part));
    const lengths = lengthsOf(shown).sort();
    const usual = lengths[Math.floor(USUAL * (lengths.length - 1))];
    return {
      kind: kind as ArrowKind,
      name,
      symbol,
      body,
      unit,
      foot: orNowhere(foot, motion),
      along: collapsed(shown, 3),
      usual,
      largest: lengths[lengths.length - 1],
      normal: orNowhere(normal, motion),
      friction: friction ? motion.constants(friction)[0] : 0,
    };
  });
  const longest: Record<string, number> = {};
  for (const { kind, largest } of found) longest[kind] = Math.max(longest[kind] ?? 0, largest);
  return found.filter(({ kind, largest }) => largest > UNSEEN * longest[kind]);
}

function orNowhere(vector: number[] | null, motion: Motion): Packed {
  return vector ? collapsed(motion.rows(vector), 3) : { shape: [0, 3], float32: new Float32Array(0) };
}

function angled({ name, body, vertex, rotations }: LiveData["drawn"]["angles"][number], motion: Motion): AnglesData {
  return {
    name,
    body,
    vertex: collapsed(motion.rows(vertex), 3),
    rotations: rotations.map(({ symbol, angle, axis, begin, offset, coordinate, sign }) => ({
      symbol,
      angle: collapsed(motion.column(angle), 1),
      axis: motion.constants(axis) as Triple,
      begin: unit(motion.constants(begin)),
      offset: motion.constants([offset])[0],
      coordinate,
      sign,
    })),
  };
}

function unit(vector: number[]): Triple {
  const size = Math.hypot(...vector) || 1;
  return vector.map((part) => part / size) as Triple;
}

function panelled({ unit, series, kind }: LiveData["drawn"]["panels"][number], motion: Motion): PanelData {
  const values = series.map(({ value }) => motion.column(value));
  const largest = Math.max(...values.map(largestOf));
  const scale = scaleFor(unit, largest);
  return {
    unit: scale.unit,
    kind,
    series: series.map(({ name, symbol }, i) => ({
      name,
      symbol,
      values: packed(values[i].map((value) => (Math.abs(value) < ROUNDING * largest ? 0 : value * scale.factor)), 1),
    })),
  };
}

function portrayed({ kind, title, names, symbols, units, values, body, axis }: LiveData["drawn"]["portraits"][number], motion: Motion): PortraitData {
  const columns = values.map((value) => motion.column(value));
  const scales = units.map((unit, i) => scaleFor(unit, largestOf(columns[i])));
  return {
    kind,
    title,
    names,
    symbols,
    units: scales.map(({ unit }) => unit),
    columns: columns.map((column, i) => packed(scales.length ? column.map((value) => value * scales[i].factor) : column, 1)),
    curve: [],
    level: 0,
    body,
    axis,
  };
}

/** How far closed loops open, if there are any. */
function loopsOf(live: LiveData, motion: Motion): NumberData[] {
  const { gaps } = live.loops;
  if (!gaps.length) return [];
  return [{ name: "closed loops", symbol: "", value: largestOf(motion.rows(gaps)), unit: "m", meaning: "largest gap" }];
}

/** Why a motion cannot be relied on: an imbalance that rounding does not explain, as _validity.py in polhode.simulate has it. */
function doubtAbout(imbalance: number, steps: number): string {
  const allowed = (LOST + PER_STEP * steps) * Number.EPSILON;
  if (imbalance <= allowed) return "";
  return `its energy balance is off by ${digits(imbalance, 2)} of its scale, where rounding explains ${digits(allowed, 1)}`;
}

/** How far energy less the work done departs from its value at the start, against the energy scale. */
function balance(live: LiveData, motion: Motion): NumberData {
  const [energy, potential] = live.drawn.energy.map((output) => motion.column(output));
  const work = motion.column(live.work);
  let [drift, scale] = [0, 0];
  energy.forEach((total, i) => {
    drift = Math.max(drift, Math.abs(total - energy[0] - (work[i] - work[0]))); // an impact at the start has done work
    scale = Math.max(scale, Math.abs(total - potential[i]) + Math.abs(potential[i]) + Math.abs(work[i]));
  });
  return { name: "energy − work done", symbol: "", value: scale ? drift / scale : drift, unit: "", meaning: "against the energy scale" };
}

// A motion against something other than time: phase portraits, potentials, directions on the sphere.

import { Quaternion, Vector3 } from "three";
import type { Clock } from "./clock";
import { apart, drawn, formula, make } from "./dom";
import { extremes } from "./envelope";
import { Pose } from "./pose";
import { type BodyData, type PortraitData, Rows, type Triple } from "./scene";

const [WIDTH, HEIGHT] = [240, 160];
const [LEFT, RIGHT, TOP, BOTTOM] = [42, 10, 8, 20]; // of the frame of a plane, pixels; more to the left for long numbers
const WIDE = 6; // of a digit, pixels
const MARGIN = 0.06; // of the range, on either side
const ROUND = 66; // radius of a sphere
const [TALL, MIDDLE] = [184, 98]; // of the picture of a sphere
const TURN = (-60 * Math.PI) / 180; // of the eye about the third axis, from the first one
const RISE = (28 * Math.PI) / 180; // of the eye above the plane of the first two
const FROM = 1.25; // length of an axis out of the sphere, in radii

type Point = [number, number];

/** A figure with a dot at the present time. */
interface Portrait {
  readonly figure: HTMLElement;
  seek(share: number): void;
}

export class Portraits {
  readonly element = make("div", { class: "portraits" });
  private shown: Portrait[] = [];

  show(portraits: PortraitData[], bodies: BodyData[], clock: Clock): void {
    this.shown = portraits.map((data) => {
      if (data.kind === "sphere") return new SpherePortrait(data, columnsOf(data));
      return data.kind === "axis" ? new SpherePortrait(data, directions(bodies[data.body], data.axis)) : new PlanePortrait(data);
    });
    this.element.replaceChildren(...this.shown.map(({ figure }) => figure));
    clock.onChange(({ time }) => {
      for (const portrait of this.shown) portrait.seek(time / clock.duration);
    });
  }
}

const columnsOf = ({ columns }: PortraitData): Rows[] => columns.map((column) => new Rows(column));

/** Where an axis of a body points. */
function directions({ pose }: BodyData, along: Triple): Rows[] {
  const turns = new Pose(pose);
  const [count] = pose.turn.shape;
  const [turn, tip] = [new Quaternion(), new Vector3()];
  const columns = [0, 1, 2].map(() => new Float32Array(count));
  for (let frame = 0; frame < count; frame++) {
    turns.turnAt(frame, turn);
    const point = tip.set(...along).applyQuaternion(turn).toArray();
    columns.forEach((column, i) => (column[frame] = point[i]));
  }
  return columns.map((float32) => new Rows({ shape: [count], float32 }));
}

/** Values between the samples of columns at a share of the whole time. */
function at(columns: Rows[], share: number): number[] {
  return columns.map((rows) => rows.at(share * (rows.count - 1), [])[0]);
}

const path = (points: (Point | null)[]): string =>
  points.map((point, i) => (point ? `${i && points[i - 1] ? "L" : "M"}${point[0].toFixed(1)} ${point[1].toFixed(1)}` : "")).join("");

function figureOf(data: PortraitData, picture: SVGElement, ...keys: (Node | string)[]): HTMLElement {
  picture.setAttribute("role", "img");
  picture.setAttribute("aria-label", `${data.title}: ${data.names.join(", ")}`);
  return make("figure", { class: "plot portrait" }, make("figcaption", {}, make("span", {}, data.title), ...keys), picture);
}

// -- planes and wells -----------------------------------------------------------------------------

class PlanePortrait implements Portrait {
  readonly figure: HTMLElement;
  private readonly columns: Rows[];
  private readonly dot = drawn("circle", { r: 4, class: "dot" });
  private readonly drop = drawn("path", { class: "drop" });
  private readonly place: (x: number, y: number) => Point;
  private readonly curve: Float32Array[];

  constructor(private readonly data: PortraitData) {
    this.columns = columnsOf(data);
    this.curve = data.curve.map((column) => new Rows(column).data);
    const [across, up] = this.ranges();
    const left = Math.max(LEFT, 12 + WIDE * Math.max(...apart(round(up), 3).map((text) => text.length)));
    this.place = (x, y) => [left + ((x - across[0]) / (across[1] - across[0])) * (WIDTH - left - RIGHT), HEIGHT - BOTTOM - ((y - up[0]) / (up[1] - up[0])) * (HEIGHT - TOP - BOTTOM)];
    const picture = drawn("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}` }, ...this.ticks(across, up), ...this.lines(), this.drop, this.dot);
    const units = data.units.map((unit) => (unit ? ` (${unit})` : ""));
    const [first, second] = data.symbols.map((symbol) => formula(symbol));
    const axes = make("span", { class: "unit" }, second, `${units[1]} over `, first, units[0]);
    this.figure = figureOf(data, picture, axes);
  }

  seek(share: number): void {
    const [x, y] = at(this.columns, share);
    const height = this.isWell ? this.data.level : y;
    const [left, top] = this.place(x, height);
    this.dot.setAttribute("cx", left.toFixed(1));
    this.dot.setAttribute("cy", top.toFixed(1));
    if (!this.isWell) return;
    const [, bottom] = this.place(x, this.heightAt(x));
    this.drop.setAttribute("d", `M${left.toFixed(1)} ${top.toFixed(1)}V${bottom.toFixed(1)}`); // the kinetic energy of the tilt
  }

  private get isWell(): boolean {
    return this.data.kind === "well";
  }

  /** The height of the potential, by linear interpolation. */
  private heightAt(x: number): number {
    const [places, heights] = this.curve;
    const i = Math.min(Math.max(places.findIndex((place) => place >= x), 1), places.length - 1);
    const share = (x - places[i - 1]) / (places[i] - places[i - 1]);
    return heights[i - 1] + share * (heights[i] - heights[i - 1]);
  }

  private ranges(): [Point, Point] {
    if (!this.isWell) return [widened(extremes(this.columns[0].data)), widened(extremes(this.columns[1].data))];
    const [places, heights] = this.curve;
    const [bottom, top] = extremes(heights);
    const { level } = this.data;
    return [extremes(places), widened([bottom, Math.min(Math.max(top, level), bottom + 3 * Math.max(level - bottom, 1e-3 * (top - bottom)))])];
  }

  private lines(): SVGElement[] {
    if (!this.isWell) {
      const [xs, ys] = this.columns.map(({ data }) => data);
      return [drawn("path", { d: path(Array.from(xs, (x, i) => this.place(x, ys[i]))), class: "line series-0" })];
    }
    const [places, heights] = this.curve;
    const line = path(Array.from(places, (x, i) => this.place(x, heights[i])));
    const [left, level] = this.place(places[0], this.data.level);
    const [right] = this.place(places[places.length - 1], this.data.level);
    const inside = { y: TOP, width: WIDTH, height: HEIGHT, viewBox: `0 ${TOP} ${WIDTH} ${HEIGHT}` }; // what is higher is cut off
    return [
      drawn("svg", inside, drawn("path", { d: line, class: "line series-0" })),
      drawn("path", { d: `M${left} ${level}H${right}`, class: "line series-1 dashed" }),
    ];
  }

  /** The frame, and the ends and the middle of both ranges. */
  private ticks(across: Point, up: Point): SVGElement[] {
    const label = (text: string, x: number, y: number, anchor: string): SVGElement => drawn("text", { x, y, "text-anchor": anchor }, text);
    const [left] = this.place(across[0], up[0]);
    const frame = drawn("rect", { x: left, y: TOP, width: WIDTH - left - RIGHT, height: HEIGHT - TOP - BOTTOM, class: "frame" });
    const told = (values: number[], put: (text: string, value: number) => SVGElement): SVGElement[] => apart(values, 3).map((text, i) => put(text, values[i]));
    const marks = told(round(across), (text, x) => label(text, this.place(x, up[0])[0], HEIGHT - 7, "middle"));
    const heights = told(round(up), (text, y) => label(text, left - 5, this.place(across[0], y)[1] + 4, "end"));
    const zero = up[0] < 0 && up[1] > 0 ? [drawn("path", { d: `M${left} ${this.place(0, 0)[1]}H${WIDTH - RIGHT}`, class: "frame" })] : [];
    return [frame, ...zero, ...marks, ...heights];
  }
}

function widened([low, high]: Point): Point {
  const margin = MARGIN * (high - low || Math.abs(high) || 1);
  return [low - margin, high + margin];
}

/** Two to five round numbers within a range. */
function round([low, high]: Point): number[] {
  const power = 10 ** Math.floor(Math.log10(high - low));
  const step = [0.2, 0.5, 1, 2, 5].map((part) => part * power).find((part) => (high - low) / part < 4.6) ?? power;
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.floor(high / step) - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(9)));
}

// -- spheres --------------------------------------------------------------------------------------

const RIGHTWARDS = [-Math.sin(TURN), Math.cos(TURN), 0];
const TOWARDS = [Math.cos(RISE) * Math.cos(TURN), Math.cos(RISE) * Math.sin(TURN), Math.sin(RISE)];
const UPWARDS = [-Math.sin(RISE) * Math.cos(TURN), -Math.sin(RISE) * Math.sin(TURN), Math.cos(RISE)];
const dot = (a: number[], b: number[]): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

class SpherePortrait implements Portrait {
  readonly figure: HTMLElement;
  private readonly dot = drawn("circle", { r: 4, class: "dot" });

  constructor(
    data: PortraitData,
    private readonly columns: Rows[],
  ) {
    const points = Array.from({ length: columns[0].count }, (_, i) => unit(columns.map(({ data: values }) => values[i])));
    const picture = drawn("svg", { viewBox: `0 0 ${WIDTH} ${TALL}` }, ...grid(), ...data.names.flatMap((name, i) => axis(name, i)), ...curve(points, "line series-0"), this.dot);
    this.figure = figureOf(data, picture);
  }

  seek(share: number): void {
    const point = unit(at(this.columns, share));
    const [x, y] = seen(point);
    this.dot.setAttribute("cx", x.toFixed(1));
    this.dot.setAttribute("cy", y.toFixed(1));
    this.dot.classList.toggle("behind", dot(point, TOWARDS) < 0);
  }
}

const unit = (vector: number[]): number[] => vector.map((part) => part / (Math.hypot(...vector) || 1));
const seen = (point: number[]): Point => [WIDTH / 2 + ROUND * dot(point, RIGHTWARDS), MIDDLE - ROUND * dot(point, UPWARDS)];

/** Bold in front of the sphere, faint behind it. */
function curve(points: number[][], style: string): SVGElement[] {
  const ahead = points.map((point) => dot(point, TOWARDS) >= 0);
  const part = (front: boolean): string => path(points.map((point, i) => (ahead[i] === front || ahead[i + 1] === front ? seen(point) : null)));
  return [drawn("path", { d: part(false), class: `${style} behind` }), drawn("path", { d: part(true), class: style })];
}

/** Circles of latitude and longitude, and the outline. */
function grid(): SVGElement[] {
  const turns = Array.from({ length: 73 }, (_, i) => (i * Math.PI) / 36);
  const latitudes = [-60, -30, 0, 30, 60].map((degrees) => {
    const rise = (degrees * Math.PI) / 180;
    return turns.map((turn) => [Math.cos(rise) * Math.cos(turn), Math.cos(rise) * Math.sin(turn), Math.sin(rise)]);
  });
  const longitudes = [0, 30, 60, 90, 120, 150].map((degrees) => {
    const along = (degrees * Math.PI) / 180;
    return turns.map((turn) => [Math.cos(along) * Math.sin(turn), Math.sin(along) * Math.sin(turn), Math.cos(turn)]);
  });
  const outline = drawn("circle", { cx: WIDTH / 2, cy: MIDDLE, r: ROUND, class: "frame" });
  return [outline, ...[...latitudes, ...longitudes].flatMap((points) => curve(points, "grid"))];
}

function axis(name: string, i: number): SVGElement[] {
  const along = [0, 1, 2].map((k) => Number(k === i));
  const [foot, tip, beyond] = [1, FROM, FROM + 0.12].map((length) => seen(along.map((part) => length * part)));
  const behind = dot(along, TOWARDS) < 0 ? " behind" : "";
  return [
    drawn("path", { d: path([foot, tip]), class: `arrow${behind}` }),
    drawn("text", { x: beyond[0], y: beyond[1] + 4, "text-anchor": "middle", class: `name${behind}` }, name),
  ];
}

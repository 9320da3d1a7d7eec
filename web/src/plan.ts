// A small plan of the paths seen from above, for pictures that follow a body.

import { Vector3 } from "three";
import { drawn } from "./dom";
import { Rows, type TraceData } from "./scene";

const SIZE = 100; // units of the drawing
const MARGIN = 12;
const POINTS = 400; // of a path

export class Plan {
  readonly element = drawn("svg", { viewBox: `0 0 ${SIZE} ${SIZE}`, class: "plan", role: "img", "aria-label": "Plan of the whole path, seen from above" });
  private readonly dot = drawn("circle", { class: "now", r: 4 });
  private readonly across: Vector3;
  private readonly upward: Vector3;
  private readonly low: [number, number] = [Infinity, Infinity];
  private scale = 1;
  /** Whether there is a path to be seen. */
  readonly isEmpty: boolean;

  /** @param up the direction that the plan is seen from. */
  constructor(up: Vector3, traces: TraceData[]) {
    const aside = Math.abs(up.x) < 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 0, 1);
    this.across = aside.addScaledVector(up, -aside.dot(up)).normalize();
    this.upward = up.clone().cross(this.across);
    const paths = traces.filter(({ support, kind }) => support < 0 && kind !== "axis").map(({ points }) => this.flattened(points));
    this.isEmpty = !paths.flat().some((point) => point !== null);
    if (this.isEmpty) return;
    this.fit(paths.flat());
    for (const path of paths) {
      // a gap, as of a contact that has opened, leaves commas without points
      const pieces = path.map((point) => (point ? this.placed(point).join(" ") : "")).join(",").split(/^,+|,{2,}|,+$/);
      for (const piece of pieces.filter(Boolean)) this.element.append(drawn("polyline", { points: piece }));
    }
    this.element.append(this.dot);
  }

  /** Show where a body is. */
  update(place: Vector3): void {
    if (this.isEmpty) return;
    const [x, y] = this.placed([place.dot(this.across), place.dot(this.upward)]);
    this.dot.setAttribute("cx", String(x));
    this.dot.setAttribute("cy", String(y));
  }

  private flattened(points: TraceData["points"]): ([number, number] | null)[] {
    const { data, count } = new Rows(points);
    const step = Math.max(1, Math.floor(count / POINTS));
    const point = new Vector3();
    return Array.from({ length: Math.ceil(count / step) }, (_, i) => {
      point.fromArray(data, 3 * i * step);
      const flat: [number, number] = [point.dot(this.across), point.dot(this.upward)];
      return flat.every(Number.isFinite) ? flat : null;
    });
  }

  private fit(points: ([number, number] | null)[]): void {
    const high: [number, number] = [-Infinity, -Infinity];
    for (const point of points) {
      point?.forEach((value, k) => {
        this.low[k] = Math.min(this.low[k], value);
        high[k] = Math.max(high[k], value);
      });
    }
    const size = Math.max(high[0] - this.low[0], high[1] - this.low[1]);
    this.scale = size > 0 ? (SIZE - 2 * MARGIN) / size : 1;
    // the narrower side in the middle
    for (const k of [0, 1]) this.low[k] -= (size - (high[k] - this.low[k])) / 2;
  }

  private placed([x, y]: [number, number]): [number, number] {
    const at = (value: number, low: number): number => MARGIN + (value - low) * this.scale;
    return [at(x, this.low[0]), SIZE - at(y, this.low[1])];
  }
}

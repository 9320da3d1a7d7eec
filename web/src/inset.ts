// A few cycles about the present time, beside curves of which a plot shows the envelope only.

import { drawn } from "./dom";

const WIDTH = 132;
const HEIGHT = 46;
const CYCLES = 3;

export class Inset {
  readonly element = drawn("svg", { class: "inset", viewBox: `0 0 ${WIDTH} ${HEIGHT}`, "aria-hidden": "true" });
  private readonly lines: SVGElement[];

  /** @param count of curves. */
  constructor(count: number) {
    this.lines = Array.from({ length: count }, (_, i) => drawn("path", { class: `series-${i % 4}` }));
    this.element.append(drawn("line", { x1: WIDTH / 2, x2: WIDTH / 2, y1: 0, y2: HEIGHT, class: "middle" }), ...this.lines);
  }

  /**
   * Show the curves about a sample, which is in the middle.
   *
   * @param curves those that are shown as envelopes; null for the others.
   * @param period of the slowest of them, in samples; 0 for no inset.
   */
  show(curves: (Float32Array | null)[], sample: number, period: number): void {
    this.element.toggleAttribute("hidden", !period);
    if (!period) return;
    const half = (CYCLES * period) / 2;
    curves.forEach((values, i) => this.lines[i].setAttribute("d", values ? path(values, sample, half) : ""));
  }
}

/** Each curve takes the whole height: what it shows is the shape of a cycle. */
function path(values: Float32Array, sample: number, half: number): string {
  const first = Math.max(0, Math.ceil(sample - half));
  const last = Math.min(values.length - 1, Math.floor(sample + half));
  if (last <= first) return "";
  const seen = values.subarray(first, last + 1);
  const low = seen.reduce((a, b) => Math.min(a, b));
  const range = seen.reduce((a, b) => Math.max(a, b)) - low || 1;
  const points = Array.from(seen, (value, k) => {
    const x = ((first + k - sample) / half + 1) * (WIDTH / 2);
    return `${x.toFixed(1)} ${(HEIGHT - 4 - ((value - low) / range) * (HEIGHT - 8)).toFixed(1)}`;
  });
  return `M${points.join("L")}`;
}

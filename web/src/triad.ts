// The axes of the laboratory, in a corner of the picture.

import { type Camera, Vector3 } from "three";

const SIZE = 72;
const LONG = 24;
/** Colours of axes. */
export const AXES = ["series-1", "series-2", "series-0"] as const;

export class Triad {
  readonly element = svg("svg", { viewBox: `${-SIZE / 2} ${-SIZE / 2} ${SIZE} ${SIZE}`, class: "triad", "aria-hidden": "true" });
  private readonly axes: { line: SVGElement; name: SVGElement }[];
  private readonly along = new Vector3();

  constructor(directions: string[]) {
    this.axes = directions.map((direction, i) => {
      const line = svg("line", { stroke: `var(--${AXES[i % 3]})`, "stroke-width": "2", "stroke-linecap": "round" });
      const name = svg("text", { fill: `var(--${AXES[i % 3]})`, "text-anchor": "middle", "dominant-baseline": "central" });
      name.textContent = GREEK[direction] ?? direction;
      this.element.append(line, name);
      return { line, name };
    });
  }

  /** Rotated as seen by the camera. */
  update(camera: Camera): void {
    this.axes.forEach(({ line, name }, i) => {
      const { x, y } = this.along.setScalar(0).setComponent(i, 1).transformDirection(camera.matrixWorldInverse);
      set(line, { x2: LONG * x, y2: -LONG * y });
      set(name, { x: 1.32 * LONG * x, y: -1.32 * LONG * y });
    });
  }
}

export const GREEK: Record<string, string> = { rho: "ρ", phi: "φ", theta: "θ", psi: "ψ", xi: "ξ", eta: "η", zeta: "ζ" };

function svg(tag: string, attributes: Record<string, string>): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

function set(element: SVGElement, attributes: Record<string, number>): void {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value.toFixed(2));
}

// How long arrows are: a bar for a round value of each quantity whose arrows are shown.

import { type PerspectiveCamera, Vector3 } from "three";
import type { Arrow } from "./arrows";
import { digits, make } from "./dom";

const LONGEST = 76; // pixels
const STEPS = [5, 2, 1]; // first digits of round values

export class ScaleBars {
  readonly element = make("div", { class: "scales", "aria-hidden": "true" });
  private readonly bars: Bar[];

  constructor(arrows: Arrow[]) {
    const units = [...new Set(arrows.map(({ data }) => data.unit))];
    this.bars = units.map((unit) => new Bar(arrows.filter(({ data }) => data.unit === unit), unit));
    this.element.append(...this.bars.map(({ element }) => element));
  }

  /** @param place of the arrows, at whose distance the lengths are true. */
  update(camera: PerspectiveCamera, place: Vector3, height: number): void {
    const distance = place.distanceTo(camera.position);
    const pixels = height / (2 * Math.tan((camera.fov * Math.PI) / 360) * distance);
    for (const bar of this.bars) bar.update(pixels);
  }
}

class Bar {
  private readonly line = make("span", { class: "bar" });
  private readonly value = make("span", {});
  readonly element = make("div", {}, this.line, this.value);

  constructor(
    private readonly arrows: Arrow[],
    private readonly unit: string,
  ) {}

  update(pixels: number): void {
    const shown = this.arrows.find(({ letter }) => letter.shown);
    this.element.hidden = !shown;
    if (!shown) return;
    const each = shown.scale * shown.group.scale.x * pixels; // pixels for one of the unit
    const value = round(LONGEST / each);
    this.line.style.width = `${(value * each).toFixed(1)}px`;
    this.line.style.background = `var(--${shown.data.kind})`;
    this.value.textContent = `${digits(value)} ${this.unit}`;
  }
}

/** The greatest round value up to this one. */
function round(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return (STEPS.find((step) => step * power <= value) ?? 1) * power;
}

// A strip that shows which contact mode a motion is in, and when it changes; a click on it seeks.

import type { Clock } from "./clock";
import { drawn, make } from "./dom";
import type { ModeSpan } from "./scene";

const COLOURS = 4; // of the plots

/** The strip, and beside it the mode at the present time; nothing for a motion in a single mode. */
export function modeStrip(spans: ModeSpan[], clock: Clock): HTMLElement[] {
  const names = [...new Set(spans.map(({ name }) => name))];
  if (names.length < 2) return [];
  const rectangles = spans.map(({ name, begin, end }) => {
    const colour = `series-${names.indexOf(name) % COLOURS}`;
    return drawn("rect", { x: begin, y: 0, width: end - begin, height: 1, class: colour }, drawn("title", {}, name));
  });
  const svg = drawn("svg", { viewBox: `0 0 ${clock.duration} 1`, preserveAspectRatio: "none", "aria-hidden": "true" }, ...rectangles);
  const now = make("div", { class: "now" });
  const strip = make("div", { class: "strip" }, svg, now);
  const told = make("output", { class: "mode" });
  strip.addEventListener("pointerdown", (event) => {
    const { left, width } = strip.getBoundingClientRect();
    clock.seek(((event.clientX - left) / width) * clock.duration);
  });
  const begins = spans.map(({ begin }) => begin);
  clock.onChange(({ time }) => {
    now.style.left = `${(100 * time) / clock.duration}%`;
    const here = spans[Math.max(0, begins.filter((begin) => begin <= time).length - 1)];
    if (told.textContent === here.name) return;
    told.textContent = here.name;
    told.className = `mode series-${names.indexOf(here.name) % COLOURS}`;
  });
  return [make("div", { class: "modes", role: "group", "aria-label": "Contact modes" }, strip, told)];
}

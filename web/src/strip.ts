// A strip that shows which contact mode a motion is in, and when it changes; a click on it seeks.

import type { Clock } from "./clock";
import { make } from "./dom";
import type { ModeSpan } from "./scene";

const SVG = "http://www.w3.org/2000/svg";
const COLOURS = 4; // of the plots

/** The strip, and beside it the mode at the present time; nothing for a motion in a single mode. */
export function modeStrip(spans: ModeSpan[], clock: Clock): HTMLElement[] {
  const names = [...new Set(spans.map(({ name }) => name))];
  if (names.length < 2) return [];
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", `0 0 ${clock.duration} 1`);
  svg.setAttribute("preserveAspectRatio", "none");
  svg.setAttribute("aria-hidden", "true");
  for (const { name, begin, end } of spans) svg.append(span(name, begin, end, names.indexOf(name) % COLOURS));
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

function span(name: string, begin: number, end: number, colour: number): SVGElement {
  const rectangle = document.createElementNS(SVG, "rect");
  const place = { x: begin, y: 0, width: end - begin, height: 1, class: `series-${colour}` };
  for (const [key, value] of Object.entries(place)) rectangle.setAttribute(key, String(value));
  const title = document.createElementNS(SVG, "title");
  title.textContent = name;
  rectangle.append(title);
  return rectangle;
}

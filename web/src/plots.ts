// Quantities against time, with a cursor at the present time that a click moves.

import uPlot from "uplot";
import type { Clock } from "./clock";
import { digits, formula, make } from "./dom";
import { type PanelData, Rows } from "./scene";

const DASHES = [[], [9, 4], [2, 4], [10, 4, 2, 4]];
const HEIGHT = 150;
const WIDE = 7; // pixels of a letter at an axis
const ROUNDING = 1e-9; // relative to the largest value: less is shown as zero
const FLAT = 1e-6; // relative to the largest value: what varies by less is drawn as constant

/** Dashes of a series; series with the same colour differ in them. */
const dashes = (number: number): number[] => DASHES[(number + Math.floor(number / 4)) % DASHES.length];

export class Plots {
  private plots: Plot[] = [];
  private kinds = "";
  private readonly fitting = new ResizeObserver(() => {
    for (const plot of this.plots) plot.fit();
  });

  constructor(private readonly holder: HTMLElement) {
    this.fitting.observe(holder);
  }

  /** Replace the quantities; if they are of the same kinds, only the lines change. */
  show(panels: PanelData[], clock: Clock): void {
    const kinds = panels.map(kindOf).join("\n");
    if (kinds === this.kinds) this.plots.forEach((plot, i) => plot.renew(panels[i], clock));
    else this.replace(panels, clock);
    this.kinds = kinds;
    clock.onChange(({ time }) => {
      for (const plot of this.plots) plot.seek(time);
    });
  }

  private replace(panels: PanelData[], clock: Clock): void {
    for (const plot of this.plots) plot.remove();
    this.plots = panels.map((panel) => new Plot(panel, clock));
    this.holder.append(...this.plots.map(({ figure }) => figure));
    for (const plot of this.plots) plot.draw();
  }

  /** Read the colours again from the style of the page. */
  theme(): void {
    for (const plot of this.plots) plot.draw();
  }
}

function kindOf({ series }: PanelData): string {
  return series.map(({ name, symbol }) => `${name} ${symbol}`).join("\t");
}

class Plot {
  readonly figure: HTMLElement;
  private readonly box = make("div", { class: "canvas", role: "img" });
  private readonly now = make("div", { class: "now" });
  private readonly unit = make("span", { class: "unit" });
  private readonly values: HTMLElement[];
  private rows: Rows[] = [];
  private least: number[] = [];
  private data: uPlot.AlignedData = [[]];
  private plot: uPlot | null = null;
  private time = 0;

  constructor(
    private panel: PanelData,
    private clock: Clock,
  ) {
    this.values = panel.series.map(() => make("span", { class: "value" }));
    const keys = panel.series.map(({ symbol }, i) =>
      make("span", { class: "key" }, swatch(i), formula(symbol), this.values[i]),
    );
    this.figure = make("figure", { class: "plot" }, make("figcaption", {}, ...keys, this.unit), this.box);
    this.read();
  }

  renew(panel: PanelData, clock: Clock): void {
    this.panel = panel;
    this.clock = clock;
    this.read();
    this.plot?.setData(this.data);
  }

  /** Draw it; its figure must already be on the page, so that its width is known. */
  draw(): void {
    this.plot?.destroy();
    this.plot = this.made();
    this.mark();
  }

  seek(time: number): void {
    this.time = time;
    const frame = (time / this.clock.duration) * (this.rows[0].count - 1);
    this.rows.forEach((rows, i) => {
      const [value] = rows.at(frame, []);
      this.values[i].textContent = digits(Math.abs(value) < this.least[i] ? 0 : value);
    });
    this.mark();
  }

  fit(): void {
    const width = this.box.clientWidth;
    if (!this.plot || this.plot.width === width) return;
    this.plot.setSize({ width, height: HEIGHT });
    this.mark();
  }

  remove(): void {
    this.plot?.destroy();
    this.figure.remove();
  }

  private read(): void {
    this.rows = this.panel.series.map(({ values }) => new Rows(values));
    this.least = this.rows.map(({ data }) => ROUNDING * data.reduce((a, b) => Math.max(a, Math.abs(b)), 0));
    const { count } = this.rows[0];
    const times = Float64Array.from({ length: count }, (_, i) => (i / (count - 1)) * this.clock.duration);
    this.data = [times, ...this.rows.map(({ data }) => levelled(data))];
    this.unit.textContent = this.panel.unit;
    this.box.setAttribute("aria-label", this.described());
  }

  private described(): string {
    const ranges = this.panel.series.map(({ name }, i) => {
      const { data } = this.rows[i];
      const low = data.reduce((a, b) => Math.min(a, b));
      const high = data.reduce((a, b) => Math.max(a, b));
      return `${name} between ${digits(low, 3)} and ${digits(high, 3)} ${this.panel.unit}`;
    });
    return `Plot against time: ${ranges.join("; ")}`;
  }

  private mark(): void {
    const left = this.plot?.valToPos(this.time, "x") ?? 0;
    this.now.style.transform = `translateX(${left}px)`;
  }

  private made(): uPlot {
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string): string => style.getPropertyValue(name).trim();
    const axis: uPlot.Axis = {
      stroke: colour("--muted"),
      font: `12px ${colour("--sans")}`,
      grid: { stroke: colour("--line"), width: 1 },
      ticks: { stroke: colour("--line"), width: 1, size: 4 },
    };
    const series = this.panel.series.map(({ name }, i) => ({
      label: name,
      stroke: colour(`--series-${i % 4}`),
      width: 1.8,
      dash: dashes(i),
      points: { show: false },
    }));
    return new uPlot(
      {
        width: this.box.clientWidth || 320,
        height: HEIGHT,
        legend: { show: false },
        cursor: { drag: { x: false, y: false }, y: false, points: { show: false } },
        scales: { x: { time: false }, y: { range: paddedRange } },
        axes: [
          { ...axis, size: 30, values: (_, ticks) => apart(ticks).map((tick, i) => (i ? tick : `${tick} s`)) },
          { ...axis, size: (_, labels) => Math.max(62, 20 + WIDE * longest(labels)), values: (_, ticks) => apart(ticks) },
        ],
        series: [{}, ...series],
        hooks: { ready: [(plot) => this.ready(plot)] },
      },
      this.data,
      this.box,
    );
  }

  private ready(plot: uPlot): void {
    plot.over.append(this.now);
    plot.over.addEventListener("pointerdown", (event) => {
      this.seekTo(plot, event);
      plot.over.setPointerCapture(event.pointerId);
    });
    plot.over.addEventListener("pointermove", (event) => {
      if (event.buttons) this.seekTo(plot, event);
    });
  }

  private seekTo(plot: uPlot, event: PointerEvent): void {
    const left = event.clientX - plot.over.getBoundingClientRect().left;
    this.clock.seek(plot.posToVal(left, "x"));
  }
}

/** A line that hardly varies as a level one: the steps of its single precision are no motion. */
function levelled(values: Float32Array): Float32Array {
  const low = values.reduce((a, b) => Math.min(a, b), Infinity);
  const high = values.reduce((a, b) => Math.max(a, b), -Infinity);
  const flat = high - low <= FLAT * Math.max(Math.abs(low), Math.abs(high));
  return flat ? new Float32Array(values.length).fill((low + high) / 2) : values;
}

/** Numbers with as many digits as needed to distinguish them. */
function apart(ticks: number[]): string[] {
  for (let count = 4; count < 15; count++) {
    const told = ticks.map((tick) => digits(tick, count));
    if (new Set(told).size === new Set(ticks).size) return told;
  }
  return ticks.map(String);
}

/** Number of characters of the longest label. */
const longest = (labels: string[] | null): number => Math.max(0, ...(labels ?? []).map((label) => label.length));

/** Limits that do not magnify rounding errors to the height of the panel. */
function paddedRange(_: uPlot, low: number, high: number): uPlot.Range.MinMax {
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low <= FLAT * size || !size) return [low - (0.2 * size || 1), high + (0.2 * size || 1)];
  const margin = 0.08 * (high - low);
  return [low - margin, high + margin];
}

function swatch(number: number): SVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("class", `swatch series-${number % 4}`);
  svg.setAttribute("viewBox", "0 0 26 6");
  svg.setAttribute("aria-hidden", "true");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  line.setAttribute("d", "M0 3H26");
  line.setAttribute("stroke-dasharray", dashes(number).join(" "));
  svg.append(line);
  return svg;
}

// Quantities against time, with a line at the present that can be moved by a click.

import uPlot from "uplot";
import type { Clock } from "./clock";
import { digits, formula, make } from "./dom";
import { type PanelData, Rows } from "./scene";

const DASHES = [[], [9, 4], [2, 4], [10, 4, 2, 4]];
const HEIGHT = 150;
const ROUNDING = 1e-9; // of the largest value: what is less is told as zero

/** Dashes of a series; those that share a colour differ in them. */
const dashes = (number: number): number[] => DASHES[(number + Math.floor(number / 4)) % DASHES.length];

export class Plots {
  private readonly plots: Plot[];
  private readonly fitting: ResizeObserver;

  constructor(panels: PanelData[], clock: Clock, holder: HTMLElement) {
    this.plots = panels.map((panel) => new Plot(panel, clock, holder));
    clock.onChange(({ time }) => {
      for (const plot of this.plots) plot.seek(time);
    });
    this.fitting = new ResizeObserver(() => {
      for (const plot of this.plots) plot.fit();
    });
    this.fitting.observe(holder);
  }

  /** Nothing is left of them. */
  remove(): void {
    this.fitting.disconnect();
    for (const plot of this.plots) plot.remove();
  }

  /** Colours are read again from the style of the page. */
  theme(): void {
    for (const plot of this.plots) plot.theme();
  }
}

class Plot {
  private readonly figure: HTMLElement;
  private readonly box: HTMLElement;
  private readonly now = make("div", { class: "now" });
  private readonly values: HTMLElement[];
  private readonly rows: Rows[];
  private readonly least: number[];
  private readonly data: uPlot.AlignedData;
  private plot: uPlot;
  private time = 0;

  constructor(
    private readonly panel: PanelData,
    private readonly clock: Clock,
    holder: HTMLElement,
  ) {
    this.rows = panel.series.map(({ values }) => new Rows(values));
    this.least = this.rows.map(({ data }) => ROUNDING * data.reduce((a, b) => Math.max(a, Math.abs(b)), 0));
    const times = Array.from({ length: this.rows[0].count }, (_, i) => (i / (this.rows[0].count - 1)) * clock.duration);
    this.data = [times, ...this.rows.map(({ data }) => Array.from(data))];
    this.values = panel.series.map(() => make("span", { class: "value" }));
    const keys = panel.series.map(({ symbol }, i) =>
      make("span", { class: "key" }, swatch(i), formula(symbol), this.values[i]),
    );
    const unit = make("span", { class: "unit" }, panel.unit);
    this.box = make("div", { class: "canvas", role: "img", "aria-label": this.described() });
    this.figure = make("figure", { class: "plot" }, make("figcaption", {}, ...keys, unit), this.box);
    holder.append(this.figure);
    this.plot = this.made();
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
    this.plot.setSize({ width: this.box.clientWidth, height: HEIGHT });
    this.mark();
  }

  theme(): void {
    this.plot.destroy();
    this.plot = this.made();
    this.mark();
  }

  remove(): void {
    this.plot.destroy();
    this.figure.remove();
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
    const left = this.plot.valToPos(this.time, "x");
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
        scales: { x: { time: false }, y: { range: room } },
        axes: [
          { ...axis, size: 30, values: (_, ticks) => ticks.map((tick, i) => (i ? digits(tick) : `${digits(tick)} s`)) },
          { ...axis, size: 62, values: (_, ticks) => ticks.map((tick) => digits(tick)) },
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

/** Limits that do not blow rounding up to the height of the panel. */
function room(_: uPlot, low: number, high: number): uPlot.Range.MinMax {
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low <= 1e-6 * size || !size) return [low - (0.2 * size || 1), high + (0.2 * size || 1)];
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

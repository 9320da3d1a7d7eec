// Quantities against time, with a cursor at the present time that a click moves.

import uPlot from "uplot";
import type { Clock } from "./clock";
import { apart, digits, drawn, formula, make } from "./dom";
import { type Envelope, envelopeOf, extremes } from "./envelope";
import { Inset } from "./inset";
import { type PanelData, Rows } from "./scene";
import { Span } from "./span";

const DASHES = [[], [9, 4], [2, 4], [10, 4, 2, 4]];
const HEIGHT = 150;
const LABELS = 75; // pixels beside a plot, about
const WIDE = 7; // pixels of a letter at an axis
const ROUNDING = 1e-9; // relative to the largest value: less is shown as zero
const [KINETIC, POTENTIAL] = [1, 2]; // places among the energies, after the total one
const FLAT = 1e-6; // relative to the largest value: what varies by less is drawn as constant

/** Dashes of a series; series with the same colour differ in them. */
const dashes = (number: number): number[] => DASHES[(number + Math.floor(number / 4)) % DASHES.length];

export class Plots {
  private plots: Plot[] = [];
  private kinds = "";
  private clock: Clock | null = null;
  private readonly span = new Span(() => {
    for (const plot of this.plots) plot.stretch();
    this.bound();
  });
  private loops = false;
  private readonly zooming = this.span.buttons(
    () => this.clock?.time ?? 0,
    (loops) => {
      this.loops = loops;
      this.bound();
    },
  );
  private readonly fitting = new ResizeObserver(() => {
    for (const plot of this.plots) plot.fit();
  });

  constructor(private readonly holder: HTMLElement) {
    this.fitting.observe(holder);
  }

  /** Replace the quantities; if they are of the same kinds, only the lines change. */
  show(panels: PanelData[], clock: Clock): void {
    if (!panels.length) return;
    const kinds = panels.map(kindOf).join("\n");
    this.clock = clock;
    this.span.take(clock.duration, panels[0].series[0].values.shape[0]);
    if (kinds === this.kinds) this.plots.forEach((plot, i) => plot.renew(panels[i], clock));
    else this.replace(panels, clock);
    this.kinds = kinds;
    this.bound();
    clock.onChange(({ time }) => {
      if (!this.loops) this.span.follow(time);
      for (const plot of this.plots) plot.seek(time);
    });
  }

  private bound(): void {
    if (this.clock) this.clock.loop = this.loops ? [this.span.begin, this.span.end] : null;
  }

  private replace(panels: PanelData[], clock: Clock): void {
    for (const plot of this.plots) plot.remove();
    this.plots = panels.map((panel) => new Plot(panel, clock, this.span));
    this.holder.append(this.zooming, ...this.plots.map(({ figure }) => figure));
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
  private readonly inset: Inset;
  /** Whether what the first curve has above the third is the second. */
  private readonly isStacked: boolean;
  private rows: Rows[] = [];
  private least: number[] = [];
  private curves: Float32Array[] = [];
  private envelopes: (Envelope | null)[] = [];
  private plot: uPlot | null = null;
  private time = 0;

  constructor(
    private panel: PanelData,
    private clock: Clock,
    private readonly span: Span,
  ) {
    this.values = panel.series.map(() => make("span", { class: "value" }));
    const keys = panel.series.map(({ symbol }, i) =>
      make("span", { class: "key" }, swatch(i, panel.kind === "energies" && i > 0), formula(symbol), this.values[i]),
    );
    this.inset = new Inset(panel.series.length);
    this.isStacked = panel.kind === "energies";
    this.figure = make("figure", { class: "plot" }, make("figcaption", {}, ...keys, this.unit), this.box);
    this.read();
  }

  renew(panel: PanelData, clock: Clock): void {
    this.panel = panel;
    this.clock = clock;
    this.read();
    this.stretch();
  }

  /** Show the part of the motion that is chosen, with lines where they have room. */
  stretch(): void {
    const { plot, span } = this;
    if (!plot) return;
    plot.batch(() => {
      plot.setData(this.drawn(), false);
      plot.setScale("x", { min: span.begin, max: span.end });
    });
    this.mark();
  }

  /** Draw it; its figure must already be on the page, so that its width is known. */
  draw(): void {
    this.plot?.destroy();
    this.plot = null;
    this.plot = this.made();
    if (this.span.isWhole) this.mark();
    else this.stretch();
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
    this.stretch();
  }

  remove(): void {
    this.plot?.destroy();
    this.figure.remove();
  }

  private read(): void {
    this.rows = this.panel.series.map(({ values }) => new Rows(values));
    this.least = this.rows.map(({ data }) => ROUNDING * data.reduce((a, b) => Math.max(a, Math.abs(b)), 0));
    this.curves = this.rows.map(({ data }) => levelled(data));
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

  /** Times, and of each curve its line or the two ends of its envelope. */
  private drawn(): uPlot.AlignedData {
    const last = this.rows[0].count - 1;
    const [begin, end] = [this.span.begin, this.span.end].map((time) => Math.round((time / this.clock.duration) * last));
    const pixels = this.plot ? this.plot.bbox.width / devicePixelRatio : this.box.clientWidth - LABELS;
    const ends = this.curves.flatMap((values) => extremes(values));
    const range = Math.max(...ends) - Math.min(...ends);
    this.envelopes = this.curves.map((values) => (this.isStacked ? null : envelopeOf(values, range, begin, end, pixels)));
    const times = Float64Array.from({ length: last + 1 }, (_, i) => (i / last) * this.clock.duration);
    const none = new Array<null>(last + 1).fill(null);
    return [times, ...this.curves.flatMap((line, i) => (this.isStacked && i === KINETIC ? [none, none, none] : threefold(line, this.envelopes[i], none)))];
  }

  private mark(): void {
    const { now, time, span } = this;
    const left = this.plot?.valToPos(time, "x") ?? 0;
    now.style.transform = `translateX(${left}px)`;
    now.hidden = time < span.begin || time > span.end;
    const curves = this.curves.map((values, i) => (this.envelopes[i] ? values : null));
    const sample = (time / this.clock.duration) * (this.rows[0].count - 1);
    this.inset.show(curves, sample, Math.max(0, ...this.envelopes.map((found) => found?.period ?? 0)));
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
    const pale = (i: number): string => `${colour(`--series-${i % 4}`)}4d`;
    const series = this.panel.series.flatMap(({ name }, i): uPlot.Series[] => {
      const ground = this.isStacked && i === POTENTIAL ? { fill: pale(i), fillTo: (plot: uPlot) => plot.scales.y.min ?? 0 } : {};
      const line = { label: name, ...ground, stroke: colour(`--series-${i % 4}`), width: 1.8, points: { show: false } };
      const edge = { ...line, width: 1 };
      return [{ ...line, dash: dashes(i) }, edge, edge];
    });
    const bands = this.panel.series.map((_, i): uPlot.Band => ({ series: [3 * i + 3, 3 * i + 2], fill: pale(i) }));
    if (this.isStacked) bands.push({ series: [1, 3 * POTENTIAL + 1], fill: pale(KINETIC) });
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
        bands,
        hooks: { ready: [(plot) => this.ready(plot)] },
      },
      this.drawn(),
      this.box,
    );
  }

  private ready(plot: uPlot): void {
    plot.over.append(this.now, this.inset.element);
    plot.over.tabIndex = 0;
    plot.over.setAttribute("aria-label", "Plus and minus zoom, page keys move on, zero shows the whole");
    plot.over.setAttribute("role", "application");
    this.span.listen(plot.over, (x) => plot.posToVal(x - plot.over.getBoundingClientRect().left, "x"));
    plot.over.addEventListener("pointerdown", (event) => {
      if (!event.isPrimary) return;
      this.seekTo(plot, event);
      plot.over.setPointerCapture(event.pointerId);
    });
    plot.over.addEventListener("pointermove", (event) => {
      if (event.buttons && event.isPrimary) this.seekTo(plot, event);
    });
  }

  private seekTo(plot: uPlot, event: PointerEvent): void {
    const left = event.clientX - plot.over.getBoundingClientRect().left;
    this.clock.seek(plot.posToVal(left, "x"));
  }
}

/** A line, or else the two ends of a band; nothing in place of the others. */
function threefold(line: Float32Array, envelope: Envelope | null, none: null[]): (Float32Array | (number | null)[])[] {
  return envelope ? [none, envelope.low, envelope.high] : [line, none, none];
}

/** A line that hardly varies as a level one: the steps of its single precision are no motion. */
function levelled(values: Float32Array): Float32Array {
  const low = values.reduce((a, b) => Math.min(a, b), Infinity);
  const high = values.reduce((a, b) => Math.max(a, b), -Infinity);
  const flat = high - low <= FLAT * Math.max(Math.abs(low), Math.abs(high));
  return flat ? new Float32Array(values.length).fill((low + high) / 2) : values;
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

/** A line as in the plot, or a patch for what is an area there. */
function swatch(number: number, isArea: boolean): SVGElement {
  const line = drawn("path", { d: "M0 3H26", ...(isArea ? {} : { "stroke-dasharray": dashes(number).join(" ") }) });
  return drawn("svg", { class: `swatch series-${number % 4}${isArea ? " area" : ""}`, viewBox: "0 0 26 6", "aria-hidden": "true" }, line);
}

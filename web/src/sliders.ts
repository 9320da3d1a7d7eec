// Sliders, each with a field: a number with its unit, or a formula in other parameters.

import { digits, formula, make, raised } from "./dom";

const FINENESS = 1000; // positions of a slider
const PLAIN = /^\s*([+\-−]?\d*\.?\d+(?:e[+-]?\d+)?)\s*([^\d\s*/^(+\-−.].*?)?\s*$/i; // a number, and a unit

const valueOf = (number: string): number => Number(number.replace("−", "-"));

/** A slider as polhode describes it; documented at Control in polhode.view. */
export interface Control {
  name: string;
  symbol: string;
  meaning: string;
  text: string;
  value: number;
  unit: string;
  size: number;
  si: string;
  low: number;
  high: number;
  ratio: boolean;
  extra: boolean;
}

export type Changed = (name: string, text: string) => void;

export class Slider {
  readonly row: HTMLElement;
  private readonly range: HTMLInputElement;
  private readonly field: HTMLInputElement;
  private readonly remark = make("small", { class: "remark", role: "status" });
  private low: number;
  private high: number;

  constructor(
    readonly control: Control,
    text: string,
    private readonly changed: Changed,
  ) {
    this.low = control.low;
    this.high = control.high;
    const meant = raised(control.meaning);
    const called = meant || control.name;
    this.range = make("input", { type: "range", min: 0, max: FINENESS, step: 1, "aria-label": [control.name, meant].filter(Boolean).join(", ") });
    this.field = make("input", { type: "text", spellcheck: "false", autocomplete: "off", "aria-label": `${control.name}: value with unit` });
    const label = make("span", { class: "what", title: called }, formula(control.symbol));
    const meaning = meant ? [make("small", {}, meant)] : [];
    this.row = make("div", { class: "slider", "data-name": control.name }, label, this.range, this.field, ...meaning, this.remark);
    this.range.addEventListener("input", () => this.slid());
    this.field.addEventListener("change", () => this.typed());
    this.show(this.inUnit(text));
  }

  /** A number in SI units, converted to the displayed unit. */
  private inUnit(text: string): string {
    const [, number, unit] = PLAIN.exec(text) ?? [];
    if (number === undefined || unit) return text;
    return this.printed(valueOf(number) / this.control.size, 8);
  }

  /** Set a value in SI units. */
  set(si: number): void {
    this.changed(this.control.name, this.put(si));
  }

  /** Show a value in SI units; what it is written as. */
  put(si: number): string {
    this.show(this.printed(si / this.control.size, 6));
    return this.field.value;
  }

  /** Mark values in SI units on the slider, of which those that are not finite or out of its range are left out. */
  tick(marks: { value: number; title: string }[]): void {
    const seen = marks.filter(({ value }) => Number.isFinite(value) && value > 0);
    const places = seen.map(({ value, title }) => ({ share: this.share(value / this.control.size), title }));
    const within = places.filter(({ share }) => share >= 0 && share <= 1);
    const ticks = within.map(({ share, title }) => {
      const tick = make("span", { class: "tick", title });
      tick.style.left = `${100 * share}%`;
      return tick;
    });
    for (const part of this.row.querySelectorAll(".ticks, .told")) part.remove();
    if (!ticks.length) return;
    this.field.after(make("span", { class: "ticks" }, ...ticks));
    this.row.append(make("small", { class: "told" }, within.map(({ title }) => title).join("; ")));
  }

  get name(): string {
    return this.control.name;
  }

  wrong(message: string): void {
    mark(this.field, message);
  }

  private show(text: string): void {
    this.field.value = text;
    const value = this.read(text) ?? (text === this.control.text ? this.control.value : undefined);
    const { si } = this.control;
    this.remark.textContent = value === undefined && si && !PLAIN.test(text) ? `a formula, in ${raised(si)}` : "";
    if (value === undefined) return;
    this.low = Math.min(this.low, value);
    this.high = Math.max(this.high, value);
    this.range.value = String(Math.round(FINENESS * this.share(value)));
    this.range.setAttribute("aria-valuetext", text);
  }

  /** The text as a number in the unit of the slider, if it is one. */
  private read(text: string): number | undefined {
    const [, number, unit] = PLAIN.exec(text) ?? [];
    if (number === undefined) return undefined;
    return (unit ?? "") === this.control.unit ? valueOf(number) : undefined;
  }

  private share(value: number): number {
    if (this.control.ratio && value > 0) return Math.log(value / this.low) / Math.log(this.high / this.low);
    return (value - this.low) / (this.high - this.low);
  }

  private slid(): void {
    const share = Number(this.range.value) / FINENESS;
    const value = this.control.ratio
      ? this.low * (this.high / this.low) ** share
      : this.rounded(this.low + share * (this.high - this.low));
    this.field.value = this.printed(value);
    this.remark.textContent = "";
    this.range.setAttribute("aria-valuetext", this.field.value);
    this.changed(this.control.name, this.field.value);
  }

  private rounded(value: number): number {
    const step = 10 ** Math.floor(Math.log10((this.high - this.low) / 200));
    return Math.round(value / step) * step;
  }

  private printed(value: number, digits = 4): string {
    return `${Number(value.toPrecision(digits))} ${this.control.unit}`.trim();
  }

  /** A number without a unit is in the displayed unit, which is appended; an empty field returns to the default. */
  private typed(): void {
    const { name, text, value } = this.control;
    const [, number, unit] = PLAIN.exec(this.field.value) ?? [];
    const bare = number !== undefined && !unit;
    this.show(bare ? `${number.replace("−", "-")} ${this.control.unit}`.trim() : this.field.value.trim() || this.inUnit(text));
    this.changed(name, this.read(this.field.value) === value ? text : this.field.value);
  }
}

/** A field without a slider, for formulas. */
export class Field {
  readonly row: HTMLElement;
  private readonly field: HTMLInputElement;

  /**
   * @param usual what it is set to where it is emptied.
   * @param unit put behind a number without one; none for formulas.
   */
  constructor(
    readonly name: string,
    symbol: string,
    hint: string,
    text: string,
    usual: string,
    unit: string,
    changed: Changed,
  ) {
    this.field = make("input", { type: "text", spellcheck: "false", autocomplete: "off", value: text, "aria-label": `${name} ${hint}`.trim() });
    this.field.addEventListener("change", () => {
      const typed = this.field.value.trim() || usual;
      this.field.value = unit && PLAIN.test(typed) && !PLAIN.exec(typed)?.[2] ? `${typed} ${unit}` : typed;
      changed(name, this.field.value);
    });
    const letter = symbol ? formula(symbol) : name;
    this.row = make("div", { class: "slider formula", "data-name": name }, make("span", { class: "what" }, letter, make("small", {}, hint)), this.field);
  }

  wrong(message: string): void {
    mark(this.field, message);
  }
}

function mark(field: HTMLInputElement, message: string): void {
  field.setAttribute("aria-invalid", String(Boolean(message)));
  field.title = message;
}

/** Whether an error concerns the value typed for a name. */
export function isAbout(message: string, name: string): boolean {
  return [`${name}:`, `${name} =`, `'${name}' in`, `a ${name} of`].some((begins) => message.startsWith(begins));
}

export function shownNumber(value: number | null): string {
  return value === null ? "—" : digits(value, 4);
}

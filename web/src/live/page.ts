// A live page: its sliders integrate the equations in the page itself.

import "../sliders.css";
import { digits, formula, make, painted, raised } from "../dom";
import { film } from "../film";
import { Player } from "../player";
import type { SceneData, TraceData, Triple } from "../scene";
import { type Control, isAbout, Slider } from "../sliders";
import { footer, heading, judgements, sections, warning } from "../text";
import { Computer } from "./computer";
import type { Answer } from "./answer";
import { Grips } from "./grips";
import type { Hand, Handled } from "./hand";
import { type Handling, Hands } from "./hands";
import { type Chosen, read, unchanged, written } from "./link";
import type { LiveData, Numbers } from "./model";
import type { Ending } from "./motion";
import { ANGLES } from "./units";

const QUICK = 601; // frames while a slider moves
const SETTLED = 180; // ms after the last change, when all frames are computed
const ROWS = 2001; // of a table
const LONGEST = 3600; // s
const LEFT = "The motion starts as the body was let go; a slider of the start begins another one.";
const SAME = 1e-6; // of a duration, or of a coefficient
const ROUNDED_UP = 1.005; // before three digits are printed

export class LivePage implements Handling {
  private readonly player = new Player();
  private readonly panel = make("section", { class: "panel live", "aria-label": "Numbers" });
  private readonly message = make("p", { class: "message", role: "status" });
  private readonly words = make("div", { class: "words" });
  private sliders: Slider[] = [];
  private computer: Computer | null = null;
  private chosen: Chosen = unchanged();
  private preset = -1; // the motion that was chosen, until a number changes
  private shown: SceneData;
  private kept: TraceData[] = []; // paths of another motion
  private busy = false;
  private wanted = 0; // frames of the next motion to compute; none is waiting at 0
  private ticks = { others: "", needed: [NaN, NaN] };
  private settling = 0;
  private rewinds = false; // whether the next motion is shown from its start

  constructor(
    private readonly scene: SceneData,
    private readonly live: LiveData,
    private readonly code: string,
  ) {
    this.shown = scene;
    const aside = make("div", { class: "aside" }, this.panel, this.player.plots);
    const show = make("div", { class: "show live" }, this.player.theatre, aside);
    document.body.append(make("main", {}, heading(scene), show, this.words), footer(scene));
    this.furnish();
    new Grips(this.player, (name, value) => this.grip(name, value));
    new Hands(this.player, this);
  }

  async open(): Promise<void> {
    await painted();
    this.play(this.scene);
    this.tell(this.scene);
    try {
      this.computer = await Computer.of(this.live, this.code);
    } catch {
      this.say("This page may not compute here, so that it plays the motion that it was made with.");
      this.panel.querySelectorAll<HTMLInputElement>("input, button").forEach((part) => (part.disabled = true));
    }
    if (this.computer) this.follow(location.hash);
    if (this.computer && !this.isChanged()) void this.compute(this.live.frames);
    addEventListener("hashchange", () => this.follow(location.hash));
    document.body.dataset.ready = "yes";
  }

  // -- numbers ------------------------------------------------------------------------------------

  private furnish(): void {
    const { live } = this;
    const row = (kind: "parameters" | "start") => (control: Control): HTMLElement => {
      const slider = new Slider(shown(control), this.chosen[kind].get(control.name) ?? shown(control).text, (name, text) => this.changed(kind, name, text));
      this.sliders.push(slider);
      return slider.row;
    };
    this.sliders = [];
    const presets = this.presets();
    const free = live.start.filter((_, i) => !live.loops.solved.includes(i));
    const [usual, extra] = [false, true].map((hidden) => free.filter((control) => control.extra === hidden));
    const formulas = live.formulas.map(({ symbol, formula: value }) => make("p", { class: "follows" }, formula(symbol), " = ", formula(value)));
    const reset = make("button", { type: "button", class: "switch" }, "Reset");
    reset.addEventListener("click", () => this.reset());
    const keep = make("button", { type: "button", class: "switch", "aria-pressed": String(this.kept.length > 0), title: "Keep the paths of this motion in the picture, to compare others with" }, "Keep path");
    keep.addEventListener("click", () => this.keep(keep));
    const link = make("button", { type: "button", class: "switch" }, "Copy link");
    link.addEventListener("click", () => this.copy());
    const frame = make("button", { type: "button", class: "switch", title: "HTML that shows this motion in another page" }, "Copy frame");
    frame.addEventListener("click", () => this.copyFrame());
    const table = make("button", { type: "button", class: "switch", title: "Times, coordinates, speeds and plotted quantities with all digits, as CSV" }, "Save table");
    table.addEventListener("click", () => void this.save());
    const picture = make("button", { type: "button", class: "switch", title: "The picture as PNG" }, "Save picture");
    picture.addEventListener("click", () => this.savePicture());
    const films = make("button", { type: "button", class: "switch", title: "What plays, or what the plots show in a loop, as GIF" }, "Save film");
    films.addEventListener("click", () => void this.saveFilm(films));
    this.panel.replaceChildren(
      ...(presets ? [presets] : []),
      make("h2", {}, "Start"),
      ...usual.map(row("start")),
      ...(extra.length ? [make("details", {}, make("summary", {}, "Other coordinates"), ...extra.map(row("start")))] : []),
      make("h2", {}, "Parameters"),
      ...live.parameters.map(row("parameters")),
      ...formulas,
      this.span(),
      make("div", { class: "keeping" }, reset, keep, link, frame, table, picture, films),
      this.message,
    );
  }

  /** A choice of motions, if there are some. */
  private presets(): HTMLElement | null {
    const { presets } = this.live;
    if (!presets.length) return null;
    const select = make("select", { "aria-label": "Motions" }, make("option", { value: "" }, "A motion to look at …"), ...presets.map(({ title }, i) => make("option", { value: i, selected: i === this.preset }, raised(title))));
    select.addEventListener("change", () => {
      const chosen = presets[Number(select.value)];
      if (select.value === "" || !chosen) return this.reset();
      this.chosen = { ...unchanged(), parameters: new Map(Object.entries(chosen.parameters)), start: new Map(Object.entries(chosen.start)), duration: chosen.duration };
      this.preset = Number(select.value);
      this.furnish();
      void this.compute(this.live.frames);
    });
    return select;
  }

  /** The field of the duration. */
  private span(): HTMLElement {
    const text = this.chosen.duration || `${digits(this.live.duration)} s`;
    const field = make("input", { type: "text", spellcheck: "false", autocomplete: "off", value: text, "aria-label": "duration: value with unit" });
    field.addEventListener("change", () => {
      this.chosen.duration = field.value.trim();
      this.forget();
      this.request();
    });
    return make("div", { class: "slider formula", "data-name": "duration" }, make("span", { class: "what" }, "duration"), field);
  }

  private changed(kind: "parameters" | "start", name: string, text: string): void {
    this.chosen[kind].set(name, text);
    if (kind === "start") this.chosen.begin = null;
    this.forget();
    this.request();
  }

  /** Set the start by what is dragged in the picture. */
  private grip(name: string, value: number): void {
    this.sliders.find((slider) => slider.name === name)?.set(value);
  }

  // -- hands --------------------------------------------------------------------------------------

  get isTimed(): boolean {
    return this.live.timed || this.live.schedule.times.length > 0;
  }

  handle(numbers: Numbers, hand: Hand): Promise<Handled> {
    if (!this.computer) throw new Error("This page may not compute here.");
    return this.computer.handle(numbers, hand);
  }

  release(): void {
    this.play(this.shown);
  }

  restart({ start, begin }: Handled): void {
    this.live.start.forEach(({ name }, i) => {
      const slider = this.sliders.find((one) => one.name === name);
      if (slider) this.chosen.start.set(name, slider.put(start[i]));
    });
    this.chosen.begin = begin;
    this.rewinds = true;
    this.forget();
    this.request();
  }

  /** The motion is no longer the one that was chosen by its question. */
  private forget(): void {
    this.preset = -1;
    const motions = this.panel.querySelector<HTMLSelectElement>("select");
    if (motions) motions.value = "";
  }

  private reset(): void {
    this.chosen = unchanged();
    this.preset = -1;
    this.furnish();
    remember(location.pathname + location.search);
    this.say("");
    void this.compute(this.live.frames);
  }

  /** All numbers in SI units. Throws, in words, where one cannot be used. */
  numbers(): Numbers {
    const { live, chosen } = this;
    const values = (kind: "parameters" | "start"): number[] => {
      const controls = live[kind];
      const unknown = [...chosen[kind].keys()].find((name) => !controls.some((control) => control.name === name));
      const follows = kind === "start" && live.loops.solved.map((place) => controls[place].name).find((name) => chosen.start.has(name));
      if (follows) throw new Error(`${follows} follows from the other coordinates, by the loop that the bodies close.`);
      if (unknown) throw new Error(`${live.system} has no ${kind === "start" ? "coordinate or speed" : "parameter"} ${unknown}.`);
      return controls.map((control) => valueOf(control, chosen[kind].get(control.name)));
    };
    const { contact, modes } = live;
    const widest = modes.find(({ phase, beyond }) => phase === "flight" && !beyond);
    const count = contact === null || !widest ? 0 : widest.coordinates.length + widest.speeds.length;
    if (chosen.begin && (chosen.begin.length !== count || !chosen.begin.every(Number.isFinite))) throw new Error("The link begins with numbers that do not fit this page.");
    return { parameters: values("parameters"), start: values("start"), begin: chosen.begin, duration: durationOf(chosen.duration, live.duration, live.schedule.times.length ? live.duration : LONGEST) };
  }

  // -- motions ------------------------------------------------------------------------------------

  private request(): void {
    clearTimeout(this.settling);
    this.settling = window.setTimeout(() => void this.compute(this.live.frames), SETTLED);
    void this.compute(QUICK);
  }

  /** Compute a motion with the present numbers; while one is computed, the last request waits. */
  private async compute(frames: number): Promise<void> {
    this.wanted = frames;
    if (!this.computer || this.busy) return;
    this.busy = true;
    this.panel.setAttribute("aria-busy", "true");
    while (this.wanted) {
      const frames = this.wanted;
      this.wanted = 0;
      try {
        const numbers = this.numbers();
        this.show(await this.computer.ask(numbers, frames), numbers);
        if (this.isChanged()) remember(written(this.live.system, this.chosen));
      } catch (error) {
        this.refuse((error as Error).message);
      }
    }
    this.busy = false;
    this.panel.removeAttribute("aria-busy");
  }

  private show({ computed, end, ending, needed }: Answer, numbers: Numbers): void {
    const { duration } = numbers;
    this.tick(needed ?? null, numbers);
    if (!computed) {
      this.refuse(this.ended(ending, 0));
      return;
    }
    // the motion that the page opens with was followed by other means, perhaps further
    if (!this.isChanged() && end < this.scene.duration * (1 - SAME)) return this.say(this.ended(ending, end));
    for (const slider of this.sliders) slider.wrong("");
    const { time } = this.chosen;
    const scene: SceneData = { ...this.scene, ...computed };
    if (this.rewinds && this.player.clock) this.player.clock.time = 0; // not told: the motion before is not shown again
    this.rewinds = false;
    this.play(scene);
    if (time) this.player.clock?.seek(time);
    this.chosen.time = 0;
    this.say([this.chosen.begin ? LEFT : "", end < duration ? this.ended(ending, end) : "", scene.doubt && warning(scene.doubt)].filter(Boolean).join(" "));
    this.tell(scene);
  }

  /** Mark on the slider of friction how much this start needs to roll; that stays while nothing else changes. */
  private tick(needed: [number, number] | null, numbers: Numbers): void {
    const { friction, parameters } = this.live;
    const slider = this.sliders.find(({ name }) => name === friction);
    const others = JSON.stringify({ ...numbers, parameters: numbers.parameters.filter((_, i) => parameters[i].name !== friction) });
    if (needed) this.ticks = { others, needed };
    const [least, most] = this.ticks.others === others ? this.ticks.needed : [NaN, NaN];
    slider?.tick([
      ...(most - least > SAME * most ? [{ value: least, title: `below ${digits(least, 3)} it slips at once` }] : []),
      { value: most, title: `from ${digits(most * ROUNDED_UP, 3)} on it never slips` },
    ]);
  }

  /** Keep the paths of the motion that is shown, or drop those that were kept. */
  private keep(button: HTMLButtonElement): void {
    const paths = this.shown.traces.filter(({ kind, support }) => kind !== "axis" && support < 0);
    this.kept = this.kept.length ? [] : paths.map((path) => ({ ...path, kind: "kept", name: `${path.name}, kept` }));
    button.setAttribute("aria-pressed", String(this.kept.length > 0));
    this.play(this.shown);
  }

  private play(scene: SceneData): void {
    this.shown = scene;
    this.player.show({ ...scene, traces: [...scene.traces, ...this.kept] }, this.live.system);
    this.look();
    this.player.furnish();
    this.player.plot(scene);
  }

  /** See the picture as an address has it, once. */
  private look(): void {
    const { stage } = this.player;
    const { view, shown } = this.chosen;
    if (stage && shown) stage.switched = shown;
    if (stage && view.length) stage.view.from = view as Triple;
    [this.chosen.view, this.chosen.shown] = [[], null];
  }

  /** The motion that is shown stays, marked as one of other numbers. */
  private refuse(message: string): void {
    this.player.setOutdated(true);
    for (const slider of this.sliders) slider.wrong(isAbout(message, slider.name) ? message : "");
    this.say(message);
  }

  private ended({ kind, what }: Ending, end: number): string {
    const when = end ? `at t = ${digits(end, 6)} s` : "at the start";
    const only = this.live.contact === null && this.live.modes[0].phase ? " This page follows one contact mode of several contacts: polhode run and the lab go on from there." : "";
    if (what === "goes flat") return `The body lies flat ${when}, and the motion ends.`;
    if (kind === "event") return `The motion ends ${when}: ${what}.${only}`;
    if (kind === "long") return `The motion was followed until t = ${digits(end, 6)} s; to go on would take too long here.`;
    return `The motion cannot be followed beyond ${end ? `t = ${digits(end, 6)} s` : "its start"}: coordinates, speeds or forces have no finite values there, or no contact mode lasts.`;
  }

  // -- words and files ----------------------------------------------------------------------------

  private tell(scene: SceneData): void {
    const rest = sections({ ...scene, parameters: [], start: [] });
    this.words.replaceChildren(...judgements(scene), ...rest);
  }

  say(text: string): void {
    this.message.textContent = text;
  }

  /** Take the numbers of an address. */
  private follow(hash: string): void {
    let found: Chosen | null;
    try {
      found = read(this.live.system, hash);
      if (!found) return;
      const before = this.chosen;
      this.chosen = found;
      try {
        this.numbers();
      } catch (error) {
        this.chosen = before;
        throw error;
      }
    } catch (error) {
      this.say((error as Error).message);
      return;
    }
    this.furnish();
    void this.compute(this.live.frames);
  }

  private isChanged(): boolean {
    return this.chosen.parameters.size + this.chosen.start.size > 0 || this.chosen.duration !== "";
  }

  /** The address of the motion at the present time, as it is seen. */
  private address(): string {
    const { clock, stage } = this.player;
    const seen = stage ? { view: stage.view.from, shown: stage.switched } : {};
    remember(written(this.live.system, { ...this.chosen, time: clock?.time ?? 0, ...seen }));
    return location.href;
  }

  private copy(): void {
    this.clip(this.address(), "The address of this motion is on the clipboard.", "The address of this motion is the one this page has now.");
  }

  private copyFrame(): void {
    const frame = make("iframe", { src: this.address(), title: this.scene.title, width: 1000, height: 700, sandbox: "allow-scripts" });
    this.clip(frame.outerHTML, "HTML for a frame with this motion is on the clipboard.", `HTML for a frame: ${frame.outerHTML}`);
  }

  private clip(text: string, done: string, otherwise: string): void {
    if (!navigator.clipboard) return this.say(otherwise);
    navigator.clipboard.writeText(text).then(
      () => this.say(done),
      () => this.say(otherwise),
    );
  }

  private async save(): Promise<void> {
    try {
      const answer = await this.computer?.ask(this.numbers(), ROWS, true);
      if (answer?.table) this.download(new Blob([answer.table], { type: "text/csv" }), "csv");
    } catch (error) {
      this.say((error as Error).message);
    }
  }

  private savePicture(): void {
    const { stage } = this.player;
    if (!stage) return this.say("There is no picture in three dimensions here.");
    stage.drawNow(); // what was drawn before is gone from the canvas
    stage.canvas.toBlob((image) => image && this.download(image, "png"));
  }

  private async saveFilm(button: HTMLButtonElement): Promise<void> {
    const { stage, clock } = this.player;
    if (!stage || !clock) return this.say("There is no picture in three dimensions here.");
    button.disabled = true;
    try {
      const made = await film(stage, clock, (share) => this.say(`Film: ${10 * Math.floor(10 * share)} %`));
      this.download(made, "gif");
      this.say(`A film of ${digits(made.size / 1e6, 2)} MB was saved.`);
    } catch (error) {
      this.say((error as Error).message);
    }
    button.disabled = false;
  }

  private download(content: Blob, ending: string): void {
    const address = URL.createObjectURL(content);
    make("a", { href: address, download: `${this.live.system.replace(/\W+/g, "-")}.${ending}` }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
  }
}

/** Put the numbers into the address, where the page has one of its own. */
function remember(address: string): void {
  try {
    history.replaceState(null, "", address);
  } catch {
    // a frame made from text has no address
  }
}

/** A control with a value that is rounded for reading. */
function shown(control: Control): Control {
  return { ...control, value: Number(control.value.toPrecision(12)) };
}

const NUMBER = /^\s*([+\-−]?\d*\.?\d+(?:e[+-]?\d+)?)\s*(.*?)\s*$/i;

/** The value of a slider in SI units; untouched, the one that the page opens with, to the last digit. */
function valueOf(control: Control, text: string | undefined): number {
  if (text === undefined || text === control.text) return control.value * control.size;
  const [, number, unit] = NUMBER.exec(text) ?? [];
  const value = Number(number?.replace("−", "-"));
  const size = !unit || unit === control.unit ? control.size : control.unit in ANGLES ? ANGLES[unit] : undefined;
  if (number === undefined || size === undefined || !Number.isFinite(value)) {
    throw new Error(`${control.name} = ${text} cannot be read here: give a number${control.unit ? ` in ${control.unit}` : ""}.`);
  }
  return value * size;
}

const SPANS: Record<string, number> = { "": 1, s: 1, ms: 1e-3, min: 60 };

function durationOf(text: string, usual: number, longest: number): number {
  if (!text || text === `${digits(usual)} s`) return usual;
  const [, number, unit] = NUMBER.exec(text) ?? [];
  const value = Number(number) * (SPANS[unit ?? ""] ?? NaN);
  if (!(value > 0 && value <= longest)) throw new Error(`A duration of ${text} cannot be used here: give a time up to ${digits(longest)} s.`);
  return value;
}

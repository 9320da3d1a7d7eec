// The lab: sliders on one side, the resulting motion on the other.

import "uplot/dist/uPlot.min.css";
import "../page.css";
import "../sliders.css";
import "./lab.css";
import { formula, make, painted } from "../dom";
import type { SceneData } from "../scene";
import { warning, sections } from "../text";
import { ask, LatestRequest, requestNumbers } from "./requests";
import { ownEquation, Claims, explanation } from "./claims";
import { ownSolution } from "./solution";
import { keepingFocus } from "./focus";
import { sharing } from "./share";
import { Player } from "../player";
import { SheetDrag } from "./sheet";
import { type Control, Field, isAbout, shownNumber, Slider } from "../sliders";
import { badge, invariants, steadyMotions } from "./steady";
import { empty, read, written } from "./state";
import { tabs } from "./tabs";
import type { Description, Offer, Outcome, Reading, Row, Standing, State } from "./types";

const MOTION_DELAY = 0; // ms after the last change
const STUDY_DELAY = 300; // when the picture is there
const AFTER = 1.5; // s that a motion goes on once the sheet is let go
const RETURNED = 1e-9; // relative difference of velocities that count as equal
const CONTACTS: Record<string, string> = { rolling: "Rolling", smooth: "Smooth", friction: "Friction" };

class Lab {
  private state: State;
  private described: Description | null = null;
  private sliders: Slider[] = [];
  private fields: (Slider | Field)[] = [];
  private readonly player = new Player();
  private readonly claims = new Claims();
  private readonly drag = new SheetDrag(this.player, (rows, seconds) => ({ ...this.wish(), sheet: rounded(rows), duration: `${seconds.toFixed(2)} s` }), (rows) => this.dragged(rows));
  private readonly title = make("h1", {}, "polhode lab");
  private readonly about = make("p", { class: "about" });
  private readonly choice = make("select", { "aria-label": "System" });
  private readonly contact = make("div", { class: "contact", role: "radiogroup", "aria-label": "Contact" });
  private readonly panel = make("section", { class: "panel", "aria-label": "Numbers" });
  private readonly message = make("p", { class: "message", role: "status" });
  private readonly outcome = make("div", { class: "outcome" });
  private readonly equations = make("div", {});
  private readonly constants = make("div", {});
  private readonly steady = make("div", {});
  private claimsOpen = false;
  private eager = false; // to play what comes next
  private readonly motion = new LatestRequest<SceneData>((wish, signal) => requestNumbers("run", wish, signal), MOTION_DELAY, (scene, wish, signal) => this.play(scene, wish, signal), (message) => this.refused(message), (busy) => this.busy(busy));
  private readonly study = new LatestRequest<Standing>((wish, signal) => ask("standing", wish, signal), STUDY_DELAY, (standing) => this.stand(standing), (message) => this.unknown(message), (busy) => this.steady.setAttribute("aria-busy", String(busy)));

  constructor(offers: Offer[]) {
    this.state = read(location.hash) ?? empty(offers[0].name);
    for (const { name, title } of offers) this.choice.append(make("option", { value: name }, title));
    this.choice.addEventListener("change", () => this.begin(empty(this.choice.value)));
    window.addEventListener("hashchange", () => {
      const told = read(location.hash);
      if (told && written(told) !== written(this.state)) void this.begin(told);
    });
    this.lay();
    void this.begin(this.state);
  }

  private lay(): void {
    const bar = make("div", { class: "bar" }, this.choice, this.contact, sharing(() => this.wish(), (text) => this.tell(text)));
    const about = tabs([
      { title: "Steady motions", panel: this.steady },
      { title: "Equations", panel: this.equations },
      { title: "Constants", panel: this.constants },
      { title: "Claims", panel: this.claims.panel, decoded: () => this.openClaims() },
      { title: "Try an equation", panel: make("div", {}, ownEquation(() => ({ system: this.state.system, contact: this.state.contact }))) },
      { title: "Mark a solution", panel: make("div", {}, ownSolution(() => ({ system: this.state.system, contact: this.state.contact }))) },
    ]);
    const seen = make("div", { class: "seen" }, this.player.theatre, this.outcome, this.message);
    const work = make("div", { class: "work" }, seen, this.panel, this.player.plots, about);
    document.body.append(
      make("main", { class: "lab" }, make("header", {}, make("div", { class: "masthead" }, this.title, bar), this.about), work),
      make("footer", {}, "Computed on this machine by polhode; nothing leaves it."),
    );
  }

  /** Another system, or another contact: request the options again. */
  private async begin(state: State): Promise<void> {
    this.state = state;
    this.forget();
    this.choice.value = state.system;
    this.drag.arm(false);
    try {
      const { system, contact } = state;
      this.described = await ask<Description>("describe", { system, contact });
      if (state !== this.state) return;
      this.describe(this.described);
      this.changed();
      if (this.claimsOpen) void this.claims.open(system);
    } catch (error) {
      this.refused(explanation(error));
      document.body.dataset.ready = "yes";
    }
  }

  /** Responses to earlier requests no longer apply. */
  private forget(): void {
    this.motion.forget();
    this.study.forget();
  }

  private describe(found: Description): void {
    keepingFocus([this.contact, this.panel], () => this.offer(found));
  }

  private offer(found: Description): void {
    this.forget();
    document.title = `${found.title} · polhode lab`;
    this.title.textContent = found.title;
    this.about.textContent = found.about;
    this.contact.replaceChildren(...found.contacts.map((kind) => this.contactChoice(kind, found)));
    const { settings, start } = this.state;
    const make_ = (store: Record<string, string>) => (control: Control): Slider =>
      new Slider(control, store[control.name] ?? control.text, (_, text) => this.put(store, control, text));
    const parameters = found.parameters.map(make_(settings));
    const starts = found.start.map(make_(start));
    this.sliders = [...starts, ...parameters];
    const usual = starts.filter(({ control }) => !control.extra);
    const extra = starts.filter(({ control }) => control.extra);
    const free = found.forcing.filter(({ name }) => !(this.state.sheet.length && (name === "X" || name === "Y")));
    const forcing = free.map(({ name, symbol, text, unit }) =>
      new Field(name, symbol, `(t), ${unit}`, settings[name] ?? text, text, "", (_, typed) => this.put(settings, { name, text }, typed)),
    );
    const duration = new Field("duration", "", "", this.state.duration || found.duration, found.duration, "s", (_, text) => {
      this.state.duration = text === found.duration ? "" : text;
      this.changed();
    });
    this.fields = [...this.sliders, ...forcing, duration];
    const reset = make("button", { type: "button", class: "switch" }, "Usual numbers");
    reset.addEventListener("click", () => void this.begin({ ...empty(this.state.system), contact: this.state.contact }));
    this.panel.replaceChildren(
      ...(found.sheet ? [this.sheetBox(found)] : []),
      make("h2", {}, "Start"),
      ...usual.map(({ row }) => row),
      ...(extra.length ? [make("details", {}, make("summary", {}, "Other coordinates"), ...extra.map(({ row }) => row))] : []),
      make("h2", {}, "Parameters"),
      ...parameters.map(({ row }) => row),
      ...(forcing.length ? [make("h2", {}, "Prescribed"), ...forcing.map(({ row }) => row)] : []),
      duration.row,
      reset,
    );
  }

  private sheetBox(found: Description): HTMLElement {
    const forget = make("button", { type: "button", class: "switch" }, "Usual path");
    forget.addEventListener("click", () => {
      this.state.sheet = [];
      this.state.duration = "";
      this.describe(found);
      this.changed();
    });
    const words = make("p", { class: "long" }, "Press the button, then pull the sheet about in the picture, or push it with the arrow keys; Enter lets go. However it was pulled, the ball ends with the velocity it began with.");
    return make("div", { class: "sheet" }, words, this.drag.button, forget);
  }

  private contactChoice(kind: string, found: Description): HTMLElement {
    const input = make("input", { type: "radio", name: "contact", value: kind, checked: kind === found.contact });
    input.addEventListener("change", () => {
      const contact = kind === found.declared ? "" : kind;
      void this.begin({ ...this.state, contact });
    });
    return make("label", {}, input, make("span", {}, CONTACTS[kind] ?? kind));
  }

  private put(store: Record<string, string>, control: { name: string; text: string }, text: string): void {
    if (text === control.text || !text) delete store[control.name];
    else store[control.name] = text;
    this.changed();
  }

  private wish(): State {
    const start: Record<string, string> = {};
    for (const { name, text } of this.described?.start ?? []) {
      const chosen = this.state.start[name] ?? text;
      if (chosen !== "0" || name in this.state.start) start[name] = chosen;
    }
    const known = new Set([...(this.described?.parameters ?? []), ...(this.described?.forcing ?? [])].map(({ name }) => name));
    const settings = Object.fromEntries(Object.entries(this.state.settings).filter(([name]) => known.has(name)));
    const sheet = this.described?.sheet ? this.state.sheet : [];
    return { ...this.state, settings, start, sheet };
  }

  private changed(): void {
    history.replaceState(null, "", written(this.state));
    this.motion.ask(this.wish());
    this.study.ask(this.wish());
  }

  private dragged(rows: Row[]): void {
    if (rows.length > 4) {
      this.state.sheet = rounded(rows);
      this.state.duration = `${(rows[rows.length - 1][0] + AFTER).toFixed(2)} s`;
    }
    this.drag.arm(false);
    if (this.described) this.describe(this.described);
    this.eager = true;
    this.changed();
  }

  /** Show the picture first; the readable part is requested meanwhile and follows. */
  private async play(scene: SceneData, wish: object, signal: AbortSignal): Promise<void> {
    const asked = requestNumbers<Reading>("read", wish, signal);
    asked.catch(() => {}); // told where it is waited for
    this.player.show(scene, `${this.state.system} ${this.state.sheet.length}`);
    this.drag.arm(this.drag.armed);
    if (this.eager) this.player.clock?.play();
    this.eager = false;
    counted("pictures");
    await painted();
    if (signal.aborted) return;
    this.player.furnish();
    this.read(await asked);
  }

  private read({ account, outcome }: Reading): void {
    this.player.plot(account);
    this.equations.replaceChildren(...sections(account));
    this.outcome.replaceChildren(...(this.state.sheet.length ? [returned(outcome)] : []));
    for (const field of this.fields) field.wrong("");
    this.tell("");
    if (account.doubt) this.warn(warning(account.doubt));
    document.body.dataset.ready = "yes";
    counted("answers");
  }

  private stand(standing: Standing): void {
    this.steady.replaceChildren(...steadyMotions(standing, (values) => this.go(values)));
    this.constants.replaceChildren(...invariants(standing));
  }

  /** With values that cannot be read, there is nothing to say about them. */
  private unknown(message: string): void {
    for (const panel of [this.steady, this.constants]) panel.replaceChildren(make("p", {}, message));
  }

  /** Start with these values, in SI units; ignore what is neither an initial value nor a parameter. */
  private go(values: Record<string, number>): void {
    for (const slider of this.sliders) {
      const value = values[slider.control.name];
      if (value !== undefined) slider.set(value);
    }
  }

  private openClaims(): void {
    this.claimsOpen = true;
    if (this.described) void this.claims.open(this.state.system);
  }

  private refused(message: string): void {
    for (const field of this.fields) field.wrong(isAbout(message, field.name) ? message : "");
    const isOld = this.player.setOutdated(true);
    this.outcome.replaceChildren();
    this.warn(isOld ? `${message}. The picture and the plots are still of the numbers before.` : message);
    document.body.dataset.ready = "yes";
  }

  private warn(message: string): void {
    this.message.classList.add("wrong");
    this.message.textContent = message;
  }

  private tell(message: string): void {
    this.message.classList.remove("wrong");
    this.message.textContent = message;
  }

  private busy(busy: boolean): void {
    this.player.theatre.classList.toggle("busy", busy);
    this.player.theatre.setAttribute("aria-busy", String(busy));
  }
}

/** For observers of the page. */
function counted(what: string): void {
  const { dataset } = document.body;
  dataset[what] = String(Number(dataset[what] ?? 0) + 1);
}

/** A path to a hundredth of a second and a tenth of a millimetre. */
function rounded(rows: Row[]): Row[] {
  return rows.map(([t, x, y]) => [Math.round(t * 100) / 100, Math.round(x * 1e4) / 1e4, Math.round(y * 1e4) / 1e4]);
}

/** Initial and final velocity, and whether they are equal. */
function returned(outcome: Outcome[]): HTMLElement {
  const shown = outcome.filter(({ name }) => name.startsWith("v_"));
  const size = Math.max(...shown.flatMap(({ start, end }) => [Math.abs(start), Math.abs(end)]), 1e-30);
  const same = shown.every(({ start, end }) => Math.abs(start - end) < RETURNED * size);
  const cells = shown.map(({ symbol, start, end }) =>
    make("span", { class: "ends" }, formula(symbol), ` ${shownNumber(tidy(start, size))} → ${shownNumber(tidy(end, size))} m/s`),
  );
  return make("p", {}, ...cells, badge(same ? "the velocity has returned" : "not the velocity it began with", same ? "holds" : "fails"));
}

function tidy(value: number, size: number): number {
  return Math.abs(value) < 1e-12 * size ? 0 : value;
}

const { systems } = document.body.dataset;
if (systems) new Lab(JSON.parse(systems) as Offer[]);

// Play, pause, speed, slider, arrows, and the keys that do the same.

import type { Extra } from "./annotations";
import { type Clock, rates } from "./clock";
import { digits, formula, make } from "./dom";
import type { ArrowKind } from "./scene";
import type { Arrow } from "./arrows";
import type { Stage } from "./stage";

const STEP = 0.01; // of the duration, for one press of an arrow key
const FINENESS = 2000; // positions of the slider
const TURN = 0.12; // rad, for one press of an arrow key on the picture
const NAMES: Record<ArrowKind, [string, string]> = {
  force: ["F", "forces of supports"],
  load: ["loads", "loads"],
  torque: ["τ", "torque"],
  omega: ["ω", "angular velocity"],
  momentum: ["L", "angular momentum"],
};

const EXTRAS: Record<Extra, [string, string]> = {
  components: ["N, f", "normal force and friction, with the cone of friction"],
  angles: ["Angles", "angles of the rotations that lead to the axes"],
  axes: ["Axes", "axes of the bodies and of the laboratory"],
};

const ICONS = {
  play: "M7 4.5v15l12-7.5z",
  pause: "M6 5h4v14H6zM14 5h4v14h-4z",
  back: "M6 5h2.5v14H6zM19 5v14L9 12z",
};

/** The row of controls under the picture. */
export function transport(clock: Clock): HTMLElement {
  const play = make("button", { type: "button", class: "play", "aria-keyshortcuts": "Space" });
  play.addEventListener("click", () => clock.toggle());
  const back = make("button", { type: "button", "aria-label": "Back to the start" }, icon("back"));
  back.addEventListener("click", () => clock.seek(0));
  const told = make("output", { class: "time" });
  const slider = make("input", {
    type: "range",
    min: 0,
    max: FINENESS,
    step: 1,
    value: 0,
    "aria-label": "Time",
  });
  slider.addEventListener("input", () => clock.seek((Number(slider.value) / FINENESS) * clock.duration));
  const places = Math.max(0, 3 - Math.floor(Math.log10(clock.duration) + 1));
  let shown: boolean | undefined;
  clock.onChange(({ time, playing }) => {
    slider.value = String((time / clock.duration) * FINENESS);
    told.textContent = `${time.toFixed(places)} s`;
    slider.setAttribute("aria-valuetext", told.textContent);
    if (shown === playing) return;
    shown = playing;
    play.replaceChildren(icon(playing ? "pause" : "play"));
    play.setAttribute("aria-label", playing ? "Pause" : "Play");
  });
  return make("div", { class: "transport" }, play, back, slider, told, speed(clock));
}

function speed(clock: Clock): HTMLElement {
  const { offered } = rates(clock.duration);
  const select = make("select", { "aria-label": "Speed" });
  for (const rate of offered) {
    select.append(make("option", { value: rate, selected: rate === clock.rate }, `× ${digits(rate)}`));
  }
  select.addEventListener("change", () => {
    clock.rate = Number(select.value);
  });
  return select;
}

/** Switches for arrows, traces and the camera. */
export function switches(stage: Stage, clock: Clock): HTMLElement {
  const arrows = stage.annotations.kinds.map((kind) => arrowSwitch(kind, stage, clock));
  const traces = toggle("Traces", stage.showsTraces, (on) => stage.showTraces(on));
  const extras = (Object.keys(EXTRAS) as Extra[]).filter((extra) => stage.annotations.has(extra)).map((extra) => {
    const [text, title] = EXTRAS[extra];
    const button = toggle(text, stage.annotations.shows(extra), (on) => stage.annotations.show(extra, on));
    button.title = title;
    return button;
  });
  const follow = toggle("Follow", stage.view.follow, (on) => stage.setFollow(on));
  const home = make("button", { type: "button", class: "switch" }, "Reset view");
  home.addEventListener("click", () => stage.view.home());
  return make(
    "div",
    { class: "switches", role: "group", "aria-label": "What is shown" },
    ...arrows,
    ...extras,
    ...(stage.traces.length ? [traces] : []),
    follow,
    home,
  );
}

function arrowSwitch(kind: ArrowKind, stage: Stage, clock: Clock): HTMLElement {
  const own = stage.annotations.arrows.filter(({ data }) => data.kind === kind);
  const [letter, words] = NAMES[kind];
  const about = pointOf(own);
  const value = make("span", { class: "value" });
  const button = toggle("", stage.annotations.shows(kind), (shown) => stage.annotations.show(kind, shown));
  const dot = make("span", { class: "dot", "aria-hidden": "true" });
  dot.style.background = `var(--${kind})`;
  button.title = `${words}: ${own.map(({ data }) => data.name).join(", ")}`;
  const spoken = [words, about && `about the ${about}`].filter(Boolean).join(" ");
  button.append(dot, lettered(own) ?? make("i", {}, letter), make("span", { class: "spoken" }, ` ${spoken} `));
  button.append(...(about ? [make("small", { "aria-hidden": "true" }, `about ${about.split(" ")[0]}`)] : []), value);
  if (own.length === 1) {
    clock.onChange(({ time }) => {
      const frame = (time / clock.duration) * (stage.scene.frames - 1);
      value.textContent = `${digits(own[0].size(frame), 3)} ${own[0].data.unit}`;
    });
  }
  return button;
}

/** The letters that a model has for arrows, if it has one for each: M g. */
function lettered(arrows: Arrow[]): Node | null {
  const symbols = [...new Set(arrows.map(({ data }) => data.symbol))];
  return symbols.length === 1 && symbols[0] ? formula(symbols[0]) : null;
}

/** The point about which moments are taken: where they begin, or the centre of mass. */
function pointOf(arrows: Arrow[]): string {
  if (!arrows.every(({ data }) => data.kind === "torque" || data.kind === "momentum")) return "";
  const points = new Set(arrows.map(({ data }) => (data.foot.shape[0] ? "pivot" : "centre of mass")));
  return points.size === 1 ? [...points][0] : "";
}

function toggle(text: string, on: boolean, change: (on: boolean) => void): HTMLButtonElement {
  const button = make("button", { type: "button", class: "switch", "aria-pressed": String(on) }, text);
  button.addEventListener("click", () => {
    const next = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(next));
    change(next);
  });
  return button;
}

function icon(name: keyof typeof ICONS): SVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  return svg;
}

/** Space plays and pauses, arrow keys step; on the picture they rotate the view. */
export function keys(
  clock: Clock,
  picture: HTMLElement,
  stage: Stage | null,
  signal?: AbortSignal,
): void {
  const seek = (share: number) => (): void => clock.seek(clock.time + share * clock.duration);
  const everywhere: Record<string, () => void> = {
    " ": () => clock.toggle(),
    ArrowLeft: seek(-STEP),
    ArrowRight: seek(STEP),
    Home: () => clock.seek(0),
    End: () => clock.seek(clock.duration),
  };
  const turning: Record<string, () => void> = {
    ArrowLeft: () => stage?.view.orbit(-TURN, 0),
    ArrowRight: () => stage?.view.orbit(TURN, 0),
    ArrowUp: () => stage?.view.orbit(0, -TURN),
    ArrowDown: () => stage?.view.orbit(0, TURN),
    "+": () => stage?.view.zoom(1 / 1.15),
    "-": () => stage?.view.zoom(1.15),
  };
  document.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const own = target.closest("input, select, textarea, a, summary, [role=tab]") !== null;
    const pressed = event.key === " " && target.closest("button") !== null;
    if (own || pressed) return;
    const act = (target === picture && stage ? turning[event.key] : undefined) ?? everywhere[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }, { signal });
}

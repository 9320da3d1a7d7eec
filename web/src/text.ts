// The text of the page: formulas, numbers and words.

import { digits, formula, make, raised } from "./dom";
import type { AccountData, FormulaData, JudgementData, NoteData, NumberData, SceneData } from "./scene";

export function heading(scene: SceneData): HTMLElement {
  const about = scene.about ? [make("p", { class: "about" }, scene.about)] : [];
  const doubt = scene.doubt ? [make("p", { class: "doubt", role: "alert" }, warning(scene.doubt))] : [];
  return make("header", {}, make("h1", {}, scene.title), ...doubt, ...about);
}

export function warning(doubt: string): string {
  return `This motion cannot be relied on: ${doubt}.`;
}

export function sections(scene: AccountData): HTMLElement[] {
  return [
    ...section("Equations of motion", formulas(scene.motion)),
    ...section("Reactions", formulas(scene.reactions)),
    make(
      "div",
      { class: "beside" },
      ...section("Parameters", numbers(scene.parameters)),
      ...section("Start", numbers(scene.start)),
      ...section("Evidence", evidence(scene)),
      ...section("Events", events(scene)),
    ),
  ];
}

export function footer(scene: SceneData): HTMLElement {
  const { versions, integrator } = scene.origin;
  const version = versions?.polhode ? ` ${versions.polhode}` : "";
  const by = integrator ? `, integrated with ${integrator}` : "";
  return make("footer", {}, `Made by polhode${version}${by}. This page is one file and asks nothing of any network.`);
}

function section(title: string, content: HTMLElement[]): HTMLElement[] {
  return content.length ? [make("section", {}, make("h2", {}, title), ...content)] : [];
}

function formulas(rows: FormulaData[]): HTMLElement[] {
  return rows.map(({ name, pieces, spoken }) => {
    const head = name ? [make("h3", {}, name)] : [];
    if (!pieces.length) return make("div", {}, ...head, make("p", { class: "long" }, spoken));
    const set = make("div", { class: "equation", role: "math", "aria-label": spoken }, ...pieces.map(formula));
    scrolled.observe(set);
    return make("div", {}, ...head, set);
  });
}

function numbers(rows: NumberData[], count = 4): HTMLElement[] {
  if (!rows.length) return [];
  const lines = rows.map(({ name, symbol, value, unit, meaning }) =>
    make(
      "tr",
      {},
      make("th", { scope: "row", ...(symbol && { "aria-label": name }) }, symbol ? formula(symbol) : name),
      make("td", { class: "number" }, digits(value, count), " ", raised(unit.replace(/^1$/, ""))),
      make("td", {}, raised(meaning)),
    ),
  );
  return [make("table", {}, make("tbody", {}, ...lines))];
}

function evidence(scene: AccountData): HTMLElement[] {
  const told = make("p", {}, "Maximum drift of conserved quantities and constraints over the whole motion:");
  return scene.evidence.length ? [told, ...numbers(scene.evidence, 2)] : [];
}

function events(scene: AccountData): HTMLElement[] {
  if (!scene.happenings.length) return [];
  const lines = scene.happenings.map(({ time, what }) =>
    make("tr", {}, make("th", { scope: "row", class: "number" }, `${digits(time)} s`), make("td", {}, what)),
  );
  return [make("table", {}, make("tbody", {}, ...lines))];
}

/** Every claim with its verdict; a convention precedes the first claim to which it applies. */
export function judgements(scene: SceneData): HTMLElement[] {
  let last = "";
  const rows = scene.judgements.flatMap((judgement) => {
    const { convention } = judgement;
    const opening = convention && convention !== last ? [make("p", { class: "convention long" }, convention)] : [];
    last = convention;
    return [...opening, judged(judgement)];
  });
  return section("Claims", rows);
}

/** How a claim was read, line by line. */
export function noteElements(notes: NoteData[]): HTMLElement[] {
  return notes.map(({ label, text, formula: set }) =>
    make("p", { class: "note" }, make("span", { class: "long" }, label), " ", set ? formula(set) : text),
  );
}

function judged({ claim, verdict, reason, formula: stated, correction, notes }: JudgementData): HTMLElement {
  const badge = make("strong", { class: `verdict ${verdict.replace(/\W/g, "")}` }, verdict);
  const row = make("article", { class: "judged" }, stated ? set(stated, claim) : make("p", {}, claim));
  row.append(...noteElements(notes), make("p", {}, badge, ` ${reason}`));
  if (correction) row.append(make("p", { class: "long" }, "It holds as"), set(correction, ""));
  return row;
}

function set(mathml: string, spoken: string): HTMLElement {
  const row = make("div", { class: "equation", role: "math", ...(spoken && { "aria-label": spoken }) }, formula(mathml));
  scrolled.observe(row);
  return row;
}

/** Rows that are too wide can be scrolled with the keyboard. */
const scrolled = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    if (target.scrollWidth > target.clientWidth) target.setAttribute("tabindex", "0");
    else target.removeAttribute("tabindex");
  }
});

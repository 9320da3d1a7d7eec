// Steady motions and thresholds, and the position of the present start relative to them.

import { formula, make } from "../dom";
import { shownNumber } from "../sliders";
import type { Family, Standing, Valued } from "./types";

const DECADES = 1; // to either side of a threshold, on its scale

export type Go = (values: Record<string, number>) => void;

export function steadyMotions({ families }: Standing, go: Go): HTMLElement[] {
  if (!families.length) return [make("p", {}, "No steady motion was found: none exists, or its conditions cannot be solved exactly.")];
  const note = make("p", { class: "long" }, "Exact, for the present system. Eigenvalues with positive real part prove instability; purely imaginary ones leave the question to terms of higher order.");
  return [...families.map((family) => shown(family, go)), note];
}

function shown(family: Family, go: Go): HTMLElement {
  const title = make("h3", { class: "equation" }, family.formula ? formula(family.formula) : family.spoken);
  const state = family.here ? badge("you are here", "holds") : make("span", { class: "told" }, "the start is not such a motion");
  const held = make("button", { type: "button", class: "switch" }, "Start there");
  held.addEventListener("click", () => go(family.set));
  return make(
    "article",
    { class: "family" },
    make("div", { class: "head" }, title, state, ...(family.startable && Object.keys(family.set).length ? [held] : [])),
    ...(family.broken ? [make("p", {}, badge("does not last", "fails"), ` ${family.broken}`)] : []),
    ...branches(family, go),
    ...stability(family),
    ...valued("frequencies of small oscillations", family.frequencies),
    ...valued("rates of growth where unstable", family.growth ?? []),
  );
}

function branches(family: Family, go: Go): HTMLElement[] {
  return family.branches.map((branch) => {
    const value = make("span", { class: "number" }, branch.value === null ? " not real here" : ` = ${inUnit(branch.value, branch.unit)} here`);
    const row = make("p", { class: "branch" }, branch.formula ? formula(branch.formula) : branch.name, value);
    const { name, value: si, startable } = branch;
    if (name && si !== null && startable) {
      const button = make("button", { type: "button", class: "switch" }, "Start there");
      button.addEventListener("click", () => go({ ...family.set, [name]: si }));
      row.append(" ", button);
    }
    return row;
  });
}

/** A value in SI units for display: angles in degrees. */
function inUnit(value: number, unit: string): string {
  return unit === "rad" ? `${shownNumber((value * 180) / Math.PI)} deg` : `${shownNumber(value)} ${unit}`;
}

function stability(family: Family): HTMLElement[] {
  if (family.undecided) return [make("p", {}, badge("undecided", "unread"), ` ${family.undecided}`)];
  if (family.stable === "true") return [make("p", {}, badge("stable", "holds"), " at every rate, to first order")];
  if (family.stable === "false") return [make("p", {}, badge("unstable", "fails"), " at every rate")];
  const rows = family.conditions.map((condition) => {
    const told = condition.formula ? formula(condition.formula) : make("span", { class: "long" }, condition.spoken);
    return make("div", { class: "condition" }, make("p", {}, "stable when ", told), ...(condition.holds === undefined ? [] : [scale(condition.ratio)]));
  });
  const verdict = family.verdict ? [make("p", {}, badge(`${family.verdict} here`, family.verdict === "stable" ? "holds" : "fails"))] : [];
  return [...rows, ...verdict, make("p", { class: "long" }, `Loss: ${family.loss ?? ""}`)];
}

/** Ratio of the two sides of an inequality; the threshold is in the middle. */
function scale(ratio: number | null): HTMLElement {
  const power = ratio === null ? DECADES : ratio > 0 ? Math.log10(ratio) / DECADES : -DECADES;
  const place = 50 + 50 * Math.max(-1, Math.min(1, power));
  const mark = make("span", { class: "mark" });
  mark.style.left = `${place}%`;
  const explanation = ratio === null ? "no term opposes it" : `${shownNumber(ratio)} times the threshold`;
  return make("div", { class: "scale", role: "img", "aria-label": explanation, title: explanation }, mark, make("span", { class: "told" }, explanation));
}

function valued(title: string, values: Valued[]): HTMLElement[] {
  if (!values.length) return [];
  const pieces = values.map(({ formula: text, value, on }) =>
    make("span", { class: "valued" }, text ? formula(text) : "(long)", on === false ? "" : ` = ${value === null ? "not real here" : `${shownNumber(value)} rad/s`}`),
  );
  return [make("p", { class: "freq" }, `${title}: `, ...pieces)];
}

export function badge(text: string, kind: string): HTMLElement {
  return make("strong", { class: `verdict ${kind}` }, text);
}

export function invariants({ invariants: found }: Standing): HTMLElement[] {
  if (!found.length) return [make("p", {}, "None was found.")];
  return found.map(({ meaning, pieces, spoken }) => {
    const set = pieces.length
      ? make("div", { class: "equation", role: "math", "aria-label": spoken }, ...pieces.map(formula))
      : make("p", { class: "long" }, spoken);
    return make("div", {}, make("h3", {}, meaning), set);
  });
}

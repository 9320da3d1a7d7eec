// The claims of the problem set about a system, judged one after the other, and the user's own.

import { formula, make } from "../dom";
import { noteElements } from "../text";
import { ask, RefusedError } from "./requests";
import { badge } from "./steady";
import type { Stated, Verdict } from "./types";

const CONTEXTS: Record<string, string> = {
  motion: "on every true motion",
  identity: "for all states, whatever the forces",
  steady: "on steady motions",
  threshold: "as a condition for stability",
};

export class Claims {
  readonly panel = make("div", { class: "claims" });
  private system = "";
  private judging = new AbortController();

  /** Show the claims about a system and judge them, each only once. */
  async open(system: string): Promise<void> {
    if (system === this.system) return;
    this.system = system;
    this.judging.abort();
    this.judging = new AbortController();
    const { signal } = this.judging;
    this.panel.replaceChildren(make("p", { class: "long" }, "Reading the problem set …"));
    try {
      const { claims } = await ask<{ claims: Stated[] }>("claims", { system }, signal);
      await this.judge(claims, signal);
    } catch (error) {
      if (!signal.aborted) this.panel.replaceChildren(make("p", {}, explanation(error)));
    }
  }

  private async judge(claims: Stated[], signal: AbortSignal): Promise<void> {
    if (!claims.length) {
      this.panel.replaceChildren(make("p", {}, "The problem set makes no claims about this system; you can try your own equations."));
      return;
    }
    const count = make("p", { role: "status" }, `${claims.length} claims`);
    const rows = claims.map(stated);
    const parted = rows.flatMap((row, i) => [...opening(claims[i], claims[i - 1]), row]);
    this.panel.replaceChildren(count, make("div", { class: "claimed" }, ...parted));
    const counts: Record<string, number> = {};
    for (const [i, { id }] of claims.entries()) {
      const verdict = await judged(this.system, id, signal);
      rows[i].querySelector(".verdict-place")?.replaceChildren(...told(verdict));
      counts[verdict.verdict] = (counts[verdict.verdict] ?? 0) + 1;
      const summed = Object.entries(counts).map(([answer, number]) => `${number} ${answer}`).join(", ");
      count.textContent = `${i + 1} of ${claims.length} claims judged: ${summed}`;
    }
  }
}

async function judged(system: string, id: string, signal: AbortSignal): Promise<Verdict> {
  try {
    return await ask<Verdict>("judge", { system, id }, signal);
  } catch (error) {
    if (signal.aborted) throw error;
    return { verdict: "unread", reason: explanation(error), correction: null, residuals: [], counterexample: null, remarks: [] };
  }
}

/** The heading and the convention of a part of the text, before its first claim. */
function opening(claim: Stated, before: Stated | undefined): HTMLElement[] {
  if (before && before.part === claim.part && before.convention === claim.convention) return [];
  const convention = claim.convention ? [make("p", { class: "convention long" }, claim.convention)] : [];
  return [make("h3", {}, claim.part), ...convention];
}

function stated(claim: Stated): HTMLElement {
  const text = claim.words || !claim.formula ? make("p", {}, claim.words || claim.printed) : make("div", { class: "equation" }, formula(claim.formula));
  return make(
    "article",
    { class: "claim" },
    make("span", { class: "number id" }, `(${claim.id})`),
    make("div", {}, text, ...noteElements(claim.notes), make("div", { class: "verdict-place" }, make("span", { class: "long" }, "…"))),
  );
}

function told(verdict: Verdict): HTMLElement[] {
  const { correction, counterexample } = verdict;
  const head: HTMLElement = make("p", {}, badge(verdict.verdict, verdict.verdict), ` ${verdict.reason}`);
  const rows: HTMLElement[] = [head];
  if (correction) rows.push(make("div", {}, `${correction.what}; it holds as `, make("div", { class: "equation" }, correction.formula ? formula(correction.formula) : "")));
  if (counterexample) {
    const state = Object.entries(counterexample.values).map(([name, value]) => `${name} = ${value}`).join(", ");
    rows.push(details("A state that refutes it", `${state}: left ${counterexample.left}, right ${counterexample.right}`));
  }
  if (verdict.residuals.length && verdict.verdict === "fails") rows.push(details("Left minus right", verdict.residuals.join("; ")));
  return [...rows, ...verdict.remarks.map((remark) => make("p", { class: "long" }, remark))];
}

function details(title: string, text: string): HTMLElement {
  return make("details", {}, make("summary", {}, title), make("p", { class: "long code" }, text));
}

/** A field for the user's own equation. */
export function ownEquation(subject: () => { system: string; contact: string }): HTMLElement {
  const field = make("textarea", { rows: 3, spellcheck: "false", "aria-label": "Equation in LaTeX", placeholder: "\\dot{\\omega}_3 = 0" });
  const context = make("select", { "aria-label": "Where it is meant to hold" });
  for (const [name, words] of Object.entries(CONTEXTS)) context.append(make("option", { value: name }, words));
  const read = make("input", { type: "text", spellcheck: "false", autocomplete: "off", "aria-label": "What ambiguous letters mean", placeholder: "L = about pivot" });
  const button = make("button", { type: "submit", class: "go" }, "Judge it");
  const result = make("div", { class: "result", role: "status" });
  const form = make("form", { class: "asking" }, make("label", {}, "An equation of this system in LaTeX, as printed in a text:", field), make("label", {}, "What ambiguous letters mean (may be empty; several are separated by semicolons):", read), make("div", { class: "row" }, context, button), result);
  let number = 0;
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const mine = ++number;
    result.replaceChildren(make("p", { class: "long" }, "Judging …"));
    void ask<Verdict>("check", { ...subject(), latex: field.value, context: context.value, read: read.value }).then(
      (verdict) => mine === number && result.replaceChildren(...answered(verdict)),
      (error) => mine === number && result.replaceChildren(make("p", {}, explanation(error))),
    );
  });
  field.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || event.shiftKey) return;
    event.preventDefault();
    form.requestSubmit();
  });
  return form;
}

function answered(verdict: Verdict): HTMLElement[] {
  const set = verdict.formula ? [make("div", { class: "equation" }, formula(verdict.formula))] : [];
  return [...set, ...told(verdict)];
}

export function explanation(error: unknown): string {
  return error instanceof RefusedError ? error.message : "The lab's server does not answer; is polhode lab still running?";
}

// A solution of the user's own, pasted in and marked line by line.

import { formula, make } from "../dom";
import { explanation } from "./claims";
import { ask } from "./requests";
import type { MarkedLine, Marks } from "./types";

const KINDS: Record<string, string> = {
  true: "holds",
  error: "fails",
  doubt: "unread",
  follows: "fails",
  unlinked: "approximate",
  needs: "ambiguous",
  "not-judged": "unread",
};

/** A field for a whole derivation. */
export function ownSolution(subject: () => { system: string; contact: string }): HTMLElement {
  const field = make("textarea", {
    rows: 9,
    spellcheck: "false",
    "aria-label": "Solution in LaTeX or Markdown",
    placeholder: "The energy is $E = T + V$, hence\n\\[ \\dot E = 0 . \\]",
  });
  const button = make("button", { type: "submit", class: "go" }, "Mark it");
  const status = make("p", { class: "long", role: "status" });
  const result = make("div", { class: "marked" });
  const label = make("label", {}, "A solution about this system, in LaTeX or Markdown, as it is:", field);
  const form = make("form", { class: "asking" }, label, make("div", { class: "row" }, button), status, result);
  let number = 0;
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const mine = ++number;
    status.textContent = "Marking …";
    result.replaceChildren();
    void ask<Marks>("review", { ...subject(), text: field.value, format: formatOf(field.value) }).then(
      (marks) => {
        if (mine !== number) return;
        status.textContent = summed(marks);
        result.replaceChildren(...rows(marks.lines));
      },
      (error) => {
        if (mine === number) status.textContent = explanation(error);
      },
    );
  });
  return form;
}

/** Text with a heading of Markdown, or without any command that structures LaTeX, is Markdown. */
function formatOf(text: string): string {
  return /\\(?:begin|section|newcommand|item)\b/.test(text) ? ".tex" : ".md";
}

function summed({ lines, counts }: Marks): string {
  if (!lines.length) return "No relation was found. Formulas stand between dollar signs, or in displays.";
  return Object.entries(counts).map(([title, count]) => `${count} ${title}`).join(", ");
}

function rows(lines: MarkedLine[]): HTMLElement[] {
  return lines.flatMap((line, i) => {
    const opens = line.part && line.part !== lines[i - 1]?.part;
    return [...(opens ? [make("h3", {}, line.part)] : []), row(line)];
  });
}

function row(line: MarkedLine): HTMLElement {
  const { correction, counterexample } = line;
  const sign = make("span", { "aria-hidden": "true" }, line.sign);
  const badge = make("span", { class: `verdict ${KINDS[line.mark] ?? "unread"}` }, sign, ` ${line.title}`);
  const final = line.final ? [make("span", { class: "long" }, "final answer")] : [];
  const head = make("p", {}, badge, " ", make("span", { class: "long" }, `line ${line.line}`), " ", ...final);
  const said = line.mark === "true" ? [] : [make("p", {}, line.told)];
  const set = make("div", { class: "equation" }, line.formula ? formula(line.formula) : make("code", {}, line.latex));
  const inner: HTMLElement[] = [set, head, ...said];
  if (correction && line.mark !== "true") {
    inner.push(make("div", {}, `${correction.what}; it holds as `, make("div", { class: "equation" }, correction.formula ? formula(correction.formula) : "")));
  }
  if (counterexample && line.mark === "error") {
    const state = Object.entries(counterexample.values).map(([name, value]) => `${name} = ${value}`).join(", ");
    const text = `${state}: left ${counterexample.left}, right ${counterexample.right}`;
    inner.push(make("details", {}, make("summary", {}, "A state that refutes it"), make("p", { class: "long code" }, text)));
  }
  return make("article", { class: `marked-line ${line.mark}` }, ...inner);
}

// Tabs: one panel is seen at a time; arrow keys go from one to the next.

import { make } from "../dom";

export interface Tab {
  title: string;
  panel: HTMLElement;
  decoded?: () => void;
}

export function tabs(entries: Tab[]): HTMLElement {
  const buttons = entries.map(({ title, panel }, i) => {
    panel.id = `panel-${i}`;
    panel.setAttribute("role", "tabpanel");
    panel.setAttribute("aria-labelledby", `tab-${i}`);
    panel.setAttribute("tabindex", "0");
    return make("button", { type: "button", role: "tab", id: `tab-${i}`, "aria-controls": panel.id }, title);
  });
  const open = (chosen: number): void => {
    buttons.forEach((button, i) => {
      button.setAttribute("aria-selected", String(i === chosen));
      button.tabIndex = i === chosen ? 0 : -1;
      entries[i].panel.hidden = i !== chosen;
    });
    entries[chosen].decoded?.();
  };
  buttons.forEach((button, i) => {
    button.addEventListener("click", () => open(i));
    button.addEventListener("keydown", ({ key }) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[key];
      if (!step) return;
      const next = (i + step + buttons.length) % buttons.length;
      open(next);
      buttons[next].focus();
    });
  });
  open(0);
  const list = make("div", { role: "tablist", "aria-label": "About this system" }, ...buttons);
  return make("section", { class: "tabs", "aria-label": "About this system" }, list, ...entries.map(({ panel }) => panel));
}

// The state of the lab in the fragment of its address, which browsers do not send.

import type { Row, State } from "./types";

const TICKS = 100; // a second, in the path of a sheet
const FINE = 1e4; // a metre

export function empty(system: string): State {
  return { system, contact: "", settings: {}, start: {}, duration: "", sheet: [] };
}

export function written(state: State): string {
  const pairs = new URLSearchParams({ system: state.system });
  if (state.contact) pairs.set("contact", state.contact);
  if (state.duration) pairs.set("duration", state.duration);
  for (const [name, text] of Object.entries(state.settings)) pairs.append("set", `${name}=${text}`);
  for (const [name, text] of Object.entries(state.start)) pairs.append("start", `${name}=${text}`);
  if (state.sheet.length) pairs.set("sheet", packed(state.sheet));
  return `#${pairs}`;
}

/** The state in an address, or null. */
export function read(hash: string): State | null {
  const pairs = new URLSearchParams(hash.replace(/^#/, ""));
  const system = pairs.get("system");
  if (!system) return null;
  return {
    system,
    contact: pairs.get("contact") ?? "",
    settings: assignments(pairs.getAll("set")),
    start: assignments(pairs.getAll("start")),
    duration: pairs.get("duration") ?? "",
    sheet: unpacked(pairs.get("sheet") ?? ""),
  };
}

function assignments(texts: string[]): Record<string, string> {
  const split = texts.map((text): [string, string] => {
    const at = text.indexOf("=");
    return [text.slice(0, at), text.slice(at + 1)];
  });
  return Object.fromEntries(split.filter(([name, text]) => name && text));
}

/** Steps of time and place as whole numbers. */
function packed(rows: Row[]): string {
  const whole = rows.map(([t, x, y]) => [Math.round(t * TICKS), Math.round(x * FINE), Math.round(y * FINE)]);
  return whole.map((row, i) => row.map((n, k) => n - (i ? whole[i - 1][k] : 0)).join(".")).join("_");
}

function unpacked(text: string): Row[] {
  const rows: Row[] = [];
  const sum = [0, 0, 0];
  for (const part of text ? text.split("_") : []) {
    const steps = part.split(".").map(Number);
    if (steps.length !== 3 || !steps.every(Number.isInteger)) return [];
    steps.forEach((step, k) => {
      sum[k] += step;
    });
    rows.push([sum[0] / TICKS, sum[1] / FINE, sum[2] / FINE]);
  }
  return rows;
}

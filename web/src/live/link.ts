// The numbers of a live page in the fragment of its address, which browsers do not send.

/** What differs from the numbers that the page opens with, as texts with units. */
export interface Chosen {
  parameters: Map<string, string>;
  start: Map<string, string>;
  /** Numbers of a start that sliders do not hold, SI; null for one that they do. */
  begin: number[] | null;
  duration: string;
  time: number;
  /** From where the picture is seen, in reaches of the body; empty for the usual view. */
  view: number[];
  /** What is switched on in the picture, by name; null for what usually is. */
  shown: string[] | null;
}

export const unchanged = (): Chosen => ({ parameters: new Map(), start: new Map(), begin: null, duration: "", time: 0, view: [], shown: null });

const KNOWN = ["system", "set", "start", "begin", "duration", "time", "view", "show"];
const FARTHEST = 1e4; // reaches

export function written(system: string, chosen: Chosen): string {
  const pairs = new URLSearchParams({ system });
  for (const [name, text] of chosen.parameters) pairs.append("set", `${name}=${text}`);
  for (const [name, text] of chosen.start) pairs.append("start", `${name}=${text}`);
  if (chosen.begin) pairs.set("begin", chosen.begin.join(" "));
  if (chosen.duration) pairs.set("duration", chosen.duration);
  if (chosen.time) pairs.set("time", chosen.time.toPrecision(6));
  if (chosen.view.length) pairs.set("view", chosen.view.map((part) => Number(part.toPrecision(4))).join(" "));
  if (chosen.shown) pairs.set("show", chosen.shown.join(" "));
  return `#${pairs}`;
}

/** The numbers in an address; null for an address without any. Throws, in words, for one that cannot be read. */
export function read(system: string, hash: string): Chosen | null {
  const pairs = new URLSearchParams(hash.replace(/^#/, ""));
  if (![...pairs].length) return null;
  const named = pairs.get("system");
  if (named !== system) throw new Error(`The link is for ${named ? `the system ${named}` : "no system"}, and this page shows ${system}.`);
  const other = [...pairs.keys()].find((key) => !KNOWN.includes(key));
  if (other) throw new Error(`The link says something about “${other}”, which this page does not know.`);
  const time = Number(pairs.get("time") ?? 0);
  if (!Number.isFinite(time)) throw new Error("The link gives a time that is no number.");
  const view = (pairs.get("view") ?? "").split(" ").filter(Boolean).map(Number);
  const size = Math.hypot(...view);
  if (view.length && !(view.length === 3 && size > 0 && size < FARTHEST)) throw new Error("The link gives a view that is not three numbers.");
  const begin = pairs.has("begin") ? (pairs.get("begin") ?? "").split(" ").map(Number) : null;
  const shown = pairs.has("show") ? (pairs.get("show") ?? "").split(" ") : null;
  return { parameters: assigned(pairs.getAll("set")), start: assigned(pairs.getAll("start")), begin, duration: pairs.get("duration") ?? "", time, view, shown };
}

function assigned(texts: string[]): Map<string, string> {
  return new Map(
    texts.map((text) => {
      const at = text.indexOf("=");
      if (at < 1) throw new Error(`The link has “${text}” where a name and a number were expected.`);
      return [text.slice(0, at), text.slice(at + 1)];
    }),
  );
}

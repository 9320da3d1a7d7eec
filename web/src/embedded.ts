// What is embedded in a page as packed data.

import { make } from "./dom";
import { unpacked } from "./packed";

/** The packed text of an element; null where there is none. */
export function packedIn(id: string): string | null {
  const text = document.getElementById(id)?.textContent;
  return text ? (JSON.parse(text) as string) : null;
}

/** Show the scene of the page, unless the browser cannot unpack it. */
export async function opened<T>(show: (scene: T) => void | Promise<void>): Promise<void> {
  const packed = packedIn("scene");
  if (packed === null) return;
  const scene = await unpacked<T>(packed).catch(() => null);
  if (scene) return show(scene);
  document.body.append(make("p", {}, "This browser is too old for this page: open it in one that was made since 2023."));
  document.body.dataset.ready = "yes";
}

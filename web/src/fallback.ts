// Shown in place of the picture if the browser has no WebGL.

import { make } from "./dom";

/** @param working what still works. */
export function makeFallback(picture: HTMLElement, working: string): void {
  picture.removeAttribute("tabindex");
  picture.setAttribute("role", "note");
  picture.removeAttribute("aria-label");
  picture.classList.add("blind");
  picture.append(make("p", {}, `No picture in three dimensions: this browser offers no WebGL. ${working} work without it.`));
}

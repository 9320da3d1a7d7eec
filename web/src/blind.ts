// What stands in place of the picture where a browser cannot draw it.

import { make } from "./dom";

/** @param working what there is all the same. */
export function makeBlind(picture: HTMLElement, working: string): void {
  picture.removeAttribute("tabindex");
  picture.setAttribute("role", "note");
  picture.removeAttribute("aria-label");
  picture.classList.add("blind");
  picture.append(make("p", {}, `No picture in three dimensions: this browser offers no WebGL. ${working} work without it.`));
}

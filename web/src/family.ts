// Colours of the family of everything that polhode draws, from the file that pages, stills and figures have, too.

import family from "../../src/polhode/base/family.json";

export const MATERIALS = family.materials;

/** A colour of pages by day or by night. */
export const colourOf = (name: keyof typeof family.pages, dark: boolean): string => family.pages[name][dark ? 1 : 0];

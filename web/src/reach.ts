// The size of a body.

import type { BodyData } from "./scene";

// A box of three equal sides, and a rod and a racquet from their middle, reach so far in their longest sides.
const HALVES: Record<string, number> = { box: 0.87, rod: 0.5, racquet: 0.6 };

/** Distance from the centre of mass to the farthest drawn point. */
export function reach({ shape: { kind, size, centre }, arms }: Pick<BodyData, "shape" | "arms">): number {
  const far = Math.max(...size.map(Math.abs)) * (HALVES[kind] ?? 1) + Math.hypot(...centre);
  return Math.max(kind === "revolution" ? outermost(size) : far, ...arms.map((arm) => Math.hypot(...arm)));
}

/** Of pairs of a height along an axis and a radius, the greatest distance. */
function outermost(outline: number[]): number {
  return outline.reduce((far, length, i) => (i % 2 ? Math.max(far, Math.hypot(outline[i - 1], length)) : far), 0);
}

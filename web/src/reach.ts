// The size of a body.

import type { BodyData } from "./scene";

/** Distance from the centre of mass to the farthest drawn point. */
export function reach(body: BodyData): number {
  const half = ["box", "rod", "racquet"].includes(body.shape.kind) ? 0.5 : 1;
  const far = half * Math.max(...body.shape.size.map(Math.abs)) + Math.hypot(...body.shape.centre);
  return Math.max(far, ...body.arms.map((arm) => Math.hypot(...arm)));
}

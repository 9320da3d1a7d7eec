// Supports of fixed points of bodies.

import { type Object3D, Vector3 } from "three";
import { bracket, post } from "./shapes";

const THICK = 0.1; // of a post, in reaches
const HANGS = 0.4; // reaches above the middle, from where a point hangs instead of standing

interface Extent {
  up: Vector3;
  middle: Vector3;
  reach: number;
}

/** Fixed points stand on posts on a floor of this height, or hang from above. */
export function mounts(points: Vector3[], floor: number, { up, middle, reach }: Extent): Object3D[] {
  const highest = middle.dot(up) + HANGS * reach;
  return points.map((point) => {
    const height = point.dot(up);
    const holder = height > highest ? bracket(0.5 * THICK * reach) : post(height - floor, THICK * reach);
    holder.position.copy(point);
    holder.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), up);
    return holder;
  });
}

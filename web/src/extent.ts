// How much room a motion takes.

import { Box3, Vector3 } from "three";
import type { Pose } from "./pose";

const LOOKS = 200; // along the motion

/** Middle and radius of all the places that bodies of this reach pass through, and of fixed points. */
export function extent(poses: Pose[], fixed: Vector3[], frames: number, reach: number): [Vector3, number] {
  const box = new Box3().setFromPoints(fixed);
  const place = new Vector3();
  for (const pose of poses) {
    for (let i = 0; i <= LOOKS; i++) box.expandByPoint(pose.placeAt((i / LOOKS) * (frames - 1), place));
  }
  return [box.getCenter(new Vector3()), box.min.distanceTo(box.max) / 2 + reach];
}

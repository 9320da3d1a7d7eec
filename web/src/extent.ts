// How much room a motion takes.

import { Box3, Sphere, Vector3 } from "three";
import type { Arrow } from "./arrows";
import type { Pose } from "./pose";

const LOOKS = 200; // along the motion
const AIR = 1.15; // radius of what is kept free about a body, in reaches
const LONG = 2.5; // reaches of an arrow that are to be in view; a shock may make it longer
const TIP = 0.15; // of what is kept free about the tip of an arrow, in reaches

export interface Room {
  up: Vector3;
  /** Of all that is to be in view. */
  middle: Vector3;
  /** Of the places that bodies pass through, m. */
  radius: number;
  /** From the middle of the largest body to its farthest point, m. */
  reach: number;
  /** What is to be in view, at many instants. */
  balls: Sphere[];
}

/** The room that bodies and arrows take, and points that are held. */
export function roomOf(up: Vector3, poses: Pose[], reach: number, held: Vector3[], arrows: Arrow[], frames: number): Room {
  const instants = Array.from({ length: LOOKS + 1 }, (_, i) => (i / LOOKS) * (frames - 1));
  const places = instants.flatMap((frame) => poses.map((pose) => pose.placeAt(frame, new Vector3())));
  const tips = instants.flatMap((frame) => arrows.map((arrow) => arrow.tip(frame, LONG * reach, new Vector3())));
  const balls = [
    ...places.map((place) => new Sphere(place, AIR * reach)),
    ...[...tips.filter(isPlace), ...held].map((point) => new Sphere(point, TIP * reach)),
  ];
  const passed = new Box3().setFromPoints([...places, ...held]);
  const seen = balls.reduce((box, ball) => box.union(ball.getBoundingBox(new Box3())), new Box3());
  const radius = passed.min.distanceTo(passed.max) / 2 + reach;
  return { up, middle: seen.getCenter(new Vector3()), radius, reach, balls };
}

function isPlace({ x, y, z }: Vector3): boolean {
  return Number.isFinite(x + y + z);
}

// The extent of a motion in space.

import { Box3, Object3D, Sphere, Vector3 } from "three";
import type { Arrow } from "./arrows";
import type { Pose } from "./pose";
import { Rows, type TraceData } from "./scene";

const LOOKS = 200; // along the motion
const AIR = 1.15; // radius of what is kept free about a body, in reaches
const LONG = 2.5; // reaches of an arrow that are to be in view; a shock may make it longer
const TURNS = 12; // instants at which a trace on a moving support is looked at
const TIP = 0.15; // of what is kept free about the tip of an arrow or a path, in reaches
const EDGE = 0.03; // likewise, relative to the extent of the motion

export interface Extent {
  up: Vector3;
  /** Of everything that is to be in view. */
  middle: Vector3;
  /** Of the positions of the bodies, m. */
  radius: number;
  /** From the centre of the largest body to its farthest point, m. */
  reach: number;
  /** Everything to be in view, at many instants. */
  balls: Sphere[];
}

/** The extent of bodies, arrows, traces and held points. */
export function extentOf(
  up: Vector3,
  poses: Pose[],
  reach: number,
  held: Vector3[],
  arrows: Arrow[],
  traced: Vector3[],
  frames: number,
): Extent {
  const instants = Array.from({ length: LOOKS + 1 }, (_, i) => (i / LOOKS) * (frames - 1));
  const places = instants.flatMap((frame) => poses.map((pose) => pose.placeAt(frame, new Vector3())));
  const tips = instants.flatMap((frame) => arrows.map((arrow) => arrow.tip(frame, LONG * reach, new Vector3())));
  const passed = new Box3().setFromPoints([...places, ...held]);
  const radius = passed.min.distanceTo(passed.max) / 2 + reach;
  const balls = [
    ...places.map((place) => new Sphere(place, AIR * reach)),
    ...[...tips, ...traced, ...held].filter(isPlace).map((point) => new Sphere(point, Math.max(TIP * reach, EDGE * radius))),
  ];
  const seen = balls.reduce((box, ball) => box.union(ball.getBoundingBox(new Box3())), new Box3());
  return { up, middle: seen.getCenter(new Vector3()), radius, reach, balls };
}

/** Points of a trace; on a moving support, at their positions during its motion. */
export function tracedBy({ points, support }: TraceData, supports: Pose[], frames: number): Vector3[] {
  const { data, count } = new Rows(points);
  const step = Math.max(1, Math.floor(count / LOOKS));
  const places = Array.from({ length: Math.ceil(count / step) }, (_, i) => new Vector3().fromArray(data, 3 * i * step));
  const pose = supports[support];
  if (!pose) return places;
  const carrier = new Object3D();
  return Array.from({ length: TURNS }, (_, i) => (i + 1) / TURNS).flatMap((share) => {
    pose.apply(share * (frames - 1), carrier);
    carrier.updateMatrixWorld();
    return places.slice(0, Math.ceil(share * places.length)).map((place) => carrier.localToWorld(place.clone()));
  });
}

function isPlace({ x, y, z }: Vector3): boolean {
  return Number.isFinite(x + y + z);
}

// The extent of a motion in space.

import { Box3, Object3D, Sphere, Vector3 } from "three";
import type { Arrow } from "./arrows";
import { Pose } from "./pose";
import { type Packed, Rows, type SupportData, type TraceData } from "./scene";

const LOOKS = 200; // along the motion
const AIR = 1.15; // radius of what is kept free about a body, in reaches
const LONG = 2.5; // reaches of an arrow that are to be in view; a shock may make it longer
const NEAR = 6; // reaches about the path of the bodies up to which a sheet is to be in view
const SPARSE = 7; // of the points of a curved surface, every so many are looked at
const ROUND = 24; // points of the rim of a turntable
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

/** The extent of bodies, arrows, traces, supports and held points. */
export function extentOf(
  up: Vector3,
  poses: Pose[],
  reach: number,
  held: Vector3[],
  arrows: Arrow[],
  traced: Vector3[],
  supports: SupportData[],
  frames: number,
): Extent {
  const instants = Array.from({ length: LOOKS + 1 }, (_, i) => (i / LOOKS) * (frames - 1));
  const places = instants.flatMap((frame) => poses.map((pose) => pose.placeAt(frame, new Vector3())));
  const tips = instants.flatMap((frame) => arrows.map((arrow) => arrow.tip(frame, LONG * reach, new Vector3())));
  const passed = new Box3().setFromPoints([...places, ...held]);
  const radius = passed.min.distanceTo(passed.max) / 2 + reach;
  const outlines = supports.flatMap((support) => outlineOf(support, places, reach));
  const balls = [
    ...places.map((place) => new Sphere(place, AIR * reach)),
    ...[...tips, ...traced, ...outlines, ...held].filter(isPlace).map((point) => new Sphere(point, Math.max(TIP * reach, EDGE * radius))),
  ];
  const seen = balls.reduce((box, ball) => box.union(ball.getBoundingBox(new Box3())), new Box3());
  return { up, middle: seen.getCenter(new Vector3()), radius, reach, balls };
}

/** Points of a trace in the laboratory; one on a moving support may go anywhere with it. */
export function tracedBy({ points, support }: TraceData): Vector3[] {
  if (support >= 0) return [];
  const { data, count } = new Rows(points);
  const step = Math.max(1, Math.floor(count / LOOKS));
  return Array.from({ length: Math.ceil(count / step) }, (_, i) => new Vector3().fromArray(data, 3 * i * step));
}

/** Points of the outline of a support at the start, of a sheet only near the bodies; a plane has no outline. */
function outlineOf({ kind, pose, middle, reach, points }: SupportData, places: Vector3[], size: number): Vector3[] {
  const carrier = new Object3D();
  new Pose(pose).apply(0, carrier);
  carrier.updateMatrixWorld();
  const lift = ([x, y]: number[]): Vector3 => carrier.localToWorld(new Vector3(x, y, 0));
  if (kind === "turntable") return turns(reach[0]).map(lift);
  if (kind === "curved") return closeBy(points, carrier, places, size);
  if (kind !== "sheet") return [];
  const passed = new Box3().setFromPoints(places.map((place) => carrier.worldToLocal(place.clone())));
  const near = passed.expandByScalar(NEAR * size);
  const [x, y] = [0, 1].map((i) => [-1, 1].map((side) => {
    const end = middle[i] + side * reach[i];
    return Math.min(Math.max(end, near.min.getComponent(i)), near.max.getComponent(i));
  }));
  return x.flatMap((a) => y.map((b) => lift([a, b])));
}

/** The points of a curved surface near the bodies. */
function closeBy(points: Packed, carrier: Object3D, places: Vector3[], size: number): Vector3[] {
  const { data } = new Rows(points);
  const passed = new Box3().setFromPoints(places).expandByScalar(NEAR * size);
  const count = data.length / 3;
  const all = Array.from({ length: Math.ceil(count / SPARSE) }, (_, i) => carrier.localToWorld(new Vector3().fromArray(data, 3 * SPARSE * i)));
  return all.filter((point) => passed.containsPoint(point));
}

function turns(radius: number): number[][] {
  return Array.from({ length: ROUND }, (_, i) => (2 * Math.PI * i) / ROUND).map((angle) => [radius * Math.cos(angle), radius * Math.sin(angle)]);
}

function isPlace({ x, y, z }: Vector3): boolean {
  return Number.isFinite(x + y + z);
}

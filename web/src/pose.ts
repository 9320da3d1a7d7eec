// Positions and orientations between two frames.

import { Object3D, Quaternion, Vector3 } from "three";
import { type PoseData, Rows } from "./scene";

export class Pose {
  private readonly place: Rows;
  private readonly turn: Rows;
  private readonly spin: Rows;
  private readonly axis: Vector3;
  private readonly buffer: number[] = [];
  private readonly spun = new Quaternion();
  private readonly next = new Quaternion();

  constructor(data: PoseData) {
    this.place = new Rows(data.place);
    this.turn = new Rows(data.turn);
    this.spin = new Rows(data.spin);
    this.axis = new Vector3(...data.axis);
  }

  placeAt(frame: number, out: Vector3): Vector3 {
    return out.fromArray(this.place.at(frame, this.buffer));
  }

  apply(frame: number, object: Object3D): void {
    this.placeAt(frame, object.position);
    this.turnAt(frame, object.quaternion);
    if (this.spin.count) {
      const [angle] = this.spin.at(frame, this.buffer);
      object.quaternion.multiply(this.spun.setFromAxisAngle(this.axis, angle));
    }
  }

  /** Its axes, which do not turn with its spin. */
  turnAt(frame: number, out: Quaternion): void {
    const { data, count } = this.turn;
    const first = Math.min(Math.floor(frame), count - 1);
    out.fromArray(data, 4 * first);
    if (first + 1 < count) out.slerp(this.next.fromArray(data, 4 * first + 4), frame - first);
  }
}

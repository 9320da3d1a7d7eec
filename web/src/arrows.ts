// Arrows: solid where they can be seen, and faint where a body hides them.

import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";
import type { Pose } from "./pose";
import { type ArrowData, type ArrowKind, Rows } from "./scene";

export const COLOURS: Record<ArrowKind, string> = {
  force: "#d55e00",
  load: "#8a6d00",
  torque: "#a8518f",
  omega: "#009e73",
  momentum: "#0072b2",
};

const UP = new Vector3(0, 1, 0);
const HEAD = 5.5; // length of the head, in thicknesses

export class Arrow {
  readonly group = new Group();
  private readonly foot: Rows;
  private readonly along: Rows;
  private readonly parts: { shaft: Mesh; head: Mesh }[] = [];
  private readonly buffer: number[] = [];
  private readonly vector = new Vector3();
  private readonly turn = new Quaternion();

  constructor(
    readonly data: ArrowData,
    private readonly body: Pose,
    private readonly scale: number,
    private readonly thick: number,
  ) {
    this.foot = new Rows(data.foot);
    this.along = new Rows(data.along);
    for (const [depthTest, opacity, order] of [[true, 1, 20], [false, 0.62, 19]] as const) {
      const material = new MeshBasicMaterial({
        color: COLOURS[data.kind],
        transparent: true,
        depthTest,
        depthWrite: depthTest,
        opacity,
      });
      const shaft = new Mesh(new CylinderGeometry(thick, thick, 1, 16).translate(0, 0.5, 0), material);
      const head = new Mesh(new ConeGeometry(2.6 * thick, HEAD * thick, 24).translate(0, (-HEAD * thick) / 2, 0), material);
      for (const part of [shaft, head]) {
        part.renderOrder = order;
        this.group.add(part);
      }
      this.parts.push({ shaft, head });
    }
  }

  /** Its length in its unit. */
  size(frame: number): number {
    return Math.hypot(...this.along.at(frame, this.buffer));
  }

  update(frame: number): void {
    if (this.foot.count) this.group.position.fromArray(this.foot.at(frame, this.buffer));
    else this.body.placeAt(frame, this.group.position);
    this.vector.fromArray(this.along.at(frame, this.buffer)).multiplyScalar(this.scale);
    const length = this.vector.length();
    const hidden = length < 0.3 * this.thick || Number.isNaN(this.group.position.x);
    for (const { shaft, head } of this.parts) {
      shaft.visible = head.visible = !hidden;
      const tip = Math.min(1, length / (1.5 * HEAD * this.thick));
      head.scale.setScalar(tip);
      head.position.y = length;
      shaft.scale.set(tip, Math.max(length - 0.9 * HEAD * this.thick * tip, 1e-9), tip);
    }
    if (!hidden) this.group.quaternion.copy(this.turn.setFromUnitVectors(UP, this.vector.normalize()));
  }
}

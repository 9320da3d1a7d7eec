// Paths that grow during the motion.

import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { colourOf } from "./family";
import { Rows, type TraceData } from "./scene";

const COLOURS = { contact: "path-contact", centre: "path-centre", axis: "path-axis", kept: "path-kept" } as const;

export class Trace {
  readonly line: LineSegments2;
  private readonly material: LineMaterial;
  private readonly drawn: number[] = [0]; // how many pieces there are up to each frame

  constructor(readonly data: TraceData) {
    const { data: points, count } = new Rows(data.points);
    const pieces = new Float32Array(6 * Math.max(count - 1, 1));
    let length = 0;
    for (let i = 1; i < count; i++) {
      if (!Number.isNaN(points[3 * i - 3]) && !Number.isNaN(points[3 * i])) {
        pieces.set(points.subarray(3 * i - 3, 3 * i + 3), length);
        length += 6;
      }
      this.drawn.push(length / 6);
    }
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(pieces.subarray(0, Math.max(length, 6)));
    this.material = new LineMaterial({
      linewidth: data.kind === "contact" ? 2.6 : 1.8,
      transparent: true,
      opacity: data.support >= 0 ? 0.55 : 0.9,
      depthWrite: false,
      polygonOffset: true,
      polygonOffsetFactor: -2,
    });
    this.line = new LineSegments2(geometry, this.material);
    this.line.frustumCulled = false;
  }

  update(frame: number): void {
    const last = this.drawn.length - 1;
    // a path that is kept from another motion is there from the beginning
    const count = this.drawn[this.data.kind === "kept" ? last : Math.min(Math.floor(frame), last)];
    this.line.geometry.instanceCount = count;
    this.line.visible = count > 0;
  }

  theme(dark: boolean): void {
    this.material.color.set(colourOf(COLOURS[this.data.kind as keyof typeof COLOURS], dark));
  }
}

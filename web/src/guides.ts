// Thin lines that explain the picture: axes with their names, and the arcs of angles.

import { CircleGeometry, Curve, CylinderGeometry, DoubleSide, Group, Matrix4, Mesh, MeshBasicMaterial, Object3D, Plane, Quaternion, type Ray, TubeGeometry, Vector3 } from "three";
import { colourOf } from "./family";
import { AXES, GREEK } from "./triad";
import { Letter, type Letters } from "./letters";
import type { Pose } from "./pose";
import { type AnglesData, type RotationData, Rows } from "./scene";

const UP = new Vector3(0, 1, 0);
export const THIN = 0.011; // radius of a line, against the size of the body
const PARTS = 240; // of a whole turn
const SPINS = 12; // turns during a motion beyond which an arc would only flicker
const NEAR = 0.62; // radius of the first arc at a point that holds the body, against its size
const AROUND = 1.12; // at its centre of mass
const STEP = 0.13; // from one arc to the next
const EDGEWISE = 0.08; // sine of the angle between a plane and a line of sight below which they do not meet well
const CLOSED = 0.02; // rad: a smaller angle is not drawn
const LONG = 1.35; // of an axis of a body, against its size
const LONGER = 1.75; // of an axis of the laboratory

/** Lines in one colour, in front of everything. */
function ink(opacity: number): MeshBasicMaterial {
  return new MeshBasicMaterial({ transparent: true, opacity, depthTest: false, depthWrite: false, side: DoubleSide });
}

/** A line of unit length along y, of this radius. */
function line(radius: number, material: MeshBasicMaterial): Mesh {
  const mesh = new Mesh(new CylinderGeometry(radius, radius, 1, 8, 1, true).translate(0, 0.5, 0), material);
  mesh.renderOrder = 16;
  return mesh;
}

/** The unit circle. */
class Round extends Curve<Vector3> {
  constructor() {
    super(); // which is protected
  }

  override getPoint(share: number, out = new Vector3()): Vector3 {
    return out.set(Math.cos(2 * Math.PI * share), Math.sin(2 * Math.PI * share), 0);
  }
}

/** A part of the picture with letters that can be switched on and off. */
export abstract class Guide {
  readonly object = new Group();
  protected readonly letters: Letter[] = [];

  constructor(protected readonly written: Letters) {}

  show(shown: boolean): void {
    this.object.visible = shown;
    for (const letter of this.letters) letter.shown = shown;
  }

  abstract theme(dark: boolean): void;

  abstract update(frame: number): void;

  protected letter(text: string, kind: string): Letter {
    const letter = this.written.add(new Letter(text, kind));
    this.letters.push(letter);
    return letter;
  }
}

/** The arcs of the angles that lead to the axes of a body or a support. */
export class AngleArcs extends Guide {
  private readonly vertex: Rows;
  private readonly arcs: Arc[];
  private readonly turn = new Quaternion();
  private readonly materials = [ink(0.13), ink(0.95), ink(0.7)];

  /**
   * @param size that the arcs are drawn by, m.
   * @param thin radius of their lines, m.
   * @param isHeld whether they are drawn where something holds the body, or around it.
   */
  constructor(data: AnglesData, size: number, thin: number, isHeld: boolean, written: Letters) {
    super(written);
    this.vertex = new Rows(data.vertex);
    const first = isHeld ? NEAR : AROUND;
    let drawn = 0;
    this.arcs = data.rotations.map((rotation) => {
      const arc = new Arc(rotation, size * (first + STEP * drawn), thin, this.materials);
      if (!arc.isDrawn) return arc;
      drawn += 1;
      arc.letter = this.letter(rotation.symbol, "angle");
      if (rotation.coordinate) arc.letter.element.dataset.coordinate = rotation.coordinate;
      this.object.add(arc.object);
      return arc;
    });
  }

  /** The present value of a coordinate with an arc, rad. */
  valueOf(coordinate: string): number | null {
    return this.arcs.find((arc) => arc.coordinate === coordinate)?.value ?? null;
  }

  /** The value of a coordinate whose arc would end under a line of sight; null where none does. */
  valueAt(coordinate: string, sight: Ray): number | null {
    return this.arcs.find((arc) => arc.coordinate === coordinate)?.valueAt(sight, this.object.position) ?? null;
  }

  theme(dark: boolean): void {
    for (const material of this.materials) material.color.set(colourOf("angle", dark));
  }

  update(frame: number): void {
    this.object.position.fromArray(this.vertex.at(frame, []));
    this.turn.identity();
    for (const arc of this.arcs) {
      arc.update(frame, this.turn, this.object.position);
      if (arc.letter) arc.letter.shown = this.object.visible && arc.object.visible;
    }
  }
}

class Arc {
  readonly object = new Group();
  readonly isDrawn: boolean;
  letter: Letter | null = null;
  private readonly angle: Rows;
  private readonly axis: Vector3;
  private readonly begin: Vector3;
  private readonly parts: { tube: Mesh; sector: Mesh; spokes: [Object3D, Object3D] } | null = null;
  private readonly step = new Quaternion();
  value = 0; // of its coordinate, rad
  private readonly across: [Vector3, Vector3] = [new Vector3(), new Vector3()]; // in its plane: where it begins, and a right angle further
  private readonly basis = new Matrix4();

  constructor(
    private readonly data: RotationData,
    private readonly radius: number,
    thin: number,
    [fill, stroke, faint]: MeshBasicMaterial[],
  ) {
    this.angle = new Rows(data.angle);
    this.axis = new Vector3(...data.axis);
    this.begin = new Vector3(...data.begin);
    this.isDrawn = data.symbol !== "" && this.turns() <= SPINS;
    if (!this.isDrawn) return;
    const tube = new Mesh(new TubeGeometry(new Round(), PARTS, thin / radius, 6), stroke);
    const sector = new Mesh(new CircleGeometry(1, PARTS), fill);
    const spokes: [Object3D, Object3D] = [line(0.6 * thin / radius, faint), line(0.6 * thin / radius, faint)];
    sector.renderOrder = 14;
    tube.renderOrder = 16;
    for (const spoke of spokes) spoke.scale.y = 1.14;
    spokes[0].rotation.z = -Math.PI / 2; // along x, where the arc begins
    this.object.add(tube, sector, ...spokes);
    this.object.scale.setScalar(radius);
    this.parts = { tube, sector, spokes };
  }

  /** Draw it after the rotations before it, and add its own to them. */
  update(frame: number, turn: Quaternion, vertex: Vector3): void {
    const [angle] = this.angle.at(frame, []);
    this.value = this.data.sign * (angle - this.data.offset);
    if (this.parts) this.draw(angle - this.data.offset, turn, vertex, this.parts);
    turn.multiply(this.step.setFromAxisAngle(this.axis, angle));
  }

  /** The coordinate that it is; none for the arcs of other angles. */
  get coordinate(): string {
    return this.isDrawn ? this.data.coordinate : "";
  }

  /** Its coordinate, if it ended where a line of sight meets its plane; null where that is seen from its edge. */
  valueAt(sight: Ray, vertex: Vector3): number | null {
    const [x, y] = this.across;
    const normal = x.clone().cross(y);
    if (Math.abs(normal.dot(sight.direction)) < EDGEWISE) return null;
    const hit = sight.intersectPlane(new Plane().setFromNormalAndCoplanarPoint(normal, vertex), new Vector3());
    const from = hit?.sub(vertex);
    return from ? this.data.sign * Math.atan2(from.dot(y), from.dot(x)) : null;
  }

  private turns(): number {
    const { data } = this.angle;
    const [low, high] = [data.reduce((a, b) => Math.min(a, b)), data.reduce((a, b) => Math.max(a, b))];
    return (high - low) / (2 * Math.PI);
  }

  private draw(whole: number, turn: Quaternion, vertex: Vector3, { tube, sector, spokes }: NonNullable<Arc["parts"]>): void {
    const sweep = whole % (2 * Math.PI);
    const side = sweep < 0 ? -1 : 1;
    const x = this.begin.clone().applyQuaternion(turn);
    const z = this.axis.clone().applyQuaternion(turn).multiplyScalar(side);
    const y = z.clone().cross(x);
    this.across[0].copy(x);
    this.across[1].copy(y).multiplyScalar(side);
    this.object.quaternion.setFromRotationMatrix(this.basis.makeBasis(x, y, z));
    const share = Math.abs(sweep) / (2 * Math.PI);
    this.object.visible = Math.abs(sweep) > CLOSED;
    tube.geometry.setDrawRange(0, 36 * Math.round(share * PARTS));
    sector.geometry.setDrawRange(0, 3 * Math.round(share * PARTS));
    spokes[1].rotation.z = Math.abs(sweep) - Math.PI / 2;
    if (!this.letter) return;
    const half = Math.abs(sweep) / 2;
    const middle = x.multiplyScalar(Math.cos(half)).addScaledVector(y, Math.sin(half));
    this.letter.from.copy(vertex);
    this.letter.place.copy(vertex).addScaledVector(middle, this.radius);
  }
}

const TURNED = [new Quaternion().setFromUnitVectors(UP, new Vector3(1, 0, 0)), new Quaternion(), new Quaternion().setFromUnitVectors(UP, new Vector3(0, 0, 1))];
const ALONG = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

/** Three axes with their names: of a body, through its centre of mass, or of the laboratory. */
export class Axes extends Guide {
  private readonly length: number;
  private readonly materials: MeshBasicMaterial[];

  /**
   * @param pose of the body through which they go.
   * @param turns whether they turn with it.
   */
  constructor(
    private readonly pose: Pose,
    names: string[],
    size: number,
    private readonly turns: boolean,
    written: Letters,
  ) {
    super(written);
    this.length = size * (turns ? LONG : LONGER);
    this.materials = names.map(() => ink(turns ? 0.95 : 0.55));
    names.forEach((name, i) => {
      const axis = line(size * THIN * (turns ? 1 : 0.7), this.materials[i]);
      axis.quaternion.copy(TURNED[i]);
      axis.scale.y = this.length;
      this.object.add(axis);
      this.letter(GREEK[name] ?? name, `axis-${i} ${turns ? "" : "fixed"}`);
    });
  }

  theme(dark: boolean): void {
    this.materials.forEach((material, i) => material.color.set(colourOf(AXES[i % 3], dark)));
  }

  update(frame: number): void {
    this.pose.placeAt(frame, this.object.position);
    if (this.turns) this.pose.turnAt(frame, this.object.quaternion);
    this.letters.forEach((letter, i) => {
      letter.from.copy(this.object.position);
      letter.place.copy(ALONG[i]).applyQuaternion(this.object.quaternion).multiplyScalar(this.length).add(this.object.position);
    });
  }
}

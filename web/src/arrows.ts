// Arrows: solid where visible, faint where a body hides them.

import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";
import { colourOf } from "./family";
import { Letter, type Letters } from "./letters";
import type { Pose } from "./pose";
import { type ArrowData, type ArrowKind, Rows } from "./scene";

/** Letters of vectors for which a model has none of its own. */
const LETTERS: Partial<Record<ArrowKind, string>> = {
  force: "<math><mi>F</mi></math>",
  torque: "<math><mi>τ</mi></math>",
  omega: "<math><mi>ω</mi></math>",
  momentum: "<math><mi>L</mi></math>",
};

const UP = new Vector3(0, 1, 0);
const HEAD = 5.5; // length of the head, in thicknesses
// Default lengths of the longest arrows, in units of the body's size: unequal, so that parallel arrows can be distinguished.
const USUAL: Record<ArrowKind, number> = { force: 2.4, load: 2.4, torque: 1.9, omega: 1.5, momentum: 1.9 };
const SPIKE = 12; // largest over usual length, beyond which the usual one no longer decides

/** Forces, or the rotational vectors if there are none. */
export function usuallyShown(kinds: ArrowKind[]): Set<ArrowKind> {
  return new Set(kinds.includes("force") ? ["force"] : ["omega", "momentum"]);
}

/** Drawn length of a unit vector of each kind, for a body of this size; m. */
export function scales(arrows: ArrowData[], reach: number): (kind: ArrowKind) => number {
  const group = (kind: ArrowKind): string => (kind === "load" ? "force" : kind);
  const sizes: Record<string, number> = {};
  for (const { kind, usual, largest } of arrows) {
    sizes[group(kind)] = Math.max(sizes[group(kind)] ?? 0, usual, largest / SPIKE);
  }
  return (kind) => (USUAL[kind] * reach) / sizes[group(kind)];
}

/** Shaft and head, solid and faint, with zero length. */
export function arrowObject(kind: ArrowKind, thick: number): Group {
  const group = new Group();
  for (const [depthTest, opacity, order] of [[true, 1, 20], [false, 0.62, 19]] as const) {
    const material = new MeshBasicMaterial({
      color: colourOf(kind, false),
      transparent: true,
      depthTest,
      depthWrite: depthTest,
      opacity,
    });
    const shaft = new Mesh(new CylinderGeometry(thick, thick, 1, 16).translate(0, 0.5, 0), material);
    const head = new Mesh(new ConeGeometry(2.6 * thick, HEAD * thick, 24).translate(0, (-HEAD * thick) / 2, 0), material);
    shaft.renderOrder = head.renderOrder = order;
    group.add(shaft, head);
  }
  return group;
}

/** Give an arrow its colour by day or by night. */
export function dye(group: Group, kind: ArrowKind, dark: boolean): void {
  for (const part of group.children) ((part as Mesh).material as MeshBasicMaterial).color.set(colourOf(kind, dark));
}

/** Give an arrow this vector in the laboratory, and tell whether it is long enough to be seen. */
export function stretch(group: Group, vector: Vector3, thick: number): boolean {
  const length = vector.length();
  const isSeen = length >= 0.3 * thick && !Number.isNaN(group.position.x);
  const tip = Math.min(1, length / (1.5 * HEAD * thick));
  const [solid, tipped, faint, faintTip] = group.children;
  for (const [shaft, head] of [[solid, tipped], [faint, faintTip]]) {
    shaft.visible = head.visible = isSeen;
    head.scale.setScalar(tip);
    head.position.y = length;
    shaft.scale.set(tip, Math.max(length - 0.9 * HEAD * thick * tip, 1e-9), tip);
  }
  if (isSeen) group.quaternion.copy(turn.setFromUnitVectors(UP, vector.normalize()));
  return isSeen;
}

const turn = new Quaternion();

export class Arrow {
  /** Beside its tip; hidden with it. */
  readonly letter: Letter;
  /** An arrow at whose tip this one begins while both are shown: dL/dt = τ. */
  follows: Arrow | null = null;
  private readonly foot: Rows;
  private readonly along: Rows;
  private readonly buffer: number[] = [];
  private readonly drawn = new Vector3();
  private readonly from = new Vector3();

  /** @param group its drawn object, of this thickness. */
  constructor(
    readonly data: ArrowData,
    readonly group: Group,
    private readonly body: Pose,
    readonly scale: number,
    private readonly thick: number,
    letters: Letters,
  ) {
    this.foot = new Rows(data.foot);
    this.along = new Rows(data.along);
    this.letter = letters.add(new Letter(data.symbol || LETTERS[data.kind] || data.name.split(" on ")[0], data.kind));
  }

  /** Its magnitude in its unit. */
  size(frame: number): number {
    return Math.hypot(...this.along.at(frame, this.buffer));
  }

  /** Its tip, at most this far from its foot; m. */
  tip(frame: number, most: number, out: Vector3): Vector3 {
    return this.vector(frame, out).clampLength(0, most).add(this.start(frame, this.from));
  }

  update(frame: number): void {
    const { group, letter, follows } = this;
    if (follows?.group.visible) group.position.copy(follows.letter.place);
    else this.start(frame, group.position);
    this.vector(frame, this.drawn);
    letter.from.copy(group.position);
    letter.place.copy(this.drawn).multiplyScalar(group.scale.x).add(group.position);
    letter.shown = stretch(group, this.drawn, this.thick) && group.visible;
  }

  start(frame: number, out: Vector3): Vector3 {
    return this.foot.count ? out.fromArray(this.foot.at(frame, this.buffer)) : this.body.placeAt(frame, out);
  }

  /** As it is drawn, m. */
  vector(frame: number, out: Vector3): Vector3 {
    return out.fromArray(this.along.at(frame, this.buffer)).multiplyScalar(this.scale);
  }
}

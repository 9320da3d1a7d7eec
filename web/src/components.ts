// The parts of a contact force: normal force, friction, and the cone that friction keeps it in.

import { ConeGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";
import { type Arrow, arrowObject, dye, stretch } from "./arrows";
import { colourOf } from "./family";
import { Letter, type Letters } from "./letters";
import { Rows } from "./scene";

const UP = new Vector3(0, 1, 0);
const SLIM = 0.72; // thickness of a part against that of the whole
const NORMAL = "<math><mi>N</mi></math>";
const FRICTION = "<math><mi>f</mi></math>";

export class Components {
  readonly object = new Group();
  private readonly normal: Rows;
  private readonly thick: number;
  private readonly parts: Group[];
  private readonly letters: Letter[];
  private readonly cone: Mesh | null = null;
  private readonly along = new Vector3();
  private readonly up = new Vector3();
  private readonly turn = new Quaternion();

  /** @param arrow that of the whole force, with a normal. */
  constructor(
    private readonly arrow: Arrow,
    thick: number,
    letters: Letters,
  ) {
    this.thick = SLIM * thick;
    this.normal = new Rows(arrow.data.normal);
    this.parts = [arrowObject("force", this.thick), arrowObject("force", this.thick)];
    this.letters = [NORMAL, FRICTION].map((text) => letters.add(new Letter(text, "force")));
    this.object.add(...this.parts);
    if (arrow.data.friction > 0) this.object.add((this.cone = coneOf(arrow.data.friction)));
  }

  show(shown: boolean): void {
    this.object.visible = shown;
    if (!shown) for (const letter of this.letters) letter.shown = false;
  }

  update(frame: number): void {
    if (!this.object.visible) return;
    const { arrow, along, up } = this;
    arrow.vector(frame, along).multiplyScalar(arrow.group.scale.x);
    up.fromArray(this.normal.at(frame, []));
    const pressing = along.dot(up);
    const friction = along.clone().addScaledVector(up, -pressing);
    const normal = up.clone().multiplyScalar(pressing);
    [normal, friction].forEach((part, i) => {
      const letter = this.letters[i];
      arrow.start(frame, this.parts[i].position);
      letter.shown = stretch(this.parts[i], part.clone(), this.thick);
      letter.from.copy(this.parts[i].position);
      letter.place.copy(part).add(letter.from);
    });
    if (!this.cone) return;
    this.cone.visible = pressing > 0;
    this.cone.position.copy(this.parts[0].position);
    this.cone.quaternion.copy(this.turn.setFromUnitVectors(UP, up));
    this.cone.scale.setScalar(Math.max(pressing, 1e-9));
  }

  theme(dark: boolean): void {
    for (const part of this.parts) dye(part, "force", dark);
    (this.cone?.material as MeshBasicMaterial | undefined)?.color.set(colourOf("force", dark));
  }
}

/** The directions of a force that friction allows, for a normal force of unit length. */
function coneOf(friction: number): Mesh {
  const material = new MeshBasicMaterial({ color: colourOf("force", false), transparent: true, opacity: 0.16, depthWrite: false, side: DoubleSide });
  const cone = new Mesh(new ConeGeometry(friction, 1, 64, 1, true).rotateX(Math.PI).translate(0, 0.5, 0), material);
  cone.renderOrder = 13;
  return cone;
}

// Springs, dampers and ropes, redrawn as their ends move.

import {
  BufferGeometry,
  CylinderGeometry,
  Float32BufferAttribute,
  Group,
  Mesh,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import { MATERIALS } from "./family";
import { surface } from "./marks";
import { type LinkData, Rows } from "./scene";

const TURNS = 11;
const PARTS = 20; // of a turn
const SIDES = 8; // of the wire
const WIRE = 0.16; // thickness against the radius of the coil
const STRAIGHT = 0.07; // share of the length at either end that is not wound
const POT = 0.5; // of a damper's length at the middle of the motion
const UP = new Vector3(0, 0, 1);

/** An object between two points, along its own z axis. */
interface Stretched {
  readonly object: Group;
  stretch(length: number): void;
}

export class Link {
  readonly object = new Group();
  readonly ends: [Rows, Rows];
  private readonly drawn: Stretched;
  private readonly from = new Vector3();
  private readonly along = new Vector3();
  private readonly buffer: number[] = [];

  constructor(data: LinkData) {
    this.ends = [new Rows(data.start), new Rows(data.end)];
    this.drawn = this.shape(data);
    this.object.add(this.drawn.object);
    for (const end of this.ends) if (end.count === 1) this.object.add(anchor(end, 1.5 * data.thick));
    this.object.traverse((part) => {
      part.castShadow = true;
    });
  }

  update(frame: number): void {
    const { object } = this.drawn;
    const [start, end] = this.ends;
    this.along.fromArray(end.at(frame, this.buffer));
    this.from.fromArray(start.at(frame, this.buffer));
    const length = this.along.sub(this.from).length();
    object.visible = length > 0;
    if (!length) return;
    object.position.copy(this.from);
    object.quaternion.copy(turn.setFromUnitVectors(UP, this.along.divideScalar(length)));
    this.drawn.stretch(length);
  }

  private shape({ kind, thick }: LinkData): Stretched {
    if (kind === "spring") return new Coil(thick);
    return kind === "rope" ? new Cord(thick) : new Pot(thick, this.usual());
  }

  private usual(): number {
    const [start, end] = this.ends;
    const middle = Math.floor(Math.max(start.count, end.count) / 2);
    return this.from.fromArray(start.at(middle, [])).distanceTo(this.along.fromArray(end.at(middle, [])));
  }
}

const turn = new Quaternion();

/** A fixed point to which something is attached. */
function anchor(place: Rows, radius: number): Mesh {
  const knob = new Mesh(new SphereGeometry(radius, 24, 16), surface(MATERIALS.dark));
  knob.position.fromArray(place.at(0, []));
  return knob;
}

class Coil implements Stretched {
  readonly object = new Group();
  private readonly geometry = new BufferGeometry();
  private readonly place: Float32BufferAttribute;
  private readonly normal: Float32BufferAttribute;

  constructor(private readonly radius: number) {
    const rings = TURNS * PARTS + 1;
    this.place = new Float32BufferAttribute(new Float32Array(3 * rings * SIDES), 3);
    this.normal = new Float32BufferAttribute(new Float32Array(3 * rings * SIDES), 3);
    this.geometry.setAttribute("position", this.place);
    this.geometry.setAttribute("normal", this.normal);
    this.geometry.setIndex(faces(rings));
    const wire = new Mesh(this.geometry, surface(MATERIALS.metal));
    wire.frustumCulled = false;
    this.object.add(wire);
  }

  stretch(length: number): void {
    const pitch = ((1 - 2 * STRAIGHT) * length) / (2 * Math.PI * TURNS);
    const slope = Math.hypot(this.radius, pitch);
    const last = TURNS * PARTS;
    for (let i = 0; i <= last; i++) {
      const angle = (2 * Math.PI * i) / PARTS;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const end = Math.min(i, last - i) / (PARTS / 2); // the last half turn runs in to the middle
      const out = this.radius * Math.min(1, end);
      const height = i === 0 ? 0 : i === last ? length : STRAIGHT * length + pitch * angle;
      for (let k = 0; k < SIDES; k++) {
        const round = (2 * Math.PI * k) / SIDES;
        const [n, b] = [Math.cos(round), Math.sin(round)];
        const x = n * c + (b * s * pitch) / slope;
        const y = n * s - (b * c * pitch) / slope;
        const z = (b * this.radius) / slope;
        const thick = WIRE * this.radius;
        this.normal.setXYZ(i * SIDES + k, x, y, z);
        this.place.setXYZ(i * SIDES + k, out * c + thick * x, out * s + thick * y, height + thick * z);
      }
    }
    this.place.needsUpdate = true;
    this.normal.needsUpdate = true;
  }
}

/** Quadrilaterals between the rings of a tube, as triangles seen from outside. */
function faces(rings: number): number[] {
  const found: number[] = [];
  for (let i = 0; i + 1 < rings; i++) {
    for (let k = 0; k < SIDES; k++) {
      const [a, b] = [i * SIDES + k, i * SIDES + ((k + 1) % SIDES)];
      found.push(a, a + SIDES, b, b, a + SIDES, b + SIDES);
    }
  }
  return found;
}

/** A damper: a cylinder at one end, a piston rod at the other. */
class Pot implements Stretched {
  readonly object = new Group();
  private readonly pot: Mesh;
  private readonly rod: Mesh;
  private readonly deep: number;

  constructor(radius: number, usual: number) {
    this.deep = POT * usual;
    this.pot = new Mesh(upright(radius), surface(MATERIALS.deep));
    this.rod = new Mesh(upright(0.35 * radius), surface(MATERIALS.light));
    this.object.add(this.pot, this.rod);
  }

  stretch(length: number): void {
    this.pot.scale.z = Math.min(this.deep, 0.8 * length);
    this.rod.scale.z = length;
  }
}

class Cord implements Stretched {
  readonly object = new Group();
  private readonly cord: Mesh;

  constructor(radius: number) {
    this.cord = new Mesh(upright(radius), surface(MATERIALS.dark));
    this.object.add(this.cord);
  }

  stretch(length: number): void {
    this.cord.scale.z = length;
  }
}

function upright(radius: number): CylinderGeometry {
  const geometry = new CylinderGeometry(radius, radius, 1, 32);
  geometry.rotateX(Math.PI / 2);
  geometry.translate(0, 0, 0.5);
  return geometry;
}

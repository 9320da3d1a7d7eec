// Bodies: every shape is built around its own z axis and then rotated to the body's axes.

import {
  BoxGeometry,
  CylinderGeometry,
  DoubleSide,
  Group,
  LatheGeometry,
  Matrix4,
  Mesh,
  type BufferGeometry,
  type Material,
  type Object3D,
  SphereGeometry,
  TorusGeometry,
  Vector2,
  Vector3,
} from "three";
import { MATERIALS } from "./family";
import { edge, marked, panels, sectors, surface } from "./marks";
import { reach } from "./reach";
import type { BodyData, JointData, ShapeData, Triple } from "./scene";

type Builder = (size: number[]) => Object3D;

const BUILDERS: Record<string, Builder> = {
  ball: ([radius]) => sphere(radius, radius, radius),
  ellipsoid: ([a, b, c]) => sphere(a, b, c),
  disk,
  hoop,
  wheel,
  rod,
  box,
  racquet,
  revolution,
};

/** A body with thin rods to the points at which it is held, and its joints there. */
export function bodyObject(body: BodyData, joints: JointData[]): Object3D {
  const group = new Group();
  const build = BUILDERS[body.shape.kind] ?? BUILDERS.ball;
  const shape = build(body.shape.size);
  if (body.shape.kind !== "ellipsoid") shape.quaternion.setFromRotationMatrix(basis(body.shape));
  shape.position.set(...body.shape.centre);
  group.add(shape);
  const thick = 0.055 * reach(body);
  for (const arm of body.arms) {
    if (Math.hypot(...arm) > 0) group.add(axle(arm, thick));
  }
  const clear = body.shape.kind === "rod" ? 1.9 * body.shape.size[1] : 2 * thick;
  for (const joint of joints) {
    const drawn = JOINTS[joint.kind];
    if (drawn && Math.hypot(...joint.place) > 0) group.add(placed(drawn(clear), joint));
  }
  group.traverse((object) => {
    object.castShadow = true;
    object.receiveShadow = true;
  });
  return group;
}

function basis(shape: ShapeData): Matrix4 {
  const z = new Vector3(...shape.axis);
  const x = new Vector3(...shape.across);
  return new Matrix4().makeBasis(x, z.clone().cross(x), z);
}

function mesh(geometry: BufferGeometry, material: Material | Material[]): Mesh {
  return new Mesh(geometry, material);
}

function sphere(a: number, b: number, c: number): Object3D {
  const ball = mesh(new SphereGeometry(1, 48, 28), marked(panels()));
  ball.scale.set(a, b, c);
  return ball;
}

function upright(radius: number, height: number, material: Material | Material[]): Mesh {
  const geometry = new CylinderGeometry(radius, radius, height, 96);
  geometry.rotateX(Math.PI / 2);
  return mesh(geometry, material);
}

/** The outline, of heights and radii in turn from the top downwards, turned about the z axis. */
function revolution(lengths: number[]): Object3D {
  const points: Vector2[] = [];
  for (let i = 0; i < lengths.length; i += 2) points.push(new Vector2(lengths[i + 1], lengths[i]));
  const geometry = new LatheGeometry(points.reverse(), 96);
  geometry.rotateX(Math.PI / 2);
  const material = marked(edge());
  material.side = DoubleSide;
  return mesh(geometry, material);
}

function disk([radius, height]: number[]): Object3D {
  const face = marked(sectors());
  return upright(radius, height, [marked(edge()), face, face]);
}

function hoop([radius, height]: number[]): Object3D {
  const group = new Group();
  const tube = rim(radius, height);
  const count = 12;
  for (let i = 0; i < count; i++) {
    const colour = i === 0 ? MATERIALS.accent : i % 2 ? MATERIALS.blue : MATERIALS.light;
    const arc = mesh(new TorusGeometry(radius - tube, tube, 16, 10, (2 * Math.PI) / count), surface(colour));
    arc.rotation.z = (2 * Math.PI * i) / count;
    group.add(arc);
  }
  return group;
}

/** Radius of the tube of a hoop. */
const rim = (radius: number, height: number): number => Math.max(height / 2, 0.045 * radius);

/** The spokes end inside the tube of the rim, which hides their ends. */
function wheel([radius, height]: number[]): Object3D {
  const group = hoop([radius, height]);
  const thin = 0.028 * radius;
  const long = radius - rim(radius, height);
  for (let i = 0; i < 6; i++) {
    const spoke = mesh(new CylinderGeometry(thin, thin, long, 12), surface(i ? MATERIALS.metal : MATERIALS.accent));
    spoke.geometry.translate(0, long / 2, 0);
    spoke.rotation.z = (Math.PI * i) / 3;
    group.add(spoke);
  }
  group.add(upright(0.12 * radius, 0.2 * radius, surface(MATERIALS.deep)));
  group.add(upright(0.04 * radius, 1.3 * radius, surface(MATERIALS.dark)));
  return group;
}

function rod([length, radius]: number[]): Object3D {
  const group = new Group();
  group.add(upright(radius, length, surface(MATERIALS.blue)));
  for (const side of [-1, 1]) {
    const end = mesh(new SphereGeometry(1.7 * radius, 24, 16), surface(side > 0 ? MATERIALS.accent : MATERIALS.light));
    end.position.z = (side * length) / 2;
    group.add(end);
  }
  return group;
}

function box([long, wide, thick]: number[]): Object3D {
  const colours = [MATERIALS.blue, MATERIALS.blue, MATERIALS.light, MATERIALS.deep, MATERIALS.accent, MATERIALS.metal];
  return mesh(new BoxGeometry(wide, thick, long), colours.map((colour) => surface(colour)));
}

function racquet([length, width, thick]: number[]): Object3D {
  const group = new Group();
  const head = 0.27 * length;
  const middle = 0.5 * length - head;
  const frame = mesh(new TorusGeometry(1, 0.07, 16, 72), surface(MATERIALS.deep));
  frame.rotation.x = Math.PI / 2;
  frame.scale.set(width / 2, head, width / 2);
  frame.position.z = middle;
  group.add(frame);
  for (const side of [-1, 1]) {
    const strings = mesh(new CylinderGeometry(1, 1, 0.02, 72), surface(side > 0 ? MATERIALS.accent : MATERIALS.light));
    strings.scale.set(width / 2, thick, head);
    strings.position.set(0, side * 0.012 * width, middle);
    group.add(strings);
  }
  const handle = 0.5 * length + middle - head;
  const grip = upright(1.3 * thick, handle, surface(MATERIALS.blue));
  grip.position.z = handle / 2 - 0.5 * length;
  group.add(grip);
  return group;
}

function axle(arm: Triple, thick: number): Object3D {
  const length = Math.hypot(...arm);
  const rodMesh = mesh(new CylinderGeometry(thick, thick, length, 20), surface(MATERIALS.metal));
  rodMesh.geometry.translate(0, length / 2, 0);
  rodMesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...arm).normalize());
  return rodMesh;
}

/** The joint on which a body turns, large enough to be visible; a pin lies along z. */
const JOINTS: Record<string, (clear: number) => Object3D> = {
  pivot: (clear) => mesh(new SphereGeometry(clear, 32, 24), surface(MATERIALS.metal)),
  hinge: (clear) => pin(1.6 * clear, clear),
  universal: (clear) => pin(0.9 * clear, 1.5 * clear),
  weld: (clear) => mesh(new BoxGeometry(2 * clear, 2 * clear, 2 * clear), surface(MATERIALS.dark)),
};

/** A short cylinder with an eye at each end. */
function pin(radius: number, half: number): Object3D {
  const group = new Group();
  group.add(upright(0.6 * radius, 2.8 * half, surface(MATERIALS.metal)), upright(radius, 1.9 * half, surface(MATERIALS.dark)));
  return group;
}

function placed(object: Object3D, joint: JointData): Object3D {
  object.position.set(...joint.place);
  object.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...joint.axis));
  return object;
}

/** A post under a held point, or a hanger above it. */
export function post(height: number, thick: number): Object3D {
  const geometry = new CylinderGeometry(0.25 * thick, 1.4 * thick, height, 32);
  geometry.rotateX(Math.PI / 2);
  geometry.translate(0, 0, -height / 2);
  const cone = mesh(geometry, surface(MATERIALS.dark));
  cone.castShadow = true;
  return cone;
}

export function bracket(thick: number): Object3D {
  const plate = upright(2.4 * thick, 0.8 * thick, surface(MATERIALS.dark));
  plate.position.z = 0.9 * thick;
  plate.material = surface(MATERIALS.dark);
  (plate.material as Material).side = DoubleSide;
  const group = new Group();
  group.add(plate);
  return group;
}

// Where the picture is seen from: about the middle of the motion, or along with a body.

import { type PerspectiveCamera, Plane, Quaternion, Raycaster, Sphere, Vector2, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Room } from "./extent";
import type { House } from "./house";
import type { Triple } from "./scene";

const CLOSE = 2.15; // reaches of the body that are in view about it when it is followed
const LIT = 1.7; // of what is in view, so that shadows beside it are there too
const STEEPEST = 0.995; // cosine from the upright

export class Eye {
  private readonly controls: OrbitControls;
  private readonly place = new Vector3();
  private readonly level: [Vector3, Vector3];

  /**
   * @param follow whether it goes along with a body.
   * @param body where that is at the time that is shown.
   * @param moved told of every change.
   */
  constructor(
    private readonly house: House,
    private readonly holder: HTMLElement,
    private readonly room: Room,
    public follow: boolean,
    private readonly body: (out: Vector3) => Vector3,
    private readonly moved: () => void,
  ) {
    const { radius, reach, up } = room;
    this.level = horizontal(up);
    this.camera.up.copy(up); // which the controls read when they are made
    this.controls = new OrbitControls(this.camera, holder);
    this.controls.maxDistance = 40 * Math.max(radius, reach);
    this.controls.minDistance = 1.5 * reach;
    this.controls.addEventListener("change", moved);
    this.camera.near = reach / 8;
    this.camera.far = 300 * Math.max(radius, reach);
    this.camera.updateProjectionMatrix();
    house.lights.fit(reach);
  }

  private get camera(): PerspectiveCamera {
    return this.house.camera;
  }

  /** Whether pulling turns the view; where it does not, something else is pulled. */
  set turns(turns: boolean) {
    this.controls.enabled = turns;
  }

  /** Look from where an earlier eye did, as far away as goes with the size of the bodies. */
  takeOver({ controls, room }: Eye, from: Vector3): void {
    const offset = from.clone().sub(controls.target).multiplyScalar(this.room.reach / room.reach);
    if (!this.follow && this.room.reach === room.reach) this.controls.target.copy(controls.target);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.enabled = controls.enabled;
    this.controls.update();
  }

  leave(): void {
    this.controls.dispose();
  }

  /** The place on the level ground under a point of the screen, along the root frame; m. */
  groundAt(x: number, y: number): Triple | null {
    const box = this.holder.getBoundingClientRect();
    const point = new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    const sight = new Raycaster();
    sight.setFromCamera(point, this.camera);
    const hit = sight.ray.intersectPlane(new Plane(this.room.up), this.place);
    return hit && hit.toArray();
  }

  /** Back to where the picture was first seen from, as near as all of it is in view. */
  home(): void {
    const [side, ahead] = this.level;
    const offset = this.room.up.clone().multiplyScalar(0.44).addScaledVector(ahead, -0.82).addScaledVector(side, 0.36);
    this.target(this.controls.target);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.camera.position.copy(this.controls.target).addScaledVector(offset.normalize(), this.distance());
    this.controls.update();
    this.aim();
    this.moved();
  }

  setFollow(follow: boolean): void {
    this.follow = follow;
    this.home();
  }

  /** Turn the view about the upright and up or down, rad. */
  orbit(round: number, over: number): void {
    const { up } = this.room;
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyQuaternion(new Quaternion().setFromAxisAngle(up, round));
    const aside = up.clone().cross(offset).normalize();
    const tipped = offset.clone().applyQuaternion(new Quaternion().setFromAxisAngle(aside, over));
    if (Math.abs(tipped.clone().normalize().dot(up)) < STEEPEST) offset.copy(tipped);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.moved();
  }

  zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.moved();
  }

  /** Go along with the body, if it is followed. */
  chase(): void {
    if (!this.follow) return;
    const before = this.controls.target.clone();
    const step = this.target(this.controls.target).clone().sub(before);
    this.camera.position.add(step);
    this.controls.update();
    this.aim();
  }

  private target(out: Vector3): Vector3 {
    return this.follow ? this.body(out) : out.copy(this.room.middle);
  }

  private get balls(): Sphere[] {
    const { balls, reach } = this.room;
    return this.follow ? [new Sphere(this.body(new Vector3()), CLOSE * reach)] : balls;
  }

  /** From which all balls are in view, in the direction that the camera has; m. */
  private distance(): number {
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    const turn = this.camera.quaternion.clone().invert();
    const needed = this.balls.map(({ center, radius }) => {
      const { x, y, z } = center.clone().sub(this.controls.target).applyQuaternion(turn);
      return z + Math.max(Math.abs(y) + radius, (Math.abs(x) + radius) / this.camera.aspect) / half;
    });
    return Math.max(...needed);
  }

  private aim(): void {
    const target = this.target(this.place);
    const radius = Math.max(...this.balls.map((ball) => ball.center.distanceTo(target) + ball.radius));
    this.house.lights.aim(target, LIT * radius, this.room.up, this.level);
  }
}

/** Two level directions, to the right and away. */
function horizontal(up: Vector3): [Vector3, Vector3] {
  const guess = Math.abs(up.z) > 0.9 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
  const side = guess.clone().cross(up).normalize();
  return [side, up.clone().cross(side)];
}

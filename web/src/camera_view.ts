// The view: around the middle of the motion, or following a body.

import { type PerspectiveCamera, Plane, Quaternion, type Ray, Raycaster, Sphere, Vector2, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Extent } from "./extent";
import type { Display } from "./display";
import type { Triple } from "./scene";

const CLOSE = 2.15; // reaches of the body that are in view about it when it is followed
const LIT = 1.7; // of what is in view, so that shadows beside it are there too
const STEEPEST = 0.995; // cosine from the upright
const ROOMY = 0.9; // of the distance for an earlier motion, from which one that needs less is moved closer
const MARGIN = 0.85; // of half the picture, within which a body is in view

/** What the camera was moved for: where it looks, and from how far. */
interface Fitted {
  target: Vector3;
  balls: Sphere[];
  distance: number;
}

export class CameraView {
  private readonly controls: OrbitControls;
  private readonly place = new Vector3();
  private readonly last = new Vector3();
  private readonly level: [Vector3, Vector3];
  private fitted: Fitted = { target: new Vector3(), balls: [], distance: 1 };
  /** Whether a reader wants to follow a body; null where the motion decides. */
  chosen: boolean | null = null;
  /** Whether it stays as it is, since a hand holds a body in it. */
  held = false;

  /**
   * @param follow whether it goes along with a body.
   * @param body where that is at the time that is shown.
   * @param moved told of every change.
   */
  constructor(
    private readonly display: Display,
    private readonly holder: HTMLElement,
    private readonly extent: Extent,
    public follow: boolean,
    private readonly body: (out: Vector3) => Vector3,
    private readonly moved: () => void,
  ) {
    const { radius, reach, up } = extent;
    this.level = horizontal(up);
    this.camera.up.copy(up); // which the controls read when they are made
    this.controls = new OrbitControls(this.camera, holder);
    // The wheel and a vertical swipe scroll the page until the picture has been clicked.
    holder.style.touchAction = "";
    this.setZooms();
    holder.addEventListener("focus", this.setZooms);
    holder.addEventListener("blur", this.setZooms);
    this.controls.maxDistance = 40 * Math.max(radius, reach);
    this.controls.minDistance = 1.5 * reach;
    this.controls.addEventListener("change", moved);
    this.camera.near = reach / 8;
    this.camera.far = 300 * Math.max(radius, reach);
    this.camera.updateProjectionMatrix();
    display.lights.fit(reach);
  }

  private get camera(): PerspectiveCamera {
    return this.display.camera;
  }

  /** Whether dragging rotates the view. */
  set turns(turns: boolean) {
    this.controls.enabled = turns;
  }

  /**
   * Take over the direction of an earlier view, and how far it was zoomed and moved aside.
   *
   * It stays where it is as long as the new motion is in view; otherwise it is fitted again.
   *
   * @param from where the camera was.
   */
  takeOver(before: CameraView, from: Vector3): void {
    if (before.held) return this.hold(before, from);
    const { target, balls, distance } = before.fitted;
    const offset = from.clone().sub(before.controls.target);
    const aside = before.follow ? new Vector3() : before.controls.target.clone().sub(target);
    const zoom = offset.length() / distance;
    this.controls.enabled = before.controls.enabled;
    this.look(offset);
    const needed = this.distance(this.balls, target) / this.distance(balls, target);
    const isKept = !this.follow && !before.follow && needed < 1 + 1e-6 && needed > ROOMY;
    this.fitted = isKept ? before.fitted : { ...this.fitted, distance: this.distance() };
    const scale = this.fitted.distance / distance;
    this.controls.target.copy(this.fitted.target).addScaledVector(aside, this.follow ? 0 : scale);
    this.camera.position.copy(this.controls.target).addScaledVector(offset.normalize(), zoom * this.fitted.distance);
    this.controls.update();
    this.aim();
  }

  /** See everything as an earlier view did. */
  private hold(before: CameraView, from: Vector3): void {
    [this.held, this.follow, this.fitted] = [true, before.follow, before.fitted];
    this.controls.target.copy(before.controls.target);
    this.camera.position.copy(from);
    this.controls.update();
  }

  private readonly setZooms = (): void => {
    this.controls.enableZoom = document.activeElement === this.holder;
  };

  leave(): void {
    this.holder.removeEventListener("focus", this.setZooms);
    this.holder.removeEventListener("blur", this.setZooms);
    this.controls.dispose();
  }

  /** The point on the horizontal ground under a point of the screen, in the root frame; m. */
  groundAt(x: number, y: number): Triple | null {
    const hit = this.sight(x, y).intersectPlane(new Plane(this.extent.up), this.place);
    return hit && hit.toArray();
  }

  /** From where it looks, in reaches of the body about what it looks at. */
  get from(): Triple {
    const { reach } = this.extent;
    return this.camera.position.clone().sub(this.controls.target).divideScalar(reach).toArray();
  }

  set from(offset: Triple) {
    this.camera.position.set(...offset).multiplyScalar(this.extent.reach).add(this.controls.target);
    this.controls.update();
    this.moved();
  }

  /** The line of sight through a point of the screen. */
  sight(x: number, y: number): Ray {
    const box = this.holder.getBoundingClientRect();
    const point = new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    const caster = new Raycaster();
    caster.setFromCamera(point, this.camera);
    return caster.ray;
  }

  /** Where on the screen a point of the root frame is seen, in pixels. */
  seenAt(point: Triple): [number, number] {
    const box = this.holder.getBoundingClientRect();
    const { x, y } = this.place.set(...point).project(this.camera);
    return [box.left + ((x + 1) / 2) * box.width, box.top + ((1 - y) / 2) * box.height];
  }

  /** The point under a point of the screen that is as far away as another one. */
  facing(x: number, y: number, other: Vector3): Vector3 | null {
    const plane = new Plane().setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(new Vector3()), other);
    return this.sight(x, y).intersectPlane(plane, new Vector3());
  }

  /** Back to the initial view, as close as possible with everything in view. */
  home(): void {
    const [side, ahead] = this.level;
    const offset = this.extent.up.clone().multiplyScalar(0.44).addScaledVector(ahead, -0.82).addScaledVector(side, 0.36);
    this.look(offset);
    this.fitted = { target: this.controls.target.clone(), balls: this.balls, distance: this.distance() };
    this.camera.position.copy(this.controls.target).addScaledVector(offset.normalize(), this.fitted.distance);
    this.controls.update();
    this.aim();
    this.moved();
  }

  /** Look at the target along a direction, from any distance. */
  private look(offset: Vector3): void {
    this.target(this.controls.target);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
  }

  setFollow(follow: boolean): void {
    this.choose(follow);
    this.home();
  }

  /** Follow a body or not, as a reader chose. */
  choose(follow: boolean | null): void {
    this.chosen = follow;
    this.follow = follow ?? this.follow;
  }

  /** Rotate the view about the vertical and up or down, rad. */
  orbit(round: number, over: number): void {
    const { up } = this.extent;
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

  /** Move with the body, if it is followed. */
  chase(): void {
    this.body(this.last);
    if (!this.follow || this.held) return;
    const before = this.controls.target.clone();
    const step = this.target(this.controls.target).clone().sub(before);
    this.camera.position.add(step);
    this.controls.update();
    this.aim();
  }

  /** Move along with the body, if it is followed or would leave the picture. */
  keepInView(): void {
    const place = this.body(new Vector3());
    const step = place.clone().sub(this.last);
    this.chase();
    if (this.follow) return;
    this.camera.updateMatrixWorld();
    const { x, y } = place.project(this.camera);
    if (Math.max(Math.abs(x), Math.abs(y)) < MARGIN || step.length() > this.fitted.distance) return;
    this.controls.target.add(step);
    this.camera.position.add(step);
    this.controls.update();
  }

  private target(out: Vector3): Vector3 {
    return this.follow ? this.body(out) : out.copy(this.extent.middle);
  }

  private get balls(): Sphere[] {
    const { balls, reach } = this.extent;
    return this.follow ? [new Sphere(this.body(new Vector3()), CLOSE * reach)] : balls;
  }

  /** Distance from a point at which spheres are in view, in the present direction of the camera; m. */
  private distance(balls = this.balls, target = this.controls.target): number {
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    const turn = this.camera.quaternion.clone().invert();
    const needed = balls.map(({ center, radius }) => {
      const { x, y, z } = center.clone().sub(target).applyQuaternion(turn);
      return z + Math.max(Math.abs(y) + radius, (Math.abs(x) + radius) / this.camera.aspect) / half;
    });
    return Math.max(...needed);
  }

  private aim(): void {
    const target = this.target(this.place);
    const radius = Math.max(...this.balls.map((ball) => ball.center.distanceTo(target) + ball.radius));
    this.display.lights.aim(target, LIT * radius, this.extent.up, this.level);
  }
}

/** Two horizontal directions, to the right and away. */
function horizontal(up: Vector3): [Vector3, Vector3] {
  const guess = Math.abs(up.z) > 0.9 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
  const side = guess.clone().cross(up).normalize();
  return [side, up.clone().cross(side)];
}

// The picture in three dimensions.

import { type Object3D, type PerspectiveCamera, Plane, Quaternion, Raycaster, Vector2, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Arrow, arrowObject, scales, usuallyShown } from "./arrows";
import { extent } from "./extent";
import { House } from "./house";
import { Link } from "./links";
import { Pose } from "./pose";
import { posts } from "./posts";
import { type ArrowKind, Rows, type SceneData, type SupportData, type Triple } from "./scene";
import { bodyObject, reach } from "./shapes";
import { boundless, paint, surfaceOf } from "./supports";
import { Trace } from "./traces";
import { Triad } from "./triad";

const FAR = 5.5; // reaches of the body that are in view when it is followed
const WIDE = 60; // reaches by which a sheet is wider while a hand pulls it
const LIFT = 0.05; // of a floor below what stands on it, in reaches

export class Stage {
  readonly arrows: Arrow[];
  readonly traces: Trace[];
  follow: boolean;
  private readonly house: House;
  private readonly controls: OrbitControls;
  private readonly shown: Set<ArrowKind>;
  private readonly links: Link[];
  private readonly triad: Triad;
  private readonly moving: { pose: Pose; object: Object3D }[] = [];
  private readonly poses: Pose[];
  private readonly carriers: Object3D[] = [];
  private readonly reach: number;
  private readonly radius: number;
  private readonly middle: Vector3;
  private readonly up: Vector3;
  private readonly place = new Vector3();
  private readonly fitting = new ResizeObserver(() => this.fit());
  private readonly sheets: { pose: Pose; object: Object3D; support: SupportData }[] = [];
  private dark = false;
  private frame = 0;
  private stale = false;
  private traced = true;

  /**
   * Throws where there is no WebGL.
   *
   * It takes the place of an earlier stage, and its view of the same bodies where that is kept.
   */
  constructor(
    readonly scene: SceneData,
    private readonly holder: HTMLElement,
    before?: Stage,
    keepsView = false,
  ) {
    this.house = before?.house ?? new House();
    this.house.begin();
    this.up = new Vector3(...scene.up);
    this.triad = new Triad(scene.directions);
    this.poses = scene.bodies.map((body) => new Pose(body.pose));
    this.reach = Math.max(...scene.bodies.map(reach));
    this.links = scene.links.map((data) => new Link(data));
    [this.middle, this.radius] = extent(this.poses, this.fixed(), this.scene.frames, this.reach);
    this.follow = this.radius > 1.4 * FAR * this.reach && !this.isTied();
    this.addBodies();
    this.addGrounds();
    this.traces = scene.traces.map((data) => new Trace(data));
    for (const trace of this.traces) this.carrier(trace).add(this.house.own(trace.line));
    this.arrows = this.makeArrows();
    this.shown = usuallyShown(this.kinds);
    for (const link of this.links) this.house.own(link.object);
    before?.leave();
    this.controls = new OrbitControls(this.camera, holder);
    this.controls.maxDistance = 40 * Math.max(this.radius, this.reach);
    this.controls.minDistance = 1.5 * this.reach;
    this.controls.addEventListener("change", () => this.draw());
    this.open(keepsView ? before : undefined);
    holder.append(this.canvas, this.triad.element);
    this.fitting.observe(holder);
    this.fit();
  }

  private get camera(): PerspectiveCamera {
    return this.house.camera;
  }

  /** Show what is seen first, from where an earlier stage was looked at. */
  private open(before?: Stage): void {
    const eye = this.camera.position.clone();
    this.camera.up.copy(this.up);
    this.camera.near = this.reach / 8;
    this.camera.far = 300 * Math.max(this.radius, this.reach);
    this.camera.updateProjectionMatrix();
    this.house.lights.fit(this.reach);
    this.aim();
    if (before) this.inherit(before);
    for (const { data, group } of this.arrows) group.visible = this.shown.has(data.kind);
    this.showTraces(this.traced);
    this.home();
    if (before) this.look(before, eye);
  }

  /** What was switched on or off stays so. */
  private inherit(before: Stage): void {
    this.follow = before.follow;
    this.traced = before.traced;
    for (const kind of before.kinds) this.shown[before.shown.has(kind) ? "add" : "delete"](kind);
  }

  private look(before: Stage, eye: Vector3): void {
    const moved = this.controls.target.clone().sub(before.controls.target);
    if (!this.follow) moved.setScalar(0);
    this.controls.target.copy(before.controls.target).add(moved);
    this.camera.position.copy(eye).add(moved);
    this.controls.enabled = before.controls.enabled;
    this.controls.update();
  }

  private leave(): void {
    this.house.set();
    this.stale = false;
    this.fitting.disconnect();
    this.triad.element.remove();
    this.controls.dispose();
  }

  /** Whether pulling turns the view; where it does not, something else is pulled. */
  set turns(turns: boolean) {
    this.controls.enabled = turns;
  }

  /** The place on the level ground under a point of the screen, along the root frame; m. */
  groundAt(x: number, y: number): Triple | null {
    const box = this.holder.getBoundingClientRect();
    const point = new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    const sight = new Raycaster();
    sight.setFromCamera(point, this.camera);
    const hit = sight.ray.intersectPlane(new Plane(this.up), this.place);
    return hit && hit.toArray();
  }

  /** Leave out what belongs to the motion as it was, on wide sheets: a hand makes another of it. */
  bare(): void {
    for (const arrow of this.arrows) arrow.group.visible = false;
    for (const trace of this.traces) trace.line.removeFromParent();
    for (const sheet of this.sheets) {
      const { reach } = sheet.support;
      const wide: [number, number] = [reach[0] + WIDE * this.reach, reach[1] + WIDE * this.reach];
      sheet.object.visible = false;
      sheet.object = this.house.own(surfaceOf({ ...sheet.support, reach: wide }, this.grid()));
    }
    paint(this.house.world, this.dark);
  }

  /** Draw bodies as other poses have them. */
  put(poses: Pose[], frame: number): void {
    poses.forEach((pose, i) => {
      this.poses[i] = pose;
      pose.apply(frame, this.moving[i].object);
    });
    this.frame = frame;
    if (this.follow) this.chase();
    this.draw();
  }

  /** Draw sheets away from where they are at the start, m. */
  shift(by: Triple): void {
    for (const { pose, object } of this.sheets) {
      pose.apply(0, object);
      object.position.add(new Vector3(...by));
    }
    this.draw();
  }

  get canvas(): HTMLCanvasElement {
    return this.house.renderer.domElement;
  }

  /** Back to where the picture was first seen from. */
  home(): void {
    const [side, ahead] = this.horizontal();
    const distance = (1.15 * this.seen()) / Math.tan((this.camera.fov * Math.PI) / 360);
    this.target(this.controls.target);
    this.camera.position
      .copy(this.controls.target)
      .addScaledVector(ahead, -0.82 * distance)
      .addScaledVector(side, 0.36 * distance)
      .addScaledVector(this.up, 0.44 * distance);
    this.controls.update();
    this.draw();
  }

  /** Turn the view about the upright and up or down, rad. */
  orbit(round: number, over: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyQuaternion(new Quaternion().setFromAxisAngle(this.up, round));
    const aside = this.up.clone().cross(offset).normalize();
    const tipped = offset.clone().applyQuaternion(new Quaternion().setFromAxisAngle(aside, over));
    if (Math.abs(tipped.clone().normalize().dot(this.up)) < 0.995) offset.copy(tipped);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  setFollow(follow: boolean): void {
    this.follow = follow;
    this.home();
  }

  get kinds(): ArrowKind[] {
    return [...new Set(this.scene.arrows.map(({ kind }) => kind))];
  }

  shows(kind: ArrowKind): boolean {
    return this.shown.has(kind);
  }

  get showsTraces(): boolean {
    return this.traced;
  }

  show(kind: ArrowKind, shown: boolean): void {
    this.shown[shown ? "add" : "delete"](kind);
    for (const arrow of this.arrows) if (arrow.data.kind === kind) arrow.group.visible = shown;
    this.draw();
  }

  showTraces(shown: boolean): void {
    this.traced = shown;
    for (const trace of this.traces) this.carrier(trace)[shown ? "add" : "remove"](trace.line);
    this.draw();
  }

  theme(dark: boolean): void {
    this.dark = dark;
    paint(this.house.world, dark);
    for (const trace of this.traces) trace.theme(dark);
    this.draw();
  }

  seek(time: number): void {
    this.frame = (time / this.scene.duration) * (this.scene.frames - 1);
    this.seekFrame();
    if (this.follow) this.chase();
    this.draw();
  }

  private seekFrame(): void {
    for (const { pose, object } of this.moving) pose.apply(this.frame, object);
    for (const arrow of this.arrows) arrow.update(this.frame);
    for (const link of this.links) link.update(this.frame);
    for (const trace of this.traces) trace.update(this.frame);
  }

  private chase(): void {
    const before = this.controls.target.clone();
    const step = this.target(this.controls.target).clone().sub(before);
    this.camera.position.add(step);
    this.controls.update();
    this.aim();
  }

  private target(out: Vector3): Vector3 {
    return this.follow ? this.poses[0].placeAt(this.frame, out) : out.copy(this.middle);
  }

  /** Radius of what is to be in view. */
  private seen(): number {
    return this.follow ? 0.55 * FAR * this.reach : Math.max(this.radius, 1.9 * this.reach);
  }

  private draw(): void {
    if (this.stale) return;
    this.stale = true;
    requestAnimationFrame(() => {
      if (this.stale) this.drawNow();
    });
  }

  /** Draw what is to be drawn without waiting for the next frame of the screen. */
  drawNow(): void {
    this.stale = false;
    this.house.draw();
    this.triad.update(this.camera);
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (!width || !height) return;
    this.camera.aspect = width / height;
    this.camera.fov = width < height ? 40 : 32;
    this.camera.updateProjectionMatrix();
    const { renderer } = this.house;
    const before = renderer.getSize(new Vector2());
    if (before.x === width && before.y === height) return; // or what is drawn would be cleared
    renderer.setSize(width, height);
    this.draw();
  }

  /** Points in space that hold something. */
  private fixed(): Vector3[] {
    const feet = this.scene.arrows.map((arrow) => new Rows(arrow.foot));
    const ends = [...feet, ...this.links.flatMap((link) => link.ends)];
    return ends.filter(({ count }) => count === 1).map((end) => new Vector3().fromArray(end.at(0, [])));
  }

  /** Two level directions, to the right and away. */
  private horizontal(): [Vector3, Vector3] {
    const guess = Math.abs(this.up.z) > 0.9 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
    const side = guess.clone().cross(this.up).normalize();
    return [side, this.up.clone().cross(side)];
  }

  private addBodies(): void {
    this.scene.bodies.forEach((body, i) => {
      const { shape, arms } = body;
      const joints = this.scene.joints.filter((joint) => joint.body === i);
      const object = this.house.part({ shape, arms, joints }, () => bodyObject(body, joints));
      this.moving.push({ pose: this.poses[i], object });
    });
  }

  /** Whether a spring or damper ties a body to a place in space. */
  private isTied(): boolean {
    return this.links.some(({ ends }) => ends.some(({ count }) => count === 1));
  }

  private carrier(trace: Trace): Object3D {
    return this.carriers[trace.data.support] ?? this.house.world;
  }

  private addGrounds(): void {
    const grid = this.grid();
    for (const support of this.scene.supports) {
      const { kind, middle, reach } = support;
      const object = this.house.part({ kind, middle, reach, grid }, () => surfaceOf(support, grid));
      this.carriers.push(object);
      const pose = new Pose(support.pose);
      this.moving.push({ pose, object });
      if (kind !== "sheet") continue;
      this.sheets.push({ pose, object, support });
      this.table(pose, Math.max(...reach) + this.radius, grid);
    }
    const { floor } = this.scene;
    if (floor === null) return;
    this.floor(floor, grid);
    for (const post of posts(this.held(), floor, { up: this.up, middle: this.middle, reach: this.reach })) this.house.own(post);
  }

  /** About how far the lines on the ground are apart, m. */
  private grid(): number {
    return 1.2 * Math.max(this.reach, this.follow ? 0 : 0.35 * this.radius);
  }

  private table(pose: Pose, width: number, grid: number): void {
    const table = this.boundless(2.5 * width, grid);
    pose.apply(0, table);
    table.position.addScaledVector(this.up, -LIFT * this.reach);
  }

  private boundless(radius: number, grid: number): Object3D {
    return this.house.part({ radius, grid }, () => boundless([0, 0], radius, grid));
  }

  private floor(height: number, grid: number): void {
    const floor = this.boundless(7 * this.radius, grid);
    floor.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), this.up);
    floor.position.copy(this.middle).addScaledVector(this.up, height - this.middle.dot(this.up));
  }

  /** Points in space that hold a body away from its middle. */
  private held(): Vector3[] {
    return this.scene.arrows
      .map(({ foot, body }) => ({ foot: new Rows(foot), middle: this.poses[body].placeAt(0, new Vector3()) }))
      .filter(({ foot }) => foot.count === 1)
      .map(({ foot, middle }) => ({ point: new Vector3().fromArray(foot.at(0, [])), middle }))
      .filter(({ point, middle }) => point.distanceTo(middle) >= 1e-6 * this.reach)
      .map(({ point }) => point);
  }

  private makeArrows(): Arrow[] {
    const thick = 0.028 * this.reach;
    const scale = scales(this.scene.arrows, this.reach);
    return this.scene.arrows.map((data) => {
      const { kind, body } = data;
      const object = this.house.part({ kind, thick }, () => arrowObject(kind, thick));
      return new Arrow(data, object, this.poses[body], scale(kind), thick);
    });
  }

  private aim(): void {
    this.house.lights.aim(this.target(this.place), 1.2 * this.seen(), this.up, this.horizontal());
  }
}

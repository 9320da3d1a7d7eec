// The picture in three dimensions.

import {
  LineSegments,
  type Material,
  Mesh,
  type Object3D,
  PCFShadowMap,
  PerspectiveCamera,
  Plane,
  Quaternion,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Arrow } from "./arrows";
import { extent } from "./extent";
import { Lights } from "./lights";
import { Link } from "./links";
import { Pose } from "./pose";
import { posts } from "./posts";
import { type ArrowKind, Rows, type SceneData, type SupportData, type Triple } from "./scene";
import { bodyObject, reach } from "./shapes";
import { Grounds } from "./supports";
import { Trace } from "./traces";
import { Triad } from "./triad";

const FAR = 5.5; // reaches of the body that are in view when it is followed
// Usual lengths of the longest arrows, in reaches: unlike, so that parallel ones are told apart.
const ARROW: Record<ArrowKind, number> = { force: 2.4, load: 2.4, torque: 1.9, omega: 1.5, momentum: 1.9 };
const SPIKE = 12; // largest over usual length, beyond which the usual one no longer decides
const WIDE = 60; // reaches by which a sheet is wider while a hand pulls it
const LIFT = 0.05; // of a floor below what stands on it, in reaches

export class Stage {
  readonly arrows: Arrow[];
  readonly traces: Trace[];
  follow: boolean;
  private readonly renderer: WebGLRenderer;
  private readonly world = new Scene();
  private readonly camera: PerspectiveCamera;
  private readonly controls: OrbitControls;
  private readonly lights: Lights;
  private readonly grounds = new Grounds();
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
  private waiting = false;
  private released = false;

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
    this.renderer = before?.renderer ?? rendererOf();
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
    for (const trace of this.traces) this.carrier(trace).add(trace.line);
    this.arrows = this.makeArrows();
    this.world.add(...this.arrows.map((arrow) => arrow.group), ...this.links.map((link) => link.object));
    this.camera = new PerspectiveCamera(32, 1, this.reach / 8, 300 * Math.max(this.radius, this.reach));
    this.camera.up.copy(this.up);
    this.lights = new Lights(this.world, this.camera, this.reach);
    this.aim();
    holder.append(this.renderer.domElement, this.triad.element);
    this.controls = new OrbitControls(this.camera, holder);
    this.controls.maxDistance = 40 * Math.max(this.radius, this.reach);
    this.controls.minDistance = 1.5 * this.reach;
    this.controls.addEventListener("change", () => this.draw());
    this.home();
    if (before) this.succeed(before, keepsView);
    this.fitting.observe(holder);
    this.fit();
  }

  private succeed(before: Stage, keepsView: boolean): void {
    if (keepsView && before.follow === this.follow) {
      const moved = this.controls.target.clone().sub(before.controls.target);
      if (!this.follow) moved.setScalar(0);
      this.controls.target.copy(before.controls.target).add(moved);
      this.camera.position.copy(before.camera.position).add(moved);
    }
    this.controls.enabled = before.controls.enabled;
    this.renderer.compile(this.world, this.camera); // or the shaders they share would go with the old
    before.release();
    this.controls.update();
  }

  private release(): void {
    this.released = true;
    this.fitting.disconnect();
    this.triad.element.remove();
    this.controls.dispose();
    this.lights.dispose();
    this.world.traverse((object) => {
      if (!(object instanceof Mesh || object instanceof LineSegments)) return;
      object.geometry.dispose();
      for (const material of [object.material].flat() as Material[]) material.dispose();
    });
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
      sheet.object = this.grounds.surface({ ...sheet.support, reach: wide }, this.grid());
      this.world.add(sheet.object);
    }
    this.grounds.theme(this.dark);
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
    return this.renderer.domElement;
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

  show(kind: ArrowKind, shown: boolean): void {
    for (const arrow of this.arrows) if (arrow.data.kind === kind) arrow.group.visible = shown;
    this.draw();
  }

  showTraces(shown: boolean): void {
    for (const trace of this.traces) this.carrier(trace)[shown ? "add" : "remove"](trace.line);
    this.draw();
  }

  theme(dark: boolean): void {
    this.dark = dark;
    this.grounds.theme(dark);
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
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (this.released) return;
      this.renderer.render(this.world, this.camera);
      this.triad.update(this.camera);
    });
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (!width || !height) return;
    this.camera.aspect = width / height;
    this.camera.fov = width < height ? 40 : 32;
    this.camera.updateProjectionMatrix();
    const before = this.renderer.getSize(new Vector2());
    if (before.x === width && before.y === height) return; // or what is drawn would be cleared
    this.renderer.setSize(width, height);
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
      const object = bodyObject(body, this.scene.joints.filter((joint) => joint.body === i));
      this.world.add(object);
      this.moving.push({ pose: this.poses[i], object });
    });
  }

  /** Whether a spring or damper ties a body to a place in space. */
  private isTied(): boolean {
    return this.links.some(({ ends }) => ends.some(({ count }) => count === 1));
  }

  private carrier(trace: Trace): Object3D {
    return this.carriers[trace.data.support] ?? this.world;
  }

  private addGrounds(): void {
    const grid = this.grid();
    for (const support of this.scene.supports) {
      const object = this.grounds.surface(support, grid);
      this.carriers.push(object);
      this.world.add(object);
      const pose = new Pose(support.pose);
      this.moving.push({ pose, object });
      if (support.kind === "sheet") this.sheets.push({ pose, object, support });
      if (support.kind === "sheet") this.world.add(this.table(pose, Math.max(...support.reach) + this.radius, grid));
    }
    const { floor } = this.scene;
    if (floor !== null) this.world.add(this.floor(floor, grid), ...posts(this.held(), floor, { up: this.up, middle: this.middle, reach: this.reach }));
  }

  /** About how far the lines on the ground are apart, m. */
  private grid(): number {
    return 1.2 * Math.max(this.reach, this.follow ? 0 : 0.35 * this.radius);
  }

  private table(pose: Pose, width: number, grid: number): Object3D {
    const table = this.grounds.boundless([0, 0], 2.5 * width, grid);
    pose.apply(0, table);
    table.position.addScaledVector(this.up, -LIFT * this.reach);
    return table;
  }

  private floor(height: number, grid: number): Object3D {
    const floor = this.grounds.boundless([0, 0], 7 * this.radius, grid);
    floor.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), this.up);
    floor.position.copy(this.middle).addScaledVector(this.up, height - this.middle.dot(this.up));
    return floor;
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
    const group = (kind: ArrowKind): string => (kind === "load" ? "force" : kind);
    const sizes: Record<string, number> = {};
    for (const { kind, usual, largest } of this.scene.arrows) {
      sizes[group(kind)] = Math.max(sizes[group(kind)] ?? 0, usual, largest / SPIKE);
    }
    return this.scene.arrows.map((data) => {
      const scale = (ARROW[data.kind] * this.reach) / sizes[group(data.kind)];
      return new Arrow(data, this.poses[data.body], scale, 0.028 * this.reach);
    });
  }

  private aim(): void {
    this.lights.aim(this.target(this.place), 1.2 * this.seen(), this.up, this.horizontal());
  }
}

function rendererOf(): WebGLRenderer {
  const renderer = new WebGLRenderer({ antialias: true, alpha: true });
  renderer.debug.checkShaderErrors = false; // waiting for them holds up the first picture
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  return renderer;
}

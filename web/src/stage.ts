// The three-dimensional picture.

import { type Object3D, Raycaster, Vector2, Vector3 } from "three";
import { Annotations } from "./annotations";
import { type Extent, extentOf, tracedBy } from "./extent";
import { CameraView } from "./camera_view";
import { Display } from "./display";
import { Link } from "./links";
import { Plan } from "./plan";
import { Pose } from "./pose";
import { mounts } from "./mounts";
import { Rows, type SceneData, type SupportData, type Triple } from "./scene";
import { reach } from "./reach";
import { bodyObject } from "./shapes";
import { boundless, paint, surfaceOf } from "./supports";
import { Trace } from "./traces";
import { Triad } from "./triad";

const SPACIOUS = 6; // body sizes: beyond this extent, arrows are drawn larger
const WANDERS = 12; // body sizes: beyond this extent the body would be a dot, and is followed
const WIDE = 60; // reaches by which a sheet is wider while a hand pulls it
const BESIDE = 22; // pixels from the centre of a small body, at which a finger takes it
const LIFT = 0.05; // of a floor below what stands on it, in reaches

export class Stage {
  readonly annotations: Annotations;
  readonly traces: Trace[];
  readonly view: CameraView;
  private readonly display: Display;
  private readonly links: Link[];
  private readonly triad: Triad;
  private readonly plan: Plan;
  private readonly moving: { pose: Pose; object: Object3D }[] = [];
  private readonly poses: Pose[];
  private readonly carriers: Object3D[] = [];
  private readonly extent: Extent;
  private readonly grid: number; // about how far the lines on the ground are apart, m
  private readonly fitting = new ResizeObserver(() => this.fit());
  private readonly sheets: { pose: Pose; object: Object3D; support: SupportData }[] = [];
  private dark = false;
  private frame = 0;
  private stale = false;
  private traced = true;
  /**
   * Throws `NoWebGL` where there is none.
   *
   * It takes the place of an earlier stage, and its view of the same bodies where that is kept.
   */
  constructor(
    readonly scene: SceneData,
    private readonly holder: HTMLElement,
    before?: Stage,
    keepsView = false,
  ) {
    this.display = before?.display ?? new Display();
    this.display.begin();
    this.triad = new Triad(scene.directions);
    this.poses = scene.bodies.map((body) => new Pose(body.pose));
    this.links = scene.links.map((data) => new Link(data));
    const reaches = Math.max(...scene.bodies.map(reach));
    this.annotations = new Annotations(scene, this.poses, this.display, reaches, () => this.refresh());
    const first = this.annotations.arrows.filter(({ data }) => this.annotations.shows(data.kind));
    this.extent = extentOf(new Vector3(...scene.up), this.poses, reaches, this.fixed(), first, scene.traces.flatMap(tracedBy), scene.supports, scene.frames);
    const follow = this.extent.radius > WANDERS * reaches && !this.isTied();
    this.addBodies();
    this.grid = 1.2 * Math.max(reaches, follow ? 0 : 0.35 * this.extent.radius);
    this.addGrounds(this.grid);
    this.traces = scene.traces.map((data) => new Trace(data));
    for (const trace of this.traces) this.carrier(trace).add(this.display.own(trace.line));
    for (const { object } of this.links) this.display.own(object);
    before?.leave();
    const from = this.display.camera.position.clone();
    this.fit();
    const body = (out: Vector3): Vector3 => this.poses[0].placeAt(this.frame, out);
    this.view = new CameraView(this.display, holder, this.extent, follow, body, () => this.draw());
    this.plan = new Plan(this.extent.up, scene.traces);
    this.open(from, keepsView ? before : undefined);
    const canvas = Object.assign(this.canvas, { camera: this.display.camera }); // which tells what is in view
    holder.append(canvas, ...this.annotations.elements, this.triad.element, this.plan.element);
    this.showPlan();
    this.fitting.observe(holder);
  }

  /** Show the first frame, from the view of an earlier stage. */
  private open(from: Vector3, before?: Stage): void {
    if (before) this.inherit(before);
    if (before) this.view.choose(before.view.chosen);
    this.annotations.begin();
    this.showTraces(this.traced);
    this.magnify();
    this.view.home();
    if (before) this.view.takeOver(before.view, from);
  }

  /** Follow the body, or show its whole path, also in the motions that take the place of this one. */
  setFollow(follow: boolean): void {
    this.view.setFollow(follow);
    this.showPlan();
    this.magnify();
    this.draw();
  }

  private showPlan(): void {
    this.plan.element.toggleAttribute("hidden", !this.view.follow || this.plan.isEmpty);
  }

  /** Arrows are large enough to be visible when a long path is in view. */
  private magnify(): void {
    const { radius, reach } = this.extent;
    this.annotations.magnify(this.view.follow ? 1 : Math.max(1, radius / (SPACIOUS * reach)));
  }

  /** Keep what was switched on or off. */
  private inherit(before: Stage): void {
    this.traced = before.traced;
    this.annotations.inherit(before.annotations);
  }

  private leave(): void {
    this.display.set();
    this.stale = false;
    this.fitting.disconnect();
    for (const element of [this.triad.element, ...this.annotations.elements]) element.remove();
    this.plan.element.remove();
    this.view.leave();
  }

  /** Hide what belongs to the previous motion, on a wide sheet, while the sheet is dragged. */
  bare(): void {
    this.annotations.hide();
    for (const trace of this.traces) trace.line.removeFromParent();
    for (const sheet of this.sheets) {
      const { reach } = sheet.support;
      const extra = WIDE * this.extent.reach;
      const wide: [number, number] = [reach[0] + extra, reach[1] + extra];
      sheet.object.visible = false;
      sheet.object = this.display.own(surfaceOf({ ...sheet.support, reach: wide }, this.grid));
    }
    paint(this.display.world, this.dark);
  }

  /** Draw bodies in other poses. */
  put(poses: Pose[], frame: number): void {
    poses.forEach((pose, i) => {
      this.poses[i] = pose;
      pose.apply(frame, this.moving[i].object);
    });
    this.frame = frame;
    this.view.keepInView();
    this.draw();
  }

  /** Draw sheets displaced from their initial position, m. */
  shift(by: Triple): void {
    for (const { pose, object } of this.sheets) {
      pose.apply(0, object);
      object.position.add(new Vector3(...by));
    }
    this.draw();
  }

  get canvas(): HTMLCanvasElement {
    return this.display.renderer.domElement;
  }

  get showsTraces(): boolean {
    return this.traced;
  }

  /** The value of a coordinate whose arc would end under a point of the screen; null where none does. */
  angleAt(coordinate: string, x: number, y: number): number | null {
    return this.annotations.angleAt(coordinate, this.view.sight(x, y));
  }

  /** The body under a point of the screen, or right beside it, and the point of it that is seen; m. */
  bodyAt(x: number, y: number): { body: number; point: Vector3 } | null {
    const { origin, direction } = this.view.sight(x, y);
    const objects = this.moving.slice(0, this.poses.length).map(({ object }) => object);
    const [hit] = new Raycaster(origin, direction).intersectObjects(objects);
    if (hit) {
      let object = hit.object;
      while (!objects.includes(object) && object.parent) object = object.parent;
      return { body: objects.indexOf(object), point: hit.point };
    }
    const away = (body: number): number => {
      const [seenX, seenY] = this.view.seenAt(this.placeOf(body));
      return Math.hypot(seenX - x, seenY - y);
    };
    const nearest = objects.reduce((best, _, i) => (away(i) < away(best) ? i : best), 0);
    return away(nearest) < BESIDE ? { body: nearest, point: new Vector3(...this.placeOf(nearest)) } : null;
  }

  /** The centre of mass of a body, m. */
  placeOf(body: number): Triple {
    return this.poses[body].placeAt(this.frame, new Vector3()).toArray();
  }

  /** Everything that is switched on, by name. */
  get switched(): string[] {
    return [...this.annotations.switched, ...(this.traced ? ["traces"] : []), ...(this.view.follow ? ["follow"] : [])];
  }

  set switched(names: string[]) {
    this.annotations.switched = names;
    this.showTraces(names.includes("traces"));
    if (this.view.follow !== names.includes("follow")) this.setFollow(!this.view.follow);
  }

  /** Draw again what depends on what else is shown. */
  private refresh(): void {
    this.seekFrame();
    this.draw();
  }

  showTraces(shown: boolean): void {
    this.traced = shown;
    for (const trace of this.traces) this.carrier(trace)[shown ? "add" : "remove"](trace.line);
    this.draw();
  }

  theme(dark: boolean): void {
    this.dark = dark;
    paint(this.display.world, dark);
    for (const part of [...this.traces, this.annotations]) part.theme(dark);
    this.draw();
  }

  seek(time: number): void {
    this.frame = (time / this.scene.duration) * (this.scene.frames - 1);
    this.seekFrame();
    this.view.chase();
    this.draw();
  }

  private seekFrame(): void {
    for (const { pose, object } of this.moving) pose.apply(this.frame, object);
    this.annotations.update(this.frame);
    for (const link of this.links) link.update(this.frame);
    for (const trace of this.traces) trace.update(this.frame);
    this.plan.update(this.poses[0].placeAt(this.frame, new Vector3()));
  }

  private draw(): void {
    if (this.stale) return;
    this.stale = true;
    requestAnimationFrame(() => {
      if (this.stale) this.drawNow();
    });
  }

  /** Draw immediately, without waiting for the next animation frame. */
  drawNow(): void {
    this.stale = false;
    this.display.draw();
    const { camera } = this.display;
    this.triad.update(camera);
    const { clientWidth: width, clientHeight: height } = this.holder;
    this.annotations.place(camera, width, height, this.poses[0].placeAt(this.frame, new Vector3()));
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (!width || !height) return;
    const { camera, renderer } = this.display;
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    const before = renderer.getSize(new Vector2());
    if (before.x === width && before.y === height) return; // or what is drawn would be cleared
    renderer.setSize(width, height);
    this.draw();
  }

  /** Fixed points that hold something. */
  private fixed(): Vector3[] {
    const feet = this.scene.arrows.map((arrow) => new Rows(arrow.foot));
    const ends = [...feet, ...this.links.flatMap((link) => link.ends)];
    return ends.filter(({ count }) => count === 1).map((end) => new Vector3().fromArray(end.at(0, [])));
  }

  private addBodies(): void {
    this.scene.bodies.forEach((body, i) => {
      const { shape, arms } = body;
      const joints = this.scene.joints.filter((joint) => joint.body === i);
      const object = this.display.part({ shape, arms, joints }, () => bodyObject(body, joints));
      this.moving.push({ pose: this.poses[i], object });
    });
  }

  /** Whether a spring or damper connects a body to a fixed point. */
  private isTied(): boolean {
    return this.links.some(({ ends }) => ends.some(({ count }) => count === 1));
  }

  private carrier(trace: Trace): Object3D {
    return this.carriers[trace.data.support] ?? this.display.world;
  }

  private addGrounds(grid: number): void {
    for (const support of this.scene.supports) {
      const { kind, middle, reach, points } = support;
      const object = this.display.part({ kind, middle, reach, points, grid }, () => surfaceOf(support, grid));
      this.carriers.push(object);
      const pose = new Pose(support.pose);
      this.moving.push({ pose, object });
      if (kind !== "sheet") continue;
      this.sheets.push({ pose, object, support });
      this.table(pose, Math.max(...reach) + this.extent.radius, grid);
    }
    const { floor } = this.scene;
    if (floor === null) return;
    this.floor(floor, grid);
    for (const post of mounts(this.held(), floor, this.extent)) this.display.own(post);
  }

  private table(pose: Pose, width: number, grid: number): void {
    const table = this.boundless(2.5 * width, grid);
    pose.apply(0, table);
    table.position.addScaledVector(this.extent.up, -LIFT * this.extent.reach);
  }

  private boundless(radius: number, grid: number): Object3D {
    return this.display.part({ radius, grid }, () => boundless([0, 0], radius, grid));
  }

  private floor(height: number, grid: number): void {
    const { up, middle, radius } = this.extent;
    const floor = this.boundless(7 * radius, grid);
    floor.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), up);
    floor.position.copy(middle).addScaledVector(up, height - middle.dot(up));
  }

  /** Fixed points that hold a body away from its centre. */
  private held(): Vector3[] {
    return this.scene.arrows
      .filter(({ kind }) => kind === "force")
      .map(({ foot, body }) => ({ foot: new Rows(foot), middle: this.poses[body].placeAt(0, new Vector3()) }))
      .filter(({ foot }) => foot.count === 1)
      .map(({ foot, middle }) => ({ point: new Vector3().fromArray(foot.at(0, [])), middle }))
      .filter(({ point, middle }) => point.distanceTo(middle) >= 1e-6 * this.extent.reach)
      .map(({ point }) => point);
  }
}

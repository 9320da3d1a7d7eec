// What explains the picture: arrows with their parts, arcs of angles, axes, letters and scales.

import { type PerspectiveCamera, type Ray, Vector3 } from "three";
import { Arrow, arrowObject, dye, scales, usuallyShown } from "./arrows";
import { Components } from "./components";
import type { Display } from "./display";
import { AngleArcs, Axes, THIN } from "./guides";
import { Letters } from "./letters";
import type { Pose } from "./pose";
import { reach } from "./reach";
import { ScaleBars } from "./scale_bars";
import { type ArrowKind, Rows, type SceneData } from "./scene";

const THICK = 0.028; // of an arrow, in reaches of the largest body
const ARCS = 0.9; // size by which arcs far from their body are drawn, against that distance
const TOUCHING = 1e-6; // reaches

/** Switched on and off beside the kinds of arrows. */
export type Extra = "angles" | "axes" | "components";

export class Annotations {
  readonly arrows: Arrow[];
  private readonly letters = new Letters();
  private readonly bars: ScaleBars;
  private readonly shown: Set<ArrowKind>;
  private readonly extras: Record<Extra, boolean> = { angles: true, axes: false, components: false };
  private readonly angles: AngleArcs[];
  private readonly axes: Axes[];
  private readonly components: Components[];
  /** Everything but the arrows. */
  private readonly drawn: (AngleArcs | Axes | Components)[];

  /**
   * @param reaches size of the largest body, m.
   * @param changed told when something else is shown.
   */
  constructor(
    private readonly scene: SceneData,
    private readonly poses: Pose[],
    private readonly display: Display,
    reaches: number,
    private readonly changed: () => void,
  ) {
    const thick = THICK * reaches;
    this.arrows = this.makeArrows(reaches, thick);
    this.components = this.arrows.filter(({ data }) => data.normal.shape[0]).map((arrow) => new Components(arrow, thick, this.letters));
    this.angles = this.makeAngles();
    this.axes = this.makeAxes(reaches);
    this.drawn = [...this.angles, ...this.axes, ...this.components];
    this.bars = new ScaleBars(this.arrows);
    this.shown = usuallyShown(this.kinds);
    for (const { object } of this.drawn) display.own(object);
  }

  /** Elements above the picture. */
  get elements(): HTMLElement[] {
    return [this.letters.element, this.bars.element];
  }

  // -- what is shown ------------------------------------------------------------------------------

  get kinds(): ArrowKind[] {
    return [...new Set(this.scene.arrows.map(({ kind }) => kind))];
  }

  shows(what: ArrowKind | Extra): boolean {
    return what in this.extras ? this.extras[what as Extra] : this.shown.has(what as ArrowKind);
  }

  /** Whether there is anything of this sort to be shown. */
  has(extra: Extra): boolean {
    return this[extra].length > 0;
  }

  show(what: ArrowKind | Extra, shown: boolean): void {
    this.turn(what, shown);
    this.begin();
    this.changed();
  }

  /** Everything that is switched on, by name. */
  get switched(): string[] {
    return this.switches.filter((what) => this.shows(what));
  }

  set switched(names: string[]) {
    for (const what of this.switches) this.turn(what, names.includes(what));
    this.begin();
    this.changed();
  }

  private get switches(): (ArrowKind | Extra)[] {
    return [...this.kinds, ...(Object.keys(this.extras) as Extra[])];
  }

  private turn(what: ArrowKind | Extra, on: boolean): void {
    if (what in this.extras) this.extras[what as Extra] = on;
    else this.shown[on ? "add" : "delete"](what as ArrowKind);
  }

  /** Keep what was switched on or off. */
  inherit(before: Annotations): void {
    Object.assign(this.extras, before.extras);
    for (const kind of before.kinds) this.turn(kind, before.shows(kind));
  }

  /** Make visible what is switched on. */
  begin(): void {
    for (const { data, group } of this.arrows) group.visible = this.shown.has(data.kind);
    for (const [extra, shown] of Object.entries(this.extras)) for (const part of this[extra as Extra]) part.show(shown);
  }

  /** Hide everything, for as long as the picture is not of the motion. */
  hide(): void {
    for (const { group } of this.arrows) group.visible = false;
    for (const part of this.drawn) part.show(false);
    this.letters.element.hidden = true;
  }

  // -- drawing ------------------------------------------------------------------------------------

  /** Draw arrows so many times as long and thick. */
  magnify(times: number): void {
    for (const { group } of this.arrows) group.scale.setScalar(times);
  }

  theme(dark: boolean): void {
    for (const part of this.drawn) part.theme(dark);
    for (const { group, data } of this.arrows) dye(group, data.kind, dark);
  }

  update(frame: number): void {
    // an arrow that begins at the tip of another one comes after it
    for (const arrow of this.arrows) if (!arrow.follows) arrow.update(frame);
    for (const arrow of this.arrows) if (arrow.follows) arrow.update(frame);
    for (const part of this.drawn) part.update(frame);
  }

  /** Put letters and scales where the camera sees what they are about. */
  place(camera: PerspectiveCamera, width: number, height: number, body: Vector3): void {
    this.letters.update(camera, width, height);
    this.bars.update(camera, body, height);
  }

  // -- angles -------------------------------------------------------------------------------------

  /** The present value of a coordinate with an arc, rad. */
  angleOf(coordinate: string): number | null {
    return this.angles.reduce<number | null>((found, arcs) => found ?? arcs.valueOf(coordinate), null);
  }

  /** The value of a coordinate whose arc would end under a line of sight; null where none does. */
  angleAt(coordinate: string, sight: Ray): number | null {
    return this.angles.reduce<number | null>((found, arcs) => found ?? arcs.valueAt(coordinate, sight), null);
  }

  // -- making -------------------------------------------------------------------------------------

  private makeArrows(size: number, thick: number): Arrow[] {
    const scale = scales(this.scene.arrows, size);
    const arrows = this.scene.arrows.map((data) => {
      const { kind, body } = data;
      const object = this.display.part({ kind, thick }, () => arrowObject(kind, thick));
      return new Arrow(data, object, this.poses[body], scale(kind), thick, this.letters);
    });
    for (const torque of arrows.filter(({ data }) => data.kind === "torque")) {
      torque.follows = arrows.find(({ data }) => data.kind === "momentum" && data.body === torque.data.body) ?? null;
    }
    return arrows;
  }

  private makeAngles(): AngleArcs[] {
    return this.scene.angles.map((data) => {
      const vertex = new Vector3().fromArray(new Rows(data.vertex).at(0, []));
      const away = this.poses[data.body].placeAt(0, new Vector3()).distanceTo(vertex);
      const size = reach(this.scene.bodies[data.body]);
      return new AngleArcs(data, Math.max(size, ARCS * away), THIN * size, away > TOUCHING * size, this.letters);
    });
  }

  /** Those of the laboratory, and of every body that has axes. */
  private makeAxes(size: number): Axes[] {
    const own = this.scene.bodies.flatMap((body, i) => (body.labels.length ? [new Axes(this.poses[i], body.labels, reach(body), true, this.letters)] : []));
    return [new Axes(this.poses[0], this.scene.directions, size, false, this.letters), ...own];
  }
}

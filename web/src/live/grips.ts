// Takes hold of the letters of angles in the picture: dragged, they change the start.

import type { Player } from "../player";

const STEP = Math.PI / 360; // half a degree

export class Grips {
  private coordinate = "";
  /** Of the coordinate, against what the place of the pointer means. */
  private ahead = 0;
  private value = 0;

  /** @param set sets the start of a coordinate, rad. */
  constructor(
    private readonly player: Player,
    private readonly set: (coordinate: string, value: number) => void,
  ) {
    const { picture } = player;
    picture.classList.add("grips");
    // before the picture turns with the pointer
    picture.addEventListener("pointerdown", (event) => this.take(event), { capture: true });
    addEventListener("pointermove", (event) => this.drag(event));
    for (const end of ["pointerup", "pointercancel"] as const) addEventListener(end, () => this.leave());
  }

  private take(event: PointerEvent): void {
    const letter = (event.target as HTMLElement).closest<HTMLElement>(".letter[data-coordinate]");
    const { clock, stage } = this.player;
    const coordinate = letter?.dataset.coordinate;
    if (!coordinate || !clock || !stage) return;
    event.stopPropagation();
    event.preventDefault();
    clock.pause();
    clock.seek(0); // an arc shows there the start, which it is to change
    const pointed = stage.angleAt(coordinate, event.clientX, event.clientY);
    const present = stage.annotations.angleOf(coordinate);
    if (pointed === null || present === null) return;
    this.coordinate = coordinate;
    this.value = present;
    this.ahead = present - pointed;
    this.player.picture.classList.add("dragging");
  }

  private drag(event: PointerEvent): void {
    if (!this.coordinate) return;
    const pointed = this.player.stage?.angleAt(this.coordinate, event.clientX, event.clientY) ?? null;
    if (pointed === null) return;
    const turn = 2 * Math.PI;
    const value = pointed + this.ahead;
    this.value = value + turn * Math.round((this.value - value) / turn); // on past half a turn
    this.set(this.coordinate, STEP * Math.round(this.value / STEP));
  }

  private leave(): void {
    if (!this.coordinate) return;
    this.coordinate = "";
    this.player.picture.classList.remove("dragging");
  }
}

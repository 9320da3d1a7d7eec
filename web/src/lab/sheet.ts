// Dragging the sheet: the path of the pointer over the ground, while it is held down.

import { make } from "../dom";
import type { Player } from "./player";
import type { Row } from "./types";

const LONGEST = 12; // s
const STEP = 1 / 60; // s between rows

/** A button that lets the pointer pull the sheet instead of turning the view. */
export class SheetDrag {
  readonly button = make("button", { type: "button", class: "switch drag", "aria-pressed": "false" }, "Drag the sheet");
  private rows: Row[] = [];
  private origin: number[] = [0, 0];
  private began = 0;
  private pulling = false;

  constructor(
    private readonly player: Player,
    private readonly done: (rows: Row[]) => void,
  ) {
    this.button.addEventListener("click", () => this.arm(this.button.getAttribute("aria-pressed") !== "true"));
    const { picture } = player;
    picture.addEventListener("pointerdown", (event) => this.grip(event), { capture: true });
    picture.addEventListener("pointermove", (event) => this.pull(event));
    picture.addEventListener("pointerup", () => this.release());
    picture.addEventListener("pointercancel", () => this.release());
  }

  get armed(): boolean {
    return this.button.getAttribute("aria-pressed") === "true";
  }

  arm(on: boolean): void {
    this.button.setAttribute("aria-pressed", String(on));
    this.player.picture.classList.toggle("dragging", on);
    if (this.player.stage) this.player.stage.turns = !on;
  }

  private grip(event: PointerEvent): void {
    const place = this.armed && this.player.stage?.groundAt(event.clientX, event.clientY);
    if (!place) return;
    event.stopPropagation();
    this.player.clock?.pause();
    this.player.clock?.seek(0);
    this.player.picture.setPointerCapture(event.pointerId);
    this.pulling = true;
    this.origin = place;
    this.began = performance.now();
    this.rows = [[0, 0, 0]];
  }

  private pull(event: PointerEvent): void {
    const place = this.pulling && this.player.stage?.groundAt(event.clientX, event.clientY);
    if (!place) return;
    const time = (performance.now() - this.began) / 1000;
    const [x, y] = [place[0] - this.origin[0], place[1] - this.origin[1]];
    if (time > LONGEST) this.release();
    else if (time - this.rows[this.rows.length - 1][0] >= STEP) this.rows.push([time, x, y]);
    this.player.stage?.shift([x, y, 0]);
  }

  private release(): void {
    if (!this.pulling) return;
    this.pulling = false;
    if (this.rows.length > 4) this.done(this.rows);
  }
}

// Dragging the sheet: the path of the pointer over the ground, while it is held down, or of a point
// that arrow keys push. Meanwhile the ball is shown as the path so far, the sheet coming to rest
// after it, has it roll.

import { make } from "../dom";
import { Pose } from "../pose";
import type { PoseData, Triple } from "../scene";
import { requestNumbers } from "./requests";
import type { Player } from "../player";
import type { Row } from "./types";

const LONGEST = 12; // s
const STEP = 1 / 60; // s between rows
const AHEAD = 2; // s that the ball is followed beyond the path so far
const PUSH = 160; // pixels a second, by an arrow key
const PUSHES: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};
const STILL: Row[] = [[0, 0, 0], [0.1, 0, 0]];

interface Followed {
  duration: number;
  frames: number;
  poses: PoseData[];
}

/** The motion of the ball on the sheet, as far as it is known. */
interface Course {
  duration: number;
  frames: number;
  poses: Pose[];
}

/** A button that makes the pointer drag the sheet instead of rotating the view. */
export class SheetDrag {
  readonly button = make("button", { type: "button", class: "switch drag", "aria-pressed": "false" }, "Drag the sheet");
  private rows: Row[] = [];
  private hand = { x: 0, y: 0 };
  private gripped = { x: 0, y: 0 };
  private began = 0;
  private last = 0;
  private pulling = false;
  private readonly held = new Set<string>();
  private course: Course | null = null;
  private following = new AbortController();

  /**
   * @param wish what is to be asked for, with a path of the sheet and a duration.
   * @param done takes the path of the sheet once it is let go; it may be too short to mean anything.
   */
  constructor(
    private readonly player: Player,
    private readonly wish: (rows: Row[], duration: number) => object,
    private readonly done: (rows: Row[]) => void,
  ) {
    const { picture } = player;
    this.button.addEventListener("click", () => {
      this.arm(!this.armed);
      if (this.armed) picture.focus({ preventScroll: true });
    });
    picture.addEventListener("keydown", (event) => this.press(event));
    picture.addEventListener("keyup", ({ key }) => this.held.delete(key));
    picture.addEventListener("blur", () => this.held.clear());
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
    if (this.player.stage) this.player.stage.view.turns = !on;
    if (on && !this.pulling) void this.follow(STILL);
  }

  private grip(event: PointerEvent): void {
    if (!this.armed || !this.take(event.clientX, event.clientY)) return;
    event.stopPropagation();
    this.player.picture.setPointerCapture(event.pointerId);
  }

  /** Arrow keys push the sheet, Enter and space release it, Escape cancels. */
  private press(event: KeyboardEvent): void {
    const { key } = event;
    if (!this.armed || !(key in PUSHES || ["Enter", " ", "Escape"].includes(key))) return;
    event.preventDefault();
    event.stopPropagation();
    if (key in PUSHES) {
      const box = this.player.picture.getBoundingClientRect();
      if (this.pulling || this.take(box.x + box.width / 2, box.y + box.height / 2)) this.held.add(key);
      return;
    }
    if (key === "Escape") this.rows = [];
    if (this.pulling) this.release();
    else this.arm(false);
  }

  /** Start dragging at a point of the screen, if the ground is there. */
  private take(x: number, y: number): boolean {
    const { stage, clock } = this.player;
    if (!stage?.view.groundAt(x, y)) return false;
    clock?.pause();
    clock?.seek(0);
    stage.bare();
    this.pulling = true;
    this.hand = this.gripped = { x, y };
    this.began = this.last = performance.now();
    this.rows = [[0, 0, 0]];
    requestAnimationFrame(this.step);
    return true;
  }

  private pull(event: PointerEvent): void {
    if (this.pulling) this.hand = { x: event.clientX, y: event.clientY };
  }

  /** Displacement of the sheet since it was gripped, whether or not the camera follows the ball. */
  private moved(): Triple | null {
    const { stage } = this.player;
    const from = stage?.view.groundAt(this.gripped.x, this.gripped.y);
    const to = stage?.view.groundAt(this.hand.x, this.hand.y);
    return from && to ? [to[0] - from[0], to[1] - from[1], 0] : null;
  }

  private readonly step = (): void => {
    if (!this.pulling) return;
    const now = performance.now();
    const time = (now - this.began) / 1000;
    this.push((now - this.last) / 1000);
    this.last = now;
    const by = this.moved();
    if (by && time - this.rows[this.rows.length - 1][0] >= STEP) this.rows.push([time, by[0], by[1]]);
    if (by) this.show(time, by);
    if (time > LONGEST) this.release();
    else requestAnimationFrame(this.step);
  };

  private push(seconds: number): void {
    for (const key of this.held) {
      const [x, y] = PUSHES[key];
      this.hand = { x: this.hand.x + PUSH * seconds * x, y: this.hand.y + PUSH * seconds * y };
    }
  }

  private show(time: number, by: Triple): void {
    const { stage } = this.player;
    if (this.course) {
      const { poses, frames, duration } = this.course;
      stage?.put(poses, Math.min(time / duration, 1) * (frames - 1));
    }
    stage?.shift(by);
  }

  /** Request the motion of the ball repeatedly while the sheet is dragged, one request at a time. */
  private async follow(rows: Row[]): Promise<void> {
    this.following.abort();
    const { signal } = (this.following = new AbortController());
    let path = rows;
    while (this.armed && !signal.aborted) {
      try {
        const duration = path[path.length - 1][0] + AHEAD;
        const found = await requestNumbers<Followed>("follow", this.wish(path, duration), signal);
        this.course = { ...found, poses: found.poses.map((pose) => new Pose(pose)) };
      } catch {
        if (signal.aborted) return; // what the ball does is then told once the sheet is let go
      }
      while (this.armed && !signal.aborted && !(this.pulling && this.rows.length > 2)) await pause();
      path = [...this.rows];
      await pause();
    }
  }

  private release(): void {
    if (!this.pulling) return;
    this.pulling = false;
    this.held.clear();
    this.following.abort();
    this.course = null;
    this.done(this.rows);
  }
}

function pause(): Promise<void> {
  return new Promise((done) => setTimeout(done, 30));
}

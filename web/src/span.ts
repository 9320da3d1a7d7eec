// The part of a motion that the plots show, which wheel, fingers, keys and buttons change.

import { make } from "./dom";

const STEP = 2; // of the length, for one press
const LEAST = 12; // samples that are shown at least
const AHEAD = 0.1; // of the span behind the present time when the plots move on with it

export class Span {
  begin = 0;
  end = 0;
  private duration = 0;
  private samples = 1;

  /** @param told of every change. */
  constructor(private readonly told: () => void) {}

  /**
   * Take another motion; of the same duration, the same part stays in view.
   *
   * @param duration s.
   * @param samples of a curve.
   */
  take(duration: number, samples: number): void {
    this.samples = samples;
    if (duration === this.duration) return;
    [this.duration, this.begin, this.end] = [duration, 0, duration];
  }

  get isWhole(): boolean {
    return this.length >= this.duration;
  }

  private get length(): number {
    return this.end - this.begin;
  }

  /** Show more or less, with a time that stays where it is. */
  zoom(factor: number, about: number): void {
    const least = (LEAST * this.duration) / this.samples;
    const length = Math.min(Math.max(this.length * factor, least), this.duration);
    const share = this.length ? (about - this.begin) / this.length : 0.5;
    this.put(about - share * length, length);
  }

  pan(by: number): void {
    this.put(this.begin + by * this.length, this.length);
  }

  whole(): void {
    this.put(0, this.duration);
  }

  /** Move on with the present time. */
  follow(time: number): void {
    if (time < this.begin || time > this.end) this.put(time - AHEAD * this.length, this.length);
  }

  private put(begin: number, length: number): void {
    const first = Math.min(Math.max(begin, 0), this.duration - length);
    if (first === this.begin && first + length === this.end) return;
    this.begin = first;
    this.end = first + length;
    this.told();
  }

  /**
   * Buttons that zoom about the present time, and one that makes it play what is shown again and again.
   *
   * @param loop told whether it is to.
   */
  buttons(now: () => number, loop: (loops: boolean) => void): HTMLElement {
    const again = make("button", { type: "button", class: "switch", "aria-pressed": "false", title: "Play what the plots show again and again" }, "loop");
    again.addEventListener("click", () => {
      const loops = again.getAttribute("aria-pressed") !== "true";
      again.setAttribute("aria-pressed", String(loops));
      loop(loops);
    });
    const button = (text: string, label: string, act: () => void): HTMLElement => {
      const made = make("button", { type: "button", class: "switch", "aria-label": label, title: label }, text);
      made.addEventListener("click", act);
      return made;
    };
    return make(
      "div",
      { class: "zooming", role: "group", "aria-label": "Time shown by the plots" },
      button("+", "Plots: zoom in", () => this.zoom(1 / STEP, this.nearest(now()))),
      button("−", "Plots: zoom out", () => this.zoom(STEP, this.nearest(now()))),
      button("whole", "Plots: the whole motion", () => this.whole()),
      again,
    );
  }

  /** Wheel and fingers over a plot, and keys while it has the focus. */
  listen(plot: HTMLElement, timeAt: (x: number) => number): void {
    plot.addEventListener("wheel", (event) => this.wheel(event, plot, timeAt), { passive: false });
    plot.addEventListener("keydown", (event) => this.key(event));
    plot.addEventListener("dblclick", () => this.whole());
    this.pinch(plot, timeAt);
  }

  /** Without a focus or the control key, which a pinch on a touchpad sends, the wheel scrolls the page. */
  private wheel(event: WheelEvent, plot: HTMLElement, timeAt: (x: number) => number): void {
    const isMeant = event.ctrlKey || plot.contains(document.activeElement);
    if (!isMeant) return;
    event.preventDefault();
    if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) this.pan(event.deltaX / plot.clientWidth);
    else this.zoom(Math.exp(event.deltaY / (event.ctrlKey ? 100 : 400)), timeAt(event.clientX));
  }

  private key(event: KeyboardEvent): void {
    const acts: Record<string, () => void> = {
      "+": () => this.zoom(1 / STEP, (this.begin + this.end) / 2),
      "-": () => this.zoom(STEP, (this.begin + this.end) / 2),
      "0": () => this.whole(),
      PageUp: () => this.pan(-1 / STEP),
      PageDown: () => this.pan(1 / STEP),
    };
    const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : acts[event.key];
    if (!act) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  }

  private pinch(plot: HTMLElement, timeAt: (x: number) => number): void {
    const fingers = new Map<number, number>();
    const apart = (): number => {
      const [one, other] = [...fingers.values()];
      return Math.max(Math.abs(one - other), 1);
    };
    plot.addEventListener("pointerdown", (event) => fingers.set(event.pointerId, event.clientX));
    for (const end of ["pointerup", "pointercancel", "pointerleave"] as const) {
      plot.addEventListener(end, (event) => fingers.delete(event.pointerId));
    }
    plot.addEventListener("pointermove", (event) => {
      if (fingers.size !== 2 || !fingers.has(event.pointerId)) return;
      const before = apart();
      fingers.set(event.pointerId, event.clientX);
      const [one, other] = [...fingers.values()];
      this.zoom(before / apart(), timeAt((one + other) / 2));
    });
  }

  /** The present time if it is in view, or else the middle. */
  private nearest(time: number): number {
    return time >= this.begin && time <= this.end ? time : (this.begin + this.end) / 2;
  }
}

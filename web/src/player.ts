// The picture with its clock and plots, in which one motion replaces another.

import { makeFallback } from "./fallback";
import { Clock, rates } from "./clock";
import { keys, switches, transport } from "./controls";
import { NoWebGL } from "./display";
import { make } from "./dom";
import { Plots } from "./plots";
import { Portraits } from "./portraits";
import type { AccountData, BodyData, SceneData } from "./scene";
import { Stage } from "./stage";
import { modeStrip } from "./strip";

export class Player {
  readonly picture = make("div", { class: "picture", tabindex: 0, role: "application", "aria-label": "Picture in three dimensions. Arrow keys turn the view, plus and minus zoom, space plays." });
  private readonly mark = make("p", { class: "mark", hidden: true }, "Out of date");
  readonly theatre = make("section", { class: "theatre", "aria-label": "Motion" }, this.picture);
  readonly plots = make("section", { class: "plots", "aria-label": "Plots against time" });
  private readonly drawn = new Plots(this.plots);
  private readonly portraits = new Portraits();
  stage: Stage | null = null;
  clock: Clock | null = null;
  private system = "";
  private bodies: BodyData[] = [];
  private listening = new AbortController();
  private blind = false;
  private resumes = false;
  private readonly dark = matchMedia("(prefers-color-scheme: dark)");

  constructor() {
    this.picture.append(this.mark);
    this.dark.addEventListener("change", () => {
      this.drawn.theme();
      this.stage?.theme(this.dark.matches);
    });
  }

  /** Play a motion; for the same system the clock keeps its time. The picture is drawn immediately. */
  show(scene: SceneData, system: string): void {
    const same = system === this.system;
    this.system = system;
    this.bodies = scene.bodies;
    this.setOutdated(false);
    const clock = this.follower(scene, same);
    if (this.resumes && same) clock.play();
    this.resumes = false;
    this.stage = this.staged(scene, same);
    const { stage } = this;
    if (!stage) return;
    clock.onChange(({ time }) => stage.seek(time));
    stage.theme(this.dark.matches);
    stage.drawNow();
  }

  /** Stop the motion that is shown, if there is one, and mark it as one of other numbers, until the next is shown. */
  setOutdated(outdated: boolean): boolean {
    const marked = outdated && this.clock !== null;
    if (marked && this.clock?.playing) {
      this.resumes = true;
      this.clock.pause();
    }
    this.mark.hidden = !marked;
    for (const part of [this.theatre, this.plots]) part.classList.toggle("outdated", marked);
    return marked;
  }

  /** The controls for the present motion. */
  furnish(): void {
    const { clock, stage } = this;
    if (!clock) return;
    this.controls(clock);
    this.listening.abort();
    this.listening = new AbortController();
    keys(clock, this.picture, stage, this.listening.signal);
  }

  /** Plots and contact modes of the present motion. */
  plot({ panels, portraits, modes }: Pick<AccountData, "panels" | "portraits" | "modes">): void {
    if (!this.clock) return;
    this.drawn.show(panels, this.clock);
    this.portraits.show(portraits, this.bodies, this.clock);
    this.plots.append(this.portraits.element); // after the plots, also where those are new
    this.theatre.querySelector(".modes")?.remove();
    this.theatre.append(...modeStrip(modes, this.clock));
  }

  private follower(scene: SceneData, same: boolean): Clock {
    const before = this.clock;
    const still = same && before?.duration === scene.duration;
    const clock = new Clock(scene.duration, still && before ? before.rate : rates(scene.duration).usual);
    if (before && same) {
      clock.time = Math.min(before.time, scene.duration);
      if (before.playing) clock.play();
      before.stop();
    }
    this.clock = clock;
    return clock;
  }

  private staged(scene: SceneData, same: boolean): Stage | null {
    if (this.blind) return null;
    try {
      return new Stage(scene, this.picture, this.stage ?? undefined, same);
    } catch (error) {
      if (!(error instanceof NoWebGL)) throw error;
      this.blind = true;
      makeFallback(this.picture, "Plots, sliders and numbers");
      return null;
    }
  }

  /** The rows under the picture, with the keyboard focus kept. */
  private controls(clock: Clock): void {
    const held = (): HTMLElement[] => [...this.theatre.querySelectorAll<HTMLElement>(".controls :is(button, input, select)")];
    const focused = held().indexOf(document.activeElement as HTMLElement);
    const rows = make("div", { class: "controls" }, ...(this.stage ? [switches(this.stage, clock)] : []), transport(clock));
    this.theatre.querySelector(".controls")?.remove();
    this.picture.after(rows);
    if (focused >= 0) held()[focused]?.focus();
  }
}

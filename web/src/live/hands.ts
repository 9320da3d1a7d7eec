// Takes hold of a body in the picture: dragged, it is moved to another start, or pushed.

import { Vector3 } from "three";
import { digits, make } from "../dom";
import type { Player } from "../player";
import { reach } from "../reach";
import type { Hand, Handled } from "./hand";
import type { Numbers } from "./model";

type Use = "view" | "move" | "push";

const USES: Record<Use, [string, string]> = {
  view: ["Turn view", "Dragging turns the view"],
  move: ["Move", "Dragging a body moves it to another start"],
  push: ["Push", "Dragging a body pushes it: it starts anew from there, with an impulse at that point"],
};
const GRAVITY = 9.81; // m/s²: a pull of one body size is the speed after a fall from half of that
const SHORTEST = 5; // pixels of a push

/** The page whose motion a hand changes. */
export interface Handling {
  readonly isTimed: boolean;
  numbers(): Numbers;
  handle(numbers: Numbers, hand: Hand): Promise<Handled>;
  /** Follow the motion from another start. */
  restart(handled: Handled): void;
  /** See the motion as usual again. */
  release(): void;
  say(text: string): void;
}

/** What is held. */
interface Held {
  body: number;
  pointer: number;
  /** Size of the body, m. */
  size: number;
  /** The point that is pushed. */
  point: Vector3;
  /** Where the centre of the body is on the screen, against the pointer; pixels. */
  aside: [number, number];
  /** Of which the start is changed; null until it is known. */
  numbers: Numbers | null;
  pushes: boolean;
}

export class Hands {
  private use: Use = "view";
  private held: Held | null = null;
  private wanted: [number, number] | null = null;
  private begun: Promise<void> = Promise.resolve();
  private working: Promise<void> | null = null;
  private readonly label = make("span", { class: "impulse" });
  private readonly arrow = make("div", { class: "pull", hidden: true }, make("span", { class: "shaft" }), this.label);

  constructor(
    private readonly player: Player,
    private readonly page: Handling,
  ) {
    const { picture } = player;
    const buttons = (Object.keys(USES) as Use[]).map((use) => this.button(use));
    picture.append(make("div", { class: "hands", role: "group", "aria-label": "What dragging does" }, ...buttons), this.arrow);
    // before the picture turns with the pointer
    picture.addEventListener("pointerdown", (event) => this.take(event), { capture: true });
    addEventListener("pointermove", (event) => this.drag(event));
    for (const end of ["pointerup", "pointercancel"] as const) addEventListener(end, (event) => this.leave(event));
  }

  private button(use: Use): HTMLElement {
    const [text, title] = USES[use];
    const button = make("button", { type: "button", class: "switch", title, "aria-pressed": String(use === this.use), "data-use": use }, text);
    button.addEventListener("click", () => {
      this.use = use;
      const { picture } = this.player;
      for (const other of picture.querySelectorAll<HTMLElement>("[data-use]")) other.setAttribute("aria-pressed", String(other.dataset.use === use));
      picture.dataset.drags = use;
    });
    return button;
  }

  private take(event: PointerEvent): void {
    const { clock, stage, picture } = this.player;
    const target = event.target as HTMLElement;
    if (target.closest(".hands")) return event.stopPropagation(); // or the view would turn with it
    if (this.use === "view" || this.held || !clock || !stage || target.closest(".letter[data-coordinate]")) return;
    if (!stage.bodyAt(event.clientX, event.clientY)) return;
    event.stopPropagation();
    event.preventDefault();
    picture.focus();
    clock.pause();
    if (this.page.isTimed) clock.seek(0); // another motion would follow from a later start
    const found = stage.bodyAt(event.clientX, event.clientY);
    if (!found) return;
    const [x, y] = stage.view.seenAt(stage.placeOf(found.body));
    this.held = {
      body: found.body,
      pointer: event.pointerId,
      size: reach(stage.scene.bodies[found.body]),
      point: found.point,
      aside: [x - event.clientX, y - event.clientY],
      numbers: null,
      pushes: this.use === "push",
    };
    stage.view.held = true;
    picture.classList.add("dragging");
    this.begun = this.begin(this.held, clock.time);
  }

  /** Start anew from an instant of the motion. */
  private async begin(held: Held, time: number): Promise<void> {
    try {
      const numbers = this.page.numbers();
      const found = await this.page.handle(numbers, { kind: "take", time });
      if (time) this.page.restart(found);
      held.numbers = { ...numbers, start: found.start, begin: found.begin };
      await this.work();
    } catch (error) {
      this.page.say((error as Error).message);
      this.drop();
    }
  }

  private drag(event: PointerEvent): void {
    if (event.pointerId !== this.held?.pointer) return;
    this.wanted = [event.clientX, event.clientY];
    this.draw(event.clientX, event.clientY);
    void this.work();
  }

  /** Bring about what the pointer wants now; what it wanted meanwhile is left out. */
  private work(): Promise<void> {
    this.working ??= this.worked().finally(() => (this.working = null));
    return this.working;
  }

  private async worked(): Promise<void> {
    while (this.held?.numbers && this.wanted) {
      const { held, wanted } = this;
      const { numbers } = this.held;
      this.wanted = null;
      const hand = this.hand(held, wanted);
      if (!hand) continue;
      try {
        const found = await this.page.handle(numbers, hand);
        const told = found.impulse ? `${digits(found.impulse, 2)} N s` : "this point does not move";
        this.label.textContent = held.pushes ? told : "";
        if (!held.pushes) held.numbers = { ...numbers, start: found.start, begin: found.begin };
        this.page.restart(found);
      } catch (error) {
        this.page.say((error as Error).message);
      }
    }
  }

  private hand({ body, size, point, aside, pushes }: Held, [x, y]: [number, number]): Hand | null {
    const { stage } = this.player;
    if (!stage) return null;
    if (!pushes) {
      const { origin, direction } = stage.view.sight(x + aside[0], y + aside[1]);
      return { kind: "move", body, size, sight: { origin: origin.toArray(), direction: direction.toArray() } };
    }
    const tip = stage.view.facing(x, y, point);
    if (!tip) return null;
    const change = tip.sub(point).multiplyScalar(Math.sqrt(GRAVITY / size));
    return { kind: "push", body, point: point.toArray(), change: change.toArray() };
  }

  /** An arrow from the point that is pushed to the pointer. */
  private draw(x: number, y: number): void {
    const { held, arrow } = this;
    const { stage, picture } = this.player;
    if (!held?.pushes || !stage) return;
    const box = picture.getBoundingClientRect();
    const [fromX, fromY] = stage.view.seenAt(held.point.toArray());
    const [along, over] = [x - fromX, y - fromY];
    arrow.hidden = Math.hypot(along, over) < SHORTEST;
    arrow.style.transform = `translate(${fromX - box.left}px, ${fromY - box.top}px)`;
    const shaft = arrow.firstElementChild as HTMLElement;
    shaft.style.width = `${Math.hypot(along, over)}px`;
    shaft.style.transform = `rotate(${Math.atan2(over, along)}rad)`;
    this.label.style.transform = `translate(${along}px, ${over}px) translate(0.8rem, -50%)`;
  }

  private leave(event: PointerEvent): void {
    if (event.pointerId !== this.held?.pointer) return;
    const isPush = this.held.pushes && !this.arrow.hidden;
    void this.finish(isPush);
  }

  /** Let go once the last wish is granted; what was pushed moves on. */
  private async finish(plays: boolean): Promise<void> {
    await this.begun;
    await this.work();
    this.drop();
    if (plays) this.player.clock?.play();
  }

  private drop(): void {
    this.held = this.wanted = null;
    this.arrow.hidden = true;
    this.label.textContent = "";
    this.player.picture.classList.remove("dragging");
    if (this.player.stage) this.player.stage.view.held = false;
    this.page.release();
  }
}

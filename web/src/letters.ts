// Letters beside what they name in the picture: text, which a formula's font and a screen draw best.

import { type PerspectiveCamera, Vector3 } from "three";
import { formula, make } from "./dom";

const BESIDE = 13; // pixels between a point and the middle of its letter
const EDGE = 4; // pixels between a letter and the edge of the picture

/** A letter that stays at a place, on the far side of another one. */
export class Letter {
  readonly place = new Vector3();
  readonly from = new Vector3();
  readonly element: HTMLElement;
  shown = false;
  private size: [number, number] | null = null;

  /** @param text MathML, or words. */
  constructor(text: string, kind: string) {
    this.element = make("span", { class: `letter ${kind}` }, text.startsWith("<math") ? formula(text) : text);
  }

  /** Half its width and height, in pixels. */
  half(): [number, number] {
    this.size ??= [this.element.offsetWidth / 2, this.element.offsetHeight / 2];
    return this.size;
  }
}

export class Letters {
  readonly element = make("div", { class: "letters", "aria-hidden": "true" });
  private readonly letters: Letter[] = [];
  private readonly point = new Vector3();

  add(letter: Letter): Letter {
    this.letters.push(letter);
    this.element.append(letter.element);
    return letter;
  }

  /** Put every letter where the camera sees its place, none above another. */
  update(camera: PerspectiveCamera, width: number, height: number): void {
    const put: Spot[] = [];
    for (const letter of this.letters) {
      const [x, y, isAhead] = this.seen(letter.place, camera, width, height);
      const isSeen = isAhead && x > 0 && x < width && y > 0 && y < height;
      letter.element.hidden = !letter.shown || !isSeen;
      if (letter.element.hidden) continue;
      const [fromX, fromY] = this.seen(letter.from, camera, width, height);
      const away = Math.hypot(x - fromX, y - fromY);
      const [aside, over] = away > 1 ? [(x - fromX) / away, (y - fromY) / away] : [0.7, -0.7];
      const spot = { x: x + BESIDE * aside, y: y + BESIDE * over, half: letter.half() };
      spot.x = within(spot.x, spot.half[0], width);
      spot.y = within(spot.y, spot.half[1], height);
      for (const other of put) makeRoom(spot, other);
      put.push(spot);
      letter.element.style.transform = `translate(${spot.x.toFixed(1)}px, ${spot.y.toFixed(1)}px) translate(-50%, -50%)`;
    }
  }

  private seen(place: Vector3, camera: PerspectiveCamera, width: number, height: number): [number, number, boolean] {
    const { x, y, z } = this.point.copy(place).project(camera);
    return [((x + 1) * width) / 2, ((1 - y) * height) / 2, Math.abs(z) < 1];
  }
}

/** A middle with room for half the letter on either side, within the picture. */
const within = (middle: number, half: number, size: number): number => Math.min(Math.max(middle, half + EDGE), size - half - EDGE);

type Spot = { x: number; y: number; half: [number, number] };

/** Move a letter off another one, by the shorter way. */
function makeRoom(spot: Spot, other: Spot): void {
  const aside = spot.half[0] + other.half[0] - Math.abs(spot.x - other.x);
  const over = spot.half[1] + other.half[1] - Math.abs(spot.y - other.y);
  if (aside <= 0 || over <= 0) return;
  if (aside < over) spot.x += spot.x < other.x ? -aside : aside;
  else spot.y += spot.y < other.y ? -over : over;
}

// Closed loops: coordinates at the start that follow from the others.

import { NoModeError } from "./errors";
import { dot, inRows, plus, solved as solution, transposed, type Vector } from "./linear";
import type { LiveData, Numbers } from "./model";
import type { Modes } from "./modes";

const STAGES = 32; // between the numbers that the page opens with and others
const STEPS = 30; // of Newton's method in each
const CLOSED = 1e-9; // rad or m: with a smaller error of the coordinates the loops count as closed

/** Coordinates and speeds at the start, of which the loops determine some coordinates. */
export class Loops {
  private readonly opening: Pick<Numbers, "parameters" | "start">;

  constructor(
    private readonly live: LiveData,
    private readonly modes: Modes,
  ) {
    const values = (kind: "parameters" | "start"): Vector => live[kind].map(({ value, size }) => value * size);
    this.opening = { parameters: values("parameters"), start: values("start") };
  }

  /**
   * The start with closed loops, for the parameters that the modes then have.
   *
   * From the numbers that the page opens with on, the bodies are taken along: so links with the same numbers
   * have the same of the configurations that close the loops, however the sliders came there.
   */
  closed({ parameters, start }: Numbers): Vector {
    const { solved } = this.live.loops;
    const given = start.map((value, i) => (solved.includes(i) ? this.opening.start[i] : value));
    const isOpening = given.every((value, i) => value === this.opening.start[i]) && parameters.every((value, i) => value === this.opening.parameters[i]);
    if (!solved.length || isOpening) return given;
    let found = this.opening.start;
    for (let stage = 1; stage <= STAGES; stage++) {
      const between = (from: Vector, to: Vector): Vector => (stage === STAGES ? to : plus(from, plus(to, from, -1), stage / STAGES));
      this.modes.begin(between(this.opening.parameters, parameters));
      const others = between(this.opening.start, given);
      found = this.newton(others.map((value, i) => (solved.includes(i) ? found[i] : value)));
    }
    return found;
  }

  private newton(from: Vector): Vector {
    const { solved } = this.live.loops;
    let [found, left] = [from, this.missed(from)];
    let slopes = this.slopes(found);
    for (let step = 0; step < STEPS && left.some((gap) => gap !== 0); step++) {
      const columns = transposed(slopes);
      const shares = solution(columns.map((one) => columns.map((other) => dot(one, other))), columns.map((one) => dot(one, left)));
      const next = found.map((value, i) => value - (shares[solved.indexOf(i)] ?? 0));
      const after = this.missed(next);
      if (!(Math.hypot(...after) < Math.hypot(...left))) break;
      [found, left, slopes] = [next, after, this.slopes(next)];
    }
    const steepest = Math.max(...slopes.flat().map(Math.abs));
    if (!(Math.max(...left.map(Math.abs)) <= CLOSED * steepest)) throw new NoModeError("The bodies cannot be joined at the start: with these numbers the loop does not close.");
    return found;
  }

  private missed(start: Vector): Vector {
    return this.modes.shownAtStart(start, this.live.loops.gaps);
  }

  private slopes(start: Vector): Vector[] {
    return inRows(this.modes.shownAtStart(start, this.live.loops.slopes), this.live.loops.solved.length);
  }
}

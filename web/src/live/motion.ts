// One motion: integrated through contact modes, and everything shown along it.

import { BROKEN, compiled, FALL, GOING, type Kernel } from "./kernel";
import type { ModeSpan } from "../scene";
import type { LiveData, Numbers } from "./model";
import { NoModeError } from "./errors";
import { Loops } from "./loops";
import { type Entry, Modes } from "./modes";
import { Onset, type Step } from "./onset";

const MOST = 400_000; // steps
const MOST_CHANGES = 5000;
const PATIENCE = 8000; // ms
const SLIP = 1e-5; // of a slip at the beginning of a search for its end, below which the next search begins
const GROWN = 10; // times a slip grows before it is watched against its new size
const FEW = 8; // steps of a call in which a slip may grow
const FAR = 1.5; // of the time in which a slip would end at its present rate: no step is longer
const ALMOST = 1e-8; // of its largest size: a slip that cannot be followed any further has ended
const SOON = 1e-12; // s before a slip ends, where its series is too steep for doubles: its end is on a straight line
const AT_ONCE = 32; // changes of mode that take no time: none lasts
const NO_TIME = 1e-11; // of the duration

export interface Happening {
  time: number;
  kind: string;
  /** The contact mode that follows. */
  mode: string;
}

/** Why a motion ends: in the words of an event, or "" where it has reached its time. */
export interface Ending {
  kind: "goal" | "event" | "broken" | "long";
  what: string;
}

/** The search for the end of a slip: its size at the beginning, the largest so far, and whether it is about to end. */
interface Search {
  slip: number;
  largest: number;
  isLast: boolean;
}

interface Stretch {
  mode: number;
  /** Its place in the schedule of prescribed motions. */
  held: number;
  steps: Step[];
  begin: number;
  start: number[];
}

/** A motion at equally spaced instants from 0 to its end. */
export class Motion {
  private readonly width: number;

  constructor(
    readonly end: number,
    readonly ending: Ending,
    readonly happenings: Happening[],
    readonly modes: ModeSpan[],
    /** How many steps it took. */
    readonly steps: number,
    readonly frames: number,
    /** All outputs at one instant after the other. */
    readonly values: Float64Array,
    /** Friction over normal force, at the start and at most, of a motion that rolls throughout. */
    readonly needed: [number, number] | null = null,
  ) {
    this.width = values.length / frames;
  }

  /** An output along the motion. */
  column(output: number): Float64Array {
    return Float64Array.from({ length: this.frames }, (_, i) => this.values[i * this.width + output]);
  }

  /** Several outputs, row by row. */
  rows(outputs: number[]): Float64Array {
    const found = new Float64Array(this.frames * outputs.length);
    for (let i = 0; i < this.frames; i++) {
      for (let k = 0; k < outputs.length; k++) found[i * outputs.length + k] = this.values[i * this.width + outputs[k]];
    }
    return found;
  }

  /** Outputs that depend on parameters alone. */
  constants(outputs: number[]): number[] {
    return outputs.map((output) => this.values[output]);
  }

  time(frame: number): number {
    return this.frames > 1 ? (frame / (this.frames - 1)) * this.end : 0;
  }
}

export class Engine {
  private readonly modes: Modes;
  private readonly loops: Loops;

  private constructor(
    private readonly live: LiveData,
    module: WebAssembly.Module,
  ) {
    this.modes = new Modes(live, module);
    this.loops = new Loops(live, this.modes);
  }

  static async of(live: LiveData): Promise<Engine> {
    return new Engine(live, await compiled(live.code));
  }

  /** The motion with some numbers, at so many instants. Throws, in words, for a start that is impossible. */
  follow(numbers: Numbers, frames: number): Motion {
    return this.sampled(this.course(numbers, numbers.duration), frames);
  }

  private course(numbers: Numbers, duration: number): Course {
    const start = this.closed(numbers);
    const course = new Course(this.live, this.modes, duration);
    course.run({ ...numbers, start });
    return course;
  }

  /** The start with closed loops, and its parameters taken. */
  private closed(numbers: Numbers): number[] {
    const start = numbers.begin ? numbers.start : this.loops.closed(numbers);
    this.begin(numbers.parameters);
    return start;
  }

  /** Take the parameters of a motion. */
  begin(parameters: number[]): void {
    this.modes.begin(parameters);
  }

  /** The mode from whose coordinates and speeds a hand lets motions begin: flight, where there are several. */
  get widest(): number {
    return this.live.contact === null ? 0 : this.modes.flight(false);
  }

  /** The coordinates and speeds of the widest mode in a motion at an instant. */
  takenAt(numbers: Numbers, time: number): number[] {
    const isOnly = this.live.contact === null;
    if (!time && numbers.begin) return numbers.begin;
    if (!time && isOnly) return this.closed(numbers);
    const { mode, state } = time ? this.reached(numbers, time) : this.modes.initial(this.closed(numbers));
    if (isOnly) return state.slice(0, this.live.start.length);
    const { coordinates, speeds } = this.modes.shared(mode, state, time);
    return [...coordinates, ...speeds];
  }

  private reached(numbers: Numbers, time: number): { mode: number; state: number[] } {
    const course = this.course(numbers, time);
    const { mode, steps, start } = course.stretches[course.stretches.length - 1];
    const step = steps[steps.length - 1];
    return { mode, state: step ? Array.from(step.at((course.end - step.begin) / step.length)) : start };
  }

  /** What the sliders of the start show for coordinates and speeds of the widest mode. */
  startOf(begin: number[]): number[] {
    if (this.live.contact === null) return begin;
    const { mode, state } = this.modes.resumed(begin);
    const values = new Float64Array(this.live.outputs);
    this.modes.viewer(mode).valuesAt(state, 0, values, 0, values.length);
    return this.live.states.map((output) => values[output]);
  }

  /** Outputs of the widest mode at coordinates and speeds of it. */
  outputsAt(begin: number[]): Float64Array {
    const { widest } = this;
    const viewer = this.modes.viewer(widest);
    const values = new Float64Array(viewer.data.outputs.length);
    viewer.valuesAt(this.modes.whole(widest, begin, 0), 0, values);
    return values;
  }

  /** Outputs of the first mode at values of two states, for the parameters of the last motion; row by row. */
  pointsAt([u, v]: [number, number], [us, vs]: [number[], number[]], outputs: number[]): number[] {
    const viewer = this.modes.viewer(0);
    const state = new Float64Array(viewer.data.states[1]);
    const values = new Float64Array(viewer.data.outputs.length);
    return us.flatMap((value, i) => {
      [state[u], state[v]] = [value, vs[i]];
      viewer.valuesAt(state, 0, values);
      return outputs.map((output) => values[output]);
    });
  }

  private sampled(course: Course, frames: number): Motion {
    const { stretches, end } = course;
    const width = this.live.outputs;
    const values = new Float64Array(frames * width);
    const rolls = this.live.friction !== "" && stretches.every(({ mode }) => this.live.modes[mode].phase === "rolling");
    const ratios: number[] = [];
    let [stretch, step, held] = [0, 0, -1];
    for (let i = 0; i < frames; i++) {
      const time = frames > 1 ? (i / (frames - 1)) * end : 0;
      while (stretch + 1 < stretches.length && time >= stretches[stretch + 1].begin) [stretch, step] = [stretch + 1, 0];
      const { mode, held: place, steps, start } = stretches[stretch];
      if (place !== held) this.modes.hold(place);
      held = place;
      while (step + 1 < steps.length && time >= steps[step + 1].begin) step += 1;
      const now = steps.length ? steps[step].at((time - steps[step].begin) / steps[step].length) : start;
      this.modes.viewer(mode).valuesAt(now, time, values, i * width, width);
      if (rolls) ratios.push(this.modes.friction(mode, Array.from(now), time));
    }
    const needed: [number, number] | null = rolls ? [ratios[0], Math.max(...ratios)] : null;
    return new Motion(end, course.ending, course.happenings, course.spans((mode) => this.live.modes[mode].name), course.steps, frames, values, needed);
  }
}

/** A motion from mode to mode. */
class Course {
  readonly stretches: Stretch[] = [];
  readonly happenings: Happening[] = [];
  end = 0;
  ending: Ending = { kind: "goal", what: "" };
  private readonly since = performance.now();
  steps = 0;
  private held = 0; // place in the schedule of prescribed motions

  constructor(
    private readonly live: LiveData,
    private readonly modes: Modes,
    private readonly duration: number,
  ) {}

  run({ start, begin }: Numbers): void {
    const changes = this.live.contact !== null;
    const first = (): Entry => (begin ? this.modes.resumed(begin) : this.modes.initial(start));
    let entry: Entry | null = changes ? first() : this.only(start);
    while (entry) entry = this.through(entry, changes);
  }

  /** The entry into a mode that has no other. */
  private only(start: number[]): Entry {
    const state = this.modes.whole(0, start, 0);
    this.modes.refuseImpossibleMasses(0, state);
    this.modes.refuseEnded(0, state);
    return { mode: 0, time: 0, state };
  }

  /** Follow one mode; the entry into the next, if there is one. */
  private through(entry: Entry, changes: boolean): Entry | null {
    const { mode } = entry;
    const { watched, name } = this.modes.data(mode);
    const stretch: Stretch = { mode, held: this.held, steps: [], begin: entry.time, start: entry.state };
    this.stretches.push(stretch);
    let what = "";
    try {
      const last = this.integrated(entry, stretch);
      this.end = last.time;
      if (last.guard < 0) return this.isOver() ? null : this.scheduled(mode, last.state);
      const { kind, ends } = watched[last.guard];
      if (ends || !changes) return this.over("event", kind, name);
      if (this.happenings.length >= MOST_CHANGES) return this.over("long", "", name);
      if (this.standsStill()) return this.over("broken", "", name);
      what = `${kind}, and `;
      const next = this.modes.next(kind, mode, last.state, last.time);
      this.happenings.push({ time: last.time, kind: next.kind, mode: this.modes.data(next.entry.mode).name });
      return next.entry;
    } catch (error) {
      if (!(error instanceof NoModeError)) throw error;
      return this.over("event", `${what}${error.message.charAt(0).toLowerCase()}${error.message.slice(1, -1)}`, name);
    }
  }

  /** The contact modes one after the other; stays in the same one are joined. */
  spans(nameOf: (mode: number) => string): ModeSpan[] {
    const found: ModeSpan[] = [];
    this.stretches.forEach(({ mode, begin }, i) => {
      const end = this.stretches[i + 1]?.begin ?? this.end;
      const last = found[found.length - 1];
      if (last?.name === nameOf(mode)) last.end = end;
      else if (end > begin) found.push({ name: nameOf(mode), begin, end });
    });
    return found;
  }

  private isOver(): boolean {
    return this.ending.kind !== "goal" || this.end >= this.duration;
  }

  /** Go on with the next coefficients of prescribed motions. */
  private scheduled(mode: number, state: number[]): Entry {
    this.held += 1;
    if (!this.live.schedule.jerks[this.held] || this.live.contact === null) {
      this.modes.hold(this.held);
      return { mode, time: this.end, state };
    }
    const entry = this.modes.jerk(mode, state, this.end, this.held);
    this.happenings.push({ time: this.end, kind: "jerk", mode: this.modes.data(entry.mode).name });
    return entry;
  }

  /** Until when the present coefficients hold, s. */
  private get goal(): number {
    return Math.min(this.duration, this.live.schedule.times[this.held + 1] ?? Infinity);
  }

  private over(kind: Ending["kind"], what: string, mode: string): null {
    this.ending = { kind, what };
    if (kind === "event") this.happenings.push({ time: this.end, kind: what, mode });
    return null;
  }

  private standsStill(): boolean {
    const before = this.happenings[this.happenings.length - AT_ONCE];
    return before !== undefined && this.end - before.time <= NO_TIME * this.duration;
  }

  /** Steps within a mode, until a guard falls for good or the motion ends. */
  private integrated(entry: Entry, stretch: Stretch): { state: number[]; time: number; guard: number } {
    const { mode } = entry;
    const { slips, watched, fewest } = this.modes.data(mode);
    const kernel = this.modes.integrator(mode);
    const sticks = slips.length ? watched.findIndex(({ kind }) => kind === "sticks") : -1;
    let { state, time } = entry;
    if (entry.onset !== undefined && this.live.radau) {
      const begun = new Onset(this.modes, this.live.radau, entry).follow(this.goal);
      stretch.steps.push(...begun.steps);
      [state, time] = [begun.state, begun.time];
      if (begun.hasEnded) return { state, time, guard: sticks };
      if (time >= this.goal) return { state, time, guard: -1 };
    }
    let search = this.restart(kernel, mode, state, time, 0);
    for (;;) {
      const longest = this.duration / fewest;
      const found = slips.length ? kernel.advance(this.goal, Math.min(longest, this.sliding(mode, state, time)), FEW) : kernel.advance(this.goal, longest);
      const count = state.length;
      found.series.forEach((series, i) => stretch.steps.push({ begin: found.begins[i], length: found.lengths[i], at: (share) => stateAt(series, share, count) }));
      this.steps += found.begins.length;
      [state, time] = [found.state, found.end];
      const [slip] = this.slip(mode, state, time);
      const isAlmostOver = slips.length > 0 && slip < ALMOST * search.largest;
      if (found.status === FALL) {
        if (found.fallen !== sticks) return { state, time, guard: found.fallen };
        if (search.isLast) return { ...this.stopped(mode, state, time), guard: sticks };
        search = this.restart(kernel, mode, state, time, search.largest);
      } else if (found.status === BROKEN) {
        return isAlmostOver ? { state, time, guard: sticks } : this.stop("broken", "", state, time);
      } else if (found.status !== GOING) return { state, time, guard: -1 };
      else if (slip > GROWN * search.slip) search = this.restart(kernel, mode, state, time, search.largest);
      if (slips.length && this.modes.freedom(mode, state, time) <= 0) return this.stop("event", "sliding jams (Painlevé's paradox)", state, time);
      if (this.steps > MOST || performance.now() - this.since > PATIENCE) return this.stop("long", "", state, time);
    }
  }

  private stop(kind: Ending["kind"], what: string, state: number[], time: number): { state: number[]; time: number; guard: number } {
    this.ending = { kind, what };
    return { state, time, guard: -1 };
  }

  /**
   * Start a kernel from a state. A slip is watched until it is much smaller than there, or about to end.
   * @param largest slip so far.
   */
  private restart(kernel: Kernel, mode: number, state: number[], time: number, largest: number): Search {
    const [slip, rate] = this.slip(mode, state, time);
    const soon = SOON * rate;
    const isLast = SLIP * slip <= soon && slip > 2 * soon && slip < largest / 2;
    kernel.start(this.modes.bounded((isLast ? soon : SLIP * slip) ** 2), state, time);
    return { slip, largest: Math.max(slip, largest), isLast };
  }

  /** How far a step may go while a contact slides: beyond the end of the slip, its small values would be lost beside the others, s. */
  private sliding(mode: number, state: number[], time: number): number {
    const [slip, rate] = this.slip(mode, state, time);
    return rate ? (FAR * slip) / rate : Infinity;
  }

  /** The speed of slip, and the size of its rate. */
  private slip(mode: number, state: number[], time: number): [number, number] {
    const { slips } = this.modes.data(mode);
    if (!slips.length) return [0, 0];
    const rates = this.modes.rates(mode, state, time);
    return [Math.hypot(...slips.map((place) => state[place])), Math.hypot(...slips.map((place) => rates[place]))];
  }

  /** Where a slip that is about to end has ended. */
  private stopped(mode: number, state: number[], time: number): { state: number[]; time: number } {
    const [slip, rate] = this.slip(mode, state, time);
    const left = slip / rate;
    const rates = this.modes.rates(mode, state, time);
    return { state: state.map((value, i) => value + left * rates[i]), time: time + left };
  }
}

/** A state from its series, by Horner's rule. */
function stateAt(series: Float64Array, share: number, count: number): Float64Array {
  const length = series.length / count;
  return Float64Array.from({ length: count }, (_, i) => {
    let sum = 0;
    for (let k = length - 1; k >= 0; k--) sum = sum * share + series[i * length + k];
    return sum;
  });
}

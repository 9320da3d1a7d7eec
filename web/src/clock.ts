// The clock that picture, plots and slider share.

type Listener = (clock: Clock) => void;

export class Clock {
  time = 0;
  playing = false;
  /** Instants between which it plays again and again; null for once to the end. */
  loop: [number, number] | null = null;
  private last = 0;
  private readonly listeners: Listener[] = [];

  constructor(
    readonly duration: number,
    public rate: number,
  ) {}

  onChange(listener: Listener): void {
    this.listeners.push(listener);
    listener(this);
  }

  seek(time: number): void {
    this.time = Math.min(Math.max(time, 0), this.duration);
    this.tell();
  }

  play(): void {
    if (this.time >= this.duration) this.time = 0;
    this.playing = true;
    this.last = performance.now();
    requestAnimationFrame(this.step);
    this.tell();
  }

  pause(): void {
    this.playing = false;
    this.tell();
  }

  /** Remove all listeners. */
  stop(): void {
    this.playing = false;
    this.listeners.length = 0;
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  private readonly step = (now: number): void => {
    if (!this.playing) return;
    this.time = Math.min(this.time + (Math.max(now - this.last, 0) / 1000) * this.rate, this.duration);
    this.last = now;
    if (this.loop && this.time >= this.loop[1]) this.time = this.loop[0];
    if (this.time >= this.duration) this.playing = false;
    else requestAnimationFrame(this.step);
    this.tell();
  };

  private tell(): void {
    for (const listener of this.listeners) listener(this);
  }
}

// From a billionth of real time to a billion times it.
const RATES = Array.from({ length: 55 }, (_, i) => Number(`${[1, 2, 5][i % 3]}e${Math.floor(i / 3) - 9}`));
const SHOW = 9; // s that a whole motion should take at least

/** The playback speeds offered, and the default: the fastest that leaves time to watch. */
export function rates(duration: number): { offered: number[]; usual: number } {
  const fitting = RATES.filter((rate) => duration / rate >= SHOW);
  const usual = fitting[fitting.length - 1] ?? RATES[0];
  const middle = RATES.indexOf(usual);
  return { offered: RATES.slice(Math.max(middle - 5, 0), middle + 5), usual };
}

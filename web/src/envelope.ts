// What is drawn of a curve with more cycles than there is room for: a band between its extremes.

const ROOM = 7; // pixels for a cycle, below which its line would be a smear
const THIN = 0.015; // of the range of the plot: a band that is thinner looks like a line
const FLAT = 1e-6; // of the range: smaller ups and downs are no cycles

export interface Envelope {
  low: number[];
  high: number[];
  /** Of a cycle, in samples. */
  period: number;
}

/**
 * The least and the greatest value within a cycle around each sample; null where a line has room.
 *
 * @param range of all curves in the plot.
 * @param begin of the samples that are in view.
 * @param end of them.
 * @param pixels they share.
 */
export function envelopeOf(values: Float32Array, range: number, begin: number, end: number, pixels: number): Envelope | null {
  const [least, greatest] = extremes(values, begin, end);
  if (greatest - least < THIN * range) return null;
  const cycles = turnings(values, begin, end) / 2;
  if (cycles * ROOM < pixels) return null;
  const period = (end - begin) / cycles;
  const half = Math.ceil(period / 2) + 1;
  const [low, high] = [new Array<number>(values.length), new Array<number>(values.length)];
  for (let i = 0; i < values.length; i++) {
    [low[i], high[i]] = [Infinity, -Infinity];
    for (let k = Math.max(0, i - half); k <= Math.min(values.length - 1, i + half); k++) {
      low[i] = Math.min(low[i], values[k]);
      high[i] = Math.max(high[i], values[k]);
    }
  }
  return { low, high, period };
}

/** How often a curve turns from rising to falling or back. */
function turnings(values: Float32Array, begin: number, end: number): number {
  const [low, high] = extremes(values, begin, end);
  const least = FLAT * (high - low);
  let [count, direction, reached] = [0, 0, values[begin]];
  for (let i = begin + 1; i <= end; i++) {
    const step = values[i] - reached;
    if (Math.abs(step) <= least) continue;
    if (Math.sign(step) === -direction) count += 1;
    direction = Math.sign(step);
    reached = values[i];
  }
  return count;
}

/** The least and the greatest value of some samples. */
export function extremes(values: Float32Array, begin = 0, end = values.length - 1): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (let i = begin; i <= end; i++) {
    low = Math.min(low, values[i]);
    high = Math.max(high, values[i]);
  }
  return [low, high];
}

// Small matrices, row by row.

export type Vector = number[];
export type Matrix = number[][];

export const dot = (a: Vector, b: Vector): number => a.reduce((sum, part, i) => sum + part * b[i], 0);

export const times = (m: Matrix, v: Vector): Vector => m.map((row) => dot(row, v));

export const transposed = (m: Matrix): Matrix => (m.length ? m[0].map((_, k) => m.map((row) => row[k])) : []);

export const plus = (a: Vector, b: Vector, share = 1): Vector => a.map((part, i) => part + share * b[i]);

export const cross = ([a, b, c]: Vector, [x, y, z]: Vector): Vector => [b * z - c * y, c * x - a * z, a * y - b * x];

export const scaled = (a: Vector, factor: number): Vector => a.map((part) => factor * part);

/** Entries in rows of a length. */
export function inRows(entries: Vector, width: number): Matrix {
  return Array.from({ length: width ? entries.length / width : 0 }, (_, i) => entries.slice(i * width, (i + 1) * width));
}

const NOTHING = 1e-12; // of the largest entry: a smaller pivot is rounding

/** The solution of m x = v by elimination; unknowns that the equations leave open are zero. */
export function solved(m: Matrix, v: Vector): Vector {
  const rows = m.map((row, i) => [...row, v[i]]);
  const size = Math.max(...m.flat().map(Math.abs), 0);
  const count = v.length;
  const pivots: number[] = [];
  for (let k = 0; k < count; k++) {
    const done = pivots.filter((place) => place >= 0).length;
    let best = done;
    for (let i = done; i < count; i++) if (Math.abs(rows[i][k]) > Math.abs(rows[best]?.[k] ?? 0)) best = i;
    if (done >= count || !(Math.abs(rows[best][k]) > NOTHING * size)) {
      pivots.push(-1);
      continue;
    }
    [rows[done], rows[best]] = [rows[best], rows[done]];
    for (let i = done + 1; i < count; i++) {
      const share = rows[i][k] / rows[done][k];
      for (let j = k; j <= count; j++) rows[i][j] -= share * rows[done][j];
    }
    pivots.push(done);
  }
  const found: Vector = new Array<number>(count).fill(0);
  for (let k = count - 1; k >= 0; k--) {
    const row = rows[pivots[k]];
    if (!row) continue;
    let rest = row[count];
    for (let j = k + 1; j < count; j++) rest -= row[j] * found[j];
    found[k] = rest / row[k];
  }
  return found;
}

/** The solution of a large regular system, whose rows it overwrites; not a number where there is none. */
export function eliminated(rows: Float64Array[], v: Float64Array): Float64Array {
  const count = v.length;
  for (let k = 0; k < count; k++) {
    let best = k;
    for (let i = k + 1; i < count; i++) if (Math.abs(rows[i][k]) > Math.abs(rows[best][k])) best = i;
    [rows[k], rows[best]] = [rows[best], rows[k]];
    [v[k], v[best]] = [v[best], v[k]];
    const pivot = rows[k];
    for (let i = k + 1; i < count; i++) {
      const row = rows[i];
      const share = row[k] / pivot[k];
      if (share === 0) continue;
      for (let j = k + 1; j < count; j++) row[j] -= share * pivot[j];
      v[i] -= share * v[k];
    }
  }
  for (let k = count - 1; k >= 0; k--) {
    const row = rows[k];
    let rest = v[k];
    for (let j = k + 1; j < count; j++) rest -= row[j] * v[j];
    v[k] = rest / row[k];
  }
  return v;
}

export function determinant(m: Matrix): number {
  const rows = m.map((row) => [...row]);
  let found = 1;
  for (let k = 0; k < rows.length; k++) {
    let best = k;
    for (let i = k; i < rows.length; i++) if (Math.abs(rows[i][k]) > Math.abs(rows[best][k])) best = i;
    if (best !== k) {
      [rows[k], rows[best]] = [rows[best], rows[k]];
      found = -found;
    }
    found *= rows[k][k];
    if (!found) return 0;
    for (let i = k + 1; i < rows.length; i++) {
      const share = rows[i][k] / rows[k][k];
      for (let j = k; j < rows.length; j++) rows[i][j] -= share * rows[k][j];
    }
  }
  return found;
}

/** Zeros of a function around the circle between points of a grid, each by bisection. */
export function zerosAround(value: (angle: number) => number, count: number, begin: number): Vector {
  const grid = Array.from({ length: count + 1 }, (_, i) => begin + (2 * Math.PI * i) / count);
  const values = grid.map(value);
  const found: Vector = [];
  for (let i = 0; i < count; i++) {
    if (values[i] === 0) found.push(grid[i]);
    else if (values[i] * values[i + 1] < 0) found.push(bisected(value, grid[i], grid[i + 1]));
  }
  return found;
}

/** A zero of a function that changes its sign between two places. */
export function bisected(value: (place: number) => number, low: number, high: number): number {
  const sign = value(low) < 0 ? -1 : 1;
  for (;;) {
    const middle = (low + high) / 2;
    if (middle <= Math.min(low, high) || middle >= Math.max(low, high)) return high;
    if (sign * value(middle) > 0) low = middle;
    else high = middle;
  }
}

// Quaternions (x, y, z, w) along a motion.

/** Rotation matrices, row by row, as quaternions that follow each other without a jump. */
export function quaternions(matrices: Float64Array): Float64Array {
  const count = matrices.length / 9;
  const found = new Float64Array(4 * count);
  for (let i = 0; i < count; i++) {
    const q = quaternion(matrices.subarray(9 * i, 9 * i + 9));
    // q and −q are the same rotation: the one nearer to that before, between which frames interpolate
    const same = i && q.reduce((sum, part, k) => sum + part * found[4 * (i - 1) + k], 0) < 0 ? -1 : 1;
    for (let k = 0; k < 4; k++) found[4 * i + k] = same * q[k];
  }
  return found;
}

function quaternion(m: Float64Array): number[] {
  const trace = m[0] + m[4] + m[8];
  const largest = [m[0], m[4], m[8], trace].reduce((best, value, i, all) => (value > all[best] ? i : best), 0);
  const q = [0, 0, 0, 0];
  if (largest === 3) {
    q[3] = 1 + trace;
    [q[0], q[1], q[2]] = [m[7] - m[5], m[2] - m[6], m[3] - m[1]];
  } else {
    const [i, j, k] = [largest, (largest + 1) % 3, (largest + 2) % 3];
    q[i] = 1 - trace + 2 * m[4 * i];
    q[j] = m[3 * j + i] + m[3 * i + j];
    q[k] = m[3 * k + i] + m[3 * i + k];
    q[3] = m[3 * k + j] - m[3 * j + k];
  }
  const size = Math.hypot(...q);
  return q.map((part) => part / size);
}

/** Attitudes from an angular velocity along fixed axes, by rotations about its mean over each step. */
export function rolled(turning: Float64Array, step: number): Float64Array {
  const count = turning.length / 3;
  const found = new Float64Array(4 * count);
  found[3] = 1;
  for (let i = 1; i < count; i++) {
    const vector = [0, 1, 2].map((k) => ((turning[3 * i + k] + turning[3 * (i - 1) + k]) / 2) * step);
    const angle = Math.hypot(...vector);
    const share = angle ? Math.sin(angle / 2) / angle : 0.5;
    found.set(product([...vector.map((part) => part * share), Math.cos(angle / 2)], found.subarray(4 * i - 4, 4 * i)), 4 * i);
  }
  return found;
}

/** The rotation b, followed by a. */
export function product(a: ArrayLike<number>, b: ArrayLike<number>): number[] {
  return [
    a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
    a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
  ];
}

/** A vector turned by a rotation, or by its inverse. */
export function turned(vector: ArrayLike<number>, q: ArrayLike<number>, inverse = false): number[] {
  const sign = inverse ? -1 : 1;
  const there = product(product([q[0] * sign, q[1] * sign, q[2] * sign, q[3]], [vector[0], vector[1], vector[2], 0]), [-q[0] * sign, -q[1] * sign, -q[2] * sign, q[3]]);
  return there.slice(0, 3);
}

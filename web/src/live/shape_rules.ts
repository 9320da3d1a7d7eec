// What bodies look like, by the rules of _shapes.py in polhode.view.

import type { ShapeData, Triple } from "../scene";

const THIN = 0.06;
const SLENDER = 0.045;
const HOLLOW = 0.75;
const FLAT = 0.02;
const LONG = 2.5;
const SAME = 1e-6;

/** The shape that follows from numbers by a rule; a point without any. */
export function shapeOf(rule: string, numbers: number[], position: number): ShapeData {
  if (!numbers.length) return ball(0);
  const [axis, across] = [unit(position), unit((position + 1) % 3)];
  if (rule === "outline") return shape("revolution", numbers, axis, across);
  if (rule === "round") {
    const [radius, offset] = numbers;
    return { ...shape("ball", [radius], axis, across), centre: axis.map((part) => offset * part) as Triple };
  }
  if (rule === "ellipsoidal") return { ...shape("ellipsoid", numbers.slice(0, 3)), centre: numbers.slice(3) as Triple };
  if (rule === "box") return shape("box", numbers, axis, across);
  if (rule === "face") return shape("box", [3 * numbers[0], 2.4 * numbers[0], 2 * numbers[0]]);
  if (rule === "rim") {
    const [radius, offset, mass, about] = numbers;
    const kind = about > HOLLOW * mass * radius ** 2 ? "hoop" : "disk";
    return shape(kind, [radius, 2 * Math.abs(offset) || THIN * radius], axis, across);
  }
  return equivalent(numbers);
}

function shape(kind: string, size: number[], axis: Triple = [0, 0, 1], across: Triple = [1, 0, 0]): ShapeData {
  return { kind, size, axis, across, centre: [0, 0, 0] };
}

const ball = (radius: number): ShapeData => shape("ball", [radius]);

const unit = (position: number): Triple => [0, 1, 2].map((i) => (i === position ? 1 : 0)) as Triple;

/** A uniform body of the same mass and inertia. */
function equivalent([mass, ...entries]: number[]): ShapeData {
  const found = principal(entries);
  if (!(mass > 0) || !(found[2].moment > 0)) return ball(0);
  const [first, middle, last] = found;
  // The moment that differs most from the others goes last: that of the symmetry axis, if any.
  const sorted = last.moment - middle.moment < middle.moment - first.moment ? [middle, last, first] : found;
  const [a, b, c] = sorted.map(({ moment }) => moment);
  const [axis, across] = [sorted[2].direction, sorted[0].direction];
  if (c <= SAME * a) {
    const length = Math.sqrt((12 * a) / mass);
    return shape("rod", [length, SLENDER * length], axis, across);
  }
  if (Math.abs(a - b) <= SAME * a) return wheel(mass, a, c, axis, across);
  const total = a + b + c;
  const sides = sorted
    .map(({ moment, direction }) => ({ side: Math.sqrt(Math.max(0, (6 * (total - 2 * moment)) / mass)), direction }))
    .sort((one, other) => other.side - one.side);
  const [long, wide, thick] = sides.map(({ side }) => side);
  const along: [Triple, Triple] = [sides[0].direction, sides[1].direction];
  if (thick < FLAT * long && long > LONG * wide) return shape("racquet", [long, wide, THIN * wide], ...along);
  return shape("box", [long, wide, Math.max(thick, FLAT * long)], ...along);
}

function wheel(mass: number, acrossMoment: number, about: number, axis: Triple, across: Triple): ShapeData {
  const radius = Math.sqrt((2 * about) / mass);
  const squared = (12 * acrossMoment) / mass - 3 * radius ** 2;
  if (squared > (FLAT * radius) ** 2) return shape("disk", [radius, Math.sqrt(squared)], axis, across);
  const rim = Math.sqrt(about / mass);
  return shape("wheel", [rim, 2 * THIN * rim], axis, across);
}

interface Principal {
  moment: number;
  direction: Triple;
}

/** Eigenvalues of a symmetric matrix in ascending order, with their directions, by Jacobi's rotations. */
function principal(entries: number[]): Principal[] {
  const m = [0, 1, 2].map((i) => entries.slice(3 * i, 3 * i + 3));
  const v: number[][] = [0, 1, 2].map(unit);
  for (let sweep = 0; sweep < 30; sweep++) {
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (m[p][q] === 0) continue;
      const theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
      const t = (theta < 0 ? -1 : 1) / (Math.abs(theta) + Math.hypot(theta, 1));
      const c = 1 / Math.hypot(t, 1);
      const s = t * c;
      for (let k = 0; k < 3; k++) [m[k][p], m[k][q]] = [c * m[k][p] - s * m[k][q], s * m[k][p] + c * m[k][q]];
      for (let k = 0; k < 3; k++) [m[p][k], m[q][k]] = [c * m[p][k] - s * m[q][k], s * m[p][k] + c * m[q][k]];
      for (let k = 0; k < 3; k++) [v[k][p], v[k][q]] = [c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]];
    }
  }
  return [0, 1, 2]
    .map((i) => ({ moment: m[i][i], direction: v.map((row) => row[i]) as Triple }))
    .sort((one, other) => one.moment - other.moment);
}

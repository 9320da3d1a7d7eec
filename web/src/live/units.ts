// The unit in which values are neither tiny nor huge, as _quantities.py in polhode.view chooses it.

export interface Scale {
  unit: string;
  /** Shown value = value in SI units times this. */
  factor: number;
}

// Largest first: least value for which a prefix is used, size of that unit, and the prefix.
const PREFIXES: [number, number, string][] = [
  [1e12, 1e12, "T"],
  [1e9, 1e9, "G"],
  [1e6, 1e6, "M"],
  [1e4, 1e3, "k"],
  [1e-1, 1, ""],
  [1e-3, 1e-3, "m"],
  [1e-6, 1e-6, "µ"],
  [1e-9, 1e-9, "n"],
  [1e-12, 1e-12, "p"],
];
const TURN = 2 * Math.PI;

/** Units of angles, in rad. */
export const ANGLES: Record<string, number> = { rad: 1, deg: TURN / 360, turns: TURN };

export function scaleFor(unit: string, largest: number): Scale {
  if (unit === "rad") return largest > 5 * TURN ? { unit: "turns", factor: 1 / TURN } : { unit: "deg", factor: 360 / TURN };
  if (!unit || unit.startsWith("kg") || (unit.startsWith("rad") && largest >= 1)) return { unit, factor: 1 };
  for (const [least, size, prefix] of PREFIXES) if (largest >= least) return { unit: prefix + unit, factor: 1 / size };
  return { unit, factor: 1 };
}

// Supports: planes, turntables, sheets, curved surfaces, and a faint floor if there is none.

import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  CircleGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  type Object3D,
  PlaneGeometry,
  RingGeometry,
} from "three";
import { colourOf, MATERIALS } from "./family";
import { Ground } from "./ground";
import { type Packed, Rows, type SupportData } from "./scene";

type Colour = "ground" | "paper" | "lines" | "strong" | "accent";
type Point = [number, number];

const MOST = 60; // lines to either side of the middle
const PARTS = 32; // pieces of a line
const MESH = 4; // points of a curved surface between two lines on it
const VEIL = 0.12; // opacity of a curved surface from behind
const FINE = 0.6; // of the lines on it
const FADE = 0.35; // part of the radius of a boundless plane at which it begins to fade

/** The surface of a support, which moves with its pose. */
export function surfaceOf({ kind, middle, reach, points }: SupportData, grid: number): Object3D {
  if (kind === "curved") return curved(points);
  if (kind === "turntable") return turntable(reach[0], grid);
  return kind === "sheet" ? sheet(middle, reach, grid) : boundless(middle, 2.2 * Math.max(...reach), grid);
}

/** Ground in the colours of the light or dark page. */
export function paint(world: Object3D, dark: boolean): void {
  const look: Record<Colour, string> = {
    ground: colourOf("floor", dark),
    paper: colourOf("paper", dark),
    lines: colourOf("grid", dark),
    strong: colourOf("grid-strong", dark),
    accent: MATERIALS.accent,
  };
  world.traverse((object) => {
    const colour = object.userData.colour as Colour | undefined;
    if (colour) ((object as Mesh).material as Ground | LineBasicMaterial | MeshLambertMaterial).color.set(look[colour]);
  });
}

/** A plane that fades out with distance. */
export function boundless(middle: Point, radius: number, size: number): Object3D {
  const group = new Group();
  const geometry = new RingGeometry(0, radius, 64, 12);
  geometry.translate(middle[0], middle[1], 0);
  fill(group, geometry, "ground", (x, y) => fading(Math.hypot(x - middle[0], y - middle[1]) / radius));
  lines(group, gridLines(middle, [radius, radius], spacing(size)), "lines", (x, y) =>
    fading(Math.hypot(x - middle[0], y - middle[1]) / radius),
  );
  return group;
}

/** A curved surface, which can be seen through from the side where no bodies are. */
function curved(points: Packed): Object3D {
  const group = new Group();
  const { data } = new Rows(points);
  const [rows, columns] = points.shape;
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(data), 3));
  const corner = (i: number, j: number): number => i * columns + j;
  const faces: number[] = [];
  for (let i = 0; i + 1 < rows; i++) {
    for (let j = 0; j + 1 < columns; j++) {
      const [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
      faces.push(a, b, c, a, c, d);
    }
  }
  geometry.setIndex(faces);
  geometry.computeVertexNormals();
  const sides = [new MeshLambertMaterial(), new MeshLambertMaterial({ side: BackSide, transparent: true, opacity: VEIL, depthWrite: false })];
  for (const material of sides) {
    const mesh = new Mesh(geometry, material);
    mesh.receiveShadow = !material.transparent;
    mesh.userData.colour = "ground";
    mesh.renderOrder = material.transparent ? 2 : 0;
    group.add(mesh);
  }
  const along = (count: number, other: number, at: (i: number, k: number) => number): number[][] =>
    Array.from({ length: Math.floor((count - 1) / MESH) + 1 }, (_, k) => Array.from({ length: other }, (_, i) => at(k * MESH, i)));
  const drawn = [...along(rows, columns, corner), ...along(columns, rows, (k, i) => corner(i, k))];
  const ends = drawn.flatMap((line) => line.slice(1).flatMap((point, i) => [line[i], point]));
  const mesh = new BufferGeometry();
  mesh.setAttribute("position", new BufferAttribute(new Float32Array(ends.flatMap((k) => [...data.slice(3 * k, 3 * k + 3)])), 3));
  const drawing = new LineSegments(mesh, new LineBasicMaterial({ transparent: true, opacity: FINE }));
  drawing.userData.colour = "lines";
  group.add(drawing);
  return group;
}

function sheet(middle: Point, reach: Point, size: number): Object3D {
  const group = new Group();
  const [a, b] = reach;
  const [x, y] = middle;
  const geometry = new PlaneGeometry(2 * a, 2 * b);
  geometry.translate(x, y, 0);
  fill(group, geometry, "paper");
  lines(group, gridLines(middle, reach, spacing(size)), "lines");
  const corners: Point[] = [[x - a, y - b], [x + a, y - b], [x + a, y + b], [x - a, y + b]];
  lines(group, corners.map((corner, i) => [corner, corners[(i + 1) % 4]]), "strong");
  return group;
}

function turntable(radius: number, size: number): Object3D {
  const group = new Group();
  fill(group, new CircleGeometry(radius, 128), "paper");
  const step = Math.max(spacing(size), radius / 40);
  const circles = [];
  for (let r = step; r < 0.97 * radius; r += step) circles.push(...circle(r));
  lines(group, circles, "lines", undefined, 1);
  lines(group, circle(radius), "strong", undefined, 1);
  const [first, ...others] = Array.from({ length: 12 }, (_, i) => spoke(radius, (Math.PI * i) / 6));
  lines(group, [first], "strong");
  lines(group, others, "lines");
  const mark = new RingGeometry(0.93 * radius, radius, 8, 1, -0.06, 0.12);
  mark.translate(0, 0, 1e-4 * radius);
  fill(group, mark, "accent");
  return group;
}

function fill(group: Group, geometry: BufferGeometry, colour: Colour, alpha?: (x: number, y: number) => number): void {
  const material = new Ground(alpha !== undefined, colour === "accent" ? 0 : 1);
  if (alpha) veil(geometry, alpha);
  const mesh = new Mesh(geometry, material);
  mesh.receiveShadow = true;
  mesh.userData.colour = colour;
  mesh.renderOrder = alpha ? -2 : 0;
  group.add(mesh);
}

/** Straight lines, in pieces: some machines do not draw a long line that passes the camera. */
function lines(group: Group, ends: Point[][], colour: Colour, alpha?: (x: number, y: number) => number, parts = PARTS): void {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(pieces(ends, parts), 3));
  const material = new LineBasicMaterial(alpha && { transparent: true, vertexColors: true });
  if (alpha) veil(geometry, alpha);
  const drawn = new LineSegments(geometry, material);
  drawn.userData.colour = colour;
  drawn.renderOrder = alpha ? -1 : 0;
  group.add(drawn);
}

/** White with the given transparency. */
function veil(geometry: BufferGeometry, alpha: (x: number, y: number) => number): void {
  const place = geometry.getAttribute("position");
  const colours = new Float32Array(4 * place.count).fill(1);
  for (let i = 0; i < place.count; i++) colours[4 * i + 3] = alpha(place.getX(i), place.getY(i));
  geometry.setAttribute("color", new BufferAttribute(colours, 4));
}

function fading(share: number): number {
  const t = Math.min(Math.max((share - FADE) / (1 - FADE), 0), 1);
  return (1 - t) ** 2 * (1 + 2 * t);
}

/** Both ends of each piece of each line, in the plane z = 0. */
function pieces(lines: Point[][], count: number): Float32Array {
  const places = new Float32Array(6 * count * lines.length);
  let at = 0;
  for (const [[x, y], [u, v]] of lines) {
    for (let i = 0; i < 2 * count; i++, at += 3) {
      const share = Math.ceil(i / 2) / count;
      places[at] = x + share * (u - x);
      places[at + 1] = y + share * (v - y);
    }
  }
  return places;
}

function spoke(radius: number, angle: number): Point[] {
  return [[0, 0], [radius * Math.cos(angle), radius * Math.sin(angle)]];
}

function circle(radius: number): Point[][] {
  const at = (i: number): Point => [radius * Math.cos((Math.PI * i) / 48), radius * Math.sin((Math.PI * i) / 48)];
  return Array.from({ length: 96 }, (_, i) => [at(i), at(i + 1)]);
}

function gridLines(middle: Point, reach: Point, least: number): Point[][] {
  const found: Point[][] = [];
  for (const [i, j] of [[0, 1], [1, 0]]) {
    const step = spacing(Math.max(least, reach[i] / MOST) * 1.0001);
    for (let k = Math.ceil((middle[i] - reach[i]) / step); k * step <= middle[i] + reach[i]; k++) {
      const line: Point[] = [[0, 0], [0, 0]];
      line[0][i] = line[1][i] = k * step;
      line[0][j] = middle[j] - reach[j];
      line[1][j] = middle[j] + reach[j];
      found.push(line);
    }
  }
  return found;
}

/** 1, 2 or 5 times a power of ten near a length. */
function spacing(size: number): number {
  const power = 10 ** Math.floor(Math.log10(size));
  return power * ([5, 2, 1].find((step) => step * power <= size) ?? 1);
}

// What is kept from one motion to the next: canvas, lights, camera and unchanged objects.

import { LineSegments, type Material, Mesh, type Object3D, PCFShadowMap, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { Lights } from "./lights";

const FIELD = 32; // degrees that are seen from top to bottom

export class Display {
  readonly renderer = rendererOf();
  readonly world = new Scene();
  readonly camera = new PerspectiveCamera(FIELD);
  readonly lights = new Lights(this.world, this.camera);
  private parts = new Map<string, Object3D[]>();
  private former = new Map<string, Object3D[]>();
  private gone: Object3D[] = [];

  /** Begin another motion: existing objects can be reused until `set`. */
  begin(): void {
    this.former = this.parts;
    this.parts = new Map();
  }

  /** The object determined by these data: an existing one, or a new one. */
  part<T extends Object3D>(data: unknown, build: () => T): T {
    const key = JSON.stringify(data);
    const standing = this.former.get(key)?.pop() as T | undefined;
    if (standing) standing.visible = true;
    return this.put(key, standing ?? build());
  }

  /** An object of this motion only. */
  own<T extends Object3D>(part: T): T {
    return this.put("", part);
  }

  private put<T extends Object3D>(key: string, part: T): T {
    this.parts.set(key, [...(this.parts.get(key) ?? []), part]);
    this.world.add(part);
    return part;
  }

  /** Remove what was not reused. */
  set(): void {
    this.gone.push(...[...this.former.values()].flat());
    this.former.clear();
    for (const part of this.gone) part.removeFromParent();
  }

  /** Draw; only then dispose of removed objects, since disposing earlier would drop shared shaders. */
  draw(): void {
    this.renderer.render(this.world, this.camera);
    for (const part of this.gone.splice(0)) part.traverse(giveUp);
  }
}

function giveUp(object: Object3D): void {
  if (!(object instanceof Mesh || object instanceof LineSegments)) return;
  object.geometry.dispose();
  for (const material of [object.material].flat() as Material[]) material.dispose();
}

/** That this browser cannot draw in three dimensions. */
export class NoWebGL extends Error {}

function rendererOf(): WebGLRenderer {
  let renderer: WebGLRenderer;
  try {
    renderer = new WebGLRenderer({ antialias: true, alpha: true });
  } catch (error) {
    throw new NoWebGL(String(error));
  }
  renderer.debug.checkShaderErrors = false; // waiting for them holds up the first picture
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  return renderer;
}

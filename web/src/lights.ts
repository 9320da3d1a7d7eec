// Light from the sky, from the camera, and from a sun that casts shadows.

import { DirectionalLight, HemisphereLight, type PerspectiveCamera, type Scene, type Vector3 } from "three";

export class Lights {
  private readonly sun = new DirectionalLight("#fff6e8", 1.9);

  constructor(world: Scene, camera: PerspectiveCamera) {
    world.add(new HemisphereLight("#ffffff", "#b9b2a4", 1.5));
    camera.add(new DirectionalLight("#ffffff", 0.7));
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.radius = 4;
    world.add(camera, this.sun, this.sun.target);
  }

  /** Set up shadows for bodies of this size. */
  fit(reach: number): void {
    this.sun.shadow.normalBias = 0.01 * reach;
  }

  /** Aim the sun at a point, with shadows within a range around it. */
  aim(at: Vector3, range: number, up: Vector3, [side, ahead]: [Vector3, Vector3]): void {
    this.sun.target.position.copy(at);
    this.sun.position
      .copy(at)
      .addScaledVector(up, 3 * range)
      .addScaledVector(side, -1.4 * range)
      .addScaledVector(ahead, -0.8 * range);
    const { camera } = this.sun.shadow;
    camera.left = camera.bottom = -range;
    camera.right = camera.top = range;
    camera.near = 0.1 * range;
    camera.far = 8 * range;
    camera.updateProjectionMatrix();
  }
}

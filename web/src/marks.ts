// Surfaces with marks, so that spin is visible.

import { CanvasTexture, MeshLambertMaterial, SRGBColorSpace, type Texture } from "three";
import { MATERIALS } from "./family";

/** Painted once and then shared. */
function kept(paint: () => Texture): () => Texture {
  let texture: Texture | undefined;
  return () => (texture ??= paint());
}

function painted(width: number, height: number, paint: (pen: CanvasRenderingContext2D) => void): Texture {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const pen = canvas.getContext("2d");
  if (pen) paint(pen);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 2; // more costs as much as all else where there is no GPU
  return texture;
}

/** A face with sectors, one of them marked. */
export const sectors = kept(() => {
  const size = 1024;
  const count = 12;
  return painted(size, size, (pen) => {
    const middle = size / 2;
    for (let i = 0; i < count; i++) {
      pen.fillStyle = i === 0 ? MATERIALS.accent : i % 2 ? MATERIALS.blue : MATERIALS.light;
      pen.beginPath();
      pen.moveTo(middle, middle);
      const begin = (2 * Math.PI * (i - 0.5)) / count;
      pen.arc(middle, middle, size, begin, begin + (2 * Math.PI) / count);
      pen.fill();
    }
    ring(pen, middle, 0.965, MATERIALS.deep, 0.06);
    ring(pen, middle, 0.2, MATERIALS.deep, 0.03);
    pen.fillStyle = MATERIALS.light;
    pen.beginPath();
    pen.arc(middle, middle, middle * 0.185, 0, 7);
    pen.fill();
    pen.fillStyle = MATERIALS.deep;
    pen.beginPath();
    pen.arc(middle, middle, middle * 0.04, 0, 7);
    pen.fill();
  });
});

function ring(pen: CanvasRenderingContext2D, middle: number, at: number, colour: string, width: number): void {
  pen.strokeStyle = colour;
  pen.lineWidth = middle * width;
  pen.beginPath();
  pen.arc(middle, middle, middle * at, 0, 7);
  pen.stroke();
}

/** An edge with one block per sector of the face. */
export const edge = kept(() =>
  painted(1200, 8, (pen) => {
    for (let i = 0; i < 12; i++) {
      pen.fillStyle = i === 0 ? MATERIALS.accent : i % 2 ? MATERIALS.deep : MATERIALS.metal;
      pen.fillRect(i * 100, 0, 100, 8);
    }
  }),
);

/** A ball with panels and a marked cap. */
export const panels = kept(() =>
  painted(1024, 512, (pen) => {
    for (let i = 0; i < 8; i++) {
      for (let j = 0; j < 4; j++) {
        pen.fillStyle = (i + j) % 2 ? MATERIALS.blue : MATERIALS.light;
        pen.fillRect(i * 128, j * 128, 128, 128);
      }
    }
    pen.fillStyle = MATERIALS.accent;
    pen.fillRect(0, 0, 1024, 52);
    pen.fillRect(0, 128, 128, 128);
    pen.fillStyle = MATERIALS.deep;
    pen.fillRect(0, 460, 1024, 52);
    pen.fillRect(0, 252, 1024, 8);
  }),
);

export function surface(colour: string): MeshLambertMaterial {
  return new MeshLambertMaterial({ color: colour });
}

export function marked(map: Texture): MeshLambertMaterial {
  return new MeshLambertMaterial({ map });
}

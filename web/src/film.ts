// The motion as a film that can be put on a slide: GIF.

import { applyPalette, GIFEncoder, quantize } from "gifenc";
import type { Clock } from "./clock";
import { painted } from "./dom";
import type { Stage } from "./stage";

const WIDTH = 480; // pixels
const COLOURS = 256;
const PER_SECOND = 15; // frames
const MOST = 120; // frames
const SHORTEST = 40; // ms: browsers show a GIF no faster

/**
 * The whole motion, or what is played in a loop, at the present speed; a long motion faster.
 *
 * @param tell told how much is done, from 0 to 1.
 */
export async function film(stage: Stage, clock: Clock, tell: (share: number) => void): Promise<Blob> {
  const [begin, end] = clock.loop ?? [0, clock.duration];
  const seconds = (end - begin) / clock.rate;
  const count = Math.min(MOST, Math.max(2, Math.round(seconds * PER_SECOND)));
  const delay = Math.max(SHORTEST, Math.min((1000 * seconds) / count, 1000 / PER_SECOND));
  const height = Math.round((WIDTH * stage.canvas.height) / stage.canvas.width);
  const pen = Object.assign(document.createElement("canvas"), { width: WIDTH, height }).getContext("2d", { willReadFrequently: true });
  if (!pen) throw new Error("This browser cannot draw a film.");
  const before = clock.time;
  clock.pause();
  const film = GIFEncoder();
  // one choice of colours for all frames, which would flicker otherwise
  const palette = quantize(pixels(stage, clock, pen, (begin + end) / 2), COLOURS);
  for (let i = 0; i < count; i++) {
    const seen = pixels(stage, clock, pen, begin + ((end - begin) * i) / (count - 1));
    film.writeFrame(applyPalette(seen, palette), WIDTH, height, { delay, ...(i ? {} : { palette }) });
    tell((i + 1) / count);
    await painted();
  }
  film.finish();
  clock.seek(before);
  return new Blob([film.bytes()], { type: "image/gif" });
}

function pixels(stage: Stage, clock: Clock, pen: CanvasRenderingContext2D, time: number): Uint8ClampedArray {
  const { width, height } = pen.canvas;
  clock.seek(time);
  stage.drawNow(); // what was drawn before is gone from the canvas
  // behind it is the sky of the page
  const sky = pen.createLinearGradient(0, 0, 0, height);
  const style = getComputedStyle(document.documentElement);
  ["--sky-above", "--sky-below"].forEach((name, i) => sky.addColorStop(i, style.getPropertyValue(name).trim()));
  pen.fillStyle = sky;
  pen.fillRect(0, 0, width, height);
  pen.drawImage(stage.canvas, 0, 0, width, height);
  return pen.getImageData(0, 0, width, height).data;
}

// Displays the scene that is embedded in the page.

import "uplot/dist/uPlot.min.css";
import "./page.css";
import { makeFallback } from "./fallback";
import { Clock, rates } from "./clock";
import { keys, switches, transport } from "./controls";
import { NoWebGL } from "./display";
import { make, painted } from "./dom";
import { opened } from "./embedded";
import { Plots } from "./plots";
import type { SceneData } from "./scene";
import { Portraits } from "./portraits";
import { Stage } from "./stage";
import { modeStrip } from "./strip";
import { footer, heading, judgements, sections } from "./text";

function show(scene: SceneData): void {
  const clock = new Clock(scene.duration, rates(scene.duration).usual);
  const picture = make("div", { class: "picture", tabindex: 0, role: "application", "aria-label": described(scene) });
  const theatre = make("section", { class: "theatre", "aria-label": "Motion" }, picture);
  const plots = make("section", { class: "plots", "aria-label": "Plots against time" });
  const words = make("div", { class: "words" }, ...judgements(scene), ...sections(scene));
  const main = make("main", {}, heading(scene), make("div", { class: "show" }, theatre, plots), words);
  document.body.append(main, footer(scene));

  theatre.append(transport(clock), ...modeStrip(scene.modes, clock));
  const dark = matchMedia("(prefers-color-scheme: dark)");

  // Slow parts follow once the text is on the screen: the picture, then the plots.
  void painted().then(async () => {
    const stage = staged(scene, picture);
    keys(clock, picture, stage);
    if (stage) {
      picture.after(switches(stage, clock));
      clock.onChange(({ time }) => stage.seek(time));
      stage.theme(dark.matches);
      dark.addEventListener("change", () => stage.theme(dark.matches));
      stage.drawNow();
      await painted();
    }
    const drawn = new Plots(plots);
    drawn.show(scene.panels, clock);
    const portraits = new Portraits();
    portraits.show(scene.portraits, scene.bodies, clock);
    plots.append(portraits.element);
    dark.addEventListener("change", () => drawn.theme());
    document.body.dataset.ready = "yes";
  });
}

function described(scene: SceneData): string {
  const bodies = scene.bodies.map(({ name }) => name).join(", ");
  return `Picture in three dimensions of ${bodies}. Arrow keys turn the view, plus and minus zoom, space plays.`;
}

function staged(scene: SceneData, picture: HTMLElement): Stage | null {
  try {
    return new Stage(scene, picture);
  } catch (error) {
    if (!(error instanceof NoWebGL)) throw error;
    makeFallback(picture, "Plots, slider and numbers");
    return null;
  }
}

void opened<SceneData>(show);

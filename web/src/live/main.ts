// Opens the live page whose scene and kernels are embedded in it.

import "uplot/dist/uPlot.min.css";
import "../page.css";
import { opened, packedIn } from "../embedded";
import { unpacked } from "../packed";
import type { SceneData } from "../scene";
import type { LiveData } from "./model";
import { LivePage } from "./page";

void opened<SceneData>(async (scene) => {
  const { live, worker } = await unpacked<{ live: LiveData; worker: string }>(packedIn("live") ?? "");
  await new LivePage(scene, live, worker).open();
});

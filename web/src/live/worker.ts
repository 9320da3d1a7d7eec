// The worker of a live page: gets the kernels once, then answers requests in their order.

import { answered } from "./answer";
import type { Reply, Request } from "./computer";
import type { LiveData } from "./model";
import { Engine } from "./motion";

declare const self: {
  onmessage: (event: { data: LiveData | Request }) => void;
  postMessage(message: "ready" | "none" | Reply): void;
};

let live: LiveData;
let engine: Engine;

self.onmessage = ({ data }) => {
  if ("integrator" in data) {
    live = data;
    Engine.of(live).then(
      (made) => {
        engine = made;
        self.postMessage("ready");
      },
      () => self.postMessage("none"),
    );
    return;
  }
  try {
    self.postMessage({ id: data.id, answer: answered(engine, live, data) });
  } catch (error) {
    self.postMessage({ id: data.id, error: String(error) });
  }
};

// The worker of a live page: gets the kernels once, then answers requests in their order.

import { replyTo } from "./answer";
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
  if ("modes" in data) {
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
  self.postMessage(replyTo(engine, live, data));
};

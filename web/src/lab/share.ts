// Sharing and saving: the address of a state, and files of a motion.

import { make } from "../dom";
import { post } from "./requests";
import { explanation } from "./claims";

const FILES: Record<string, string> = {
  page: "Page",
  csv: "Table (CSV)",
  svg: "Figure (SVG)",
  png: "Figure (PNG)",
  gif: "Movie (GIF)",
  mp4: "Movie (MP4)",
};

export function sharing(wish: () => object, tell: (message: string) => void): HTMLElement {
  const share = make("button", { type: "button", class: "switch" }, "Copy link");
  share.addEventListener("click", () => {
    navigator.clipboard.writeText(location.href).then(
      () => tell("The address of this state is on the clipboard."),
      () => tell("The address of this state is the one this page has now."),
    );
  });
  const menu = make("select", { "aria-label": "Save as a file" }, make("option", { value: "" }, "Save …"));
  for (const [kind, title] of Object.entries(FILES)) menu.append(make("option", { value: kind }, title));
  menu.addEventListener("change", () => {
    const kind = menu.value;
    menu.value = "";
    tell("Making the file; a movie takes its time …");
    void saved(kind, wish()).then(tell, (error) => tell(explanation(error)));
  });
  return make("div", { class: "keeping" }, share, menu);
}

async function saved(kind: string, wish: object): Promise<string> {
  const response = await post("export", { ...wish, kind });
  const named = /filename="([^"]+)"/.exec(response.headers.get("content-disposition") ?? "");
  const address = URL.createObjectURL(await response.blob());
  const link = make("a", { href: address, download: named?.[1] ?? "polhode" });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
  return `${link.download} is made.`;
}

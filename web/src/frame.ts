// Plays one of several scenes at a time, each where its button stands: the front end of a page is
// heavy, and there it is in the document only once.

import { make } from "./dom";

interface Player {
  before: string;
  after: string;
}

function read<T>(id: string): T | null {
  const text = document.getElementById(id)?.textContent;
  return text ? (JSON.parse(text) as T) : null;
}

const player = read<Player>("player");
const scenes = read<Record<string, unknown>>("scenes");

function played(scene: unknown, title: string): HTMLIFrameElement {
  // Within a script element, "<" could end it.
  const data = JSON.stringify(scene).replace(/</g, "\\u003c");
  const element = `<script type="application/json" id="scene">${data}</script>`;
  // Without "allow-same-origin" the frame can reach neither this page nor the network.
  const frame = make("iframe", { title, sandbox: "allow-scripts", class: "played" });
  frame.srcdoc = `${player?.before}${element}${player?.after}`;
  return frame;
}

function toggle(button: HTMLButtonElement): void {
  const isOpen = button.getAttribute("aria-expanded") === "true";
  for (const frame of document.querySelectorAll("iframe.played")) frame.remove();
  for (const other of document.querySelectorAll("button[data-scene]")) {
    other.setAttribute("aria-expanded", "false");
  }
  if (isOpen) return;
  const scene = scenes?.[button.dataset.scene ?? ""];
  if (!scene) return;
  button.setAttribute("aria-expanded", "true");
  button.after(played(scene, button.dataset.title ?? "A motion"));
}

if (player && scenes) {
  for (const button of document.querySelectorAll<HTMLButtonElement>("button[data-scene]")) {
    button.hidden = false;
    button.addEventListener("click", () => toggle(button));
  }
}
document.body.dataset.ready = "yes";

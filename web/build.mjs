// Bundles the front end, scripts and style sheets for pages, frames, the lab and the worker of live pages: node build.mjs FOLDER
import { build } from "esbuild";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";

const folder = process.argv[2] ?? "built";
const BUNDLED = ["three", "uplot"];

await mkdir(folder, { recursive: true });
await build({
  entryPoints: { page: "src/main.ts", frame: "src/frame.ts", lab: "src/lab/main.ts", worker: "src/live/worker.ts" },
  outdir: folder,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "ascii",
  legalComments: "none",
  logLevel: "warning",
});
const licences = await Promise.all(BUNDLED.map(licence));
await writeFile(join(folder, "LICENSES.txt"), licences.join("\n"));

async function licence(name) {
  const home = join("node_modules", name);
  const { version, license } = JSON.parse(await readFile(join(home, "package.json"), "utf8"));
  const text = await readFile(join(home, "LICENSE"), "utf8");
  return `${name} ${version} (${license})\n\n${text.trim()}\n`;
}

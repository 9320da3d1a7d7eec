// Bundles the front end, scripts and style sheets for pages, frames, the lab and the worker of live pages: node build.mjs FOLDER
import { build } from "esbuild";
import { mkdir, readdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join, resolve } from "node:path";

const folder = process.argv[2] ?? "built";
const BUNDLED = { "LICENSES.txt": ["three", "uplot"], "LICENSES.live.txt": ["three", "uplot", "gifenc"] };
const THREE = resolve("node_modules/three");
const SHADERS = join(THREE, "src/renderers/shaders");
// of three's materials those that the pages have, what their shadows need, and what the renderer adds to each
const MATERIALS = [
  "src/renderers/shaders/ShaderLib/meshbasic.glsl.js",
  "src/renderers/shaders/ShaderLib/meshlambert.glsl.js",
  "src/renderers/shaders/ShaderLib/depth.glsl.js",
  "src/renderers/shaders/ShaderLib/vsm.glsl.js",
  "src/renderers/webgl/WebGLOutput.js",
  "src/renderers/webgl/WebGLProgram.js",
  "examples/jsm/lines/LineMaterial.js",
];

// what the renderer has for headsets and for surroundings that are mirrored, of which it asks here no more than this
const ABSENT = {
  "renderers/webxr/WebXRManager.js": `
    import { EventDispatcher } from "../../core/EventDispatcher.js";
    export class WebXRManager extends EventDispatcher {
      enabled = false;
      isPresenting = false;
      setAnimationLoop() {}
      getEnvironmentBlendMode() {}
      dispose() {}
    }`,
  "extras/PMREMGenerator.js": "export class PMREMGenerator {}",
};

await mkdir(folder, { recursive: true });
await build({
  entryPoints: { page: "src/main.ts", live: "src/live/main.ts", frame: "src/frame.ts", lab: "src/lab/main.ts", worker: "src/live/worker.ts" },
  outdir: folder,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "ascii",
  legalComments: "none",
  plugins: [{ name: "three", setup: lean }],
  logLevel: "warning",
});
for (const [file, names] of Object.entries(BUNDLED)) {
  const licences = await Promise.all(names.map(licence));
  await writeFile(join(folder, file), licences.join("\n"));
}

/** Bundle three from its sources, without the programs of materials that no page has, and without what is absent. */
async function lean(bundle) {
  const used = await included(MATERIALS.map((path) => join(THREE, path)));
  bundle.onResolve({ filter: /^three$/ }, () => ({ path: join(THREE, "src/Three.js"), sideEffects: false }));
  bundle.onLoad({ filter: /(WebXRManager|PMREMGenerator)\.js$/ }, ({ path }) => {
    const name = Object.keys(ABSENT).find((end) => path.endsWith(end));
    return { contents: ABSENT[name], resolveDir: dirname(path) };
  });
  bundle.onLoad({ filter: /\.glsl\.js$/ }, async ({ path }) => {
    const text = await readFile(path, "utf8");
    const kept = used.has(path) ? text.replace(/\/\*[^]*?\*\/|\/\/.*$/gm, "").replace(/\s*\n\s*/g, "\n") : text.replace(/`[^`]*`/g, '""');
    return { contents: kept };
  });
}

/** Programs, with all the pieces that they include, by path. */
async function included(paths) {
  const found = new Set(paths);
  for (const path of found) { // which grows
    const text = await readFile(path, "utf8");
    for (const [, name] of text.matchAll(/(?:#include <|ShaderChunk\[ ')(\w+)/g)) found.add(join(SHADERS, "ShaderChunk", `${name}.glsl.js`));
  }
  return found;
}

async function licence(name) {
  const home = join("node_modules", name);
  const { version, license } = JSON.parse(await readFile(join(home, "package.json"), "utf8"));
  const file = (await readdir(home)).find((path) => /^LICENSE(\.md)?$/.test(path));
  const text = await readFile(join(home, file), "utf8");
  return `${name} ${version} (${license})\n\n${text.trim()}\n`;
}

// Runs a Python file in Pyodide, with folders of this machine: node run.mjs FILE FOLDER...
import { readFileSync } from "node:fs";
import { loadPyodide } from "pyodide";

const [file, ...folders] = process.argv.slice(2);
const python = await loadPyodide();
folders.forEach((folder, i) => {
  python.FS.mkdir(`/given${i}`);
  python.mountNodeFS(`/given${i}`, folder);
});
const places = folders.map((_, i) => `/given${i}`);
python.runPython(`import sys\nsys.dont_write_bytecode = True\nsys.path[:0] = ${JSON.stringify(places)}`);
try {
  python.runPython(readFileSync(file, "utf8"));
} catch (error) {
  console.error(error.message); // not the minified source of Pyodide
  process.exitCode = 1;
}

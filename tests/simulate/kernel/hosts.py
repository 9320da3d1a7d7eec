"""Hosts that run WebAssembly for the tests: wasmtime within Python, and Node as another process."""

import json
import shutil
import struct
import subprocess

import wasmtime

_NODE = """
const { readFileSync } = require("fs");
const { file, calls } = JSON.parse(readFileSync(0, "utf8"));
const { exports } = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(file)));
const bits = new DataView(new ArrayBuffer(8));
const results = calls.map(([name, values]) => values.map((value) => {
  bits.setBigUint64(0, BigInt("0x" + value));
  bits.setFloat64(0, exports[name](bits.getFloat64(0)));
  return bits.getBigUint64(0).toString(16).padStart(16, "0");
}));
process.stdout.write(JSON.stringify(results));
"""


def exports(binary):
    """What a module exports, as Python functions."""
    store = wasmtime.Store()
    instance = wasmtime.Instance(store, wasmtime.Module(store.engine, binary), [])
    found = instance.exports(store)

    def bound(function):
        return lambda *given: function(store, *given)

    return {k: bound(v) for k, v in found.items() if isinstance(v, wasmtime.Func)}


def node(script, **document):
    """What a script writes, as JSON, for what it reads."""
    command = [shutil.which("node"), "-e", script]
    text = json.dumps(document)
    return json.loads(
        subprocess.run(command, input=text, capture_output=True, check=True, text=True).stdout
    )


def in_node(path, calls):
    """Results of functions of one double, for lists of arguments, by pairs of name and list."""
    sent = [(name, [struct.pack(">d", value).hex() for value in values]) for name, values in calls]
    found = node(_NODE, file=str(path), calls=sent)
    return [[struct.unpack(">d", bytes.fromhex(text))[0] for text in row] for row in found]

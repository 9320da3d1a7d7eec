"""The worker of live pages as its own process under Node, without a browser."""

import base64
import json
import shutil
import subprocess

import numpy as np

from polhode.view._page import front_end

_HOST = """
const { runInThisContext } = require("vm");
const { readFileSync } = require("fs");
const { code, live, requests } = JSON.parse(readFileSync(0, "utf8"));
const replies = [];
const plain = (key, value) => {
  if (!ArrayBuffer.isView(value)) return value;
  const { buffer, byteOffset, byteLength } = value;
  return { numbers: Buffer.from(buffer, byteOffset, byteLength).toString("base64") };
};
globalThis.self = {
  postMessage(message) {
    if (message === "ready") {
      requests.forEach((request, id) => self.onmessage({ data: { id, table: false, ...request } }));
      process.stdout.write(JSON.stringify(replies, plain));
    } else if (message === "none") throw new Error("no WebAssembly");
    else replies.push(message);
  },
};
runInThisContext(code);
self.onmessage({ data: live });
"""


def replies(live, *requests):
    """What the worker says to requests; arrays become NumPy arrays."""
    sent = json.dumps({"code": front_end("worker.js"), "live": live, "requests": requests})
    found = subprocess.run(
        [shutil.which("node"), "-e", _HOST], input=sent, capture_output=True, text=True, check=False
    )
    assert found.returncode == 0, found.stderr
    return json.loads(found.stdout, object_hook=_arrays)


def answers(live, *requests):
    """The worker's answers to requests that it can answer."""
    found = replies(live, *requests)
    assert all("answer" in reply for reply in found), found
    return [reply["answer"] for reply in found]


def usual_numbers(live):
    """The numbers that a page opens with."""
    values = {
        kind: [slider["value"] * slider["size"] for slider in live[kind]]
        for kind in ("parameters", "start")
    }
    return {**values, "duration": live["duration"]}


def table(text):
    """The columns of a table by name."""
    header, *rows = text.strip().split("\n")
    values = np.array([[float(part) for part in row.split(",")] for row in rows])
    return dict(zip(header.split(","), values.T, strict=True))


def _arrays(found):
    if "float32" in found and "shape" in found:
        numbers = np.frombuffer(base64.b64decode(found["float32"]["numbers"]), "<f4")
        return numbers.reshape(found["shape"])
    return found

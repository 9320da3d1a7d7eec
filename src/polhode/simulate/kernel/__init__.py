"""The kernel: a WebAssembly module that integrates motions, the same bits on every host."""

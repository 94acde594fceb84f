// Before a program for node: its WebAssembly is read from the file beside it. Emscripten of 2022 takes a node that has fetch for a browser.
Module['wasmBinary'] = require('fs').readFileSync(__filename.replace(/\.js$/, '.wasm'));

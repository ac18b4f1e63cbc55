// SPDX-License-Identifier: MIT. Copyright the sph authors.
// run.mjs FILE.wasm: runs the function main of a wasm program in node and exits with what it returns. What the program
// hands to `put` goes to standard output.
import { readFileSync, writeSync } from 'node:fs';

const [file] = process.argv.slice(2);
if (!file) {
    console.error('usage: node run.mjs FILE.wasm');
    process.exit(2);
}
let memory;
const put = (at, n) => writeSync(1, new Uint8Array(memory.buffer, at, n));
try {
    const { instance } = await WebAssembly.instantiate(readFileSync(file), { env: { put } });
    memory = instance.exports.memory;
    process.exit(instance.exports.main());
} catch (why) {
    console.error(`run.mjs: ${file}: ${why.message}`);
    process.exit(1);
}

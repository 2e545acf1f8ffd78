// Calls every function of the WebAssembly module on the inputs of native_outputs.json and compares the numbers with the
// native ones there, bit by bit.
//
//     node compare.mjs dyn_capi.wasm native_outputs.json

import { readFile } from "node:fs/promises";

const [modulePath, nativePath] = process.argv.slice(2);
const { instance, module } = await WebAssembly.instantiate(await readFile(modulePath));
const native = JSON.parse(await readFile(nativePath, "utf8"));

const imports = WebAssembly.Module.imports(module).map(({ module, name }) => `${module}.${name}`);
if (imports.length > 0) {
  console.error(`the module needs ${imports.join(", ")}: it should need nothing`);
  process.exit(1);
}

// A struct is its size as a 32-bit number, padding, then numbers. Places follow one another above the module's own memory.
const HEADER = 8;
const PAGE = 65536;
const memory = instance.exports.memory;
const start = Math.ceil(instance.exports.__heap_base.value / HEADER) * HEADER;
memory.grow(Math.ceil(3 * 8192 / PAGE) + 1);
const view = new DataView(memory.buffer);
const [PARAMETERS, INPUTS, MODEL, OUTPUT] = [0, 1, 2, 3].map((place) => start + place * 4096);

function putStructure(address, numbers) {
  view.setUint32(address, HEADER + 8 * numbers.length, true);
  numbers.forEach((number, index) => view.setFloat64(address + HEADER + 8 * index, number, true));
}

function putModel(kind) {
  view.setUint32(MODEL, 16, true);
  view.setInt32(MODEL + 4, kind, true);
  // The kind says which of the two pointers is followed.
  view.setUint32(MODEL + 8, PARAMETERS, true);
  view.setUint32(MODEL + 12, PARAMETERS, true);
}

function call(name, { structure, numbers }) {
  const header = structure ? HEADER : 0;
  if (structure) view.setUint32(OUTPUT, HEADER + 8 * numbers.length, true);
  const status = instance.exports[name](MODEL, INPUTS, OUTPUT, 0);
  if (status !== 0) throw new Error(`${name}: status ${status}`);
  return numbers.map((_, index) => view.getFloat64(OUTPUT + header + 8 * index, true));
}

let compared = 0;
let different = 0;
let worst = 0;
for (const { kind, parameters, cases } of native.platforms) {
  putStructure(PARAMETERS, parameters);
  putModel(kind);
  for (const { inputs, outputs } of cases) {
    putStructure(INPUTS, inputs);
    for (const [name, output] of Object.entries(outputs)) {
      const found = call(name, output);
      const scale = Math.max(...output.numbers.map(Math.abs), Number.MIN_VALUE);
      found.forEach((number, index) => {
        compared += 1;
        if (!Object.is(number, output.numbers[index])) {
          different += 1;
          worst = Math.max(worst, Math.abs(number - output.numbers[index]) / scale);
        }
      });
    }
  }
}
const verdict = different === 0 ? "every bit equal" : `${different} differ, by ${worst} at most`;
console.log(`WebAssembly in Node ${process.version} against native: ${compared} numbers, ${verdict}`);
// Not even NaN passes.
process.exit(compared > 0 && worst <= 1e-15 ? 0 : 1);

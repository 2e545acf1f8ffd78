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

// A struct is its size as a 32-bit number, padding, then numbers, then integers. Places follow one another above the module's own memory.
const HEADER = 8;
const PAGE = 65536;
const PLACE = 4096;
const PLACES = 8;
const memory = instance.exports.memory;
const start = Math.ceil(instance.exports.__heap_base.value / HEADER) * HEADER;
memory.grow(Math.ceil((PLACES * PLACE) / PAGE) + 1);
const view = new DataView(memory.buffer);
const [PARAMETERS, INPUTS, MODEL, OUTPUT, DETAILS, ...ARGUMENTS] = Array.from(
  { length: PLACES },
  (_, place) => start + place * PLACE,
);

function putNumbers(address, numbers) {
  numbers.forEach((number, index) => view.setFloat64(address + 8 * index, number, true));
}

function putStructure(address, numbers) {
  view.setUint32(address, HEADER + 8 * numbers.length, true);
  putNumbers(address + HEADER, numbers);
}

function putModel(kind) {
  view.setUint32(MODEL, 16, true);
  view.setInt32(MODEL + 4, kind, true);
  // The kind says which of the two pointers is followed.
  view.setUint32(MODEL + 8, PARAMETERS, true);
  view.setUint32(MODEL + 12, PARAMETERS, true);
}

// The address of an argument, which is the model, the inputs of the case, a struct or numbers.
function putArgument(argument, index) {
  if (argument === "model") return MODEL;
  if (argument === "inputs") return INPUTS;
  const put = argument.structure ? putStructure : putNumbers;
  put(ARGUMENTS[index], argument.numbers);
  return ARGUMENTS[index];
}

function getNumbers(address, count) {
  return Array.from({ length: count }, (_, index) => view.getFloat64(address + 8 * index, true));
}

function getIntegers(address, count) {
  return Array.from({ length: count }, (_, index) => view.getInt32(address + 4 * index, true));
}

// What a call gives, in the shape of what it gives natively.
function call({ name, arguments: given, status: expected, output }) {
  const pointers = given.map(putArgument);
  const { structure, numbers, integers } = output?.shape ?? {};
  const header = structure ? HEADER : 0;
  if (output !== null) {
    if (structure) view.setUint32(OUTPUT, HEADER + 8 * numbers + 8 * Math.ceil(integers / 2), true);
    pointers.push(OUTPUT);
  }
  // Size, four integers, padding, two numbers.
  view.setUint32(DETAILS, 40, true);
  const status = instance.exports[name](...pointers, DETAILS);
  if (status !== expected) throw new Error(`${name}: status ${status}, natively ${expected}`);
  const details = { numbers: getNumbers(DETAILS + 24, 2), integers: getIntegers(DETAILS + 4, 4) };
  if (output === null || status !== 0) return { details, output: { numbers: [], integers: [] } };
  return {
    details,
    output: {
      numbers: getNumbers(OUTPUT + header, numbers),
      integers: getIntegers(OUTPUT + header + 8 * numbers, integers),
    },
  };
}

let compared = 0;
let different = 0;
let worst = 0;
const names = new Set();

function compareNumbers(found, native) {
  // Infinite ones are words in JSON.
  const expected = native.map(Number);
  const scale = Math.max(...expected.filter(Number.isFinite).map(Math.abs), Number.MIN_VALUE);
  found.forEach((number, index) => {
    compared += 1;
    if (!Object.is(number, expected[index])) {
      different += 1;
      const difference = Math.abs(number - expected[index]) / scale;
      // Not even NaN passes.
      worst = Number.isNaN(difference) ? Infinity : Math.max(worst, difference);
    }
  });
}

for (const { kind, parameters, cases } of native.platforms) {
  putStructure(PARAMETERS, parameters);
  putModel(kind);
  for (const { inputs, calls } of cases) {
    putStructure(INPUTS, inputs);
    for (const native of calls) {
      const found = call(native);
      names.add(native.name);
      compareNumbers(found.details.numbers, native.details.numbers);
      compareNumbers(found.output.numbers, native.output?.numbers ?? []);
      const integers = JSON.stringify([found.details.integers, found.output.integers]);
      const expected = JSON.stringify([native.details.integers, native.output?.integers ?? []]);
      if (integers !== expected) throw new Error(`${native.name}: ${integers}, natively ${expected}`);
    }
  }
}
const verdict = different === 0 ? "every bit equal" : `${different} differ, by ${worst} at most`;
console.log(`WebAssembly in Node ${process.version} against native: ${names.size} functions, ${compared} numbers, ${verdict}`);
process.exit(compared > 0 && worst <= 1e-15 ? 0 : 1);

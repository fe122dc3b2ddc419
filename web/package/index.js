// cnctrans for node: the functions of api.js, with the files of the machine where a path stands.
'use strict';
const fs = require('fs');
const path = require('path');
const {makeApi, UsageError} = require('./api.js');
const {makeEngine} = require('./engine.js');
const create = require('./cnctrans.js');

let made = null;
// The engine is compiled once, at the first call.
function engine() {
  made = made || WebAssembly.compile(fs.readFileSync(path.join(__dirname, 'cnctrans.wasm'))).then((wasm) => makeEngine(create, wasm));
  return made;
}

function open(name) {
  try {
    return {name: path.basename(name), bytes: new Uint8Array(fs.readFileSync(name))};
  } catch (e) {
    throw new UsageError(name + ": can't be read: " + e.message);
  }
}

const api = makeApi({command: async (args, files, host) => (await engine()).command(args, files, host)}, open);

module.exports = {
  translate: api.translate,
  verify: api.verify,
  check: api.check,
  run: api.run,
  dialects: api.dialects,
  version: api.version,
  command: api.command,
  UsageError,
};

// Runs the engine beside the page. In: {id, wasm} once (the module's bytes), then {id, call, args} for a function of api.js; out: {id, value} or {id, error}.
'use strict';
let api = null;
self.onmessage = async (message) => {
  const {id, wasm, call, args} = message.data;
  try {
    if (wasm) {
      api = makeApi(makeEngine(createCnctrans, await WebAssembly.compile(wasm)));
      self.postMessage({id});
    } else {
      self.postMessage({id, value: await api[call](...args)});
    }
  } catch (e) {
    self.postMessage({id, error: String(e && e.message || e)});
  }
};

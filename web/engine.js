// One run of the command in an instance of its own: files go in; files, texts and the exit status come out. The floor of api.js.
'use strict';

// create: the factory that emscripten has made; wasm: the compiled module.
function makeEngine(create, wasm) {
  const folder = '/job';

  function putFile(fs, name, bytes) {
    const path = folder + '/' + name;
    let made = '';
    for (const part of path.split('/').slice(1, -1)) {
      made += '/' + part;
      if (!fs.analyzePath(made).exists) fs.mkdir(made);
    }
    fs.writeFile(path, bytes);
  }

  function filesBelow(fs, path, found) {
    for (const name of fs.readdir(path)) {
      if (name === '.' || name === '..') continue;
      const below = path + '/' + name;
      if (fs.isDir(fs.stat(below).mode)) filesBelow(fs, below, found);
      else found.push({name: below.slice(folder.length + 1), bytes: fs.readFile(below)});
    }
    return found;
  }

  // What a stream said, byte for byte.
  function collector() {
    let bytes = new Uint8Array(4096), size = 0;
    return {
      put(byte) {
        if (size === bytes.length) {
          const more = new Uint8Array(size * 2);
          more.set(bytes);
          bytes = more;
        }
        bytes[size++] = byte;
      },
      text: () => new TextDecoder().decode(bytes.subarray(0, size)),
    };
  }

  // args: as on the command line; files: [{name, bytes}], names below the folder that the command runs in.
  // Gives {status, stdout, stderr, files}: the files are those that are new or other than before.
  // host, for node's command: {stdin, stdout, stderr, prepare(FS)} in the place of files and texts.
  async function command(args, files, host) {
    const out = collector(), err = collector();
    let status = 0;
    const module = await create({
      noInitialRun: true,
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(wasm, imports).then((instance) => done(instance, wasm));
        return {};
      },
      stdin: host ? host.stdin : () => null,
      stdout: host ? host.stdout : out.put,
      stderr: host ? host.stderr : err.put,
      onExit: (code) => { status = code; },
      quit: (code, thrown) => { status = code; throw thrown; },
    });
    const fs = module.FS, before = new Map();
    if (host) {
      host.prepare(fs);
    } else {
      fs.mkdir(folder);
      fs.chdir(folder);
      for (const f of files || []) {
        putFile(fs, f.name, f.bytes);
        before.set(f.name, f.bytes);
      }
    }
    try {
      const code = module.callMain(args.slice());
      if (typeof code === 'number' && code) status = code;
    } catch (e) {
      if (!e || e.name !== 'ExitStatus') throw e;
      status = e.status;
    }
    if (host) return {status};
    const same = (a, b) => a && a.length === b.length && a.every((byte, i) => byte === b[i]);
    const made = filesBelow(fs, folder, []).filter((f) => !same(before.get(f.name), f.bytes));
    return {status, stdout: out.text(), stderr: err.text(), files: made};
  }

  return {command};
}

if (typeof module !== 'undefined') module.exports = {makeEngine};

#!/usr/bin/env node
// The command, as WebAssembly on the files of this machine.
'use strict';
const fs = require('fs');
const path = require('path');
const {command} = require('../index.js');

function writer(descriptor) {
  const buffer = Buffer.alloc(65536);
  let size = 0;
  const flush = () => {
    for (let done = 0; done < size;) {
      try {
        done += fs.writeSync(descriptor, buffer, done, size - done);
      } catch (e) {
        if (e.code !== 'EAGAIN') break; // nobody reads any more
      }
    }
    size = 0;
  };
  return {flush, put(byte) {
    if (byte === null) return;
    buffer[size++] = byte;
    if (size === buffer.length) flush();
  }};
}

let input = null, at = 0;
function stdin() {
  if (!input) {
    try { input = fs.readFileSync(0); } catch (e) { input = Buffer.alloc(0); }
  }
  return at < input.length ? input[at++] : null;
}

const out = writer(1), err = writer(2);
command(process.argv.slice(2), [], {
  stdin,
  stdout: out.put,
  stderr: err.put,
  // Every folder at the root of this machine, but for those that are no files or that the engine has itself.
  prepare(engineFiles) {
    if (process.platform === 'win32') {
      const root = path.parse(process.cwd()).root;
      engineFiles.mkdir('/here');
      engineFiles.mount(engineFiles.filesystems.NODEFS, {root}, '/here');
      engineFiles.chdir('/here/' + path.relative(root, process.cwd()).split(path.sep).join('/'));
      return;
    }
    for (const name of fs.readdirSync('/')) {
      if (name === 'dev' || name === 'proc' || name === 'sys' || !fs.statSync('/' + name, {throwIfNoEntry: false})?.isDirectory()) continue;
      if (!engineFiles.analyzePath('/' + name).exists) engineFiles.mkdir('/' + name);
      engineFiles.mount(engineFiles.filesystems.NODEFS, {root: '/' + name}, '/' + name);
    }
    engineFiles.chdir(process.cwd());
  },
}).then((done) => {
  out.flush();
  err.flush();
  process.exitCode = done.status;
}, (e) => {
  out.flush();
  err.flush();
  process.stderr.write('cnctrans: ' + (e && e.stack || e) + '\n');
  process.exitCode = 2;
});

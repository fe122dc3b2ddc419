// The installed npm package: the example of its README, its functions, and the same answers as the program of this machine.
// usage: node package_test.js CNCTRANS EXAMPLES      in a folder where the package is installed.
'use strict';
const assert = require('assert');
const fs = require('fs');
const os = require('os');
const path = require('path');
const {execFileSync, spawnSync} = require('child_process');
const {createRequire} = require('module');
const [native, examples] = process.argv.slice(2).map((p) => path.resolve(p));
const here = createRequire(path.join(process.cwd(), 'x.js')), home = path.dirname(here.resolve('cnctrans'));
const cnctrans = here('cnctrans');

const part = {name: 'part.pim', text: 'G17 G90 G71 G94\nG54\nT1 D1 M6\nS600 M3\nG0 G43 X0 Y0 Z5\nG1 Z-2 F100\nX50 F200\nG0 Z50\nM30\n'};

const tests = {
  async 'the example of its README'() {
    const example = /```js\n([^]*?)```/.exec(fs.readFileSync(path.join(home, 'README.md'), 'utf8'))[1];
    fs.writeFileSync('example.js', example);
    const said = execFileSync(process.execPath, ['example.js'], {encoding: 'utf8'});
    assert.match(said, /^verified: /);
    assert.match(said, /part\.MPF/);
  },

  async 'a translation'() {
    const file = path.join(examples, 'fagor', 'flange.pim');
    const done = await cnctrans.translate(file, {from: 'fagor', to: 'sinumerik'});
    assert.deepStrictEqual([done.ok, done.status, done.verified], [true, 'translated', true]);
    assert.deepStrictEqual(done.outputs.map((f) => f.name), ['flange.MPF', 'L20.SPF']);
    const d = done.diagnostics.find((m) => m.code === 'TRN-392');
    assert.deepStrictEqual([d.severity, d.file, d.line, d.endLine], ['warning', 'flange.pim', 30, 30]);
    // Each line knows where it comes from: the comment of the drills stands in both.
    const at = (text, line) => text.split('\n').findIndex((l) => l.includes(line));
    const source = fs.readFileSync(file, 'utf8'), main = done.outputs[0];
    assert.deepStrictEqual(main.lines[at(main.text, 'outside contour')], [at(source, 'outside contour') + 1]);
    assert.strictEqual(done.report.verdict.status, 'verified');
  },

  async 'a refused program'() {
    const done = await cnctrans.translate({name: 'bad.pim', text: 'G17 G90 G71 G94\nG54\nG777\nG1 X10 Y0 F100\nM30\n'}, {from: 'fagor', to: 'num'});
    assert.deepStrictEqual([done.ok, done.status, done.verified, done.outputs], [false, 'refused', false, []]);
    assert.strictEqual(done.diagnostics.find((m) => m.severity === 'error').line, 3);
  },

  async 'a report as HTML'() {
    const done = await cnctrans.translate(part, {to: 'heidenhain', report: 'html'});
    assert.match(done.report, /^<!DOCTYPE html>/);
    assert.strictEqual(done.outputs[0].lines, undefined);
  },

  async 'a program that calls another, with a machine and tools'() {
    const main = {name: 'main.pim', text: 'G17 G90 G71 G94\nG54\nT1 D1 M6\nS600 M3\nG0 G43 X0 Y0 Z5\n(CALL 77)\nG0 Z50\nM30\n'};
    const sub = {name: '000077.pim', text: '%77,MX,\n(SUB 77)\nG1 X5 F100\n(RET)\n'};
    const done = await cnctrans.translate(main, {
      from: 'fagor', to: 'num', machine: 'fagor-mill', libraries: [sub], tools: {name: 'tools.csv', text: 'number;radius;length\n1;5;80\n'}, numbering: 'none',
    });
    assert.strictEqual(done.verified, true, done.verdict);
    assert.strictEqual(done.outputs.length, 2);
    const alone = await cnctrans.translate(main, {from: 'fagor', to: 'num'});
    assert.ok(!alone.verified);
  },

  async 'a comparison'() {
    const done = await cnctrans.translate(part, {from: 'fagor', to: 'sinumerik'}), directions = {from: 'fagor', to: 'sinumerik'};
    assert.strictEqual((await cnctrans.verify(part, done.outputs, directions)).verified, true);
    const wrong = {name: 'PART.MPF', text: done.outputs[0].text.replace('X50', 'X51')};
    const said = await cnctrans.verify(part, wrong, directions);
    assert.deepStrictEqual([said.ok, said.verified], [false, false]);
    assert.match(said.verdict, /51/);
  },

  async 'a check'() {
    assert.strictEqual((await cnctrans.check(part)).ok, true);
    const bad = await cnctrans.check({name: 'bad.xpi', text: '%1\nN10 G99\nN20 M2\n'}, {dialect: 'num'});
    assert.deepStrictEqual([bad.ok, bad.diagnostics[0].line], [false, 2]);
  },

  async 'a run'() {
    const program = {name: 'count.pim', text: '(P1=P100*2)\nG90 G71 G94\nG54\nT1 D1\nG0 X0\nG1 X10 F100\nM30\n'};
    const done = await cnctrans.run(program, {dialect: 'fagor', set: {P100: 21}, events: true});
    assert.deepStrictEqual([done.ok, done.ended, done.variables.P1], [true, 'end', 42]);
    const move = done.events.find((e) => e.event === 'linear');
    assert.deepStrictEqual([move.line, move.to.X], [6, 10]);
    const cut = await cnctrans.run(program, {dialect: 'fagor', maxEvents: 2});
    assert.deepStrictEqual([cut.ok, cut.ended], [false, 'limit']);
  },

  async 'wrong calls'() {
    const wrong = (promise, text) => assert.rejects(promise, (e) => e instanceof cnctrans.UsageError && e.message.includes(text));
    await wrong(cnctrans.translate('nowhere.pim', {to: 'num'}), 'nowhere.pim');
    await wrong(cnctrans.translate(part, {to: 'nun'}), 'did you mean num');
    await wrong(cnctrans.translate(part, {to: 'num', fro: 'fagor'}), 'no option fro');
    await wrong(cnctrans.translate({text: ''}, {to: 'num'}), 'neither a path');
    await wrong(cnctrans.translate(part, {to: 'num', numbering: 'some'}), 'numbering');
  },

  async 'the command'() {
    const command = path.join('node_modules', '.bin', 'cnctrans'), run = (args, more) => spawnSync(command, args, Object.assign({encoding: 'utf8'}, more));
    fs.rmSync('out', {recursive: true, force: true});
    fs.writeFileSync('part.pim', part.text);
    const done = run(['--from', 'fagor', '--to', 'num', 'part.pim', '-o', 'out/']);
    assert.strictEqual(done.status, 0, done.stderr);
    assert.match(done.stderr, /verified: /);
    assert.match(fs.readFileSync('out/part.xpi', 'utf8'), /X50/);
    const piped = run(['--from', 'fagor', '--to', 'num', '-'], {input: part.text});
    assert.strictEqual(piped.status, 0, piped.stderr);
    assert.match(piped.stdout, /X50/);
    assert.strictEqual(run(['--nothing']).status, 2);
    fs.writeFileSync('bad.xpi', '%1\nN10 G99\nN20 M2\n');
    assert.strictEqual(run(['check', '--dialect', 'num', 'bad.xpi']).status, 1);
  },

  // Digits, orders, messages: nothing comes out otherwise under the other compiler and its library.
  async 'the same answers as the program of this machine, in every direction'() {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'cnctrans-'));
    try {
      let count = 0;
      const {languages} = await cnctrans.dialects();
      for (const from of fs.readdirSync(examples)) {
        if (!languages.some((l) => l.id === from)) continue;
        for (const name of fs.readdirSync(path.join(examples, from))) {
          const bytes = fs.readFileSync(path.join(examples, from, name));
          fs.writeFileSync(path.join(folder, name), bytes);
          for (const {id} of languages) {
            const args = ['--from', from, '--to', id, name, '-o', 'out/', '--report', 'report.json', '--color', 'never'];
            fs.rmSync(path.join(folder, 'out'), {recursive: true, force: true});
            fs.rmSync(path.join(folder, 'report.json'), {force: true});
            const wanted = spawnSync(native, args, {cwd: folder, encoding: 'utf8'});
            const got = await cnctrans.command(args, [{name, bytes}]), what = from + '/' + name + ' to ' + id;
            assert.deepStrictEqual([what, got.status, got.stderr], [what, wanted.status, wanted.stderr]);
            for (const f of got.files) {
              if (/\/\./.test(f.name)) continue; // what was written when
              assert.ok(Buffer.from(f.bytes).equals(fs.readFileSync(path.join(folder, f.name))), what + ': ' + f.name + ' is another one');
              count++;
            }
          }
          fs.rmSync(path.join(folder, name));
        }
      }
      assert.ok(count > 60, String(count));
    } finally {
      fs.rmSync(folder, {recursive: true});
    }
  },
};

(async () => {
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test();
      console.log('ok ' + name);
    } catch (e) {
      console.log('FAILED ' + name + '\n' + e.stack);
      process.exitCode = 1;
    }
  }
})();

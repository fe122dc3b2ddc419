// translate, verify, check, run on an engine (engine.js): what a program asks in words of its own, the command answers. Used by the page's worker and by the npm package.
'use strict';

// A call that can't be done: a wrong option, a file that is not there. What is wrong in a program is no such error, it stands in the result.
class UsageError extends Error {
  constructor(message) {
    super(message);
    this.name = 'UsageError';
  }
}

// engine: of makeEngine; open(path): {name, bytes} of a file of the machine, where there is one.
function makeApi(engine, open) {
  // What an option is on the command line. text, number: --option VALUE; yes, no: --option when it is true, or false; file: its name in
  // the job; texts: once for each; pairs: NAME=VALUE for each.
  const reading = {
    machine: ['--machine', 'file'], tools: ['--tools', 'file'], libraries: ['--lib', 'files'], reader: ['--reader', 'text'],
  };
  const running = {
    set: ['--set', 'pairs'], skip: ['--skip', 'list'], maxEvents: ['--max-events', 'number'], maxSteps: ['--max-steps', 'number'],
  };
  const directed = {
    from: ['--from', 'text'], to: ['--to', 'text'], targetMachine: ['--target-machine', 'file'], explore: ['--explore', 'yes'], replays: ['--replays', 'number'],
  };
  const writing = {
    unsupported: ['--unsupported', 'text'], draft: ['--draft', 'yes'], numbering: ['--numbering', 'text'], numberStep: ['--number-step', 'number'],
    cycles: ['--cycles', 'text'], structure: ['--structure', 'text'], annotate: ['--annotate', 'yes'], origin: ['--no-origin', 'no'],
    encoding: ['--encoding', 'text'], eol: ['--eol', 'text'], prove: ['--no-verify', 'no'], report: [null, 'own'],
  };
  const OPTIONS = {
    translate: Object.assign({}, directed, writing, reading, running),
    verify: Object.assign({}, directed, reading, running),
    check: Object.assign({dialect: ['--dialect', 'text']}, reading),
    run: Object.assign({dialect: ['--dialect', 'text'], events: [null, 'own']}, reading, running),
  };

  async function fileOf(what, wanted) {
    if (typeof what === 'string') {
      if (!open) throw new UsageError(wanted + ': there are no files here, use {name, text} for ' + JSON.stringify(what));
      return open(what);
    }
    if (!what || typeof what.name !== 'string' || (what.text === undefined && !what.bytes))
      throw new UsageError(wanted + ': neither a path nor {name, text} or {name, bytes}');
    const bytes = what.bytes || new TextEncoder().encode(what.text);
    return {name: what.name.split(/[\\/]/).pop(), bytes};
  }

  // A job: the files and the arguments of a call.
  async function job(call, programs, options) {
    const files = [], args = [];
    const add = async (what, wanted, folder) => {
      const file = await fileOf(what, wanted), name = (folder || '') + file.name;
      if (files.some((f) => f.name === name)) throw new UsageError(wanted + ': two files are called ' + file.name);
      files.push({name, bytes: file.bytes});
      return name;
    };
    const inputs = [];
    for (const p of programs) inputs.push(await add(p, 'program'));
    for (const [name, value] of Object.entries(options || {})) {
      const row = OPTIONS[call][name];
      if (!row) throw new UsageError(call + ' has no option ' + name + '; there are ' + Object.keys(OPTIONS[call]).join(', '));
      if (value === undefined || value === null) continue;
      const [option, kind] = row;
      if (kind === 'text' || kind === 'number') args.push(option, String(value));
      else if (kind === 'yes') { if (value) args.push(option); }
      else if (kind === 'no') { if (!value) args.push(option); }
      else if (kind === 'list') args.push(option, [].concat(value).join(','));
      else if (kind === 'pairs') for (const [k, v] of Object.entries(value)) args.push(option, k + '=' + v);
      else if (kind === 'file') args.push(option, typeof value === 'string' && !/[./\\]/.test(value) ? value : await add(value, name, name + '/'));
      else if (kind === 'files' && [].concat(value).length) {
        for (const file of [].concat(value)) await add(file, name, 'libraries/');
        args.push(option, 'libraries');
      }
    }
    return {files, args: inputs.concat(args), program: inputs[0]};
  }

  const camel = (name) => name.replace(/_(.)/g, (all, letter) => letter.toUpperCase());
  const renamed = (row) => Object.fromEntries(Object.entries(row).map(([k, v]) => [camel(k), v]));

  // The messages of a run; what is no list of messages is a wrong call.
  function messages(done) {
    if (done.status === 2) {
      const plain = done.stderr.trim() || done.stdout.trim();
      let said = plain.split('\n')[0];
      try { said = JSON.parse(plain).map((m) => m.message).join('; '); } catch (e) { /* it is the first line */ }
      throw new UsageError(said);
    }
    try {
      return JSON.parse(done.stderr).map(renamed);
    } catch (e) {
      throw new Error('the engine stopped: ' + done.stderr);
    }
  }
  // About files and verdicts, not about the program.
  const manners = /^CNC-(WRITTEN|VERDICT|REFUSED|DRAFT)$/;
  const about = (list) => list.filter((m) => !manners.test(m.code));

  async function translate(program, options) {
    const kind = (options && options.report) || 'json';
    if (!['json', 'html', 'md', 'sarif'].includes(kind)) throw new UsageError('report: json, html, md or sarif');
    const {files, args, program: name} = await job('translate', [program], options);
    const report = 'report.' + kind;
    const done = await engine.command(['--diagnostics', 'json', '--color', 'never', '-o', 'out/', '--report', report].concat(args), files);
    const said = messages(done), written = done.files.find((f) => f.name === report);
    const verdict = said.filter((m) => m.code === 'CNC-VERDICT').map((m) => m.message.slice(name.length + 2)).pop();
    const text = written && new TextDecoder().decode(written.bytes);
    // In the order in which they are written: the main program first.
    const order = said.filter((m) => m.code === 'CNC-WRITTEN').map((m) => m.message.replace('wrote ', ''));
    const outputs = done.files.filter((f) => order.includes(f.name) && f.name !== report)
      .sort((a, b) => order.indexOf(a.name) - order.indexOf(b.name))
      .map((f) => ({name: f.name.slice(4), bytes: f.bytes, text: new TextDecoder(decoderOf(f.bytes)).decode(f.bytes)}));
    const result = {
      ok: done.status === 0,
      status: ['translated', 'refused', '', 'different', 'draft'][done.status] || 'failed',
      verified: done.status === 0 && /^verified/.test(verdict || ''),
      verdict: verdict || (said.filter((m) => m.code === 'CNC-REFUSED').map((m) => m.message.slice(name.length + 2)).pop()) || '',
      outputs, diagnostics: about(said),
    };
    if (kind !== 'json') return Object.assign(result, {report: text || ''});
    const data = text && JSON.parse(text);
    for (const output of outputs) {
      const at = data && data.targets.find((t) => t.name === 'out/' + output.name);
      // The lines of the source that a line of the translation comes from; [] where it has none.
      output.lines = at ? at.lines.map((l) => (l.others || []).map((o) => o[1])) : [];
    }
    return Object.assign(result, {report: data || null});
  }

  // The encoding of a text: UTF-8 where it is that.
  function decoderOf(bytes) {
    try {
      new TextDecoder('utf-8', {fatal: true}).decode(bytes);
      return 'utf-8';
    } catch (e) {
      return 'windows-1252';
    }
  }

  async function verify(program, translation, options) {
    const {files, args} = await job('verify', [program].concat(translation), options);
    const done = await engine.command(['verify', '--diagnostics', 'json', '--color', 'never'].concat(args), files);
    const said = messages(done), verdict = done.stdout.trim();
    return {ok: done.status === 0, verified: done.status === 0 && /^verified/.test(verdict), verdict, diagnostics: about(said)};
  }

  async function check(program, options) {
    const {files, args} = await job('check', [program], options);
    const done = await engine.command(['check', '--diagnostics', 'json', '--color', 'never'].concat(args), files);
    return {ok: done.status === 0, summary: done.stdout.trim(), diagnostics: about(messages(done))};
  }

  async function run(program, options) {
    const traced = Boolean(options && options.events);
    const {files, args} = await job('run', [program], options);
    const trace = traced ? ['--trace', 'trace.jsonl'] : [];
    const done = await engine.command(['run', '--diagnostics', 'json', '--color', 'never', '--vars', 'variables.json'].concat(trace, args), files);
    const said = messages(done);
    const text = (name) => new TextDecoder().decode((done.files.find((f) => f.name === name) || {bytes: new Uint8Array()}).bytes);
    const result = {
      ok: done.status === 0,
      ended: ['end', 'error', '', 'limit'][done.status] || 'error',
      summary: done.stdout.trim(),
      variables: JSON.parse(text('variables.json') || '{}'),
      diagnostics: about(said),
    };
    if (traced) result.events = text('trace.jsonl').split('\n').filter(Boolean).map((line) => JSON.parse(line));
    return result;
  }

  // The languages and the built-in machines: {languages: [{id, name, read, extensions}], machines: [...]}.
  async function dialects() {
    const languages = [];
    let machines = [];
    for (const line of (await engine.command(['dialects'])).stdout.split('\n')) {
      const names = /^machines: (.*)$/.exec(line), language = /^(\S+) +(.*?) {2,}(.*)$/.exec(line);
      if (names) machines = names[1].split(' ');
      else if (language)
        languages.push({id: language[1], name: language[2].replace(' (written only)', ''), read: !line.includes('(written only)'),
          extensions: language[3].match(/\.\w+/g) || []});
    }
    return {languages, machines};
  }
  const version = async () => (await engine.command(['--version'])).stdout.trim().replace(/^cnctrans /, '');

  return {translate, verify, check, run, dialects, version, command: engine.command};
}

if (typeof module !== 'undefined') module.exports = {makeApi, UsageError};

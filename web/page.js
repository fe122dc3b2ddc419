// The page: files come in, one job at a time goes to the worker, its outputs and its report are shown.
'use strict';
(function () {
  const $ = (id) => document.getElementById(id);
  const data = window.cnctransEngine;
  const state = {files: [], worker: null, calls: new Map(), next: 1, urls: [], engine: null, known: null, shown: null};
  const isData = (name) => /\.(json|csv|t|toa)$/i.test(name); // machines and tools; everything else is a program

  function say(text, kind) {
    $('said').textContent = text;
    $('said').className = kind || '';
  }

  // ---- the worker -------------------------------------------------------------------------------------------------
  async function unpacked(base64) {
    const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const plain = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Uint8Array(await new Response(plain).arrayBuffer());
  }

  function post(message) {
    return new Promise((done, failed) => {
      const id = state.next++;
      state.calls.set(id, {done, failed});
      state.worker.postMessage(Object.assign({id}, message));
    });
  }
  const call = (name, ...args) => post({call: name, args});

  async function startWorker() {
    state.worker = new Worker(URL.createObjectURL(new Blob([data.code], {type: 'text/javascript'})));
    state.worker.onmessage = (m) => {
      const waiting = state.calls.get(m.data.id);
      state.calls.delete(m.data.id);
      if (m.data.error) waiting.failed(new Error(m.data.error));
      else waiting.done(m.data.value);
    };
    state.worker.onerror = (e) => stopWorker(e.message || 'the worker stopped');
    await post({wasm: state.engine});
  }
  function stopWorker(why) {
    state.worker.terminate();
    state.worker = null;
    for (const waiting of state.calls.values()) waiting.failed(new Error(why));
    state.calls.clear();
  }

  async function start() {
    if (!data) throw new Error('engine-data.js is missing beside this page');
    if (!window.DecompressionStream || !window.WebAssembly) throw new Error('this browser is too old for this page');
    state.engine = await unpacked(data.wasm);
    await startWorker();
    state.known = await call('dialects');
    for (const language of state.known.languages) {
      choice($('to'), language.id, language.name);
      if (language.read) choice($('from'), language.id, language.name);
    }
    $('to').value = 'sinumerik';
    $('version').textContent = await call('version');
    for (const name of Object.keys(examples())) choice($('example'), name);
    say('Ready. No program yet.');
    refresh();
    if (!$('go').disabled) await translate(); // it was dropped meanwhile
  }

  // ---- what is given ----------------------------------------------------------------------------------------------
  const examples = () => JSON.parse($('examples').textContent);

  function choice(select, value, text) {
    const option = document.createElement('option');
    option.value = value;
    option.textContent = text || value;
    select.append(option);
  }

  // A list is made anew, and what was chosen stays chosen.
  function fill(select, first, values) {
    const chosen = select.value;
    select.replaceChildren();
    if (first) choice(select, '', first);
    for (const value of values) choice(select, value);
    if (Array.from(select.options).some((o) => o.value === chosen)) select.value = chosen;
  }

  function refresh() {
    $('given').replaceChildren(...state.files.map((f) => {
      const item = document.createElement('li');
      item.textContent = f.name + ' (' + f.bytes.length.toLocaleString('en') + ' bytes)';
      return item;
    }));
    const names = state.files.map((f) => f.name), own = names.filter((n) => /\.json$/i.test(n));
    const machines = (language) => (state.known ? state.known.machines : []).filter((m) => !language || m.startsWith(language + '-')).concat(own);
    fill($('program'), '', names.filter((n) => !isData(n)));
    fill($('machine'), 'by the program', machines($('from').value));
    fill($('target-machine'), "as the source's", machines($('to').value));
    fill($('tools'), 'none', names.filter(isData));
    $('go').disabled = !state.worker || !$('program').value;
  }

  async function take(list) {
    const files = await Promise.all(Array.from(list, async (f) => ({name: f.name, bytes: new Uint8Array(await f.arrayBuffer())})));
    if (!files.length) return;
    // Programs begin a new job; a machine, or a list of tools, is added to the one that is there.
    const programs = files.filter((f) => !isData(f.name));
    state.files = state.files.filter((f) => !(programs.length && !isData(f.name)) && !files.some((g) => g.name === f.name)).concat(files);
    refresh();
    if (programs.length && !$('go').disabled) await translate();
  }

  // ---- a job ------------------------------------------------------------------------------------------------------
  function options() {
    const file = (value) => state.files.find((f) => f.name === value) || value;
    const program = $('program').value, others = state.files.filter((f) => f.name !== program && !isData(f.name));
    const o = {to: $('to').value, numbering: $('numbering').value, cycles: $('cycles').value, unsupported: $('unsupported').value, report: 'html'};
    if ($('from').value) o.from = $('from').value;
    if ($('machine').value) o.machine = file($('machine').value);
    if ($('target-machine').value) o.targetMachine = file($('target-machine').value);
    if ($('tools').value) o.tools = file($('tools').value);
    if (others.length) o.libraries = others;
    return o;
  }

  async function translate() {
    $('go').disabled = true;
    $('stop').hidden = false;
    say('translating and proving ...', 'busy');
    const begin = performance.now();
    try {
      const program = state.files.find((f) => f.name === $('program').value);
      show(await call('translate', program, options()), (performance.now() - begin) / 1000);
    } catch (e) {
      say(e.message, 'bad');
      $('result').hidden = true;
      if (!state.worker) await startWorker();
    }
    $('go').disabled = !state.worker;
    $('stop').hidden = true;
  }

  function item(list, parts, kind) {
    const li = document.createElement('li');
    li.append(...parts);
    if (kind) li.className = kind;
    list.append(li);
  }
  function save(name, bytes, type) {
    const link = document.createElement('a'), url = URL.createObjectURL(new Blob([bytes], {type}));
    state.urls.push(url);
    link.href = url;
    link.download = name;
    link.textContent = 'save ' + name;
    return link;
  }

  function show(done, seconds) {
    const name = $('program').value;
    // The report has the whole sentence.
    const words = {translated: done.verdict.split('; ')[0] || 'translated', refused: 'refused: nothing is written; what is in the way stands at its line', different: done.verdict};
    say((words[done.status] || done.verdict || done.status) + ' (' + seconds.toFixed(1) + ' s)', done.verified ? 'good' : done.ok ? 'unsure' : 'bad');
    for (const url of state.urls.splice(0)) URL.revokeObjectURL(url);
    $('outputs').replaceChildren();
    for (const f of done.outputs) item($('outputs'), [save(f.name, f.bytes, 'application/octet-stream')]);
    if (done.report) item($('outputs'), [save(name + '.report.html', done.report, 'text/html')]);
    // Messages without a line have no place in the texts; without a report none has.
    $('messages').replaceChildren();
    for (const m of done.diagnostics)
      if (!m.line || !done.report) item($('messages'), [(m.line ? m.file + ':' + m.line + ': ' : '') + m.severity + ' ' + m.code + ': ' + m.message + (m.hint ? ' (' + m.hint + ')' : '')], m.severity);
    $('result').hidden = false;
    if (done.report) $('report').srcdoc = done.report;
    else $('report').removeAttribute('srcdoc');
    state.shown = {status: done.status, verified: done.verified, outputs: done.outputs.map((f) => ({name: f.name, text: f.text})), diagnostics: done.diagnostics, seconds};
  }

  // ---- hands ------------------------------------------------------------------------------------------------------
  $('files').addEventListener('change', () => take($('files').files).then(() => { $('files').value = ''; }));
  $('example').addEventListener('change', () => {
    const text = examples()[$('example').value];
    if (text === undefined) return;
    $('from').value = $('machine').value = $('tools').value = '';
    take([new File([text], $('example').value.split('/').pop())]);
  });
  $('job').addEventListener('submit', (e) => { e.preventDefault(); translate(); });
  $('stop').addEventListener('click', () => stopWorker('stopped'));
  for (const name of ['from', 'to']) $(name).addEventListener('change', refresh);
  // The keys of the drawing work as soon as it is there.
  $('report').addEventListener('load', () => {
    if (!$('report').hasAttribute('srcdoc')) return;
    $('said').scrollIntoView({block: 'start'});
    $('report').focus({preventScroll: true});
  });
  for (const name of ['dragenter', 'dragover'])
    document.addEventListener(name, (e) => { e.preventDefault(); document.body.classList.add('over'); });
  document.addEventListener('dragleave', (e) => { if (!e.relatedTarget) document.body.classList.remove('over'); });
  document.addEventListener('drop', (e) => {
    e.preventDefault();
    document.body.classList.remove('over');
    take(e.dataTransfer.files);
  });
  window.cnctransPage = {take, state, ready: start().catch((e) => say(e.message, 'bad'))};
})();

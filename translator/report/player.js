// Steps and plays along the path with both lines lit; the list of the tools with their times.
(function () {
  'use strict';
  var report = window.report, side = report.moves('source') ? 'source' : 'target', last = report.moves(side) - 1;
  var at = -1, timer = null;
  function byId(id) { return document.getElementById(id); }

  function show() {
    byId('step').value = at;
    byId('count').textContent = (at + 1) + ' / ' + (last + 1);
    byId('play').textContent = timer ? '||' : '\u25b6';
  }
  function go(to) {
    at = Math.max(-1, Math.min(last, to));
    if (at < 0) { report.none(); } else { report.pick(side, at); }
    show();
  }
  function stop() {
    if (timer) clearInterval(timer);
    timer = null;
    show();
  }
  function play() {
    if (timer) return stop();
    if (at >= last) go(-1);
    timer = setInterval(function () {
      if (at >= last) return stop();
      go(at + 1);
    }, 1000 / +byId('speed').value);
    show();
  }
  byId('step').max = last;
  byId('step').addEventListener('input', function () { stop(); go(+byId('step').value); });
  byId('first').addEventListener('click', function () { stop(); go(0); });
  byId('back').addEventListener('click', function () { stop(); go(at - 1); });
  byId('next').addEventListener('click', function () { stop(); go(at + 1); });
  byId('play').addEventListener('click', play);
  byId('speed').addEventListener('change', function () { if (timer) { stop(); play(); } });
  report.onPick(function (picked, index) { if (picked === side) { at = index; show(); } });
  document.addEventListener('keydown', function (e) {
    if (/^(INPUT|SELECT|BUTTON)$/.test(e.target.tagName) && e.target.id !== 'step') return;
    var keys = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: last };
    if (e.key === ' ') { e.preventDefault(); play(); return; }
    if (keys[e.key] === undefined || e.ctrlKey || e.altKey || e.metaKey) return;
    e.preventDefault();
    stop();
    go(keys[e.key]);
  });
  if (last < 0) byId('player').style.display = 'none';
  show();

  // ---- tools ------------------------------------------------------------------------------------------------------
  function length(move) {
    var sum = 0, p = move.points;
    for (var i = 0; i + 5 < p.length; i += 3) sum += Math.hypot(p[i + 3] - p[i], p[i + 4] - p[i + 1], p[i + 5] - p[i + 2]);
    return sum;
  }
  function time(seconds) {
    var s = Math.round(seconds);
    return s < 60 ? s + ' s' : Math.floor(s / 60) + ' min ' + (s % 60) + ' s';
  }
  var order = [], tools = {};
  report.path(side).forEach(function (move) {
    var t = move.tool || 0;
    if (!tools[t]) { tools[t] = { moves: 0, feed: 0, rapid: 0, seconds: 0, open: false }; order.push(t); }
    tools[t].moves++;
    if (move.kind === 'rapid') { tools[t].rapid += length(move); return; }
    tools[t].feed += length(move);
    tools[t].seconds += move.seconds || 0;
    if (!move.seconds && length(move) > 0) tools[t].open = true;
  });
  var table = byId('tool-list');
  function row(cells, head) {
    var r = table.insertRow();
    cells.forEach(function (c) {
      var cell = r.insertCell();
      cell.textContent = c;
      if (head) cell.style.fontWeight = 600;
    });
  }
  row(['tool', 'moves', 'at feed, mm', 'rapid, mm', 'time at feed'], true);
  var sum = { moves: 0, feed: 0, rapid: 0, seconds: 0, open: false };
  order.forEach(function (t) {
    var x = tools[t];
    row([t ? 'T' + t : 'none selected', x.moves, x.feed.toFixed(0), x.rapid.toFixed(0), time(x.seconds) + (x.open ? ' and more' : '')]);
    ['moves', 'feed', 'rapid', 'seconds'].forEach(function (k) { sum[k] += x[k]; });
    sum.open = sum.open || x.open;
  });
  if (order.length > 1) row(['all', sum.moves, sum.feed.toFixed(0), sum.rapid.toFixed(0), time(sum.seconds) + (sum.open ? ' and more' : '')], true);
  if (!order.length) byId('tools').style.display = 'none';
})();

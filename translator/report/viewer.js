// The page of a report: two texts linked line to line, and both tool paths drawn over each other.
(function () {
  'use strict';
  var data = JSON.parse(document.getElementById('data').textContent);
  var lathe = data.kind === 'lathe';
  var colours = { source: 0x0969da, target: 0xe36209, picked: 0xd1006c };
  function byId(id) { return document.getElementById(id); }
  function key(place) { return place[0] + ':' + place[1]; }

  // ---- texts ------------------------------------------------------------------------------------------------------
  var rows = { source: {}, target: {} }, linked = { source: {}, target: {} };

  function fill(side, files) {
    var box = byId(side);
    files.forEach(function (file, f) {
      if (files.length > 1) {
        var title = document.createElement('div');
        title.className = 'file';
        title.textContent = file.name;
        box.appendChild(title);
      }
      file.lines.forEach(function (line, i) {
        var row = document.createElement('div'), number = document.createElement('span'), text = document.createElement('span');
        var place = f + ':' + (i + 1);
        row.className = 'line ' + line.status;
        row.title = line.status;
        number.className = 'n';
        number.textContent = i + 1;
        text.textContent = line.text || ' ';
        row.appendChild(number);
        row.appendChild(text);
        row.dataset.place = place;
        row.addEventListener('click', function () { pickLine(side, place, true); });
        box.appendChild(row);
        rows[side][place] = row;
        linked[side][place] = (line.others || []).map(key);
      });
    });
  }

  // ---- moves ------------------------------------------------------------------------------------------------------
  var paths = { source: data.source_path || [], target: data.target_path || [] };
  var movesOf = { source: {}, target: {} };
  ['source', 'target'].forEach(function (side) {
    paths[side].forEach(function (move, i) {
      var place = key(move.at);
      (movesOf[side][place] = movesOf[side][place] || []).push(i);
    });
  });

  // Lathes are drawn as on paper: Z to the right, X up.
  function point(move, i) {
    var p = move.points;
    return lathe ? [p[i + 2], p[i], 0] : [p[i], p[i + 1], p[i + 2]];
  }

  var scene = new THREE.Scene(), camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -1e5, 1e5);
  var box = new THREE.Box3(), target = new THREE.Vector3(), size = 100, zoom = 1;
  var angles = { around: lathe ? 0 : -Math.PI / 4, up: lathe ? 0 : Math.PI / 5 };
  var lines = {}, highlight = null, tool = null, renderer = null, flat = null;

  function segments(moves, keep) {
    var out = [];
    moves.forEach(function (move, index) {
      if (!keep(move, index)) return;
      for (var i = 0; i + 5 < move.points.length; i += 3) out.push.apply(out, point(move, i).concat(point(move, i + 3)));
    });
    return out;
  }
  function add(positions, colour, options) {
    var geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    var settings = { color: colour, transparent: true, opacity: options.opacity || 1, depthTest: false };
    var material = options.dash ? new THREE.LineDashedMaterial(Object.assign(settings, { dashSize: size / 80, gapSize: size / 120 }))
      : new THREE.LineBasicMaterial(settings);
    var object = new THREE.LineSegments(geometry, material);
    if (options.dash) object.computeLineDistances();
    object.renderOrder = options.order || 0;
    scene.add(object);
    return object;
  }
  function build() {
    ['source', 'target'].forEach(function (side) {
      paths[side].forEach(function (move) {
        for (var i = 0; i < move.points.length; i += 3) box.expandByPoint(new THREE.Vector3().fromArray(point(move, i)));
      });
    });
    if (box.isEmpty()) box.expandByPoint(new THREE.Vector3(0, 0, 0));
    box.getCenter(target);
    size = Math.max(box.getSize(new THREE.Vector3()).length(), 1);
    ['source', 'target'].forEach(function (side, order) {
      lines[side] = add(segments(paths[side], function (m) { return m.kind !== 'rapid'; }), colours[side],
        { dash: side === 'target', order: order });
      lines[side + '-rapid'] = add(segments(paths[side], function (m) { return m.kind === 'rapid'; }), colours[side],
        { dash: side === 'target', opacity: 0.35, order: order });
    });
  }

  function aim() {
    var holder = byId('canvas'), w = holder.clientWidth || 600, h = holder.clientHeight || 400;
    var half = size * 0.55 / zoom, aspect = w / h;
    camera.left = -half * aspect; camera.right = half * aspect; camera.top = half; camera.bottom = -half;
    var d = new THREE.Vector3(Math.cos(angles.up) * Math.sin(angles.around), -Math.cos(angles.up) * Math.cos(angles.around),
      Math.sin(angles.up));
    if (lathe) d.set(0, 0, 1);
    camera.up.set(0, lathe || Math.abs(angles.up) > 1.57 ? 1 : 0, lathe || Math.abs(angles.up) > 1.57 ? 0 : 1);
    camera.position.copy(target).addScaledVector(d, size);
    camera.lookAt(target);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return { w: w, h: h };
  }
  function screen(p, view) {
    var v = new THREE.Vector3(p[0], p[1], p[2]).project(camera);
    return [(v.x + 1) / 2 * view.w, (1 - v.y) / 2 * view.h];
  }
  // Without WebGL the same scene is drawn on a plain canvas through the same camera.
  function drawFlat(view) {
    var g = flat.getContext('2d'), ratio = window.devicePixelRatio || 1;
    flat.width = view.w * ratio; flat.height = view.h * ratio;
    g.scale(ratio, ratio);
    scene.children.forEach(function (object) {
      if (!object.visible) return;
      var p = object.geometry.attributes.position.array;
      g.strokeStyle = '#' + object.material.color.getHexString();
      g.globalAlpha = object.material.opacity;
      g.lineWidth = object === highlight ? 3 : object === tool ? 2 : 1.2;
      g.setLineDash(object.material.isLineDashedMaterial ? [6, 4] : []);
      g.beginPath();
      for (var i = 0; i + 5 < p.length; i += 6) {
        var a = screen([p[i], p[i + 1], p[i + 2]], view), b = screen([p[i + 3], p[i + 4], p[i + 5]], view);
        g.moveTo(a[0], a[1]); g.lineTo(b[0], b[1]);
      }
      g.stroke();
    });
  }
  function draw() {
    var view = aim();
    if (renderer) {
      renderer.setSize(view.w, view.h, false);
      renderer.render(scene, camera);
    } else {
      drawFlat(view);
    }
    triad(view);
    scale(view);
  }

  // ---- axes and scale ---------------------------------------------------------------------------------------------
  function triad(view) {
    var names = lathe ? [['Z', 1, 0, 0], ['X', 0, 1, 0]] : [['X', 1, 0, 0], ['Y', 0, 1, 0], ['Z', 0, 0, 1]];
    var unit = view.h / (camera.top - camera.bottom), at = [target.x, target.y, target.z], o = screen(at, view), out = '';
    names.forEach(function (n) {
      var e = screen([at[0] + n[1] / unit * 24, at[1] + n[2] / unit * 24, at[2] + n[3] / unit * 24], view);
      var x = 30 + e[0] - o[0], y = 34 + e[1] - o[1];
      out += '<line x1="30" y1="34" x2="' + x + '" y2="' + y + '" stroke="#57606a"/><text x="' + (x + 2) + '" y="' + y + '" fill="#1f2328">' + n[0] + '</text>';
    });
    byId('triad').innerHTML = out;
  }
  function scale(view) {
    var unit = view.h / (camera.top - camera.bottom), most = 120 / unit, power = Math.pow(10, Math.floor(Math.log10(most)));
    var length = [5, 2, 1].map(function (n) { return n * power; }).find(function (n) { return n <= most; }) || power;
    byId('scale').style.width = length * unit + 'px';
    byId('scale').firstChild.textContent = +length.toPrecision(1) + ' mm';
  }

  // ---- choosing ---------------------------------------------------------------------------------------------------
  function clearPicked() {
    document.querySelectorAll('.picked').forEach(function (e) { e.classList.remove('picked'); });
    [highlight, tool].forEach(function (object) { if (object) { scene.remove(object); object.geometry.dispose(); } });
    highlight = tool = null;
  }
  // Scrolls the text, never the page: who steps along the path keeps the drawing before the eyes.
  function reveal(row) {
    var text = row.parentNode, top = row.getBoundingClientRect().top - text.getBoundingClientRect().top;
    if (top < 0 || top > text.clientHeight - 40) text.scrollTop += top - text.clientHeight / 3;
  }
  function mark(side, places, scroll) {
    places.forEach(function (place, i) {
      var row = rows[side][place];
      if (!row) return;
      row.classList.add('picked');
      if (scroll && i === 0) reveal(row);
    });
  }
  // Of the lines on the other side (a cycle has as many as it has moves) the one that makes the same move.
  function counterpart(side, index, other, places) {
    var p = paths[side][index].points, found = null, least = 0.1;
    function apart(q, i, j) { return Math.hypot(p[i] - q[j], p[i + 1] - q[j + 1], p[i + 2] - q[j + 2]); }
    places.forEach(function (place) {
      (movesOf[other][place] || []).forEach(function (i) {
        var q = paths[other][i].points, d = apart(q, 0, 0) + apart(q, p.length - 3, q.length - 3);
        if (d < least) { least = d; found = place; }
      });
    });
    return found ? [found] : places;
  }
  function pickLine(side, place, scroll, only) {
    var other = side === 'source' ? 'target' : 'source', others = linked[side][place] || [];
    if (only) others = counterpart(side, only.index, other, others);
    clearPicked();
    mark(side, [place], scroll);
    mark(other, others, scroll);
    var positions = [];
    [[side, [place]], [other, others]].forEach(function (pair) {
      pair[1].forEach(function (p) {
        var indices = movesOf[pair[0]][p] || [];
        if (only && pair[0] === side) indices = [only.index];
        if (only && pair[0] !== side) indices = [];
        positions = positions.concat(segments(indices.map(function (i) { return paths[pair[0]][i]; }), function () { return true; }));
      });
    });
    if (positions.length) highlight = add(positions, colours.picked, { order: 9 });
    if (only) tool = cross(side, only.index);
    byId('move').textContent = describe(side, place, others, only);
    if (only && chosen) chosen(side, only.index);
    draw();
  }
  // A cross where the tool stands behind the move.
  function cross(side, index) {
    var move = paths[side][index], p = point(move, move.points.length - 3), arm = size / 45 / Math.sqrt(zoom), out = [];
    [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach(function (d) {
      out.push(p[0] - arm * d[0], p[1] - arm * d[1], p[2] - arm * d[2], p[0] + arm * d[0], p[1] + arm * d[1], p[2] + arm * d[2]);
    });
    return add(out, 0x1f2328, { order: 10 });
  }
  var chosen = null;  // who wants to know which move was picked
  function describe(side, place, others, only) {
    var a = side === 'source' ? [place] : others, b = side === 'source' ? others : [place];
    function list(places) {
      var text = '', from = 0, last = 0;
      places.map(function (p) { return +p.split(':')[1]; }).forEach(function (n) {
        if (n === last + 1) { last = n; return; }
        if (from) text += from === last ? from + ', ' : from + '-' + last + ', ';
        from = last = n;
      });
      return from ? text + (from === last ? from : from + '-' + last) : 'none';
    }
    var text = 'source line ' + list(a) + ', translation line ' + list(b);
    if (only) {
      var move = paths[side][only.index], p = move.points, n = p.length;
      text += ': ' + move.kind + ' to X' + p[n - 3].toFixed(3) + (lathe ? '' : ' Y' + p[n - 2].toFixed(3)) + ' Z' + p[n - 1].toFixed(3);
    }
    return text;
  }
  function shown(side, kind) {
    return byId('show-' + side).checked && (kind !== 'rapid' || byId('show-rapid').checked);
  }
  function pickAt(x, y) {
    var view = aim(), best = null, distance = 8;
    ['source', 'target'].forEach(function (side) {
      paths[side].forEach(function (move, index) {
        if (!shown(side, move.kind)) return;
        var a = screen(point(move, 0), view);
        for (var i = 3; i < move.points.length; i += 3) {
          var b = screen(point(move, i), view), dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
          var t = length ? Math.max(0, Math.min(1, ((x - a[0]) * dx + (y - a[1]) * dy) / length)) : 0;
          var d = Math.hypot(a[0] + t * dx - x, a[1] + t * dy - y);
          if (d < distance) { distance = d; best = { side: side, index: index }; }
          a = b;
        }
      });
    });
    if (best) pickLine(best.side, key(paths[best.side][best.index].at), true, best);
    return best;
  }

  // ---- controls ---------------------------------------------------------------------------------------------------
  function listen(canvas) {
    var down = null, fingers = {}, spread = 0;
    function apart() {
      var ids = Object.keys(fingers), a = fingers[ids[0]], b = fingers[ids[1]];
      return Math.hypot(a.x - b.x, a.y - b.y);
    }
    canvas.addEventListener('pointerdown', function (e) {
      fingers[e.pointerId] = { x: e.clientX, y: e.clientY };
      if (Object.keys(fingers).length === 2) { spread = apart(); down = null; return; }
      down = { x: e.clientX, y: e.clientY, moved: false, pan: e.button !== 0 || e.shiftKey };
      if (e.isTrusted) canvas.setPointerCapture(e.pointerId);
    });
    canvas.addEventListener('contextmenu', function (e) { e.preventDefault(); });
    window.addEventListener('pointermove', function (e) {
      if (fingers[e.pointerId]) fingers[e.pointerId] = { x: e.clientX, y: e.clientY };
      if (Object.keys(fingers).length === 2) {  // two fingers: larger, smaller
        var now = apart();
        if (spread > 0) zoom = Math.max(0.05, Math.min(500, zoom * now / spread));
        spread = now;
        draw();
        return;
      }
      if (!down) return;
      var dx = e.clientX - down.x, dy = e.clientY - down.y;
      if (!down.moved && Math.abs(dx) + Math.abs(dy) < 4) return;
      down.moved = true; down.x = e.clientX; down.y = e.clientY;
      if (down.pan || lathe) {
        var unit = (camera.top - camera.bottom) / canvas.clientHeight, right = new THREE.Vector3(), up = new THREE.Vector3();
        camera.matrixWorld.extractBasis(right, up, new THREE.Vector3());
        target.addScaledVector(right, -dx * unit).addScaledVector(up, dy * unit);
      } else {
        angles.around -= dx * 0.01;
        angles.up = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, angles.up + dy * 0.01));
      }
      draw();
    });
    ['pointerup', 'pointercancel'].forEach(function (name) {
      window.addEventListener(name, function (e) {
        delete fingers[e.pointerId];
        if (name === 'pointerup' && down && !down.moved && e.target === canvas) {
          var r = canvas.getBoundingClientRect();
          pickAt(e.clientX - r.left, e.clientY - r.top);
        }
        down = null;
      });
    });
    canvas.addEventListener('wheel', function (e) {
      e.preventDefault();
      zoom = Math.max(0.05, Math.min(500, zoom * Math.pow(1.1, -Math.sign(e.deltaY))));
      draw();
    });
  }
  function views() {
    var list = lathe ? [] : [['3D', -Math.PI / 4, Math.PI / 5], ['top', 0, Math.PI / 2], ['front', 0, 0], ['right', Math.PI / 2, 0]];
    list.concat([['fit', null, null]]).forEach(function (v) {
      var button = document.createElement('button');
      button.textContent = v[0];
      button.addEventListener('click', function () {
        if (v[1] !== null) { angles.around = v[1]; angles.up = v[2]; }
        zoom = 1; box.getCenter(target); draw();
      });
      byId('views').appendChild(button);
    });
    ['source', 'target', 'rapid'].forEach(function (id) {
      byId('show-' + id).addEventListener('change', function () {
        ['source', 'target'].forEach(function (side) {
          lines[side].visible = shown(side, 'linear');
          lines[side + '-rapid'].visible = shown(side, 'rapid');
        });
        draw();
      });
    });
  }
  function canvasOf() {
    try {
      renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
      renderer.setPixelRatio(window.devicePixelRatio || 1);
      return renderer.domElement;
    } catch (e) {
      renderer = null;
      flat = document.createElement('canvas');
      return flat;
    }
  }

  // ---- head and messages ------------------------------------------------------------------------------------------
  function head() {
    var verdict = byId('verdict'), v = data.verdict;
    verdict.textContent = data.refused ? 'Refused: nothing is written.' : (v.text || v.status);
    verdict.className = /^verified/.test(v.status) ? 'good' : /^not (asked|proved)/.test(v.text) ? 'open' : 'bad';
    byId('source-title').textContent = data.from + ' (' + data.machine + ')';
    byId('target-title').textContent = data.to + ' (' + data.target_machine + ')';
    Object.keys(data.lines).forEach(function (status) {
      if (!data.lines[status] || status === 'blank') return;
      var b = document.createElement('span');
      b.className = 'badge ' + status;
      b.textContent = data.lines[status] + ' ' + status;
      byId('counts').appendChild(b);
    });
  }
  // A message stands behind its line too: its code, and all of it when the mouse rests there.
  function atLine(d) {
    var f = Math.max(data.sources.findIndex(function (s) { return s.name === d.file; }), 0), row = rows.source[f + ':' + d.line];
    if (!row) return;
    var note = document.createElement('span');
    note.className = 'note ' + (d.severity === 'note' ? 'plain' : d.severity);
    note.textContent = d.code;
    note.title = d.message + (d.hint ? '\n' + d.hint : '');
    row.appendChild(note);
  }
  function messages() {
    var table = byId('diagnostics');
    data.diagnostics.forEach(function (d) {
      var row = table.insertRow();
      [[d.line || '', ''], [d.severity, d.severity], [d.code, ''], [d.message + (d.more ? ' (' + d.more + ' more)' : ''), ''], [d.hint || '', '']]
        .forEach(function (c) { var cell = row.insertCell(); cell.textContent = c[0]; cell.className = c[1]; });
      if (!d.line) return;
      atLine(d);
      row.dataset.line = d.line;
      row.addEventListener('click', function () {
        var f = data.sources.findIndex(function (s) { return s.name === d.file; });
        pickLine('source', Math.max(f, 0) + ':' + d.line, true);
      });
    });
    if (!data.diagnostics.length) table.insertRow().insertCell().textContent = 'Nothing: every line was carried as it is.';
  }
  function decisions() {
    if (!data.to_do) return;
    byId('todo').hidden = false;
    data.to_do.forEach(function (item, i) {
      var row = byId('decisions').insertRow(), lines = [];
      item.places.forEach(function (p) { if (lines.indexOf(p.line) < 0) lines.push(p.line); });
      [i + 1, item.code, item.places.length + ' times, lines ' + lines.join(', '), item.what, item.decide]
        .forEach(function (text) { row.insertCell().textContent = text; });
    });
  }
  function differences() {
    [['source', data.verdict.source_place], ['target', data.verdict.target_place]].forEach(function (pair) {
      var row = pair[1] && rows[pair[0]][key(pair[1])];
      if (!row) return;
      row.classList.add('differs');
      row.scrollIntoView({ block: 'center' });
      var moves = movesOf[pair[0]][key(pair[1])] || [];
      var positions = segments(moves.map(function (i) { return paths[pair[0]][i]; }), function () { return true; });
      if (positions.length) add(positions, 0xcf222e, { order: 5 });
    });
  }

  head();
  decisions();
  fill('source', data.sources);
  fill('target', data.targets);
  messages();
  build();
  differences();
  var canvas = canvasOf();
  byId('canvas').appendChild(canvas);
  listen(canvas);
  views();
  draw();
  window.addEventListener('resize', draw);
  window.addEventListener('beforeprint', draw);
  window.report = {
    data: data,
    lathe: lathe,
    path: function (side) { return paths[side]; },
    pick: function (side, index) { pickLine(side, key(paths[side][index].at), true, { side: side, index: index }); },
    none: function () { clearPicked(); byId('move').textContent = ''; draw(); },
    onPick: function (f) { chosen = f; },
    // For tests, from here on: the place of the middle of a move on the screen.
    moves: function (side) { return paths[side].length; },
    place: function (side, index) { return key(paths[side][index].at); },
    middle: function (side, index) {
      var m = paths[side][index], view = aim(), n = m.points.length / 3, i = Math.floor((n - 1) / 2) * 3;
      var a = screen(point(m, i), view), b = screen(point(m, i + 3), view), r = canvas.getBoundingClientRect();
      return [r.left + (a[0] + b[0]) / 2, r.top + (a[1] + b[1]) / 2];
    },
    // Whether anything but background stands on the canvas, in the colours of both paths.
    drawn: function () {
      var copy = document.createElement('canvas'), view = aim(), g, p, blue = 0, orange = 0;
      draw();
      copy.width = view.w; copy.height = view.h;
      g = copy.getContext('2d');
      g.drawImage(canvas, 0, 0, view.w, view.h);
      p = g.getImageData(0, 0, view.w, view.h).data;
      for (var i = 0; i < p.length; i += 4) {
        if (p[i + 3] < 60) continue;
        if (p[i + 2] > p[i] + 60) blue++;
        if (p[i] > p[i + 2] + 60) orange++;
      }
      return blue > 50 && orange > 50;
    }
  };
})();

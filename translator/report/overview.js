// The table of programs: sorted by a column, filtered by words, state and code.
(function() {
'use strict';
var byId = function(id) {
  return document.getElementById(id);
};
var table = byId('programs'), body = table.tBodies[0], rows = Array.prototype.slice.call(body.rows);
var find = byId('find'), state = byId('state'), code = byId('code'), shown = byId('shown');
var texts = rows.map(function(r) { return r.textContent.toLowerCase(); });

function fill(select, attribute) {
  var seen = {};
  rows.forEach(function(r) {
    (r.getAttribute(attribute) || '').split('|').forEach(function(word) {
      if (word) seen[word] = (seen[word] || 0) + 1;
    });
  });
  Object.keys(seen).sort().forEach(function(word) { select.add(new Option(word + ' (' + seen[word] + ')', word)); });
}
function filter() {
  var words = find.value.toLowerCase().split(/\s+/).filter(Boolean), count = 0;
  rows.forEach(function(r, i) {
    var good = (!state.value || r.getAttribute('data-state') === state.value) &&
        (!code.value || ('|' + r.getAttribute('data-codes') + '|').indexOf('|' + code.value + '|') >= 0) &&
        words.every(function(w) { return texts[i].indexOf(w) >= 0; });
    r.hidden = !good;
    if (good) ++count;
  });
  shown.textContent = count + ' of ' + rows.length + ' programs';
}
function sort(column, th) {
  var down = th.getAttribute('aria-sort') === 'ascending', number = th.hasAttribute('data-number');
  var keys = rows.map(function(r, i) {
    var text = r.cells[column].textContent;
    return {row: r, at: i, key: number ? parseFloat(text) || 0 : text.toLowerCase()};
  });
  keys.sort(function(a, b) { return (a.key < b.key ? -1 : a.key > b.key ? 1 : a.at - b.at) * (down ? -1 : 1); });
  Array.prototype.forEach.call(table.tHead.rows[0].cells, function(c) { c.removeAttribute('aria-sort'); });
  th.setAttribute('aria-sort', down ? 'descending' : 'ascending');
  var all = document.createDocumentFragment();
  keys.forEach(function(k) { all.appendChild(k.row); });
  body.appendChild(all);
}
Array.prototype.forEach.call(table.tHead.rows[0].cells, function(th, column) {
  var button = document.createElement('button');
  button.textContent = th.textContent;
  th.textContent = '';
  th.appendChild(button);
  button.addEventListener('click', function() { sort(column, th); });
});
document.addEventListener('click', function(e) {  // a state or a code elsewhere on the page: its programs
  var link = e.target.closest ? e.target.closest('a[data-state], a[data-code]') : null;
  if (!link) return;
  state.value = link.getAttribute('data-state') || '';
  code.value = link.getAttribute('data-code') || '';
  find.value = '';
  filter();
});
fill(state, 'data-state');
fill(code, 'data-codes');
[find, state, code].forEach(function(f) { f.addEventListener('input', filter); });
byId('filter').hidden = false;
filter();
})();

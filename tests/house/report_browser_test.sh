#!/bin/sh
# The HTML report in a real browser: both paths are drawn and a click on a move marks its line on both sides.
# usage: report_browser_test.sh CNCTRANS. Status 77 (skipped) without Chromium.
set -u
browser=
for name in chromium chromium-browser google-chrome; do command -v "$name" >/dev/null && browser=$name && break; done
[ -n "$browser" ] || { echo "no Chromium here: the browser test is skipped"; exit 77; }
cnctrans=$1
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT

open_page() { # prints the document after its scripts ran
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-sync \
    --disable-background-networking --disable-component-update --user-data-dir="$folder/profile" --window-size=1400,900 \
    --dump-dom "file://$1" 2>/dev/null
}
fail=0
check() { # NAME WANTED: a line of the last page's answers
  if ! grep -qxF "$2" "$folder/answers"; then
    echo "$1: wanted '$2', got:"; cat "$folder/answers"; fail=1
  fi
}
answers() { # PROGRAM FROM TO MOVE: writes the report and clicks the middle of a move of the translation
  "$cnctrans" --from "$2" --to "$3" "$root/$1" -o "$folder/out" --report "$folder/report.html" 2>/dev/null || return 1
  { cat "$folder/report.html"; sed "s/MOVE/$4/g" <<'PAGE'
<pre id="answers"></pre><script>
var p = report.middle('target', MOVE), canvas = document.querySelector('#canvas canvas');
var at = {clientX: p[0], clientY: p[1], button: 0, bubbles: true};
canvas.dispatchEvent(new MouseEvent('mousedown', at));
canvas.dispatchEvent(new MouseEvent('mouseup', at));
var picked = function (side) {
  return Array.from(document.querySelectorAll('#' + side + ' .picked')).map(function (row) { return row.dataset.place; }).join(' ');
};
var one_move = function () { // others may lie over the one that was clicked
  for (var i = 0; i < report.moves('target'); i++)
    if (picked('source') === report.place('source', i) && picked('target') === report.place('target', i)) return true;
  return false;
};
document.getElementById('answers').textContent = ['', 'moves equal ' + (report.moves('source') === report.moves('target')),
  'many moves ' + (report.moves('source') > 30), 'picked the lines of one move ' + one_move(), 'drawn ' + report.drawn(),
  'says ' + (document.getElementById('move').textContent.indexOf('source line ' + picked('source').split(':')[1] + ',') === 0), ''].join('\n');
</script>
PAGE
  } >"$folder/page.html"
  open_page "$folder/page.html" | sed -n '/<pre id="answers">/,/<\/pre>/p' >"$folder/answers"
}
# The last one: a move of a cycle that is written out; one line is picked, not those of the whole cycle.
for job in "examples/fagor/flange.pim fagor sinumerik 10" "examples/num/shaft-lathe.xpi num sinumerik 10" \
  "tests/golden/fagor/000322.PIT fagor sinumerik 71"; do
  set -- $job
  answers "$1" "$2" "$3" "$4" || { echo "$1: no report"; exit 1; }
  for wanted in "moves equal true" "many moves true" "picked the lines of one move true" "drawn true" "says true"; do
    check "$1" "$wanted"
  done
done
exit $fail

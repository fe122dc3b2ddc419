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
    --disable-background-networking --disable-component-update --user-data-dir="$folder/profile" --window-size="${size-1400,900}" \
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
var at = {clientX: p[0], clientY: p[1], button: 0, bubbles: true, pointerId: 1};
canvas.dispatchEvent(new PointerEvent('pointerdown', at));
canvas.dispatchEvent(new PointerEvent('pointerup', at));
var picked = function (side) {
  return Array.from(document.querySelectorAll('#' + side + ' .picked')).map(function (row) { return row.dataset.place; }).join(' ');
};
var one_move = function () { // others may lie over the one that was clicked
  for (var i = 0; i < report.moves('target'); i++)
    if (picked('source') === report.place('source', i) && picked('target') === report.place('target', i)) return true;
  return false;
};
var said = document.getElementById('move').textContent, clicked = picked('source');
var one = one_move();
function press(key) { document.dispatchEvent(new KeyboardEvent('keydown', {key: key, bubbles: true})); }
press('Home'); press('ArrowRight'); press('ArrowRight');
var stepped = document.getElementById('count').textContent.indexOf('3 / ') === 0 && picked('source') === report.place('source', 2) && picked('target') !== '';
var time = document.getElementById('tool-list').rows;
document.getElementById('answers').textContent = ['', 'steps ' + stepped, 'fits ' + (document.documentElement.scrollWidth <= window.innerWidth),
  'has a scale ' + / mm$/.test(document.getElementById('scale').textContent) + ' ' + (document.querySelectorAll('#triad text').length > 1),
  'tools ' + (time.length > 1 && /^T[0-9]+$/.test(time[1].cells[0].textContent) && / (s|min .*)$/.test(time[1].cells[4].textContent)),'', 'moves equal ' + (report.moves('source') === report.moves('target')),
  'many moves ' + (report.moves('source') > 30), 'picked the lines of one move ' + one, 'drawn ' + report.drawn(),
  'says ' + (said.indexOf('source line ' + clicked.split(':')[1] + ',') === 0), ''].join('\n');
</script>
PAGE
  } >"$folder/page.html"
  open_page "$folder/page.html" | sed -n '/<pre id="answers">/,/<\/pre>/p' >"$folder/answers"
}
# Times: 5 mm at 60 mm/min are 5 s, 100 mm at 200 mm/min 30 s and a dwell of half a second behind them, 10 mm at 0.1 mm/rev and 600 rev/min 10 s.
printf 'G17 G90 G94 G71\nG54\nT1 D1 M6\nS600 M3\nG0 X0 Y0 Z5\nG1 Z0 F60\nX100 F200\nG4 K50\nG95 G1 X110 F0.1\nM30\n' >"$folder/times.pim"
"$cnctrans" --from fagor --to num "$folder/times.pim" -o "$folder/times" --report "$folder/times.html" 2>/dev/null
times=$(grep -o '"source_path":.*' "$folder/times.html" | sed 's/"target_path".*//' | grep -oE '"tool":[0-9]+,"seconds":[0-9.]+' | tr '\n' ' ')
[ "$times" = '"tool":1,"seconds":5.0 "tool":1,"seconds":30.5 "tool":1,"seconds":10.0 ' ] || { echo "times of the moves: $times"; fail=1; }

# The last one: a move of a cycle that is written out; one line is picked, not those of the whole cycle.
for job in "examples/fagor/flange.pim fagor sinumerik 10" "examples/num/shaft-lathe.xpi num sinumerik 10" \
  "tests/golden/fagor/000322.PIT fagor sinumerik 71"; do
  set -- $job
  answers "$1" "$2" "$3" "$4" || { echo "$1: no report"; exit 1; }
  for wanted in "moves equal true" "many moves true" "picked the lines of one move true" "drawn true" "says true" "steps true" "fits true" \
    "has a scale true true" "tools true"; do
    check "$1" "$wanted"
  done
done
# On a phone and at the width where it once ran over: nothing sticks out.
for size in 390,800 641,900; do
  open_page "$folder/page.html" | sed -n '/<pre id="answers">/,/<\/pre>/p' >"$folder/answers"
  check "at $size" "fits true"
  check "at $size" "steps true"
done
# On paper, A4 upright: one text behind the other, none over another.
if command -v pdftotext >/dev/null; then
  "$cnctrans" --from fagor --to sinumerik "$root/examples/fagor/flange.pim" -o "$folder/paper" --report "$folder/paper.html" 2>/dev/null
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$folder/profile" --print-to-pdf="$folder/page.pdf" \
    "file://$folder/paper.html" >/dev/null 2>&1
  pdfinfo "$folder/page.pdf" | grep -qE 'Page size: +59[45](\.[0-9]+)? x 84[12]' || { echo "the paper is no A4 upright"; fail=1; }
  pdftotext -layout "$folder/page.pdf" "$folder/page.txt"
  order=$(grep -noE '\(RET\)|\(sinumerik-mill\)|What has to be known' "$folder/page.txt" | cut -d: -f2 | tr '\n' ' ')
  [ "$order" = "(RET) (sinumerik-mill) What has to be known " ] || { echo "on paper the parts lie over each other: $order"; fail=1; }
fi
exit $fail

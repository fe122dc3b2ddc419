#!/bin/sh
# The summary of a batch in a real browser: rows are found by words, result and code, and sorted; on a phone nothing sticks out.
# usage: overview_browser_test.sh CNCTRANS. Status 77 (skipped) without Chromium.
set -u
browser=
for name in chromium chromium-browser google-chrome; do command -v "$name" >/dev/null && browser=$name && break; done
[ -n "$browser" ] || { echo "no Chromium here: the browser test is skipped"; exit 77; }
cnctrans=$1
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/old"
# Three programs that verify, of 2, 4 and 3 moves, and two that are refused.
printf '%%ONE,MX,\nG17 G90 G94 G71\nG54\nG0 X1\nX2\nM30\n' >"$folder/old/one.pim"
printf '%%TWO,MX,\nG17 G90 G94 G71\nG54\nG0 X1\nX2\nX3\nX4\nM30\n' >"$folder/old/two.pim"
printf '%%THREE,MX,\nG17 G90 G94 G71\nG54\nG0 X1\nX2\nX3\nM30\n' >"$folder/old/three.pim"
printf '%%BAD,MX,\nG54\nG0 X1 G199\nM30\n' >"$folder/old/bad.pim"
printf '%%WORSE,MX,\nG54\nG0 X1 G198\nM30\n' >"$folder/old/worse.pim"
"$cnctrans" batch --from fagor --to sinumerik "$folder/old" "$folder/new" --reports -q
[ -s "$folder/new/one.pim/report.html" ] || { echo "no page about one.pim"; exit 1; }
{ cat "$folder/new/summary.html"; cat <<'PAGE'
<pre id="answers"></pre><script>
var byId = function (id) { return document.getElementById(id); };
var rows = function () { return Array.from(byId('programs').tBodies[0].rows); };
var names = function () { return rows().filter(function (r) { return !r.hidden; }).map(function (r) { return r.cells[0].textContent.replace('.pim', ''); }).join(' '); };
var set = function (id, value) { byId(id).value = value; byId(id).dispatchEvent(new Event('input')); };
var head = byId('programs').tHead.rows[0].cells;
var press = function (n) { head[n].querySelector('button').click(); };
var out = ['', 'all ' + names(), 'fits ' + (document.documentElement.scrollWidth <= window.innerWidth)];
set('state', 'refused'); out.push('refused ' + names() + ' ' + byId('shown').textContent);
set('find', 'WORSE'); out.push('words ' + names());
set('find', ''); set('state', ''); set('code', 'FAG-003'); out.push('code ' + names());
document.querySelector('a[data-state=verified]').click(); out.push('link ' + names());
press(2); out.push('by moves ' + names());
press(2); out.push('and back ' + names() + ' ' + head[2].getAttribute('aria-sort'));
out.push('report ' + document.querySelector('#programs a').getAttribute('href').split('/').pop());
out.push('meaning ' + document.querySelector('details summary').textContent, '');
byId('answers').textContent = out.join('\n');
</script>
PAGE
} >"$folder/page.html"
fail=0
for size in 1400,900 390,800; do
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-sync \
    --disable-background-networking --disable-component-update --user-data-dir="$folder/profile" --window-size="$size" \
    --dump-dom "file://$folder/page.html" 2>/dev/null | sed -n '/<pre id="answers">/,/<\/pre>/p' >"$folder/answers"
  while read -r wanted; do
    grep -qxF "$wanted" "$folder/answers" || { echo "at $size: wanted '$wanted', got:"; cat "$folder/answers"; fail=1; }
  done <<'WANTED'
all bad one three two worse
fits true
refused bad worse 2 of 5 programs
words worse
code bad worse
link one three two
by moves one three two
and back two three one descending
report report.html
meaning no such G function
WANTED
done
exit $fail

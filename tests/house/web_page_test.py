#!/usr/bin/env python3
"""The page of web/ in headless Chromium, at the width of a desktop and of a phone.

usage: web_page_test.py CNCTRANS [FOLDER-OF-THE-PAGE [FOLDER-FOR-SCREENSHOTS]]

Without a folder the page is put together here around a stand-in for the WebAssembly engine, which says what CNCTRANS says. Status 77 (skipped)
without Chromium.
"""
import base64
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
import browser as browsers

CNCTRANS = str(Path(sys.argv[1]).resolve())
FLANGE = (ROOT / "examples/fagor/flange.pim").read_bytes()
# No control has a G777: line 3 is refused.
REFUSED = b"G17 G90 G71 G94\nG54\nG777\nG1 X10 Y0 F100\nM30\n"

# A module like that of emscripten: files in memory, and for each command line the answer that the program of this machine gave.
STAND_IN = """
async function createCnctrans(settings) {
  const files = new Map(), folders = new Set(['/']);
  const full = (p) => p.startsWith('/') ? p : '/job/' + p;
  const FS = {
    mkdir: (p) => folders.add(p), chdir() {}, analyzePath: (p) => ({exists: folders.has(p) || files.has(p)}),
    writeFile: (p, bytes) => files.set(full(p), bytes), readFile: (p) => files.get(p),
    readdir: (p) => Array.from(new Set([...folders, ...files.keys()].filter((x) => x.startsWith(p + '/')).map((x) => x.slice(p.length + 1).split('/')[0]))),
    stat: (p) => ({mode: files.has(p) ? 0 : 1}), isDir: (mode) => mode === 1,
  };
  return {FS, callMain(args) {
    const answer = ANSWERS.find((a) => JSON.stringify(a.args) === JSON.stringify(args));
    if (!answer) throw new Error('the stand-in has no answer to ' + args.join(' '));
    for (const c of new TextEncoder().encode(answer.stdout)) settings.stdout(c);
    for (const c of new TextEncoder().encode(answer.stderr)) settings.stderr(c);
    for (const [name, text] of Object.entries(answer.files)) {
      const parts = name.split('/');
      for (let i = 1; i < parts.length; ++i) folders.add('/job/' + parts.slice(0, i).join('/'));
      files.set('/job/' + name, Uint8Array.from(atob(text), (c) => c.charCodeAt(0)));
    }
    return answer.status;
  }};
}
"""


def answer(args, files=()):
    with tempfile.TemporaryDirectory() as folder:
        for name, data in files:
            (Path(folder) / name).write_bytes(data)
        done = subprocess.run([CNCTRANS, *args], cwd=folder, capture_output=True, text=True, check=False)
        made = {str(p.relative_to(folder)): base64.b64encode(p.read_bytes()).decode() for p in Path(folder).rglob("*")
                if p.is_file() and p.name not in dict(files)}
    return {"args": args, "status": done.returncode, "stdout": done.stdout, "stderr": done.stderr, "files": made}


def translation(name, data, *more):
    args = ["--diagnostics", "json", "--color", "never", "-o", "out/", "--report", "report.html", name, "--to", "sinumerik",
            "--numbering", "keep", "--cycles", "native", "--unsupported", "error", *more]
    return answer(args, [(name, data)])


def stand_in(folder):
    answers = [answer(["dialects"]), answer(["--version"]), translation("flange.pim", FLANGE), translation("refused.pim", REFUSED),
               translation("flange.pim", FLANGE, "--from", "fagor", "--machine", "fagor-mill")]
    (folder / "cnctrans.js").write_text(f"const ANSWERS = {json.dumps(answers)};\n{STAND_IN}", encoding="utf-8")
    (folder / "cnctrans.wasm").write_bytes(b"\0asm\1\0\0\0")
    subprocess.run([ROOT / "web/assemble", folder, folder], check=True)
    return folder / "page"


def equal(what, found, wanted):
    assert found == wanted, f"{what}: wanted {wanted!r}, got {found!r}"


class Page:
    def __init__(self, browser, phone):
        self.browser, self.phone = browser, phone

    def translated(self):
        self.browser.wait("a translation", 120, "cnctransPage.state.shown && !document.getElementById('go').disabled")
        shown = self.browser.evaluate("cnctransPage.state.shown")
        self.browser.evaluate("cnctransPage.state.shown = null")
        return shown

    def said(self):
        return self.browser.evaluate("document.getElementById('said').textContent")

    def choose(self, name, value):
        self.browser.evaluate(f"{{ const s = document.getElementById('{name}'); s.value = {json.dumps(value)}; s.dispatchEvent(new Event('change')); }}")

    def drop(self, name, data):
        self.browser.evaluate(f"""{{ const t = new DataTransfer(); t.items.add(new File([{json.dumps(data.decode())}], {json.dumps(name)}));
          document.getElementById('drop').dispatchEvent(new DragEvent('drop', {{dataTransfer: t, bubbles: true, cancelable: true}})); }}""")

    def report(self, name):
        return self.browser.frame_with(f"window.report && report.data.source.endsWith({json.dumps(name)})")

    def tap_in_report(self, name, frame):
        middle = "(() => {{ const e = document.getElementById('{}'); {} const r = e.getBoundingClientRect(); return [r.left + {}, r.top + {}]; }})()"
        place = self.browser.evaluate(middle.format(name, "e.scrollIntoView({block: 'center'});", "r.width / 2", "r.height / 2"), frame)
        corner = self.browser.evaluate(middle.format("report", "", "1", "1"))
        self.browser.tap(place[0] + corner[0], place[1] + corner[1])

    def fits(self):
        equal("the page fits", self.browser.evaluate("document.documentElement.scrollWidth <= window.innerWidth"), True)


def try_out(page, shots):
    browser = page.browser
    browser.wait("the page", 60, "window.cnctransPage && document.getElementById('said').className === '' && /^Ready/.test(document.getElementById('said').textContent)")
    version = subprocess.run([CNCTRANS, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    equal("version", browser.evaluate("document.getElementById('version').textContent"), version)
    page.fits()

    # An example: what the command writes, and the report in its frame, which takes the keys.
    page.choose("example", "Fagor/flange.pim")
    shown = page.translated()
    wanted = translation("flange.pim", FLANGE)
    equal("verified", shown["verified"], True)
    equal("outputs", {"out/" + f["name"]: f["text"].encode() for f in shown["outputs"]},
          {n: base64.b64decode(b) for n, b in wanted["files"].items() if n.startswith("out/") and "/." not in n})
    assert page.said().startswith("verified: "), page.said()
    frame = page.report("flange.pim")
    equal("drawn", browser.evaluate("report.drawn()", frame), True)
    equal("the report fits", browser.evaluate("document.documentElement.scrollWidth <= window.innerWidth", frame), True)
    browser.wait("the keys are the drawing's", 10, "document.activeElement.id === 'report'")
    browser.key("Home")
    browser.key("ArrowRight")
    browser.key("ArrowRight")
    browser.wait("stepping", 10, "document.getElementById('count').textContent.startsWith('3 / ')", frame)
    equal("lines lit", browser.evaluate("['source', 'target'].every((s) => document.querySelectorAll('#' + s + ' .picked').length > 0)", frame), True)
    if page.phone:
        page.tap_in_report("next", frame)
        browser.wait("a tap", 10, "document.getElementById('count').textContent.startsWith('4 / ')", frame)
    play = (lambda: page.tap_in_report("play", frame)) if page.phone else (lambda: browser.key(" "))
    play()
    browser.wait("playing", 20, "Number(document.getElementById('count').textContent.split(' ')[0]) > 6", frame)
    play()
    page.fits()
    if shots:
        browser.screenshot(shots + "-result.png")
        browser.evaluate("window.scrollTo(0, 0)")
        browser.screenshot(shots + "-top.png")

    # A language and a machine by hand.
    page.choose("from", "fagor")
    equal("machines", browser.evaluate("Array.from(document.getElementById('machine').options).map((o) => o.value).join(' ')"), " fagor-lathe fagor-mill")
    page.choose("machine", "fagor-mill")
    browser.evaluate("document.getElementById('go').click()")
    equal("with a machine", page.translated()["verified"], True)
    page.choose("machine", "")
    page.choose("from", "")

    # A refused program: its message stands at its line.
    page.drop("refused.pim", REFUSED)
    shown = page.translated()
    equal("status", shown["status"], "refused")
    lines = [d["line"] for d in shown["diagnostics"] if d["severity"] == "error"]
    assert lines, shown
    assert page.said().startswith("refused: "), page.said()
    frame = page.report("refused.pim")
    equal("note at its line", browser.evaluate(f"document.querySelectorAll('#source .line')[{lines[0] - 1}].querySelectorAll('.note.error').length > 0", frame), True)
    if shots:
        browser.screenshot(shots + "-refused.png")
    page.fits()


def main():
    if not browsers.find():
        print("no Chromium here: the test of the page is skipped")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        at = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 and sys.argv[2] else stand_in(folder)
        browser = browsers.Browser(1400, 900)
        try:
            for name, width, height, phone in (("desktop", 1400, 900, False), ("phone", 360, 740, True)):
                browser.resize(width, height, phone)
                browser.open((at / "index.html").as_uri())
                try_out(Page(browser, phone), f"{sys.argv[3]}/{name}" if len(sys.argv) > 3 else None)
                equal("faults", browser.faults, [])
                equal("addresses", [u for u in browser.asked if not u.startswith(("file:", "blob:", "data:", "about:"))], [])
                print(f"the page on a {name}: ok")
        finally:
            browser.close()


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Long programs with many heads: is each as fast as its plain lines allow?

    bench/cliffs.py [--mb 20] [--runs 3] [--proof] [--only WORD]
    bench/cliffs.py --small EXECUTABLE      (a test: no clock; the lines that are written one by one are counted)

The files are made here, of heads, tails and bodies that vary: with and without block numbers, arcs, comments, tool changes
every few thousand lines, other numbers and spacing. Each is translated into every other language, in turn with
`sed 's/G1 /G01 /'` on the same file; the ratio is that of the two times of one turn.
"""
import argparse
import itertools
import os
import pathlib
import random
import re
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Heads by language: name, lines. {body} stands where the path goes; the rest is what programs of shops have around it.
HEADS = {
    "fagor": [
        ("tool before G43", "%CAM,MX,\nG17 G40 G90 G94\nG54\nT1 D1\nM6\nS5000 M3\nG43 G0 X0 Y0 Z15\n"),
        ("never G43", "%CAM,MX,\nG17 G40 G90 G94\nG54\nT1 D1 M6\nS5000 M3\nG0 X0 Y0 Z15\n"),
        ("a call", "%CAM,MX,\nG17 G40 G90 G94\nG54\nT1 D1 M6\n(CALL 7)\nS5000 M3\nG0 X0 Y0 Z15\n"),
        ("a condition", "%CAM,MX,\nG17 G40 G90 G94\nG54\n(IF P7 EQ 1 GOTO N9)\nT1 D1 M6\nN9 S5000 M3\nG0 X0 Y0 Z15\n"),
        ("a message", "%CAM,MX,\nG17 G40 G90 G94\nG54\n(MSG \"ROUGH\")\nT1 D1 M6\nS5000 M3\nG0 X0 Y0 Z15\n"),
        ("variables", "%CAM,MX,\nG17 G40 G90 G94\nG54\n(P1=3, P2=P1*2)\nT1 D1 M6\nS5000 M3\nG0 X0 Y0 ZP2\n"),
    ],
    "num": [
        ("tool with M6", "%100\nG17 G40 G90 G94\nT1 D1 M6\nS5000 M3 M41\nG0 X0 Y0 Z15\n"),
        ("a call", "%100\nG17 G40 G90 G94\nT1 D1 M6\nG77 H7\nS5000 M3 M41\nG0 X0 Y0 Z15\n"),
        ("a condition", "%100\nG17 G40 G90 G94\nG79 L7=1 N9\nT1 D1 M6\nN9 S5000 M3 M41\nG0 X0 Y0 Z15\n"),
        ("a message", "%100\nG17 G40 G90 G94\n$0 ROUGH\nT1 D1 M6\nS5000 M3 M41\nG0 X0 Y0 Z15\n"),
        ("variables", "%100\nG17 G40 G90 G94\nL1=3 L2=L1*2\nT1 D1 M6\nS5000 M3 M41\nG0 X0 Y0 ZL2\n"),
    ],
    "sinumerik": [
        ("T D M6 in one block", "N10 G17 G40 G90 G94\nN20 G54\nN30 T1 D1 M6\nN40 S5000 M3\nN50 G0 X0 Y0 Z15\n"),
        ("a call", "G17 G40 G90 G94\nG54\nT1 D1\nM6\nL7\nS5000 M3\nG0 X0 Y0 Z15\n"),
        ("a condition", "G17 G40 G90 G94\nG54\nIF R7==1 GOTOF GO_ON\nT1 D1\nM6\nGO_ON: S5000 M3\nG0 X0 Y0 Z15\n"),
        ("a message", "G17 G40 G90 G94\nG54\nMSG(\"ROUGH\")\nT1 D1\nM6\nS5000 M3\nG0 X0 Y0 Z15\n"),
        ("a definition", "DEF REAL SAFE=15.\nG17 G40 G90 G94\nG54\nT1 D1\nM6\nS5000 M3\nG0 X0 Y0 Z=SAFE\n"),
    ],
    "heidenhain": [
        ("a tool", "BEGIN PGM CAM MM\nBLK FORM 0.1 Z X-100 Y-100 Z-20\nBLK FORM 0.2 X+100 Y+100 Z+0\n"
                   "TOOL CALL 1 Z S5000\nM3\nL X+0 Y+0 R0 FMAX\nL Z+15 R0 FMAX\n"),
        ("a call", "BEGIN PGM CAM MM\nTOOL CALL 1 Z S5000\nCALL LBL 7\nM3\nL X+0 Y+0 R0 FMAX\nL Z+15 R0 FMAX\n"),
        ("a condition", "BEGIN PGM CAM MM\nFN 9: IF +Q7 EQU +1 GOTO LBL 9\nTOOL CALL 1 Z S5000\nLBL 9\nM3\n"
                        "L X+0 Y+0 R0 FMAX\nL Z+15 R0 FMAX\n"),
        ("a datum shift", "BEGIN PGM CAM MM\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y+5\n"
                          "TOOL CALL 1 Z S5000\nM3\nL X+0 Y+0 R0 FMAX\nL Z+15 R0 FMAX\n"),
        ("variables", "BEGIN PGM CAM MM\nQ1 = 3\nQ2 = Q1 * 5\nTOOL CALL 1 Z S5000\nM3\nL X+0 Y+0 R0 FMAX\nL Z+Q2 R0 FMAX\n"),
    ],
}
for language, (first, *_) in list(HEADS.items()):
    HEADS[language].append(("rotary axes", first[1]))
    HEADS[language].append(("increments", first[1]))
# Where the sign of a rotary word is a direction for one side only, the words go by where the axis stands.
BY_PLACE = {("num", "fagor"), ("num", "heidenhain")}
TOOLS = {"heidenhain": "L Z+50 R0 FMAX\nTOOL CALL {} Z S4000\nM3\nL X+1 Y+1 R0 FMAX\nL Z+15 R0 FMAX\n",
         "fagor": "G0 Z50\nT{} D{}\nM6\nS4000 M3\nG0 X1 Y1 Z15\n", "num": "G0 Z50\nT{} D{} M6\nS4000 M3 M41\nG0 X1 Y1 Z15\n",
         "sinumerik": "G0 Z50\nT{} D{}\nM6\nS4000 M3\nG0 X1 Y1 Z15\n"}
TAILS = {"fagor": "G0 Z50\nM5\nM30\n{}", "num": "G0 Z50\nM5\nM02\n{}", "sinumerik": "G0 Z50\nM5\nM30\n{}",
         "heidenhain": "L Z+50 R0 FMAX\nM5\nM30\n{}END PGM CAM MM\n"}
SUBS = {"fagor": "(SUB 7)\nM8\n(RET)\n", "num": "%7\nM8\n", "sinumerik": "", "heidenhain": "LBL 7\nM8\nLBL 0\n"}
COMMENTS = {"fagor": ";{}", "num": "({})", "sinumerik": "; {}", "heidenhain": "; {}"}
SIGNED = re.compile(r"([XYZAC])(?=[0-9.])")


def plain_text(words):
    """The same block as a Heidenhain says it: L or CC and C, with signs."""
    places = [SIGNED.sub(r"\1+", w) for w in words[1:] if w.lstrip("I")[0] in "XYZACF"]
    if words[0] != "G3":
        return " ".join(["L", *places])
    centre = [SIGNED.sub(r"\1+", w.replace("I", "X").replace("J", "Y")) for w in words[1:] if w[0] in "IJ"]
    return f"CC {' '.join(centre)}\nC {' '.join(places)} DR+"


def body(language, size, seed, turns=False, steps=False):
    """Lines of a path of one or more tools, about `size` bytes; `turns`: with the words of two rotary axes, `steps`: by
    increments."""
    r = random.Random(seed)
    numbers, arcs, every, tools = r.random() < 0.5, r.random() < 0.6, r.choice([0, 0, 500]), r.choice([0, 4000])
    space = r.choice([" ", " ", "" if language in ("fagor", "num") else " "])
    out, length, n, x, y, count = [], 0, 100, 0.0, 0.0, 0
    tool, blocks = 1, itertools.count(9)
    a, c, before_z = 0.0, 10.0, 15.0
    on, off = ("G91\n", "G90\n") if steps and language != "heidenhain" else ("", "")
    out.append(on)
    arcs = arcs and not (steps and language == "heidenhain")
    while length < size:
        words, lines = [], []
        z = -round(r.random() * 5, 3)
        nx, ny = (round(at + r.uniform(-3, 3) - at / 100, 3) for at in (x, y))
        kind = r.random()
        if arcs and kind < 0.1 and count > 3:
            rad = round(r.uniform(0.5, 9), 2)
            side = 1 if x < 0 else -1  # towards the middle
            nx, ny = round(x + 2 * side * rad, 3), y
            if language in ("num", "heidenhain") and not steps:  # centres are places
                centre = [f"I{x + side * rad:.3f}", f"J{y:.3f}"]
            else:
                centre = [f"I{side * rad:g}", "J0"]
            words = ["G3", f"X{nx:.3f}", f"Y{ny:.3f}", *centre]
        elif kind < 0.2:
            words = [r.choice(["G1", "G01"]), f"Z{z:.3f}", f"F{r.choice([200, 350, 800])}"]
            nx, ny = x, y
        elif kind < 0.5:
            words = ["G1", f"X{nx:.3f}", f"Y{ny:.3f}"]
        else:
            words = ["G1", f"X{nx:.3f}", f"Y{ny:.3f}", f"Z{z:.3f}"]
        if steps:
            mark = "I" if language == "heidenhain" else ""
            way = {"X": nx - x, "Y": ny - y, "Z": z - before_z}
            words = [f"{mark}{w[0]}{way[w[0]]:.3f}" if w[0] in way else w for w in words]
        if any(w.lstrip("I")[0] == "Z" for w in words):
            before_z = z
        if turns and words[0] != "G3":
            before = c
            a, c = (round(at + r.uniform(-0.9, 0.9) - at / 100, 3) for at in (a, c))
            sign = "-" if language == "num" and c < before else ""  # the direction of the way there
            words += [f"A{a:.3f}", f"C{sign}{c % 360 if language == 'num' else c:.3f}"]
        if language == "heidenhain":
            words = [plain_text(words)]
            if numbers:
                words = [re.sub(r"(?m)^", lambda _: f"{next(blocks)} ", words[0])]
        elif numbers:
            words.insert(0, f"N{n}")
            n = n + 5 if n < (30000 if language == "num" else 9999000) else 100
        lines.append(space.join(words))
        count += 1
        if every and count % every == 0:
            lines.append(COMMENTS[language].format(f"LEVEL {count // every}"))
        if tools and count % tools == 0:
            tool += 1
            lines.extend((off + TOOLS[language].format(tool % 20 + 1, 1) + on).splitlines())
            nx, ny, before_z = 1.0, 1.0, 15.0
        x, y = nx, ny
        text = "\n".join(lines) + "\n"
        out.append(text)
        length += len(text)
    return "".join(out) + off, count


def program(language, head, size, seed):
    text, count = body(language, size, seed, "rotary" in head[0], "increments" in head[0])
    sub = SUBS[language] if "call" in head[0] else ""
    if language == "fagor" and sub:
        return head[1] + text + TAILS[language].format("") + sub, count
    return head[1] + text + TAILS[language].format(sub), count


def timed(command, sink):
    with open(sink, "wb") as out:
        begin = time.monotonic()
        child = subprocess.Popen(command, stdout=out, stderr=subprocess.PIPE)
        said = child.stderr.read().decode(errors="replace")
        _, status, usage = os.wait4(child.pid, 0)
        return time.monotonic() - begin, usage.ru_maxrss / 1024, os.waitstatus_to_exitcode(status), said


def cases(only=""):
    for language, heads in HEADS.items():
        for k, head in enumerate(heads):
            for to in HEADS:
                if "rotary" in head[0] and (language, to) in BY_PLACE:
                    continue
                if to != language and only in f"{language} {to} {head[0]}":
                    yield language, head, to, k


def libraries(folder, language):
    if language != "sinumerik":
        return []
    (folder / "L7.SPF").write_text("M8\nM17\n")
    return ["--lib", folder]


def small(executable):
    """Every head of the list goes the fast way: lines that are not left out are few."""
    faults = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for language, head, to, k in cases():
            text, count = program(language, head, 300_000, 7 + k)
            part = folder / "PART.TXT"
            part.write_text(text)
            done = subprocess.run([executable, "--from", language, "--to", to, *libraries(folder, language), part,
                                   "-o", folder / "out" / "OUT.TXT", "--force"], capture_output=True, text=True)
            found = re.search(r"; (\d+) more plain lines", done.stderr)
            left_out = int(found.group(1)) if found else 0
            if done.returncode == 0 and left_out > 0.6 * count:
                continue
            faults += 1
            print(f"{language} to {to}, {head[0]}: status {done.returncode}, {left_out} of {count} lines the fast way\n"
                  + done.stderr[-400:])
    return 1 if faults else 0


def main():
    ask = argparse.ArgumentParser()
    ask.add_argument("--mb", type=float, default=20)
    ask.add_argument("--runs", type=int, default=3)
    ask.add_argument("--proof", action="store_true")
    ask.add_argument("--only", default="")
    ask.add_argument("--small")
    ask.add_argument("--exe", default=ROOT / "build" / "release" / "bin" / "cnctrans")
    a = ask.parse_args()
    if a.small:
        return small(a.small)
    print(f"load {os.getloadavg()[0]:.1f}, {a.mb:g} MB, median of {a.runs}")
    print("| from | to | head | of sed | MB/s | MB peak |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        part, sink = folder / "PART.TXT", folder / "OUT.TXT"
        made = None
        for language, head, to, k in cases(a.only):
            if made != (language, k):
                part.write_text(program(language, head, int(a.mb * 1e6), 7 + k)[0])
                made = (language, k)
            command = [a.exe, "--from", language, "--to", to, *libraries(folder, language), part]
            if not a.proof:
                command.append("--no-verify")
            ratios, times, peak, status = [], [], 0, 0
            for _ in range(a.runs):
                s, memory, status, said = timed(command, sink)
                sed, _, _, _ = timed(["sed", "s/G1 /G01 /", part], folder / "SED.TXT")
                ratios.append(s / sed)
                times.append(s)
                peak = max(peak, memory)
            note = "" if status == 0 else f" (status {status}: {said.strip().splitlines()[-1][:80] if said.strip() else ''})"
            print(f"| {language} | {to} | {head[0]}{note} | {statistics.median(ratios):.2f} | "
                  f"{part.stat().st_size / 1e6 / statistics.median(times):.0f} | {peak:.0f} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())

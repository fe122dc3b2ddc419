#!/usr/bin/env python3
"""The moves of translated programs in LinuxCNC's own interpreter against our trace of their sources.

usage: linuxcnc_test.py [--rs274 FOLDER] [--list] [--least N] CNCTRANS [PROGRAM...]

FOLDER holds Debian's linuxcnc-uspace unpacked (default: build/linuxcnc, see tools/get-linuxcnc). Status 0: all compared programs
are equal and at least N were compared; 1: not so; 77: there is no rs274 here.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXTENSIONS = {"fagor": {"mill": "pim", "lathe": "pit"}, "num": {"mill": "xpi", "lathe": "xpi"},
              "sinumerik": {"mill": "mpf", "lathe": "mpf"}, "heidenhain": {"mill": "h"}}
START = {  # header and safe start of a snippet, as in tests/language/pairs_test.cpp
    "fagor": ("%PAIR ,MX,\n", "G17 G40 G05 G71 G90 G94\n", "G18 G40 G05 G71 G90 G95 G151 G97\n", "M30\n"),
    "num": ("%100 (PAIR)\n", "G17 G40 G71 G80 G90 G94\n", "G18 G40 G71 G90 G95 G97\n", "M02\n"),
    "heidenhain": ("BEGIN PGM PAIR MM\n", "", "", "M30\n"),
    "sinumerik": ("; PAIR\n", "G17 G40 G64 G710 G90 G94\n", "G18 G40 G64 G710 G90 G95 DIAMON\n", "M30\n"),
}
AXES = "XYZABC"
ZERO = dict.fromkeys(AXES, 0.0)


# ---- the programs ---------------------------------------------------------------------------------------------------

class Program:
    def __init__(self, name, dialect, text=None, path=None, machine=None):
        self.name, self.dialect, self.text, self.path, self.machine = name, dialect, text, path, machine


def sections(path):
    """(heading, lines, fence) of every heading of level 2, and the lines below the title as the first one."""
    out, fence = [("", [], None)], None
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("```"):
            if fence is None:
                fence = []
            else:
                if out[-1][2] is None:
                    out[-1] = (out[-1][0], out[-1][1], "\n".join(fence) + "\n")
                fence = None
        elif fence is not None:
            fence.append(line)
        elif line.startswith("## "):
            out.append((line[3:].strip(), [], None))
        else:
            out[-1][1].append(line)
    return out


def pair_program(dialect, lathe, fence):
    title, mill_start, lathe_start, end = START[dialect]
    main, split, rest = fence.partition("---\n")
    defined = ""
    while main.startswith("DEF "):
        line, _, main = main.partition("\n")
        defined += line + "\n"
    return title + defined + (lathe_start if lathe else mill_start) + main + end + (rest if split else "")


def test_programs():
    found = []
    for dialect in EXTENSIONS:
        for folder in ("examples", "tests/identity", "tests/oracle/programs", "tests/golden"):
            for path in sorted((ROOT / folder / dialect).glob("**/*")):
                if path.suffix.lower() in (".pim", ".pit", ".xpi", ".mpf", ".h"):
                    found.append(Program(str(path.relative_to(ROOT)), dialect, path=path))
        for path in sorted((ROOT / "tests/catalogue" / dialect).glob("*.md")):
            for heading, lines, fence in sections(path):
                values = dict(line.split(":", 1) for line in lines if re.match(r"(machine|option|refuses):", line))
                if fence is not None and "option" not in values and "refuses" not in values:
                    machine = values.get("machine", dialect + "-mill").strip()
                    found.append(Program(f"{path.relative_to(ROOT)}: {heading}", dialect, fence, machine=machine))
    for path in sorted((ROOT / "tests/pairs").glob("*.md")):
        parts = sections(path)
        lathe = "machine: lathe" in parts[0][1]
        for heading, lines, fence in parts:
            if heading in EXTENSIONS and fence is not None and "target only" not in lines:
                kind = "lathe" if lathe else "mill"
                found.append(Program(f"{path.relative_to(ROOT)}: {heading}", heading,
                                     pair_program(heading, lathe, fence), machine=f"{heading}-{kind}"))
    return found


def named_program(path):
    path = Path(path).resolve()
    for dialect, kinds in EXTENSIONS.items():
        if path.suffix.lower()[1:] in kinds.values() or f"/{dialect}/" in str(path):
            return Program(str(path), dialect, path=path)
    sys.exit(f"what language is {path}?")


# ---- our side -------------------------------------------------------------------------------------------------------

def our_moves(lines):
    """Moves of a trace: dicts with kind, to, feed (value, mode), and what an arc has."""
    moves, at = [], dict(ZERO)
    for line in lines:
        e = json.loads(line)
        kind = e["event"]
        if kind == "dwell":
            if "seconds" in e:
                moves.append({"kind": "dwell", "seconds": e["seconds"], "line": e["line"]})
        elif "to" in e:
            at = {a: e["to"].get(a, at[a]) for a in AXES}
            move = {"kind": kind, "to": at, "line": e["line"]}
            if "feed" in e:
                move["feed"] = (e["feed"]["value"], e["feed"]["mode"])
            if kind == "arc":
                move.update(plane=e["plane"], cw=e["cw"], turns=e["turns"], center=[e["center"][a] for a in e["plane"]])
            moves.append(move)
    return moves


# ---- the witness ----------------------------------------------------------------------------------------------------

class Witness:
    """Reads rs274's canonical commands: coordinates in the program's unit and work frame, made machine positions in mm."""

    def __init__(self):
        self.moves, self.unit, self.plane = [], 1.0, "XY"
        self.g5x, self.g92, self.rotation = [0.0] * 6, [0.0] * 6, 0.0
        self.feed, self.feed_mode, self.thread = 0.0, "per_minute", False
        self.at, self.tolerance = dict(ZERO), 1e-4

    def machine(self, p):
        x = [a + b for a, b in zip(p, self.g92)]
        c, s = math.cos(math.radians(self.rotation)), math.sin(math.radians(self.rotation))
        x[0], x[1] = c * x[0] - s * x[1], s * x[0] + c * x[1]
        return [(a + b) * (self.unit if i < 3 else 1) for i, (a, b) in enumerate(zip(x, self.g5x))]

    def add(self, kind, p, **more):
        to = dict(zip(AXES, self.machine(p)))
        still = all(abs(to[a] - self.at[a]) < 2e-4 * self.unit for a in AXES)
        self.at = to
        if kind == "arc" or not still:
            if kind != "rapid":
                more["feed"] = (self.feed, self.feed_mode)
            self.moves.append({"kind": kind, "to": to, "tolerance": 1.01e-4 * self.unit, **more})

    def arc(self, v):
        first, second, c1, c2, rotation, along = v[:6]
        order = {"XY": (0, 1, 2), "ZX": (2, 0, 1), "YZ": (1, 2, 0)}[self.plane]
        end, center = [0.0] * 3, [0.0] * 3
        for place, e, c in zip(order, (first, second, along), (c1, c2, 0.0)):
            end[place], center[place] = e, c
        middle = self.machine(center + v[6:])
        self.add("arc", end + v[6:], plane=self.plane, cw=rotation < 0, turns=abs(int(rotation)) - 1,
                 center=[middle[order[0]], middle[order[1]]])

    def read(self, line):
        m = re.match(r"\s*\d+ N\S+\s+(\w+)\((.*)\)\s*$", line)
        if not m:
            return
        name, text = m.groups()
        if name == "USE_LENGTH_UNITS":
            new = 25.4 if text.endswith("INCHES") else 1.0
            # Offsets are said again in the new unit only when they change.
            for offset in (self.g5x, self.g92):
                offset[:3] = [v * self.unit / new for v in offset[:3]]
            self.feed *= self.unit / new
            self.unit = new
            return
        if name == "SELECT_PLANE":
            self.plane = {"XY": "XY", "XZ": "ZX", "YZ": "YZ"}[text[-2:]]
            return
        try:
            v = [float(x) for x in text.split(",")]
        except ValueError:
            return
        if name == "STRAIGHT_TRAVERSE":
            self.add("rapid", v)
        elif name == "STRAIGHT_FEED":
            self.add("thread" if self.thread else "linear", v)
        elif name == "STRAIGHT_PROBE":
            self.add("probe", v[:6])
        elif name == "ARC_FEED":
            self.arc(v)
        elif name == "SET_G5X_OFFSET":
            self.g5x = v[1:]
        elif name == "SET_G92_OFFSET":
            self.g92 = v
        elif name == "SET_XY_ROTATION":
            self.rotation = v[0]
        elif name == "SET_FEED_RATE":
            self.feed = v[0]
        elif name == "SET_FEED_MODE":
            self.feed_mode = "per_rev" if v[1] else "per_minute"
        elif name == "DWELL":
            if v[0] > 0:
                self.moves.append({"kind": "dwell", "seconds": v[0], "tolerance": 1.01e-4})
        elif name.startswith("START_SPEED_FEED_SYNC"):
            self.thread = True
        elif name.startswith("STOP_SPEED_FEED_SYNC"):
            self.thread = False


def without_stops(moves):
    """A rapid move on along one axis in the same sense is one move: a hole ends at its clearance, and further up."""
    out, at = [], dict(ZERO)
    for move in moves:
        way = {a: move["to"][a] - at[a] for a in AXES if abs(move["to"][a] - at[a]) > 2e-4} if "to" in move else {}
        move = dict(move, way=way if move["kind"] == "rapid" and len(way) == 1 else {})
        at = move.get("to", at)
        last = out[-1]["way"] if out else {}
        if move["way"] and last.keys() == way.keys() and all(last[a] * way[a] > 0 for a in way):
            out[-1] = dict(out[-1], to=move["to"])
        else:
            out.append(move)
    return out


def difference(ours, theirs, unit):
    """None when the move is the same, else what differs."""
    if ours["kind"] != theirs["kind"]:
        return f"{ours['kind']} here, {theirs['kind']} there"
    t = theirs["tolerance"]
    if ours["kind"] == "dwell":
        return None if abs(ours["seconds"] - theirs["seconds"]) <= t else f"dwell {ours['seconds']} / {theirs['seconds']}"
    for a in AXES:
        if abs(ours["to"][a] - theirs["to"][a]) > t:
            return f"{a} {ours['to'][a]:.6g} here, {theirs['to'][a]:.6g} there"
    if ours["kind"] == "arc":
        if ours["plane"] != theirs["plane"] or ours["cw"] != theirs["cw"] or ours["turns"] != theirs["turns"]:
            return "plane, direction or turns of the arc: " + str([(m["plane"], m["cw"], m["turns"]) for m in (ours, theirs)])
        if any(abs(a - b) > 2 * t for a, b in zip(ours["center"], theirs["center"])):
            return f"centre {ours['center']} here, {theirs['center']} there"
    if "feed" in ours and ours["kind"] in ("linear", "arc"):
        value, mode = ours["feed"]
        if mode != theirs["feed"][1] or abs(value - theirs["feed"][0] * unit) > t:
            return f"feed {value} {mode} here, {theirs['feed'][0] * unit} {theirs['feed'][1]} there"
    return None


# ---- one program ----------------------------------------------------------------------------------------------------

class Comparer:
    def __init__(self, cnctrans, folder):
        self.cnctrans = cnctrans
        self.rs274 = folder / "usr/bin/rs274"
        libraries = f"{folder}/usr/lib:{folder}/usr/lib/x86_64-linux-gnu"
        self.environment = dict(os.environ, LD_LIBRARY_PATH=libraries, PYTHONDONTWRITEBYTECODE="1")

    def ours(self, *arguments):
        run = subprocess.run([self.cnctrans, *arguments], capture_output=True, text=True, errors="replace", timeout=120)
        return run.returncode, run.stdout, run.stderr

    def fault(self):
        """Why rs274 can't run here (a missing library); empty when it can."""
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "out.ngc").write_text("G0 X1\nM2\n")
            outcome, detail = self.witness(Path(folder), [{"kind": "rapid", "to": dict(ZERO, X=1.0), "line": 1}])
            return "" if outcome == "equal" else detail

    def compare(self, p):
        """(outcome, detail): equal, different, skipped."""
        with tempfile.TemporaryDirectory() as folder:
            here = Path(folder)
            path = p.path
            if path is None:
                kind = "lathe" if p.machine.endswith("lathe") else "mill"
                path = here / f"000100.{EXTENSIONS[p.dialect][kind]}"
                path.write_bytes(p.text.encode())
            machine = ["--machine", p.machine] if p.machine else []
            status, text, _ = self.ours("run", "--dialect", p.dialect, *machine, "--trace", "-", "-q",
                                        "--max-events", "200000", str(path))
            if status != 0:
                return "skipped", "the source does not run to its end"
            ours = our_moves(text.splitlines())
            status, _, errors = self.ours("--from", p.dialect, "--to", "linuxcnc", *machine, "--diagnostics", "json",
                                          "-q", str(path), "-o", str(here / "out.ngc"))
            if status != 0:
                codes = re.findall(r'"code": ?"([A-Z]+-\d+)"[^}]*"severity": ?"error"', errors) or re.findall(
                    r'"severity": ?"error"[^}]*"code": ?"([A-Z]+-\d+)"', errors) or ["status " + str(status)]
                return "skipped", "refused " + codes[0]
            return self.witness(here, ours)

    def witness(self, here, ours):
        (here / "tools.tbl").write_text("".join(f"T{n} P{n} D0 Z0\n" for n in range(1, 100)))
        (here / "parameters.var").write_text("")
        # A feed per revolution and a thread need a spindle that turns; the spindle is not compared.
        program = here / "out.ngc"
        program.write_bytes(b"S1000 M3\n" + program.read_bytes())
        # It keeps its tool data in a file in HOME, which runs side by side must not share.
        run = subprocess.run([str(self.rs274), "-t", "tools.tbl", "-v", "parameters.var", "-g", "out.ngc", "canon.txt"],
                             cwd=here, env=dict(self.environment, HOME=str(here)), capture_output=True, text=True, errors="replace", timeout=120)
        canon = (here / "canon.txt").read_text(errors="replace").splitlines()
        w = Witness()
        for line in canon:
            before = len(w.moves)
            w.read(line)
            for move in w.moves[before:]:
                move["unit"] = w.unit
        ours, theirs = without_stops(ours), without_stops(w.moves)
        for n, (a, b) in enumerate(zip(ours, theirs)):
            what = difference(a, b, b["unit"])
            if what:
                return "different", f"move {n + 1}, source line {a['line']}: {what}"
        if not any("PROGRAM_END" in line for line in canon):
            said = " ".join((run.stdout + run.stderr).split())
            return "different", f"rs274 stops after {len(theirs)} of {len(ours)} moves: {said[-200:]}"
        if len(ours) != len(theirs):
            return "different", f"{len(ours)} moves here, {len(theirs)} there"
        return ("equal", f"{len(ours)} moves") if ours else ("skipped", "no moves")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rs274", type=Path, default=ROOT / "build/linuxcnc")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--least", type=int, default=0)
    parser.add_argument("cnctrans")
    parser.add_argument("programs", nargs="*")
    a = parser.parse_args()
    if not (a.rs274 / "usr/bin/rs274").exists():
        print(f"no rs274 in {a.rs274}: skipped (tools/get-linuxcnc fetches it)")
        return 77
    comparer = Comparer(a.cnctrans, a.rs274.resolve())
    fault = comparer.fault()
    if fault:
        print(f"rs274 does not run here: skipped ({fault})")
        return 77
    programs = [named_program(p) for p in a.programs] or test_programs()
    with ThreadPoolExecutor(os.cpu_count() or 2) as pool:
        results = list(pool.map(comparer.compare, programs))
    count, reasons = Counter(r[0] for r in results), Counter(r[1] for r in results if r[0] == "skipped")
    for p, (outcome, detail) in zip(programs, results):
        if a.list or outcome == "different":
            print(f"{outcome}: {p.name}: {detail}")
    print(f"{len(programs)} programs: {count['equal']} equal, {count['different']} different, {count['skipped']} skipped")
    for reason, n in reasons.most_common():
        print(f"  skipped {n}: {reason}")
    if count["equal"] < a.least:
        print(f"only {count['equal']} programs were compared, {a.least} are wanted")
    return 0 if count["different"] == 0 and count["equal"] >= a.least else 1


if __name__ == "__main__":
    sys.exit(main())

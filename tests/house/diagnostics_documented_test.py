#!/usr/bin/env python3
"""Every diagnostic code that the sources give has one paragraph in docs/diagnostics, and every paragraph has its code.

usage: diagnostics_documented_test.py [ROOT]
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
FLOORS = ("base", "backends", "cli", "dialects", "frontends", "interpreter", "ir", "legaliser", "machine", "translator", "verifier")
CODE = r"(?:CNC|FAG|HEI|IR|NUM|RUN|SIN|TRN|VER)-[A-Z0-9]+"


def given():
    codes = collections.defaultdict(list)
    for floor in FLOORS:
        for path in sorted((ROOT / floor).rglob("*")):
            if path.suffix not in (".cpp", ".h"):
                continue
            for line in path.read_text(encoding="utf-8").splitlines():
                if line.lstrip().startswith("//"):
                    continue
                for code in re.findall(f'"({CODE})"', line):
                    codes[code].append(path.relative_to(ROOT))
    return codes


def documented():
    codes = collections.Counter()
    for path in sorted((ROOT / "docs" / "diagnostics").glob("*.md")):
        for line in path.read_text(encoding="utf-8").splitlines():
            if line.startswith("## "):
                codes.update(re.findall(CODE, line.split(" — ")[0]))
    return codes


def main():
    codes, paragraphs = given(), documented()
    faults = [f"{c} ({places[0]}) has no paragraph in docs/diagnostics" for c, places in sorted(codes.items()) if c not in paragraphs]
    faults += [f"{c} has {n} paragraphs" for c, n in sorted(paragraphs.items()) if n > 1]
    faults += [f"{c} is described, and nothing gives it" for c in sorted(paragraphs) if c not in codes]
    for fault in faults:
        print(fault)
    print(f"{len(codes)} codes, {len(faults)} faults")
    return 1 if faults or len(codes) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())

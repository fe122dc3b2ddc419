#!/usr/bin/env python3
"""Every code of docs/diagnostics stands in a test.

usage: codes_tested_test.py [ROOT]
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
CODE = r"\b[A-Z]{2,3}-[A-Z0-9]+\b"
WITHOUT = {"CNC-MEMORY": "no test fills the memory of its computer"}


def documented():
    for path in sorted((ROOT / "docs" / "diagnostics").glob("*.md")):
        for line in path.read_text(encoding="utf-8").splitlines():
            if line.startswith("## "):
                yield from re.findall(CODE, line.split(" — ")[0])


def tested():
    codes = set()
    for path in (ROOT / "tests").rglob("*"):
        if path.is_file() and path != pathlib.Path(__file__).resolve():
            codes.update(re.findall(CODE, path.read_text(encoding="utf-8", errors="replace")))
    return codes


def main():
    codes, found = list(documented()), tested()
    faults = [f"{c} stands in no test" for c in codes if c not in found and c not in WITHOUT]
    faults += [f"{c} is tested now: it needs no exception" for c in WITHOUT if c in found]
    for fault in faults:
        print(fault)
    print(f"{len(codes)} codes, {len(faults)} faults")
    return 1 if faults or len(codes) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())

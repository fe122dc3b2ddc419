#!/usr/bin/env python3
"""Every pass of the pipeline has a test of its own, tests/passes/<concern>/<pass>.md, and every such file has its pass."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
WITHOUT = {"data/name_given_data"}  # asks for a file of names: tests/command/names-of-machine-data.md


def main():
    page = (ROOT / "docs" / "passes.md").read_text(encoding="utf-8")  # made from the table of passes
    wanted = {f"{home.split('/')[0]}/{name}" for name, home in
              re.findall(r"^\| \d+ \| `(\w+)` \| \w+ \| .* \| (\S+) \| [^|]*\|$", page, re.M)}
    folder = ROOT / "tests" / "passes"
    there = {str(p.relative_to(folder).with_suffix("")) for p in folder.glob("*/*.md")}
    faults = [f"tests/passes/{name}.md is missing" for name in sorted(wanted - there - WITHOUT)]
    faults += [f"tests/passes/{name}.md is a test of no pass" for name in sorted(there - wanted)]
    faults += [f"tests/passes/{name}.md is there: it needs no exception" for name in sorted(WITHOUT & there)]
    for fault in faults:
        print(fault)
    print(f"{len(wanted)} passes, {len(faults)} faults")
    return 1 if faults or len(wanted) < 50 else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""The archive of the guide (project_plant.py) from the survey to the second run. usage: project_test.py CNCTRANS"""
import csv
import json
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import project_plant

CNCTRANS = sys.argv[1]


def run(*args, status=0):
    done = subprocess.run([CNCTRANS, *map(str, args)], capture_output=True, text=True, check=False)
    assert done.returncode == status, (args, done.returncode, done.stdout, done.stderr)
    return done.stdout


def equal(found, wanted):
    assert found == wanted, f"wanted {wanted!r}, got {found!r}"


def states(plant):
    with open(plant / "project.csv", newline="", encoding="utf-8") as rows:
        return {row["program"]: row for row in csv.DictReader(rows)}


def files(plant):
    return {p.relative_to(plant).as_posix(): p.read_bytes() for p in (plant / "new").rglob("*.PI?")}


def main(plant):
    project_plant.make(plant)
    said = run("survey", plant / "old", "--from", "sinumerik", "--to", "fagor", "--lib", plant / "subs")
    assert "need nothing that is not here" in said, said

    # Nothing is missing: the questions are none. Then all at once.
    run("names", "--stub", plant / "old", "--from", "sinumerik", "--to", "fagor", "--lib", plant / "subs", "-o", plant / "names.json")
    said = run("project", plant, "--jobs", 2)
    assert said.startswith("40 programs (0 done before), 64 files new or other: 40 verified\n"), said
    first = files(plant)
    equal(len(first), 64)
    equal(sorted(Counter(Path(f).parent.as_posix() for f in first).items()),
          [("new/lathe", 14), ("new/lathe/JOBS/SHAFTS.WPD", 8), ("new/mill", 28), ("new/mill/JOBS/NEW.WPD", 14)])
    # One map: a subprogram has one number in all folders, and no two programs one name.
    names = json.loads((plant / "names.json").read_text(encoding="utf-8"))
    equal(len({names["routines"][r] for r in project_plant.MILL_SUBS | project_plant.LATHE_SUBS}), 12)
    equal(len(set(names["programs"].values())), 40)
    # A shared subprogram that did not come in the archive is the same text in each folder.
    slot = f"1{int(names['routines']['SLOT1']):05}.PIM"
    equal(first["new/mill/" + slot], first["new/mill/JOBS/NEW.WPD/" + slot])

    equal(run("project", plant).split("\n")[0], "40 programs (40 done before), 0 files new or other: 40 verified")
    equal(files(plant), first)

    # Somebody mends an output; two sources change, one of them in an archive.
    mended = plant / "new/mill" / names["programs"]["PLATE1"]
    mended.write_text(mended.read_text(encoding="latin-1").replace("S1050", "S1100"), encoding="latin-1")
    for name, before, after in (("old/mill/PLATE2.MPF", "S1100", "S1200"), ("old/mill/JOBS.ARC", "; PLATE 22", "; PLATE 22, MENDED")):
        path = plant / name
        text = path.read_text(encoding="utf-8")
        equal(text.count(before + "\n") + text.count(before + " "), 1)
        path.write_text(text.replace(before, after), encoding="utf-8")
    said = run("project", plant, "--status")
    found = {line[18:].split(":")[0]: line[:18].strip() for line in said.splitlines()}
    equal([found[p] for p in ("mill/PLATE1.MPF", "mill/PLATE2.MPF", "mill/JOBS.ARC/NEW.WPD/PLATE22.MPF")], ["changed by hand", "source changed", "source changed"])
    # Programs beside them that call the same subprograms were looked into; those of the lathe were not.
    equal({state for program, state in found.items() if program.startswith("lathe")}, {"verified"})
    said = run("project", plant)
    assert "done before), 2 files new or other: 1 changed by hand, 39 verified" in said, said
    assert "-S1100 M3\n+S1050 M3\n" in said, said
    assert "S1100" in mended.read_text(encoding="latin-1"), "a mended file was written over"
    equal(sorted(p for p, b in files(plant).items() if b != first[p]),
          sorted(["new/mill/" + names["programs"][p] for p in ("PLATE1", "PLATE2")] + ["new/mill/JOBS/NEW.WPD/" + names["programs"]["PLATE22"]]))
    rows = states(plant)
    equal((len(rows), rows["mill/PLATE1.MPF"]["state"], rows["mill/JOBS.ARC/NEW.WPD/PLATE22.MPF"]["state"]), (40, "changed by hand", "verified"))
    page = (plant / "project.html").read_text(encoding="utf-8")
    assert page.count("<tr data-state") == 40 and "- as it is, + as it would be" in page

    # A part that leaves its archive leaves the list; what was made of it stays until somebody removes it.
    archive = plant / "old/mill/JOBS.ARC"
    text = archive.read_text(encoding="utf-8")
    archive.write_text(text[: text.index("%_N_PLATE26_MPF")] + text[text.index("%_N_ROW4_SPF"):], encoding="utf-8")
    said = run("project", plant)
    assert said.startswith("mill/PLATE1.MPF: changed by hand") and "\n39 programs (" in said, said
    equal(len(states(plant)), 39)


def back(plant):
    """The other way round: what goes to a Sinumerik may come as one archive, each folder a workpiece of it."""
    for folder, n in (("", 1), ("CASE", 2)):
        path = plant / "old" / folder / f"00000{n}.PIM"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"%PART{n},MX,\nG17 G90 G94 G71\nG54\nG0 X{n}\n(CALL 7)\nM30\n(SUB 7)\nG0 Y{n}\n(RET)\n", encoding="ascii")
    config = {"format": "cnctrans-project-1", "from": "fagor", "to": "sinumerik", "programs": "old", "output": "new", "archive": "ALL.ARC"}
    (plant / "cnctrans.json").write_text(json.dumps(config), encoding="utf-8")
    run("project", plant)
    heads = [line for line in (plant / "new/ALL.ARC").read_text(encoding="ascii").splitlines() if line.startswith(("%", ";$"))]
    equal(len(heads), 8)
    equal([h for h in heads if "CASE" in h], [";$PATH=/_N_WKS_DIR/_N_CASE_WPD"] * 2)
    equal(sum(h.startswith("%_N_") and h.endswith(("_MPF", "_SPF")) for h in heads), 4)
    again = plant / "again"
    (again / "old").mkdir(parents=True)
    (again / "old/ALL.ARC").write_bytes((plant / "new/ALL.ARC").read_bytes())
    (again / "cnctrans.json").write_text(json.dumps(config | {"from": "sinumerik", "to": "fagor"} | {"archive": ""}), encoding="utf-8")
    assert run("project", again).startswith("2 programs (0 done before), 4 files new or other: 2 verified"), states(again)
    assert "0 files new or other" in run("project", plant)
    config["to"] = "num"
    (plant / "cnctrans.json").write_text(json.dumps(config), encoding="utf-8")
    run("project", plant, status=2)


for test in (main, back):
    with tempfile.TemporaryDirectory() as folder:
        test(Path(folder))
print("the archive went through")

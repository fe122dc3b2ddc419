"""The archive of the guide docs/migrate-an-archive.md: 40 programs and 12 shared subprograms of two Sinumerik machines, some of them in transfer archives.

usage: project_plant.py FOLDER     makes FOLDER/cnctrans.json and FOLDER/old, FOLDER/subs; everything follows from numbers, nothing from chance.
"""
import json
import sys
from pathlib import Path

# Of the mill: four patterns of holes, two slots, two outlines. Of the lathe: two grooves, two chamfers.
MILL_SUBS = {
    f"ROW{n}": ["PROC ROW%d(REAL _X,REAL _Y,REAL _T)" % n, "DEF INT _I", "_I=0", "AGAIN:", f"G0 X=_X+_I*{10 + n} Y=_Y", "Z2", "G1 Z=-_T F150", "G0 Z5",
                "_I=_I+1", f"IF _I<{2 + n} GOTOB AGAIN", "M17"]
    for n in range(1, 5)
}
MILL_SUBS |= {f"SLOT{n}": [f"PROC SLOT{n}(REAL _T)", "G1 Z=-_T F100", f"G91 X{20 * n} F300", "G90 G0 Z5", "M17"] for n in (1, 2)}
MILL_SUBS |= {f"RIM{n}": [f"PROC RIM{n}", f"G1 X{30 * n} Y0 F400", f"G3 X0 Y{30 * n} CR={30 * n}", "G1 X0 Y0", "M17"] for n in (1, 2)}
LATHE_SUBS = {f"GROOVE{n}": [f"PROC GROOVE{n}(REAL _D)", "G1 X=_D F0.08", f"G4 F{n}", "G0 X62", "M17"] for n in (1, 2)}
LATHE_SUBS |= {f"EDGE{n}": [f"PROC EDGE{n}", f"G91 G1 X{2 * n} Z-{n} F0.1", "G90", "M17"] for n in (1, 2)}


def mill(number):
    row, slot = 1 + number % 4, 1 + number % 2
    lines = [f"; PLATE {number}", "G17 G40 G90 G94 G710", "G54", f"T{1 + number % 3} D1", "M6", f"S{1000 + 50 * number} M3", f"R10={number}", "G0 X0 Y0 Z50 M8", "Z5"]
    lines += [f"ROW{row}(R10,{number % 5},{3 + number % 4})", f"G0 X{number} Y30", f"SLOT{slot}({1 + number % 3})"]
    if number % 3 == 0:
        lines += ["G0 X0 Y0", f"RIM{1 + number % 2}"]
    return lines + ["G0 Z50 M9", "M30"]


def lathe(number):
    lines = [f"; SHAFT {number}", "G18 G40 G90 G95 G710 DIAMON", "G54", f"T{1 + number % 3} D1", f"G97 S{600 + 20 * number} M4", "G0 X62 Z2 M8", f"G1 X{60 - number} Z0 F0.2",
             f"EDGE{1 + number % 2}", f"G1 Z-{20 + number}", "X62"]
    if number % 2:
        lines += [f"G0 Z-{10 + number}", f"GROOVE{1 + number % 4 // 2}({50 - number})"]
    return lines + ["G0 X100 Z100 M9", "M30"]


def text(lines):
    return "\n".join(lines) + "\n"


def header(name, kind, folder):
    return [f"%_N_{name}_{kind}", f";$PATH=/_N_{folder}"]


def make(plant):
    files = {}
    for n in range(1, 21):  # 20 programs of the mill in a folder
        files[f"old/mill/PLATE{n}.MPF"] = text(mill(n))
    for n in range(1, 11):  # 10 of the lathe
        files[f"old/lathe/SHAFT{n}.MPF"] = text(lathe(n))
    # 6 programs of the mill in an archive with three of the shared subprograms, 4 of the lathe in another.
    lines = []
    for n in range(21, 27):
        lines += header(f"PLATE{n}", "MPF", "WKS_DIR/_N_NEW_WPD") + mill(n)
    for name in ("ROW4", "RIM1", "RIM2"):
        lines += header(name, "SPF", "SPF_DIR") + MILL_SUBS[name]
    files["old/mill/JOBS.ARC"] = text(lines)
    lines = []
    for n in range(11, 15):
        lines += header(f"SHAFT{n}", "MPF", "WKS_DIR/_N_SHAFTS_WPD") + lathe(n)
    files["old/lathe/JOBS.ARC"] = text(lines)
    for name, lines in (MILL_SUBS | LATHE_SUBS).items():
        files[f"subs/{name}.SPF"] = text(lines)
    files["cnctrans.json"] = json.dumps({
        "format": "cnctrans-project-1", "from": "sinumerik", "to": "fagor", "programs": "old", "output": "new", "names": "names.json", "libraries": ["subs"],
        "folders": [{"path": "mill", "machine": "sinumerik-mill", "target_machine": "fagor-mill"},
                    {"path": "lathe", "machine": "sinumerik-lathe", "target_machine": "fagor-lathe"}]}, indent=2) + "\n"
    for name, content in files.items():
        path = Path(plant) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")


if __name__ == "__main__":
    make(sys.argv[1])

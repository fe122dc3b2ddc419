#!/usr/bin/env python3
"""Long CAM files flow through in windows: the way of their tools must not need the whole program in memory.

usage: stream_memory_test.py EXECUTABLE

A file of 5 MB takes some 100 MB as a stream with its proof and 1 GB as a program; the command gets 200 MB. What the
stream writes is compared with the whole-program path elsewhere (stream_property_test.cpp); here a loss of the stream
is seen, and its time: the same lines take some 150 ms, or 5 s.
"""
import pathlib
import resource
import subprocess
import sys
import tempfile

SIZE = 5_000_000
LIMIT = 200_000_000

FAGOR = "%CAM,MX,\nN5 G17 G40 G71 G90 G94\nN10 G54\n{}N25 S5000 M3\nN30 G43 G0 X0 Y0 Z15\n"
NUM = "%100\nN5 G17 G40 G71 G90 G94\nN10 G54\n{}N25 S5000 M3 M41\nN30 G0 X0 Y0 Z15\n"
SINUMERIK = "N5 G17 G40 G71 G90 G94\nN10 G54\n{}N25 S5000 M3\nN30 G0 X0 Y0 Z15\n"

SINUMERIK_POST = "%_N_PART_MPF\n;$PATH=/_N_WKS_DIR/_N_PART_WPD\n; PART 12\nN10 G90 G94\nN15 G71\nN20 G17 G40 G54\n{}"
STARTS = "N25 S5000 M3\nN30 G0 X0 Y0\nN35 Z15 M8\n"

# Name, language, head of the program with a place for the tool, the words of the tool, its end.
CASES = [
    ("M06 behind", "fagor", FAGOR, "N15 T3 D3\nN20 M6\n", "M30"),
    ("M06 beside", "fagor", FAGOR, "N15 T3 D3 M6\n", "M30"),
    ("no M06 in the file", "fagor", FAGOR, "N15 T3 D3\n", "M30"),
    ("no D", "fagor", FAGOR, "N15 T3 M6\n", "M30"),
    ("no tool", "fagor", FAGOR, "", "M30"),
    ("M06 beside", "num", NUM, "N15 T3 D3 M6\n", "M02"),
    ("no D", "num", NUM, "N15 T3 M6\n", "M02"),
    ("M6 and D behind", "sinumerik", SINUMERIK, "N15 T3\nN20 M6\nN22 D1\n", "M30"),
    ("no D", "sinumerik", SINUMERIK, "N15 T3\nN20 M6\n", "M30"),
    ("T and D, M6 behind", "sinumerik", SINUMERIK, "N15 T1 D1\nN20 M6\n", "M30"),
    ("T, D and M6 in one block", "sinumerik", SINUMERIK, "N15 T1 D1 M6\n", "M30"),
    ("T and D, no M6 in the file", "sinumerik", SINUMERIK, "N15 T1 D1\n", "M30"),
    ("tools by their names", "sinumerik", SINUMERIK, 'N15 T="MILL_10" ; d 10\nN20 M6\nN22 D1\n', "M30"),
    ("header and remarks of a post", "sinumerik", SINUMERIK_POST, "N22 T1 D1 ; MILL 10\nN23 M6\n" + STARTS, "M30"),
    ("a rotary table", "sinumerik", SINUMERIK_POST, "T1 D1\nM6\nG0 A0 C0\n" + STARTS, "M30"),
]
LANGUAGES = ["fagor", "num", "sinumerik"]


def cut(size, arcs=False):
    """Lines of a surface, with every number another; `arcs`: with arcs between them."""
    lines, length, i = [], 0, 0
    while length < size:
        x, y, z = (i * 37) % 99991 / 1000, (i * 53) % 99989 / 1000, -((i * 7) % 4999) / 1000
        feed = f" F{1000 + i % 7 * 50}" if i % 40 == 0 else ""
        lines.append(f"G1 X{x:.3f} Y{y:.3f} Z{z:.3f}{feed}\n")
        if arcs and i % 10 == 9:  # there and back in half a circle each, by the centre and by the radius
            lines[-1] += f"G2 X{x + 2:.3f} Y{y:.3f} I1 J0\nG3 X{x:.3f} Y{y:.3f} CR=1\n"
        length += len(lines[-1])
        i += 1
    return "".join(lines)


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT))


def main():
    executable = sys.argv[1]
    paths = {"sinumerik": cut(SIZE, arcs=True)}
    plain = cut(SIZE)
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        part, out = pathlib.Path(folder) / "PART.TXT", pathlib.Path(folder) / "OUT.TXT"
        for name, language, head, tool, end in CASES:
            part.write_text(head.format(tool) + paths.get(language, plain) + end + "\n")
            calls = [["--from", language, "--to", to] for to in LANGUAGES if to != language]
            for call in calls + [["run", "--max-events", "100000000", "--dialect", language]]:
                machine = ["--machine", language + "-mill"]
                if "rotary" in name:  # of the default machine; where the sign is the direction, the way before counts
                    machine = []
                    if call[-1] != "fagor":
                        continue
                with open(out, "wb") as sink:
                    done = subprocess.run(
                        [executable, *call, *machine, part], stdout=sink, stderr=subprocess.PIPE, preexec_fn=limited)
                proof = call[0] == "run" or b": verified: " in done.stderr.splitlines()[-1]  # in step, nothing is kept
                if proof and done.returncode == 0 and out.stat().st_size > (0 if call[0] == "run" else SIZE // 2):
                    continue
                faults += 1
                print(f"{language}, {name}: {' '.join(call)}: status {done.returncode}, {out.stat().st_size} bytes\n"
                      + done.stderr.decode(errors="replace")[:600])
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

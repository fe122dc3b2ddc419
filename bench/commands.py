#!/usr/bin/env python3
"""Times whole commands on a generated file of CAM lines and prints ratios taken in one run.

    bench/commands.py [--mb 100] [--runs 5] [--keep DIR]

Every command runs in turn (A B C, A B C, ...), one thread, output to a file, in the locale of the caller (which is
printed: `sed` is slower where characters have several bytes). The figures are the least and the median wall times of
whole processes, and the peak resident memory of the largest run; the ratio to `sed` is the median over the turns, each
taken within one turn, so that what else the machine does weighs on both.
"""
import argparse
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXE = ROOT / "build" / "release" / "bin" / "cnctrans"


def generate(path: pathlib.Path, size: int) -> int:
    """Fagor mill program of plain lines: what a CAM system writes, arcs among the lines. Returns the number of lines."""
    lines = 0
    with open(path, "w", newline="\n") as out:
        written = out.write("%CAM PART ,MX,\nN5 G17 G40 G71 G90 G94\nN10 G54\nN15 T3 D3\nN20 M6\nN25 S5000 M3\nN30 G43 G0 X0 Y0 Z15\n")
        lines = 7
        number = 35
        px, py = 0.0, 0.0
        while written < size:
            chunk = []
            for i in range(20000):
                a = 0.013 * (lines + i)
                x, y, z = 80 * math.cos(a), 60 * math.sin(0.7 * a), -5 * abs(math.sin(0.01 * a))
                if i % 40 == 39:
                    x, y = px, py + 10  # half a circle over the last point
                    chunk.append(f"N{number} G03 X{x:.3f} Y{y:.3f} I0 J5\n")
                elif i % 40 == 0:
                    chunk.append(f"N{number} G1 X{x:.3f} Y{y:.3f} Z{z:.3f} F{1000 + i % 7 * 50}\n")
                elif i % 3 == 0:
                    chunk.append(f"N{number} X{x:.3f} Y{y:.3f}\n")
                else:
                    chunk.append(f"N{number} X{x:.3f} Y{y:.3f} Z{z:.3f}\n")
                px, py = round(x, 3), round(y, 3)
                number = number + 5 if number < 99999990 else 5
            text = "".join(chunk)
            written += out.write(text)
            lines += len(chunk)
        out.write("G0 Z50\nM30\n")
        lines += 2
    return lines


def timed(command, output):
    """Wall seconds, peak resident memory in MB, exit status of one process."""
    with open(output, "wb") as out:
        start = time.monotonic()
        process = subprocess.Popen(["timeout", "120", *command], stdout=out, stderr=subprocess.PIPE)
        err = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} ended with {process.returncode}: {err.decode(errors='replace')[:2000]}")
    return seconds, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mb", type=int, default=100)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--keep", type=pathlib.Path)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = args.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        part = folder / "bench.pim"
        lines = generate(part, args.mb * 1_000_000)
        size = part.stat().st_size
        locale = os.environ.get("LC_ALL") or os.environ.get("LC_CTYPE") or os.environ.get("LANG") or "C"
        print(f"{size / 1e6:.1f} MB, {lines} lines; {args.runs} runs in turn; locale {locale}; "
              f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
        commands = {
            "translate": [EXE, "--from", "fagor", "--to", "sinumerik", part],
            "sed": ["sed", "s/G1 /G01 /", part],
            "run": [EXE, "run", "--dialect", "fagor", "--max-events", "100000000", part],
            "cat": ["cat", part],
        }
        seconds = {name: [] for name in commands}
        memory = {name: 0.0 for name in commands}
        for turn in range(args.runs + 1):
            for name, command in commands.items():
                s, m = timed(command, folder / (name + ".out"))
                if turn > 0:  # the first turn warms the caches
                    seconds[name].append(s)
                    memory[name] = max(memory[name], m)
        print(f"{'command':10} {'least s':>9} {'MB/s':>8} {'median s':>9} {'MB/s':>8} {'peak MB':>8}")
        for name in commands:
            least, median = min(seconds[name]), statistics.median(seconds[name])
            print(f"{name:10} {least:9.3f} {size / 1e6 / least:8.1f} {median:9.3f} {size / 1e6 / median:8.1f} {memory[name]:8.1f}")
        ratios = statistics.median(t / s for t, s in zip(seconds["translate"], seconds["sed"]))
        print(f"translate / sed: {ratios:.2f}")
        blocks = lines / statistics.median(seconds["run"]) / 1e6
        print(f"run: {blocks:.2f} million blocks a second")


if __name__ == "__main__":
    main()

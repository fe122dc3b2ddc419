"""The installed module. usage: test_cnctrans.py EXAMPLES-FOLDER   (run by tools/check-packages wheel, in an empty folder)"""
import itertools
import math
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import cnctrans

EXAMPLES = Path(sys.argv.pop())
FLANGE = EXAMPLES / "fagor/flange.pim"


class Module(unittest.TestCase):
    def test_what_there_is(self):
        self.assertEqual(cnctrans.version(), cnctrans.__version__)
        self.assertTrue({"fagor", "num", "sinumerik", "heidenhain"} <= {d.name for d in cnctrans.dialects() if d.read})
        self.assertIn("fagor-mill", cnctrans.machines())

    def test_translate_a_file(self):
        done = cnctrans.translate(FLANGE, source="fagor", target="sinumerik")
        self.assertTrue(done.ok)
        self.assertTrue(done.verdict.good)
        self.assertRegex(str(done.verdict), "^verified: [0-9]+ events")
        self.assertEqual((done.source_machine, done.target_machine), ("fagor-mill", "sinumerik-mill"))
        self.assertTrue(done.main.main)
        self.assertIn(b"CYCLE81", b"".join(o.bytes for o in done.outputs))
        line = done.main.bytes.split(b"\n").index(b"N50 G54")
        self.assertEqual(done.main.lines[line].line, 14)  # of the source
        with tempfile.TemporaryDirectory() as folder:
            paths = done.write(Path(folder) / "out")
            self.assertEqual([p.read_bytes() for p in paths], [o.bytes for o in done.outputs])
            with self.assertRaises(FileExistsError):
                done.write(Path(folder) / "out")

    def test_translate_a_text_and_verify(self):
        source = cnctrans.text("part.pim", "G17 G90 G94 G71\nG54\nT1 D1 M6\nF120 S900 M3\nG0 X10 Y20 Z5\nG1 Z-1\nM30\n")
        done = cnctrans.translate(source, source="fagor", target="num", numbering=cnctrans.Numbering.renumber, number_step=5)
        self.assertTrue(done.ok, done.diagnostics)
        self.assertIn(b"N10 ", done.main.bytes)
        good = [cnctrans.text(o.name, o.bytes) for o in done.outputs]
        self.assertTrue(cnctrans.verify(source, good, source="fagor", target="num").verdict.good)
        wrong = cnctrans.text(done.main.name, done.main.bytes.replace(b"X10", b"X11"))
        self.assertEqual(cnctrans.verify(source, wrong, source="fagor", target="num").status, cnctrans.Status.differs)

    def test_refused_and_wrong_usage(self):
        done = cnctrans.translate(cnctrans.text("part.pim", "G1 X10 F100 G99999\nM30\n"), source="fagor", target="sinumerik")
        self.assertEqual(done.status, cnctrans.Status.refused)
        self.assertFalse(done.outputs)
        self.assertEqual(done.diagnostics[0].place.line, 1)
        self.assertEqual(done.diagnostics[0].severity, cnctrans.Severity.error)
        self.assertIn("G99999", str(done.diagnostics[0]))
        with self.assertRaises(ValueError):
            done.write("nowhere")
        with self.assertRaisesRegex(cnctrans.UsageError, "nothing"):
            cnctrans.translate(FLANGE, source="fagor", target="nothing")
        with self.assertRaises(cnctrans.UsageError):
            list(cnctrans.trace("there-is-none.pim", dialect="fagor"))
        with self.assertRaises(TypeError):
            cnctrans.run(FLANGE, dialect="fagor", no_such_option=1)

    def test_run_check_and_trace(self):
        done = cnctrans.run(FLANGE, dialect="fagor")
        self.assertEqual((done.status, done.reason), (cnctrans.Status.ok, "program_end"))
        events = list(cnctrans.trace(FLANGE, dialect="fagor"))
        self.assertEqual(len(events), done.events)
        self.assertEqual(events[-1]["event"], "end")
        checked = cnctrans.check(FLANGE, dialect="fagor")
        self.assertEqual((checked.lines, checked.blocks), (107, checked.blocks_read))
        path = cnctrans.tool_path(FLANGE, dialect="fagor", axes=("X", "Z"))
        self.assertEqual(len(path), sum(e["event"] in ("rapid", "linear", "arc") for e in events))
        self.assertEqual(len(path.coordinates), 2 * len(path))
        self.assertEqual(list(path.coordinates[:4]), [0, 50, -95, 50])
        self.assertFalse(any(math.isnan(c) for c in path.coordinates))
        try:
            import numpy
        except ImportError:
            return
        self.assertEqual(path.points().shape, (len(path), 2))
        self.assertEqual(path.points().dtype, numpy.float64)

    def test_a_trace_that_is_left(self):
        endless = cnctrans.text("endless.pim", "G17 G90 G94\nF100\nN10 G1 X10\nX0\n(GOTO N10)\nM30\n")
        events = cnctrans.trace(endless, dialect="fagor", max_events=300_000)
        self.assertEqual(len(list(itertools.islice(events, 1000))), 1000)
        events.close()

    def test_set_and_programs(self):
        main = cnctrans.text("main.pim", "(IF P100 EQ 3 GOTO N20)\nG0 X1\nN20 (CALL 7)\nM30\n")
        sub = cnctrans.text("sub.pim", "(SUB 7)\nG0 X5\n(RET)\n")
        moved = [e["to"]["X"] for e in cnctrans.trace(main, dialect="fagor", programs=[sub], set={"P100": 3}) if e["event"] == "rapid"]
        self.assertEqual(moved, [5])

    def test_threads(self):
        said = []
        threads = [threading.Thread(target=lambda: said.append(cnctrans.translate(FLANGE, source="fagor", target="num").ok)) for _ in range(4)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        self.assertEqual(said, [True] * 4)


if __name__ == "__main__":
    unittest.main()

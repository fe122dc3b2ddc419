#!/usr/bin/env python3
"""tools/check-includes finds each kind of fault, and passes a tree without one."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools" / "check-includes"
GOOD = {
    "base/span.h": "#include <cstdint>\n",
    "ir/block.h": '#include "base/span.h"\n// a plain program, num of blocks\n',
    "ir/README.md": "The Fagor frontend fills this.\n",
    "legaliser/motion/arcs.cpp": '#include "legaliser/edit/blocks.h"\n#include "machine/profile.h"\n',
    "machine/profile.h": '#include "ir/block.h"\n',
    "machine/profile.cpp": '#include "machine/profile.h"\n#include <nlohmann/json.hpp>\n',
    "frontends/common/reader.h": '#include "ir/block.h"\n',
    "frontends/fagor/words.h": "#include <string>\n",
    "frontends/fagor/tree.h": '#include "fagor/FagorParser.h"\n',
    "frontends/fagor/parse.cpp": '#include "frontends/fagor/tree.h"\n#include "frontends/common/reader.h"\n',
    "backends/num/write.cpp": '#include "legaliser/edit/blocks.h"\n',
    "legaliser/edit/blocks.h": '#include "ir/block.h"\n',
    "include/cnctrans/cnctrans.h": "#include <stddef.h>\n",
    "translator/api.cpp": '#include "cnctrans/cnctrans.h"\n#include "base/span.h"\n',
}


class CheckIncludes(unittest.TestCase):
    def faults(self, **changed):
        """The lines printed for the good tree with some files changed; the status must fit them."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**GOOD, **changed.get("files", {})}.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            run = subprocess.run([sys.executable, TOOL, "--root", folder], capture_output=True, text=True, check=False)
        self.assertEqual(run.stderr, "")
        self.assertEqual(run.returncode, 1 if run.stdout else 0)
        return run.stdout.splitlines()

    def assert_fault(self, name, text, expected, beside=None):
        lines = self.faults(files={name: text, **(beside or {})})
        self.assertEqual(len(lines), 1, lines)
        self.assertIn(expected, lines[0])
        self.assertTrue(lines[0].startswith(name + ":"), lines[0])

    def test_a_good_tree_passes(self):
        self.assertEqual(self.faults(), [])

    def test_arrow_back(self):
        self.assert_fault("base/a.cpp", '#include "ir/block.h"\n', "base may not include ir")
        for folder in ("ir", "machine", "interpreter"):
            self.assert_fault(f"{folder}/a.cpp", '#include "legaliser/edit/blocks.h"\n', f"{folder} may not include legaliser")
        self.assert_fault("frontends/num/a.cpp", '#include "legaliser/edit/blocks.h"\n', "frontends/* may not include legaliser")
        self.assert_fault("dialects/num/a.cpp", '#include "legaliser/edit/blocks.h"\n', "dialects may not include legaliser")
        self.assert_fault("interpreter/a.cpp", '#include "frontends/common/reader.h"\n', "interpreter may not include")

    def test_rooms(self):
        self.assert_fault("legaliser/edit/a.cpp", '#include "legaliser/motion/arcs.h"\n', "legaliser/edit may not include legaliser/motion",
                          beside={"legaliser/motion/arcs.h": "#include <string>\n"})
        self.assert_fault("ir/a.cpp", '#include "ir/cycles/hole.h"\n', "ir may not include ir/cycles",
                          beside={"ir/cycles/hole.h": "#include <string>\n"})
        self.assert_fault("legaliser/attic/a.cpp", '#include "legaliser/edit/blocks.h"\n', "is not in the table")
        files = {f"base/f{n}.h": "#include <string>\n" for n in range(30)}  # beside span.h
        self.assertEqual(len(self.faults(files=files)), 1)

    def test_frontend_and_backend_do_not_meet(self):
        self.assert_fault("backends/num/a.cpp", '#include "frontends/common/reader.h"\n', "backends/* may not include")
        self.assert_fault("frontends/num/a.cpp", '#include "frontends/fagor/words.h"\n', "includes another's")

    def test_heavy_headers(self):
        self.assert_fault("machine/a.h", "#include <nlohmann/json.hpp>\n", "headers are light")
        self.assert_fault("translator/a.cpp", "#include <antlr4-runtime.h>\n", "stays in the dialect's own folder")
        self.assert_fault("frontends/num/a.cpp", '#include "fagor/FagorLexer.h"\n', "stays in the dialect's own folder")
        self.assert_fault("frontends/fagor/a.h", '#include "frontends/fagor/tree.h"\n', "headers are light")

    def test_controllers_are_not_named(self):
        for word in ("Fagor", "like SINUMERIK", "NUM", "NUM 760", "the 840D", "num_1060"):
            self.assert_fault("interpreter/a.h", f"// {word} does this\n", "names a controller")
        self.assert_fault("verifier/fagor_quirks.h", "", "in a file's name")

    def test_circle_relative_and_unknown(self):
        self.assert_fault("ir/block.h", '#include "base/span.h"\n#include "ir/block.h"\n', "circle")
        self.assert_fault("base/a.cpp", '#include "span.h"\n', "from the root")
        self.assert_fault("base/a.cpp", '#include "base/gone.h"\n', "no file of the house")


if __name__ == "__main__":
    unittest.main()

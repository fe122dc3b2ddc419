#!/usr/bin/env python3
"""tools/check-names finds helpers of two files that share a name, and passes a tree without one."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools" / "check-names"


def source(helper, space="cnctrans::ir"):
    return f"namespace {space} {{\nnamespace {{\n\n{helper}\n}}  // namespace\n}}  // namespace {space}\n"


class CheckNames(unittest.TestCase):
    def faults(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            run = subprocess.run([sys.executable, TOOL, "--root", folder], capture_output=True, text=True, check=False)
        self.assertEqual(run.stderr, "")
        self.assertEqual(run.returncode, 1 if run.stdout else 0)
        return run.stdout.splitlines()

    def assert_clash(self, one, other, **kept):
        self.assertEqual(len(self.faults({"ir/a.cpp": source(one, **kept), "ir/b.cpp": source(other)})), 1)

    def assert_good(self, one, other, second="ir/b.cpp", **kept):
        self.assertEqual(self.faults({"ir/a.cpp": source(one, **kept), second: source(other)}), [])

    def test_clashes(self):
        self.assert_clash("constexpr double tiny = 1e-9;\n", "constexpr double tiny = 1e-6;  ///< mm\n")
        self.assert_clash("struct Plan {\n  int a;\n};\n", "class Plan {\n};\n")
        self.assert_clash("using Name = std::string;\n", "struct Name {\n};\n")
        self.assert_clash("bool is_arc(MotionKind k) {\n}\n", "bool is_arc(MotionKind kind) {\n}\n")
        self.assert_clash("int f(const A& a,\n      int n = 3) {\n}\n", "int f(const A& b, int m) {\n}\n")

    def test_no_clashes(self):
        self.assert_good("int f(const A& a) {\n}\n", "int f(const B& a) {\n}\n")  # overloads
        self.assert_good("struct Plan {\n};\n", "struct Plan {\n};\n", space="cnctrans::ir::cycles")
        self.assert_good("struct Plan {\n};\n", "struct Plan {\n};\n", second="machine/b.cpp")  # another library
        self.assert_good("struct Plan {\n  int f();\n};\n", "int g() {\n  int f();\n}\n")


if __name__ == "__main__":
    unittest.main()

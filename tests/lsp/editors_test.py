#!/usr/bin/env python3
"""The files of editors/ fit the program: grammars are those that it prints, configurations name the languages that it reads.

usage: editors_test.py CNCTRANS
"""
import json
import subprocess
import sys
import tomllib
import xml.etree.ElementTree
from pathlib import Path

EDITORS = Path(__file__).resolve().parents[2] / "editors"
cnctrans = sys.argv[1]
faults = []


def printed(*words):
    return subprocess.run([cnctrans, *words], capture_output=True, text=True, check=True).stdout


package = json.loads((EDITORS / "vscode/package.json").read_text(encoding="utf-8"))
languages = [language["id"] for language in package["contributes"]["languages"]]
for language in languages:
    if (EDITORS / f"vscode/syntaxes/{language}.tmLanguage.json").read_text(encoding="utf-8") != printed("lsp", "--grammar", language):
        faults.append(f"the grammar of {language} is not what cnctrans lsp --grammar {language} prints")
if package["version"] != printed("--version").split()[1]:
    faults.append("editors/vscode/package.json has another version")
read = {line.split()[0] for line in printed("dialects", "--quiet").splitlines()} - {"linuxcnc"}
if set(languages) != read:
    faults.append(f"VS Code has {languages}, read are {sorted(read)}")
helix = tomllib.loads((EDITORS / "helix/languages.toml").read_text(encoding="utf-8"))
if {language["name"] for language in helix["language"]} != read:
    faults.append("Helix has other languages")
vim = (EDITORS / "vim/cnctrans.vim").read_text(encoding="utf-8")
for language in read:
    if language not in vim:
        faults.append(f"Vim has no {language}")
    try:
        xml.etree.ElementTree.parse(EDITORS / f"notepad++/{language}.xml")
    except (OSError, xml.etree.ElementTree.ParseError) as e:
        faults.append(f"Notepad++: {e}")
print("\n".join(faults) or "the files of the editors fit")
sys.exit(bool(faults))

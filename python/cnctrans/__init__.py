"""Translates part programs between the languages of CNC controllers, and proves that the machine moves the same way.

    import cnctrans
    done = cnctrans.translate("part.pim", source="fagor", target="sinumerik")
    print(done.verdict)                       # verified: 57 events, 52 moves, all equal
    done.write("out")                         # only what may be cut with

A program is a path, or `text(name, bytes)`. Where nothing can be made of a call (an unknown language, a file that is not there),
UsageError says why; what a program has to be told about stands in `diagnostics`.
"""
from __future__ import annotations

import json
import os
import queue
import threading
from array import array
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable, Iterator, Mapping, Sequence, Union

from ._cnctrans import (
    Check,
    Comparison,
    Cycles,
    Diagnostic,
    Dialect,
    Encoding,
    LineEnd,
    Numbering,
    Options,
    Output,
    Place,
    Program,
    Run,
    RunOptions,
    Severity,
    Status,
    TranslateOptions,
    Translation as _Translation,
    Unsupported,
    Verdict,
)
from . import _cnctrans

__all__ = [
    "Check", "Comparison", "Cycles", "Diagnostic", "Dialect", "Encoding", "LineEnd", "Numbering", "Output", "Place", "Program", "Run",
    "Severity", "Status", "ToolPath", "Translation", "Unsupported", "UsageError", "Verdict", "check", "dialects", "machines", "run", "text",
    "tool_path", "trace", "translate", "verify", "version", "__version__",
]

__version__: str = _cnctrans.version()

AnyProgram = Union[str, "os.PathLike[str]", Program]


class UsageError(ValueError):
    """The call can't be done: an option, a language, a machine or a file that does not exist."""


def version() -> str:
    """Version of the engine."""
    return _cnctrans.version()


def dialects() -> list[Dialect]:
    """The languages."""
    return _cnctrans.dialects()


def machines() -> list[str]:
    """Names of the machine profiles that are built in; a profile's file may stand wherever one is named."""
    return _cnctrans.machines()


def text(name: str, content: bytes | str) -> Program:
    """A program in memory. Its name's extension tells lathe from mill; a text is encoded as UTF-8."""
    return Program(name, content.encode() if isinstance(content, str) else content)


def _program(given: AnyProgram) -> Program:
    return given if isinstance(given, Program) else Program(os.fspath(given))


def _take(options: Options, given: Mapping[str, Any]) -> None:
    for name, value in given.items():
        if value is None:
            continue
        if not hasattr(options, name):
            raise TypeError(f"there is no option {name}")
        if name == "programs":
            value = [_program(p) for p in value]
        elif name == "libraries":
            value = [os.fspath(f) for f in value]
        elif name == "set":
            value = [(str(k), str(v)) for k, v in dict(value).items()]
        setattr(options, name, value)


def _usable(status: Status, error: str) -> None:
    if status == Status.usage:
        raise UsageError(error)


@dataclass(frozen=True)
class Translation:
    """What became of a program."""

    status: Status
    outputs: list[Output]
    diagnostics: list[Diagnostic]
    verdict: Verdict | None
    source_machine: str
    target_machine: str

    @property
    def ok(self) -> bool:
        """It may be cut with: nothing was refused, and the proof has found no difference."""
        return self.status == Status.ok

    @property
    def main(self) -> Output:
        """The main program."""
        return self.outputs[0]

    def write(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Writes the outputs into a folder. What may not be cut with is not written, and no file is written over."""
        if not self.ok:
            raise ValueError(f"not to be cut with: {self.verdict or self.status.name}")
        paths = [Path(folder) / o.name for o in self.outputs]
        for path in paths:
            if path.exists():
                raise FileExistsError(path)
        Path(folder).mkdir(parents=True, exist_ok=True)
        for path, output in zip(paths, self.outputs):
            path.write_bytes(output.bytes)
        return paths


def translate(
    program: AnyProgram,
    *,
    source: str,
    target: str,
    machine: str | None = None,
    target_machine: str | None = None,
    libraries: Sequence[str | os.PathLike[str]] | None = None,
    programs: Sequence[AnyProgram] | None = None,
    set: Mapping[str, object] | None = None,
    skip: Sequence[int] | None = None,
    max_events: int | None = None,
    unsupported: Unsupported | None = None,
    numbering: Numbering | None = None,
    number_step: int | None = None,
    cycles: Cycles | None = None,
    raise_structure: bool | None = None,
    annotate: bool | None = None,
    origin: bool | None = None,
    prove: bool | None = None,
    verify: bool | None = None,
    explore: int | None = None,
    one_file: bool | None = None,
    encoding: Encoding | None = None,
    line_end: LineEnd | None = None,
) -> Translation:
    """Translates a program from the language `source` into `target` and replays both (options: cnctrans/api.h)."""
    given = dict(locals())
    del given["program"]
    options = TranslateOptions()
    _take(options, given)
    done: _Translation = _cnctrans.translate(_program(program), options)
    _usable(done.status, done.error)
    return Translation(done.status, done.outputs, done.diagnostics, done.verdict, done.source_machine, done.target_machine)


def verify(
    program: AnyProgram,
    translation: AnyProgram | Iterable[AnyProgram],
    *,
    source: str,
    target: str,
    machine: str | None = None,
    target_machine: str | None = None,
    libraries: Sequence[str | os.PathLike[str]] | None = None,
    programs: Sequence[AnyProgram] | None = None,
    set: Mapping[str, object] | None = None,
    skip: Sequence[int] | None = None,
    max_events: int | None = None,
) -> Comparison:
    """Compares a program with a translation made by anyone: its main program first, then what it calls."""
    given = dict(locals())
    del given["program"], given["translation"]
    options = TranslateOptions()
    _take(options, given)
    one = isinstance(translation, (str, os.PathLike, Program))
    targets = [_program(translation)] if one else [_program(p) for p in translation]  # type: ignore[arg-type,union-attr]
    done = _cnctrans.verify(_program(program), targets, options)
    _usable(done.status, done.error)
    return done


def _run_options(dialect: str, given: Mapping[str, Any]) -> RunOptions:
    options = RunOptions()
    _take(options, {"dialect": dialect, **given})
    return options


def check(program: AnyProgram, *, dialect: str, **options: Any) -> Check:
    """Reads a program and says what is not right in it. Options: machine, libraries, programs."""
    done = _cnctrans.check(_program(program), _run_options(dialect, options))
    _usable(done.status, done.error)
    return done


def run(program: AnyProgram, *, dialect: str, **options: Any) -> Run:
    """Carries a program out on its machine. Options: machine, libraries, programs, set, skip, max_events."""
    done = _cnctrans.run(_program(program), _run_options(dialect, options), lambda bundle: False)
    _usable(done.status, done.error)
    return done


def trace(program: AnyProgram, *, dialect: str, **options: Any) -> Iterator[dict[str, Any]]:
    """The events of a run (docs/trace.md), one after the other while it goes on; options as of run()."""
    bundles: queue.Queue[Any] = queue.Queue(maxsize=16)
    stopped = threading.Event()
    given = _program(program), _run_options(dialect, options)

    def pass_on(bundle: bytes) -> bool:
        while not stopped.is_set():
            try:
                bundles.put(bundle, timeout=0.1)
                return True
            except queue.Full:
                continue
        return False

    def work() -> None:
        try:
            done = _cnctrans.run(*given, pass_on)
            end: Any = UsageError(done.error) if done.status == Status.usage else None
        except BaseException as failed:  # pylint: disable=broad-except
            end = failed
        while not stopped.is_set():
            try:
                return bundles.put(end, timeout=0.1)
            except queue.Full:
                continue

    worker = threading.Thread(target=work, daemon=True)
    worker.start()
    try:
        while isinstance(bundle := bundles.get(), bytes):
            for line in bundle.splitlines():
                yield json.loads(line)
        if bundle is not None:
            raise bundle
    finally:
        stopped.set()
        worker.join()


MOVES = ("rapid", "linear", "arc", "thread", "probe")


@dataclass
class ToolPath:
    """The ends of the moves of a run, in mm (X of a lathe as radius); an axis that is not known is nan."""

    axes: tuple[str, ...]
    kinds: list[str] = field(default_factory=list)
    lines: array[int] = field(default_factory=lambda: array("L"))
    coordinates: array[float] = field(default_factory=lambda: array("d"))  # row by row

    def __len__(self) -> int:
        return len(self.kinds)

    def points(self) -> Any:
        """A numpy array with a row for each move and a column for each axis."""
        import numpy  # type: ignore[import]  # pylint: disable=import-outside-toplevel

        return numpy.frombuffer(self.coordinates, dtype=float).reshape(-1, len(self.axes))


def tool_path(program: AnyProgram, *, dialect: str, axes: Sequence[str] = ("X", "Y", "Z"), **options: Any) -> ToolPath:
    """The path of a run; options as of run()."""
    path = ToolPath(tuple(axes))
    for event in trace(program, dialect=dialect, **options):
        if event["event"] not in MOVES:
            continue
        path.kinds.append(event["event"])
        path.lines.append(event.get("line", 0))
        to = event.get("to", {})
        path.coordinates.extend(float(to.get(a, "nan")) for a in path.axes)
    return path

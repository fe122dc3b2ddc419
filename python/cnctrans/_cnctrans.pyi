from enum import Enum
from typing import Callable, Sequence

class Program:
    def __init__(self, name: str, bytes: bytes | None = None) -> None: ...

class Dialect:
    name: str
    title: str
    read: bool
    mill_extensions: list[str]
    lathe_extensions: list[str]

class Place:
    file: str
    line: int
    column: int
    end_line: int
    end_column: int

class Severity(Enum):
    note = 0
    warning = 1
    error = 2

class Diagnostic:
    code: str
    severity: Severity
    place: Place
    message: str
    hint: str
    shown: str

class Status(Enum):
    ok = 0
    refused = 1
    usage = 2
    differs = 3

class Unsupported(Enum):
    error = 0
    warn = 1
    comment = 2

class Numbering(Enum):
    keep = 0
    none = 1
    renumber = 2

class Cycles(Enum):
    native = 0
    exact = 1
    explode = 2

class Encoding(Enum):
    as_source = 0
    utf8 = 1
    windows1252 = 2

class LineEnd(Enum):
    as_source = 0
    lf = 1
    crlf = 2
    cr = 3

class Options:
    machine: str
    libraries: list[str]
    programs: list[Program]
    set: list[tuple[str, str]]
    skip: list[int]
    max_events: int

class RunOptions(Options):
    dialect: str
    def __init__(self) -> None: ...

class TranslateOptions(Options):
    source: str
    target: str
    target_machine: str
    unsupported: Unsupported
    numbering: Numbering
    number_step: int
    cycles: Cycles
    raise_structure: bool
    annotate: bool
    origin: bool
    prove: bool
    verify: bool
    explore: int
    one_file: bool
    encoding: Encoding
    line_end: LineEnd
    def __init__(self) -> None: ...

class Output:
    name: str
    program: str
    @property
    def bytes(self) -> bytes: ...
    main: bool
    lines: list[Place]

class Verdict:
    class Result(Enum):
        verified = 0
        within_tolerance = 1
        differs = 2
        nothing_to_compare = 3
        not_replayable = 4
    result: Result
    events: int
    moves: int
    max_length: float
    blocks: int
    replayed: int
    text: str
    @property
    def good(self) -> bool: ...

class Translation:
    status: Status
    error: str
    outputs: list[Output]
    diagnostics: list[Diagnostic]
    verdict: Verdict | None
    source_machine: str
    target_machine: str

class Comparison:
    status: Status
    error: str
    verdict: Verdict
    diagnostics: list[Diagnostic]

class Run:
    status: Status
    error: str
    reason: str
    blocks: int
    events: int
    variables: list[tuple[str, str]]
    diagnostics: list[Diagnostic]

class Check:
    status: Status
    error: str
    lines: int
    blocks: int
    blocks_read: int
    diagnostics: list[Diagnostic]

def version() -> str: ...
def dialects() -> list[Dialect]: ...
def machines() -> list[str]: ...
def translate(program: Program, options: TranslateOptions) -> Translation: ...
def verify(source: Program, translation: Sequence[Program], options: TranslateOptions) -> Comparison: ...
def check(program: Program, options: RunOptions) -> Check: ...
def run(program: Program, options: RunOptions, sink: Callable[[bytes], bool]) -> Run: ...

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the size of headers, the licence line of each source file, and the README of each library folder."""

import re
import statistics
import sys
from pathlib import Path

MEDIAN_LINES = 120  # half of the library's headers are at most so long
MOST_LINES = 220    # nine of ten are
README_LINES = 15
LICENCE = "SPDX-License-Identifier: Apache-2.0"
SOURCES = re.compile(r".*\.(cpp|hpp|py|cmake|sh|in)$|.*/CMakeLists\.txt$|^CMakeLists\.txt$|^run$|^tools/.*|^\.ci/.*")
NOT_OURS = re.compile(r"^(build[^/]*|out|run-out|data|docs|\.git|\.cache)/|.*/(data|golden|corpus|__pycache__)/")
VAGUE = re.compile(r"(^|_)(utils?|common|misc|helpers?)$")


def lines_of(path):
    return path.read_text(encoding="utf-8", errors="replace").splitlines()


def check(root):
    names = [p.relative_to(root).as_posix() for p in sorted(root.rglob("*")) if p.is_file()]
    ours = [name for name in names if not NOT_OURS.match(name)]

    for name in ours:
        if SOURCES.match(name) and not any(LICENCE in line for line in lines_of(root / name)[:3]):
            yield f"{name}:1: the line '{LICENCE}' is missing"
        for part in Path(name).with_suffix("").parts:
            if VAGUE.search(part):
                yield f"{name}:1: '{part}' says nothing; name it after its idea"

    lengths = sorted((len(lines_of(root / name)), name) for name in ours
                     if name.startswith("beaconless/") and name.endswith(".hpp"))
    if lengths and statistics.median(length for length, _ in lengths) > MEDIAN_LINES:
        yield f"{lengths[-1][1]}:1: the median library header is longer than {MEDIAN_LINES} lines"
    for length, name in lengths[: len(lengths) * 9 // 10]:
        if length > MOST_LINES:
            yield f"{name}:1: {length} lines; nine of ten library headers have at most {MOST_LINES}"

    for folder in sorted(p for p in (root / "beaconless").iterdir() if p.is_dir() and any(p.glob("*.hpp"))):
        readme = folder / "README.md"
        name = readme.relative_to(root)
        if not readme.exists():
            yield f"{name}:1: missing: what comes in, what goes out, which papers, which file to open first"
        elif len(lines_of(readme)) > README_LINES:
            yield f"{name}:{README_LINES + 1}: longer than {README_LINES} lines"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    findings = list(check(root))
    for finding in findings:
        print(finding)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

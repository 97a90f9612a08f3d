#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the relative links and pictures in all Markdown files lead to something that exists."""

import re
import sys
from pathlib import Path

LINK = re.compile(r'\[[^\]]*\]\(\s*<?([^)\s>]+)>?[^)]*\)|^\[[^\]]+\]:\s*(\S+)|<(?:img|a)\s[^>]*(?:src|href)="([^"]+)"')
IGNORED_FOLDERS = re.compile(r"^(build[^/]*|out|run-out|\.git|\.cache)/")


def headings_of(path):
    """The anchors that a Markdown viewer makes of a file's headings."""
    titles = re.findall(r"^#+\s+(.*?)\s*#*$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def check_file(root, path):
    in_code = False
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        if line.lstrip().startswith(("```", "~~~")):
            in_code = not in_code
        if in_code:
            continue
        for groups in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            target = next(filter(None, groups))
            if re.match(r"[a-z][a-z+.-]*:", target):
                continue  # the network is not asked
            name, _, anchor = target.partition("#")
            there = path.parent / name if name else path
            where = f"{path.relative_to(root)}:{number}"
            if not there.exists():
                yield f"{where}: there is no {target}"
            elif anchor and there.suffix == ".md" and anchor not in headings_of(there):
                yield f"{where}: {name or path.name} has no heading #{anchor}"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    files = [p for p in sorted(root.rglob("*.md")) if not IGNORED_FOLDERS.match(p.relative_to(root).as_posix())]
    findings = [finding for path in files for finding in check_file(root, path)]
    for finding in findings:
        print(finding)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks who includes whom: the table below, no cycles, and the same table in ARCHITECTURE.md."""

import re
import sys
from pathlib import Path

VALUES = "core geometry scan"
EVERYTHING = "core geometry scan features map match track particle localize slam sim eval io report event pose_estimate"

# What each folder of beaconless/ (or header right in it) may include, beside itself.
MAY_INCLUDE = {
    "core": "",
    "geometry": "core",
    "scan": "core geometry",
    "pose_estimate": "core geometry",
    "event": VALUES,
    "features": VALUES,
    "map": VALUES,
    "eval": VALUES + " map pose_estimate",
    "match": VALUES + " features map",
    "track": "core geometry features",
    "particle": VALUES + " map",
    "sim": VALUES + " map event pose_estimate",
    "io": VALUES + " map sim event pose_estimate",
    "localize": VALUES + " features map match track particle event pose_estimate",
    "slam": VALUES + " features map match track particle localize event pose_estimate",
    "report": VALUES + " features map match eval pose_estimate",
    "beaconless": EVERYTHING,
}
# Folders that may use other people's libraries; all others have the standard library and Eigen.
MAY_USE_OTHERS = {"io", "report"}
STANDARD = re.compile(r"[a-z_0-9]+|(unsupported/)?Eigen/\w+|[a-z]mmintrin\.h")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def module_of(path):
    """The row of the table that a path below beaconless/ belongs to."""
    parts = Path(path).parts
    return parts[1] if len(parts) > 2 else Path(path).stem


def includes_of(root, path):
    """(line number, included path, is a file of this project) of each include line."""
    for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), start=1):
        if match := INCLUDE.match(line):
            yield number, match[2], match[2].startswith("beaconless/") or match[1] == '"'


def check_library_file(root, path, may_include):
    module = module_of(path)
    if module not in may_include:
        yield f"{path}:1: '{module}' has no row in the table of tools/check_layers.py"
        return
    for number, included, is_ours in includes_of(root, path):
        if not is_ours:
            if module not in MAY_USE_OTHERS and not STANDARD.fullmatch(included):
                yield f"{path}:{number}: '{module}' has the standard library and Eigen only, not <{included}>"
        elif not included.startswith("beaconless/"):
            yield f"{path}:{number}: \"{included}\": include lines are written from the root, \"beaconless/…\""
        else:
            other = module_of(included)
            if other != module and other not in may_include[module].split():
                yield f"{path}:{number}: '{module}' may not include '{other}' ({included})"


def check_program_file(root, path):
    """Files of apps/ and bridges/ may include the library and their own folder, not each other."""
    for number, included, _ in includes_of(root, path):
        if re.match(r"(apps|bridges|tests|bench|examples)/", included) and not included.startswith(
                "/".join(Path(path).parts[:2]) + "/"):
            yield f"{path}:{number}: programs and bridges never include each other ({included})"


def find_cycle(edges):
    """One cycle in {node: [nodes]}, as the list of its nodes, or None."""
    done, trail = set(), []

    def visit(node):
        if node in trail:
            return trail[trail.index(node):] + [node]
        if node in done:
            return None
        trail.append(node)
        for after in edges.get(node, []):
            if cycle := visit(after):
                return cycle
        trail.pop()
        done.add(node)
        return None

    for node in edges:
        if cycle := visit(node):
            return cycle
    return None


def table_of(markdown):
    """The rows '| `module` | may include |' of the section on the dependency order."""
    section = markdown.partition("## Who may include whom")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| `([\w./]+)` \| ([^|]*) \|$", section, re.MULTILINE)
    return {name.removesuffix(".hpp"): cells.replace("`", "").split() for name, cells in rows}


def check_document(root):
    path = "ARCHITECTURE.md"
    written = table_of((root / path).read_text(encoding="utf-8"))
    for module, allowed in MAY_INCLUDE.items():
        expected = ["everything"] if allowed == EVERYTHING else allowed.split() or ["nothing"]
        if sorted(written.get(module, [])) != sorted(expected):
            yield f"{path}:1: the row of '{module}' should read: {' '.join(expected)}"
    for module in written.keys() - MAY_INCLUDE.keys():
        yield f"{path}:1: '{module}' is not in the table of tools/check_layers.py"


def check(root):
    """All that is wrong below `root`, one line each."""
    def sources(*folders):
        return [p.relative_to(root).as_posix() for folder in folders for p in sorted((root / folder).rglob("*.[ch]pp"))]

    library = sources("beaconless")
    for path in library:
        yield from check_library_file(root, path, MAY_INCLUDE)
    for path in sources("apps", "bridges"):
        yield from check_program_file(root, path)
    edges = {path: [included for _, included, is_ours in includes_of(root, path) if is_ours] for path in library}
    if cycle := find_cycle(edges):
        yield f"{cycle[0]}:1: files include each other in a circle: {' -> '.join(cycle)}"
    if cycle := find_cycle({module: allowed.split() for module, allowed in MAY_INCLUDE.items()}):
        yield f"tools/check_layers.py:1: the table itself has a circle: {' -> '.join(cycle)}"
    if (root / "ARCHITECTURE.md").exists():
        yield from check_document(root)


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    findings = list(check(root))
    for finding in findings:
        print(finding)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts the figures of the last `./run bench` into docs/benchmarks.md and docs/performance.md, between their two marks.
The first mark of a page names the programs whose figures it wants.

usage: bench/figures.py [DIRECTORY OF JSON FILES] [MARKDOWN FILE …]
"""
import json
import math
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BEGIN = re.compile(r"<!-- figures: begin( \w+)+ -->\n")
END = "<!-- figures: end -->"
PAGES = [ROOT / "docs/benchmarks.md", ROOT / "docs/performance.md"]
NANOSECONDS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}


def three_digits(value):
    """0.00123, 1.23, 123, 12 300: three digits that count, no exponents."""
    if value <= 0:
        return "0"
    decimals = 2 - math.floor(math.log10(value))
    return f"{round(value, decimals):,.{max(0, decimals)}f}".replace(",", " ")


def duration(ns):
    for unit, size in (("s", 1e9), ("ms", 1e6), ("µs", 1e3)):
        if ns >= size:
            return f"{three_digits(ns / size)} {unit}"
    return f"{three_digits(ns)} ns"


def median_rows(report):
    """The medians where runs were repeated, else the runs themselves."""
    rows = [row for row in report["benchmarks"] if not row.get("error_occurred")]
    return [row for row in rows if row.get("aggregate_name") == "median"] or [
        row for row in rows if row["run_type"] == "iteration"]


def cpu_ns(row):
    return row["cpu_time"] * NANOSECONDS[row["time_unit"]]


def typical_ns(row):
    """What one call takes: the median call where calls were timed one by one."""
    return row["p50_us"] * 1e3 if "p50_us" in row else cpu_ns(row)


# Heading, and what a row has to say under it (None: nothing).
COLUMNS = [
    ("time", lambda row, _: None if "p50_us" in row else duration(cpu_ns(row))),
    ("p50", lambda row, _: duration(row["p50_us"] * 1e3) if "p50_us" in row else None),
    ("p99", lambda row, _: duration(row["p99_us"] * 1e3) if "p99_us" in row else None),
    ("max", lambda row, _: duration(row["max_us"] * 1e3) if "max_us" in row else None),
    ("calibration loops", lambda row, loop_ns: three_digits(typical_ns(row) / loop_ns)),
    ("p50 of each", lambda row, _: duration(row["p50_us_each"] * 1e3) if "p50_us_each" in row else None),
    ("found a scan", lambda row, _: three_digits(row["per_scan"]) if "per_scan" in row else None),
    ("a second", lambda row, _: three_digits(row["items_per_second"]) if "items_per_second" in row else None),
    ("MB/s", lambda row, _: three_digits(row["bytes_per_second"] / 1e6) if "bytes_per_second" in row else None),
    ("walls", lambda row, _: f"{row['walls']:.0f}" if "walls" in row else None),
    ("index", lambda row, _: f"{three_digits(row['index_MB'])} MB" if "index_MB" in row else None),
    ("µs per ms of vector_loop",
     lambda row, _: three_digits(row["us_per_loop_ms"]) if "us_per_loop_ms" in row else None),
    ("of 40 ms", lambda row, _: f"{100 * row['budget_share']:.3g} %" if "budget_share" in row else None),
    ("iterations of ICP", lambda row, _: f"{row['icp_iterations']:.1f}" if "icp_iterations" in row else None),
    ("status ok", lambda row, _: f"{100 * row['ok_share']:.3g} %" if "ok_share" in row else None),
    ("lost", lambda row, _: f"{100 * row['lost_share']:.3g} %" if "lost_share" in row else None),
]


def table(rows, loop_ns):
    cells = [[write(row, loop_ns) for _, write in COLUMNS] for row in rows]
    used = [i for i in range(len(COLUMNS)) if any(line[i] is not None for line in cells)]
    yield "| benchmark | " + " | ".join(COLUMNS[i][0] for i in used) + " |"
    yield "|---|" + "---:|" * len(used)
    for row, line in zip(rows, cells):
        yield f"| `{row['run_name']}` | " + " | ".join(line[i] or "" for i in used) + " |"


def cpu_model():
    match = re.search(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    return match[1] if match else "unknown"


def machine(context):
    yield f"* Processor: {cpu_model()}, {context['num_cpus']} cores, {context['mhz_per_cpu']} MHz by its own word"
    yield f"* Compiler: {context['compiler']}, `{context['flags'].strip()}`, assertions {context['assertions']}"
    yield f"* Date: {context['date'][:10]}; load average at the start {context['load_avg'][0]:.1f}"


def figures(directory, programs):
    reports = {}
    for program in programs:
        try:
            reports[program] = json.loads((directory / f"{program}.json").read_text(encoding="utf-8"))
        except (OSError, json.JSONDecodeError) as error:
            print(f"figures.py: {program} is left out: {error}", file=sys.stderr)
    if "calibrate_bench" not in reports:
        sys.exit(f"figures.py: {directory} has no figures of calibrate_bench; run ./run bench")
    calibration = reports["calibrate_bench"]
    loop_ns = next(cpu_ns(row) for row in median_rows(calibration) if row["run_name"] == "scalar_multiply_adds")
    yield from machine(calibration["context"])
    for program, report in reports.items():
        yield from ["", f"### {program}", ""]
        yield from table(median_rows(report), loop_ns)


def main():
    directory = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build-bench/bench/figures"
    for page in [Path(name) for name in sys.argv[2:]] or PAGES:
        text = page.read_text(encoding="utf-8")
        begin = BEGIN.search(text)
        end = text.find(END)
        if not begin or end < begin.end():
            sys.exit(f"figures.py: {page} lacks the lines <!-- figures: begin PROGRAMS --> and {END}")
        programs = begin[0].split()[3:-1]
        written = "\n".join(figures(directory, programs))
        page.write_text(f"{text[:begin.end()]}{written}\n{text[end:]}", encoding="utf-8")
        print(f"figures.py: wrote {page}")


if __name__ == "__main__":
    main()

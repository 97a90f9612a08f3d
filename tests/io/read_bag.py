#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Holds ROS 1 bags that `convert` writes against ROS's own reader in Python.

usage: read_bag.py PROGRAM FOLDER; skipped (exit code 77) where python3-rosbag or the build's bags are absent.
"""

import gzip
import shutil
import struct
import subprocess
import sys
from pathlib import Path

SKIPPED = 77


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


try:
    import rosbag
except ImportError as error:
    skip(error)


def as_floats(words):
    return [struct.unpack("f", struct.pack("f", float(word)))[0] for word in words]


def sweeps_of(log):
    """(ranges, stamp in ns) of the sweeps in a CARMEN log."""
    for line in gzip.open(log, "rt"):
        words = line.split()
        if words and words[0] == "RAWLASER1":
            seconds, decimals = words[-3].split(".")
            yield as_floats(words[9 : 9 + int(words[8])]), int(seconds) * 10**9 + int(decimals)


def main(program, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)

    def run(*words):
        return subprocess.run([program, "-q", *map(str, words)], capture_output=True, text=True, check=False)

    log = folder / "sim" / "recording.log.gz"
    placed = folder / "run.mcap"
    assert run("simulate", "small-rotation", "--out", folder / "sim").returncode == 0
    assert run("localize", log, "--map", folder / "sim" / "plan.yaml", "--base-from-laser", "0.7,0,0", "--start-from",
               folder / "sim" / "truth.tum", "--out-mcap", placed).returncode == 0
    sweeps = list(sweeps_of(log))
    assert len(sweeps) > 10
    for compression in ("none", "lz4", "bz2"):
        bag = folder / f"{compression}.bag"
        ran = run("convert", placed, bag, "--compression", compression)
        if "built without" in ran.stderr:
            skip("this build has no ROS 1 bags")
        assert ran.returncode == 0, ran.stderr
        with rosbag.Bag(str(bag)) as opened:
            messages = [(topic, message) for topic, message, _ in opened.read_messages()]
            packed = opened.get_compression_info().compression
            latched = [c.topic for c in opened._get_connections() if c.header.get("latching") in ("1", b"1")]
        assert packed == compression, packed
        assert latched == ["/tf_static"], latched
        scans = [message for topic, message in messages if topic == "/scan"]
        assert len(scans) == len(sweeps)
        for scan, (ranges, stamp_ns) in zip(scans, sweeps):
            assert list(scan.ranges) == ranges
            assert scan.header.stamp.to_nsec() == stamp_ns
        (fixed,) = [message for topic, message in messages if topic == "/tf_static"]
        (transform,) = fixed.transforms
        assert transform.header.frame_id == "base_link"
        assert transform.child_frame_id == scans[0].header.frame_id
        assert transform.transform.translation.x == 0.7
        moving = [message.transforms[0] for topic, message in messages if topic == "/tf"]
        assert moving == [] or len(moving) == len(scans)
    print(f"rosbag reads all {len(sweeps)} scans of three bags")


main(sys.argv[1], Path(sys.argv[2]))

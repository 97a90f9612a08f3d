#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Opens the shipped RViz file on a screen that nobody sees while a drive is played, and looks at what it shows.

usage: rviz_screenshot.py NODE RVIZ_FILE agv|room [PICTURE.png]; skipped (exit code 77) where ROS, rviz, Xvfb or the drive is absent.
"""

import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

import node_on_a_bag as on_a_bag
import rosgraph

WIDTH, HEIGHT = 1240, 840
# What is to be seen, in the colours of the RViz file and of RViz's maps, and in how many pixels at least.
SEEN = {"the floor of the map": ((194, 194, 194), 50_000), "the scan on the walls": ((26, 191, 51), 400),
        "the path": ((25, 120, 255), 300), "the pose": ((205, 35, 15), 20), "its covariance": ((199, 122, 199), 20)}  # shaded by its heading


def screenshot(folder):
    """Rows of (red, green, blue) of the screen, which Xvfb keeps in a file in the format of xwd."""
    raw = (folder / "Xvfb_screen0").read_bytes()
    header = struct.unpack(">25I", raw[:100])
    size, width, height, bits, line = header[0], header[4], header[5], header[11], header[12]
    assert bits == 32, f"{bits} bits a pixel"
    start = size + 12 * header[19]
    rows = []
    for y in range(height):
        row = raw[start + y * line:start + y * line + 4 * width]
        rows.append([(row[i + 2], row[i + 1], row[i]) for i in range(0, 4 * width, 4)])
    return rows


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    raw = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", len(rows[0]), len(rows), 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def count_near(rows, colour, off=45):
    return sum(all(abs(a - b) <= off for a, b in zip(pixel, colour)) for row in rows for pixel in row)


def check(rows):
    for what, (colour, least) in SEEN.items():
        count = count_near(rows, colour)
        print(f"{what}: {count} pixels")
        assert count >= least, f"{what} is not to be seen"


def run(node, rviz_file, name_of_drive, picture, folder, processes):
    drive = on_a_bag.drive_of(name_of_drive, folder)
    port = on_a_bag.free_port()
    os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1", ROS_HOSTNAME="127.0.0.1",
                      ROS_LOG_DIR=str(folder / "ros"), DISPLAY=f":{port}", LIBGL_ALWAYS_SOFTWARE="1",
                      QT_X11_NO_MITSHM="1", XDG_RUNTIME_DIR=str(folder), HOME=str(folder))
    processes.start("Xvfb", f":{port}", "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", folder, "-nolisten", "tcp")
    processes.start("roscore", "-p", port)
    on_a_bag.wait_for("roscore", lambda: rosgraph.is_master_online(os.environ["ROS_MASTER_URI"]))
    view = folder / "view.rviz"  # as it is shipped, in the drive's own frames
    view.write_text(rviz_file.read_text(encoding="utf-8").replace("Fixed Frame: map", f"Fixed Frame: {drive.map_frame}")
                    .replace("Target Frame: base_link", f"Target Frame: {drive.base_frame}"), encoding="utf-8")
    rosgraph.Master("/screen").setParam("/use_sim_time", True)
    start = [f"_initial_pose_{axis}:={value}" for axis, value in zip("xy", drive.start)]
    processes.start(node, f"_map_file:={drive.map_file}", f"_global_frame_id:={drive.map_frame}",
                    f"_base_frame_id:={drive.base_frame}", f"_stamp_is:={drive.stamp_is}", *start,
                    f"_initial_pose_a:={drive.start[2] * 3.14159265 / 180}", f"_scan_topics:={' '.join(drive.lasers)}",
                    "__name:=beaconless")
    processes.start("rviz", "-d", view)

    def is_shown():
        published = dict(rosgraph.Master("/screen").getSystemState()[1])
        return any(name.startswith("/rviz") for name in published.get("/beaconless/beams", []))

    on_a_bag.wait_for("rviz", is_shown, 60.0)
    time.sleep(3.0)
    player = processes.start("rosbag", "play", "--clock", "--delay", "2", "--quiet", drive.bag)
    on_a_bag.wait_for("the end of the recording", lambda: player.poll() is not None, 120.0)
    time.sleep(1.0)
    rows = screenshot(folder)
    if picture:
        write_png(picture, rows)
    check(rows)


def main():
    node, rviz_file, name_of_drive = sys.argv[1:4]
    picture = Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None
    for program in ("rviz", "Xvfb"):
        if not shutil.which(program):
            on_a_bag.skip(f"{program} is not installed")
    with tempfile.TemporaryDirectory(prefix="beaconless_rviz_") as name:
        processes = on_a_bag.Processes(Path(name))
        try:
            run(node, Path(rviz_file), name_of_drive, picture, Path(name), processes)
        except BaseException:
            print(processes.logs())
            raise
        finally:
            processes.end_all()
    print("RViz shows it all")
    os._exit(0)


if __name__ == "__main__":
    main()

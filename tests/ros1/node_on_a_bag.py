#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Plays a recording to the ROS 1 node through a roscore of its own, and checks what the node tells.

usage: node_on_a_bag.py NODE PROGRAM agv|room; skipped (exit code 77) where ROS or the recording is absent.

`agv` is a real drive with one laser, `room` a made-up one with two.
"""

import csv
import math
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import room_drive

SKIPPED = 77
SETTINGS = {"odometry.use": "false", "deskew": "true"}


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


try:
    import rosbag  # noqa: F401, which room_drive writes with
    import rosgraph
    import rospy
    import rosservice
    from diagnostic_msgs.msg import DiagnosticArray
    from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
    from nav_msgs.msg import OccupancyGrid
    from nav_msgs.srv import SetMap
    from std_srvs.srv import Empty, Trigger
    from tf2_msgs.msg import TFMessage
except ImportError as missing:
    skip(f"ROS is not installed: {missing}")


class Drive:
    """What is played, and how both programs are told of it."""

    def __init__(self, bag, map_file, map_frame, base_frame, start, lasers, stamp_is):
        self.bag, self.map_file, self.map_frame, self.base_frame = bag, map_file, map_frame, base_frame
        self.start = start  # metres and degrees, near the first pose
        self.lasers = lasers  # {topic: x,y,deg on the base}
        self.stamp_is = stamp_is


def drive_of(name, folder):
    if name == "room":
        lasers = {"/front": ("front", (0.3, 0.1, 0.0)), "/rear": ("rear", (-0.3, -0.1, math.pi))}
        room_drive.write_bag(folder / "room.bag", lasers)
        (folder / "room.yaml").write_text(room_drive.WALLS, encoding="utf-8")
        return Drive(folder / "room.bag", folder / "room.yaml", "map", "base_link", (5.5, 4.0, 90.0),
                     {"/front": "0.3,0.1,0", "/rear": "-0.3,-0.1,180"}, "first")
    beside = Path(__file__).resolve().parents[2] / "../shared/data"
    data = Path(os.environ.get("BEACONLESS_DATA", beside)) / "jarvis"
    if not data.exists():
        skip(f"there is no {data}; BEACONLESS_DATA names the folder of recordings")
    return Drive(data / "jarvis_circular_path_fast.bag", data / "maps/i-108_10mm.yaml", "plan", "base_footprint",
                 (14.9, 6.1, 178.5), {"/driver_laser_navigation/laser_scan": "0.194,0,0"}, "last")


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Processes:
    """What was started, each in a group of its own; all of it ends with us."""

    def __init__(self, folder):
        self.folder, self.running = folder, []

    def start(self, *words):
        words = [str(word) for word in words]
        log = open(self.folder / f"{len(self.running)}_{Path(words[0]).name}.log", "w", encoding="utf-8")
        process = subprocess.Popen(words, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
        self.running.append(process)
        return process

    @staticmethod
    def end(process):
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            if process.poll() is not None:
                return
            os.killpg(process.pid, sent)
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                pass

    def end_all(self):
        for process in reversed(self.running):
            self.end(process)

    def said(self, words):
        return any(words in log.read_text(errors="replace") for log in self.folder.glob("*.log"))

    def logs(self):
        return "\n".join(f"--- {log.name}\n{log.read_text(errors='replace')[-4000:]}"
                         for log in sorted(self.folder.glob("*.log")))


class Heard:
    """Everything that the node tells, as it comes."""

    def __init__(self, drive):
        self.drive = drive
        self.poses, self.transforms, self.odometry, self.diagnostics = {}, {}, {}, []
        rospy.Subscriber("amcl_pose", PoseWithCovarianceStamped, self.hear_pose, queue_size=1000)
        rospy.Subscriber("/tf", TFMessage, self.hear_tf, queue_size=1000)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.hear_diagnostics, queue_size=100)

    def hear_pose(self, message):
        self.poses[message.header.stamp.to_nsec()] = message.pose

    def hear_tf(self, message):
        for t in message.transforms:
            ns = t.header.stamp.to_nsec()
            if (t.header.frame_id, t.child_frame_id) == (self.drive.map_frame, "odom"):
                self.transforms[ns] = flat(t.transform.translation, t.transform.rotation)
            if (t.header.frame_id, t.child_frame_id) == ("odom", self.drive.base_frame):
                self.odometry[ns] = flat(t.transform.translation, t.transform.rotation)

    def hear_diagnostics(self, message):
        self.diagnostics += [s for s in message.status if s.name == "beaconless: localization"]

    def diagnosed(self, words):
        return any(words in value.value for status in self.diagnostics for value in status.values)


def flat(place, turn):
    return place.x, place.y, 2.0 * math.atan2(turn.z, turn.w)


def apart(a, b):
    """Metres and radians between two poses."""
    turn = a[2] - b[2]
    return math.hypot(a[0] - b[0], a[1] - b[1]), abs(math.atan2(math.sin(turn), math.cos(turn)))


def wait_for(what, is_there, seconds=30.0):
    end = time.monotonic() + seconds
    while not is_there():
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds:.0f} s in vain for {what}")
        time.sleep(0.05)


def by_command_line(program, drive, folder):
    """The poses of `beaconless localize`: {stamp in ns: (x, y, theta)} of those that are told."""
    words = [program, "localize", drive.bag, "--map", drive.map_file, "--stamp-is", drive.stamp_is,
             "--start", ",".join(map(repr, drive.start)), "--out", folder]
    for topic, place in drive.lasers.items():
        words += ["--topic", topic, f"--base-from-laser={place}"]
    for name, value in SETTINGS.items():
        words += ["--set", f"{name}={value}"]
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL)
    with open(folder / "estimates.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert all(row["status"] in ("ok", "degraded") for row in rows), "the robot is lost on the command line"
    return {int(row["t"].replace(".", "")): tuple(float(row[k]) for k in ("x_m", "y_m", "theta_rad")) for row in rows}


def check_poses(heard, expected):
    assert heard.poses.keys() == expected.keys(), \
        f"{len(heard.poses)} poses heard, {len(expected)} on the command line, " \
        f"{len(heard.poses.keys() & expected.keys())} of them of the same scans"
    off = [apart(flat(heard.poses[ns].pose.position, heard.poses[ns].pose.orientation), expected[ns])
           for ns in expected]
    most_m, most_rad = max(m for m, _ in off), max(rad for _, rad in off)
    print(f"poses: {len(off)} as on the command line, at most {most_m:.1e} m and {most_rad:.1e} rad apart")
    # A quaternion and back costs some roundings; nothing else may differ.
    assert most_m < 1e-12 and most_rad < 1e-12


def check_tf(heard, expected, tolerance_ns):
    """map_from_odom times odom_from_base is the pose, where odometry is told to the same moment."""
    assert len(heard.transforms) > 0.9 * len(expected), f"{len(heard.transforms)} transforms"
    stamps = sorted(heard.odometry)
    most_m, compared = 0.0, 0
    for ns, pose in expected.items():
        before = max((s for s in stamps if s <= ns), default=None)
        after = min((s for s in stamps if s >= ns), default=None)
        sent = heard.transforms.get(ns + tolerance_ns)
        if None in (before, after, sent):
            continue
        part = (ns - before) / (after - before) if after > before else 0.0
        a, b = heard.odometry[before], heard.odometry[after]
        turn = math.atan2(math.sin(b[2] - a[2]), math.cos(b[2] - a[2]))
        odom = (a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * turn)
        most_m = max(most_m, apart(room_drive.times(sent, odom), pose)[0])
        compared += 1
    print(f"tf: {compared} of {len(expected)} transforms give the pose to {most_m:.1e} m")
    # Between two messages tf interpolates as above; stamps of transforms are whole nanoseconds.
    assert compared > 0.9 * len(expected) and most_m < 1e-6


def check_refusal(heard, frame):
    publisher = rospy.Publisher("initialpose", PoseWithCovarianceStamped, queue_size=1)
    wait_for("the node to listen to initialpose", lambda: publisher.get_num_connections() > 0)
    bad = PoseWithCovarianceStamped()
    bad.header.frame_id, bad.pose.pose.orientation.w = frame, 1.0
    bad.pose.covariance[0] = 1e12
    publisher.publish(bad)
    wait_for("the refusal of a huge covariance", lambda: heard.diagnosed("says nothing"))
    bad.pose.covariance[0], bad.header.frame_id = 0.25, "odom"
    publisher.publish(bad)
    wait_for("the refusal of a frame", lambda: heard.diagnosed("its frame is \"odom\""))
    print("initialpose: a huge covariance and another frame are refused")


def check_services():
    saved = rospy.ServiceProxy("save_pose", Trigger)()
    assert saved.success, saved.message
    assert rospy.has_param("/beaconless/initial_pose_x")
    rospy.ServiceProxy("request_nomotion_update", Empty)()
    rospy.ServiceProxy("global_localization", Empty)()
    assert not rospy.ServiceProxy("save_pose", Trigger)().success, "it is looked for everywhere, and still saved"
    refused = rospy.ServiceProxy("set_map", SetMap)(OccupancyGrid(), PoseWithCovarianceStamped())
    assert not refused.success
    print("services: save_pose, request_nomotion_update, global_localization, set_map answer")


def check_rival(heard, drive):
    """Somebody else tells the node's transform, too, and is named."""
    publisher = rospy.Publisher("/tf", TFMessage, queue_size=1)
    wait_for("the node to listen to tf", lambda: publisher.get_num_connections() > 1)  # ourselves are one
    told = TransformStamped()
    told.header.frame_id, told.child_frame_id, told.transform.rotation.w = drive.map_frame, "odom", 1.0
    publisher.publish(TFMessage([told]))
    wait_for("the one who tells odom as well to be named", lambda: heard.diagnosed('/driver tells "odom" below'))
    print("tf: who tells the node's transform as well is named")


def check_new_master(processes, core, process, port, drive, heard, before):
    """The master goes while the node is at work; by a new one it is heard by others when the recording is played again."""
    heard.poses.clear()
    interrupted = processes.start("rosbag", "play", "--clock", "--delay", "1", "--quiet", drive.bag)
    wait_for("poses of the second pass", lambda: heard.poses)
    check_rival(heard, drive)
    processes.end(core)
    assert interrupted.poll() is None and process.poll() is None
    processes.start("roscore", "-p", port)

    def is_known():
        try:
            published, subscribed, served = rosgraph.Master("/driver").getSystemState()
        except (OSError, rosgraph.MasterException):
            return False
        return all("/beaconless" in dict(names).get(name, [])
                   for names, name in ((published, "/amcl_pose"), (published, "/tf"), (served, "/global_localization"),
                                       (subscribed, "/clock"),
                                       *((subscribed, topic) for topic in drive.lasers)))

    wait_for("a new roscore", lambda: rosgraph.is_master_online(f"http://127.0.0.1:{port}"))
    rosgraph.Master("/driver").setParam("/use_sim_time", True)
    wait_for("the node to make itself known to a new roscore", is_known)
    processes.end(interrupted)  # a player never asks for a new master
    echo = processes.start("rostopic", "echo", "-n", "3", "--filter", "m.header.stamp.secs > 0", "/amcl_pose")
    again = processes.start("rosbag", "play", "--clock", "--delay", "3", "--quiet", drive.bag)
    wait_for("poses under the new roscore", lambda: echo.poll() == 0, 30.0)
    # Diagnostics are stamped by the node's clock: where the second pass broke off, unless it hears the new one.
    told = subprocess.run(["rostopic", "echo", "-n", "3", "-p", "/diagnostics/header/stamp"], capture_output=True,
                          text=True, timeout=20, check=True).stdout.split()
    clock = [int(line.split(",")[-1]) for line in told if line[0].isdigit()]
    assert len(clock) == 3 and clock[0] < clock[1] < clock[2], f"its clock stands at {clock}"
    assert min(before) - 10**9 < clock[2] < max(before), f"its clock stands at {clock}, not in the third pass"
    processes.end(again)
    assert process.poll() is None
    print("master: the node is known to a new one, hears its clock, and tells poses")


def run(node, program, drive, folder, processes):
    expected = by_command_line(program, drive, folder / "cli")
    port = free_port()
    os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1", ROS_HOSTNAME="127.0.0.1",
                      ROS_LOG_DIR=str(folder / "ros"), ROSCONSOLE_STDOUT_LINE_BUFFERED="1")
    core = processes.start("roscore", "-p", port)
    wait_for("roscore", lambda: rosgraph.is_master_online(f"http://127.0.0.1:{port}"))
    rosgraph.Master("/driver").setParam("/use_sim_time", True)
    rospy.init_node("driver", disable_signals=True)
    heard = Heard(drive)
    x, y, heading_deg = drive.start
    parameters = {"map_file": drive.map_file, "global_frame_id": drive.map_frame, "base_frame_id": drive.base_frame,
                  "stamp_is": drive.stamp_is, "transform_tolerance": 0.1, "transform_wait": 2.0, "initial_pose_x": x,
                  "initial_pose_y": y, "initial_pose_a": repr(math.radians(heading_deg)),
                  "scan_topics": " ".join(drive.lasers), **SETTINGS}
    for name, value in parameters.items():
        rosgraph.Master("/driver").setParam("/beaconless/" + name.replace(".", "/"), str(value))
    rosgraph.Master("/driver").setParam("/beaconless/base_frame", "base")
    process = processes.start(node)
    wait_for("the node", lambda: "/global_localization" in rosservice.get_service_list())
    player = processes.start("rosbag", "play", "--clock", "--delay", "2", "--quiet", drive.bag)
    wait_for("the end of the recording", lambda: player.poll() is not None, 120.0)
    time.sleep(2.5)  # the last diagnostic comes within a second
    check_poses(heard, expected)
    check_tf(heard, expected, 100_000_000)
    assert heard.diagnostics, "no diagnostics"
    print(f"diagnostics: {len(heard.diagnostics)}, the last: {heard.diagnostics[-1].message}")
    check_refusal(heard, drive.map_frame)
    check_services()
    assert processes.said("did you mean ~base_frame_id?"), "an unknown parameter is passed over in silence"
    check_new_master(processes, core, process, port, drive, heard, expected)


def main():
    node, program, name_of_drive = sys.argv[1:]
    with tempfile.TemporaryDirectory(prefix="beaconless_ros1_") as name:
        processes = Processes(Path(name))
        try:
            run(node, program, drive_of(name_of_drive, Path(name)), Path(name), processes)
        except BaseException:
            print(processes.logs())
            raise
        finally:
            processes.end_all()
    print("the node on the bag: all well")
    os._exit(0)  # rospy's threads would wait for the roscore that has ended


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: Apache-2.0
"""A robot that drives circles in a room without symmetry: its scans, its poses, and a bag of both."""

import math
import random

WALLS = "walls:\n  - [[0, 0], [12, 0], [12, 5], [8, 5], [8, 8], [0, 8], [0, 0]]\n"
CORNERS = [(0, 0), (12, 0), (12, 5), (8, 5), (8, 8), (0, 8), (0, 0)]
CIRCLE_S = 6 * math.pi  # once around


def pose_at(seconds):
    """On a circle of 1.5 m around (4, 4), at half a metre a second."""
    angle = seconds / 3.0
    return 4 + 1.5 * math.cos(angle), 4 + 1.5 * math.sin(angle), angle + math.pi / 2


def times(a, b):
    """The pose of b seen from where a is."""
    return (a[0] + math.cos(a[2]) * b[0] - math.sin(a[2]) * b[1],
            a[1] + math.sin(a[2]) * b[0] + math.cos(a[2]) * b[1], a[2] + b[2])


def sweep(pose, beams, first, step):
    """Ranges to the walls from a laser at a pose."""
    x, y, heading = pose
    ranges = []
    for i in range(beams):
        bearing = heading + first + i * step
        c, s = math.cos(bearing), math.sin(bearing)
        nearest = 30.0
        for (x0, y0), (x1, y1) in zip(CORNERS, CORNERS[1:]):
            along = c * (y1 - y0) - s * (x1 - x0)
            if abs(along) < 1e-12:
                continue
            r = ((x0 - x) * (y1 - y0) - (y0 - y) * (x1 - x0)) / along
            part = ((x0 - x) * s - (y0 - y) * c) / along
            if r > 0 and 0 <= part <= 1:
                nearest = min(nearest, r)
        ranges.append(nearest)
    return ranges


def scan_message(frame, ranges, first, step):
    from sensor_msgs.msg import LaserScan
    message = LaserScan(angle_min=first, angle_max=first + (len(ranges) - 1) * step, angle_increment=step,
                        range_min=0.05, range_max=30.0, ranges=ranges)
    message.header.frame_id = frame
    return message


def write_bag(path, lasers, seconds=10.0, begin_s=1_700_000_000):
    """Lasers {topic: (frame, pose on the base)} that look half around at 10 Hz, one after the other; wheels in /tf at 50 Hz."""
    import rosbag
    import rospy
    from geometry_msgs.msg import TransformStamped
    from tf2_msgs.msg import TFMessage
    first, step, beams = -math.pi / 2, math.radians(0.5), 361
    noise = random.Random(1)

    def transform(stamp, parent, child, pose):
        t = TransformStamped()
        t.header.stamp, t.header.frame_id, t.child_frame_id = stamp, parent, child
        t.transform.translation.x, t.transform.translation.y = pose[0], pose[1]
        t.transform.rotation.z, t.transform.rotation.w = math.sin(pose[2] / 2), math.cos(pose[2] / 2)
        return t

    with rosbag.Bag(str(path), "w") as bag:
        start = pose_at(0.0)
        to_start = (*times((0, 0, -start[2]), (-start[0], -start[1], 0.0))[:2], -start[2])
        for tick in range(round(seconds * 100)):
            now = rospy.Time(begin_s, tick * 10_000_000 % 10**9) + rospy.Duration(tick // 100)
            if tick % 2 == 0:
                frames = [transform(now, "odom", "base_link", times(to_start, pose_at(tick / 100)))]
                frames += [transform(now, "base_link", frame, place) for frame, place in lasers.values()]
                bag.write("/tf", TFMessage(frames), now)
            for i, (topic, (frame, place)) in enumerate(lasers.items()):
                if tick % 10 != 5 * i + 3:
                    continue
                ranges = [r + noise.gauss(0.0, 0.01) for r in sweep(times(pose_at(tick / 100), place), beams, first, step)]
                message = scan_message(frame, ranges, first, step)
                message.header.stamp = now
                bag.write(topic, message, now)

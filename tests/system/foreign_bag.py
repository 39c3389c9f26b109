#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# foreign_bag.py OURS OUT: the readings of a recording as another program would have written them: raw pictures in RGB,
# other topics and frames, BZ2 chunks, no commands, no events. Needs python3-rosbag and python3-pil.
import io
import sys

import rosbag
from PIL import Image as Picture
from sensor_msgs.msg import Image


def raw(message):
    picture = Picture.open(io.BytesIO(bytes(message.data))).convert("RGB")
    made = Image()
    made.header = message.header
    made.width, made.height = picture.size
    made.encoding = "rgb8"
    made.step = 3 * made.width
    made.data = picture.tobytes()
    return made


with rosbag.Bag(sys.argv[1]) as ours, rosbag.Bag(sys.argv[2], "w", compression="bz2") as out:
    for topic, message, time in ours.read_messages():
        if topic == "/camera/image/compressed":
            out.write("/omni/image_raw", raw(message), time)
        elif topic == "/scan":
            out.write("/base_scan", message, time)
        elif topic == "/odom":
            out.write("/pose", message, time)

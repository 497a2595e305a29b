#!/usr/bin/env python3
"""reading_open3d.py ROUNDS FILE...: median wall and CPU seconds of Open3D's reader, for files that
benchmark_reading has written."""
import resource
import statistics
import sys
import time

import open3d


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


for path in sys.argv[2:]:
    wall, cpu = [], []
    for _ in range(int(sys.argv[1])):
        start, cpu_start = time.time(), cpu_seconds()
        points = len(open3d.io.read_point_cloud(path).points)
        wall.append(time.time() - start)
        cpu.append(cpu_seconds() - cpu_start)
    print(f"{path}: {points} points, {statistics.median(wall):.3f} s, {statistics.median(cpu):.3f} s of CPU")

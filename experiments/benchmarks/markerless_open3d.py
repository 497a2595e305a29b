#!/usr/bin/python3
"""markerless_open3d.py PROGRAM FILE [ROUNDS]: rounds of `PROGRAM run FILE` (markerless_peers) in turn with Open3D's
grid average, normals and point-to-plane ICP on the same points. Prints medians and their ratios to Alea's. Needs
Debian's python3-open3d (scripts/setup peers).
"""

import statistics
import subprocess
import sys
import time

import numpy as np
import open3d as o3d


def doubles(file, count):
    return np.fromfile(file, dtype=np.float64, count=count)


def cloud_of(file):
    return o3d.geometry.PointCloud(
        o3d.utility.Vector3dVector(doubles(file, 3 * int(doubles(file, 1)[0])).reshape(-1, 3)))


def error_of(found, truth):
    turn = found[:3, :3].T @ truth[:3, :3]
    angle = np.degrees(np.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2)
    return f"{angle:.4f}_deg_{np.linalg.norm((found - truth)[:3, 3]):.5f}_m"


def timed(work):
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def open3d_round(fixed, moving, truth, start):
    reg = o3d.pipelines.registration
    seconds, grid = timed(lambda: fixed.voxel_down_sample(0.05))
    yield "grid", seconds, len(grid.points)
    seconds, _ = timed(lambda: fixed.estimate_normals(o3d.geometry.KDTreeSearchParamKNN(16)))
    yield "normals", seconds, len(fixed.normals)
    seconds, found = timed(lambda: reg.registration_icp(
        moving, fixed, 0.3, start, reg.TransformationEstimationPointToPlane(),
        reg.ICPConvergenceCriteria(relative_fitness=1e-6, relative_rmse=1e-6, max_iteration=30)))
    yield "icp", seconds, error_of(found.transformation, truth)


def main():
    program, name = sys.argv[1:3]
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    with open(name, "rb") as file:
        fixed, moving = cloud_of(file), cloud_of(file)
        truth, start = (doubles(file, 16).reshape(4, 4) for _ in range(2))
    seconds, results = {}, {}
    for _ in range(rounds):
        lines = subprocess.run([program, "run", name], check=True, capture_output=True, text=True).stdout.splitlines()
        rows = [line.split() for line in lines]
        rows += [(task, "open3d", value, result) for task, value, result in open3d_round(fixed, moving, truth, start)]
        for task, who, value, result in rows:
            seconds.setdefault((task, who), []).append(float(value))
            results[task, who] = result
    print(f"{len(fixed.points)} and {len(moving.points)} points, {rounds} rounds, medians")
    for (task, who), values in seconds.items():
        middle = statistics.median(values)
        print(f"{task:12} {who:10} {middle:8.3f} s  {middle / statistics.median(seconds[task, 'alea']):6.2f} x Alea  "
              f"{results[task, who]}")


if __name__ == "__main__":
    main()

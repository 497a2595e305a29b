#!/usr/bin/python3
"""coloured_icp_open3d.py PAIRS: Open3D's coloured ICP on the pairs that coloured_icp_pairs wrote.

Prints for each cell the success (RMSE below 15 % of the side against the truth) of both programs, their
difference in points, the ratio of their mean centre errors where both succeed, and the times. Needs Debian's
python3-open3d (scripts/setup peers). Both align from the identity with pairs up to one side, lambda 0.968, 50
iterations; Open3D estimates its normals from the 30 nearest points, as Alea does.
"""

import itertools
import sys
import time

import numpy as np
import open3d as o3d


def doubles(file, count):
    values = np.fromfile(file, dtype=np.float64, count=count)
    if len(values) < count:
        raise EOFError
    return values


def cloud_of(file):
    rows = doubles(file, 4 * int(doubles(file, 1)[0])).reshape(-1, 4)
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(rows[:, :3]))
    cloud.colors = o3d.utility.Vector3dVector(np.repeat(rows[:, 3:], 3, axis=1))
    return cloud


def aligned(board, target):
    start = time.perf_counter()
    target.estimate_normals(o3d.geometry.KDTreeSearchParamKNN(30))
    prepared = time.perf_counter()
    reg = o3d.pipelines.registration
    try:
        found = reg.registration_colored_icp(
            board, target, 1.0, np.eye(4), reg.TransformationEstimationForColoredICP(lambda_geometric=0.968),
            reg.ICPConvergenceCriteria(relative_fitness=1e-6, relative_rmse=1e-6, max_iteration=50)).transformation
    except RuntimeError:  # it throws where no pair is left: a failure, as it would be for Alea
        found = np.full((4, 4), 1e3)
    return found, time.perf_counter() - prepared, prepared - start


def rmse(points, a, b):
    off = points @ (a - b)[:3, :3].T + (a - b)[:3, 3]
    return float(np.sqrt((off ** 2).sum(axis=1).mean()))


def print_cell(key, rows):
    rows = np.array(rows)
    share = 100 * (rows[:, :2] < 0.15).mean(axis=0)
    print(("identical", "independent")[key[0]], key[1], key[2], len(rows), f"{share[0]:.1f} {share[1]:.1f}",
          f"{share[0] - share[1]:+.1f}", flush=True)
    return share[0] - share[1]


def print_large(row):
    print(f"20,000 points: Alea {row[4]:.3f} s, Open3D {row[5]:.3f} s, ratio {row[5] / row[4]:.2f}; "
          f"rmse {row[0]:.5f} and {row[1]:.5f} sides", flush=True)


def rows_of(file):
    """(cell, or None for a large pair; one row of numbers) for each pair."""
    while True:
        try:
            shift, rotation, target_kind, seconds = doubles(file, 4)
        except EOFError:
            return
        board, target = cloud_of(file), cloud_of(file)
        truth, ours = (doubles(file, 16).reshape(4, 4) for _ in range(2))
        theirs, their_seconds, _ = aligned(board, target)
        points = np.asarray(board.points)
        key = None if len(points) > 1000 else (int(target_kind), int(rotation), round(100 * shift))
        yield key, (rmse(points, ours, truth), rmse(points, theirs, truth),
                    float(np.linalg.norm((ours - truth)[:3, 3])), float(np.linalg.norm((theirs - truth)[:3, 3])),
                    seconds, their_seconds)


def main():
    differences, centres = [], []
    with open(sys.argv[1], "rb") as file:
        for key, group in itertools.groupby(rows_of(file), key=lambda pair: pair[0]):
            if key is None:
                for _, row in group:
                    print_large(row)
                print("target rotation_deg shift_percent n alea_percent open3d_percent difference")
                continue
            rows = [row for _, row in group]
            differences.append(print_cell(key, rows))
            centres += [row[2:4] for row in rows if max(row[:2]) < 0.15]
    ours, theirs = np.sqrt(np.mean(np.square(centres), axis=0))
    print(f"mean difference over {len(differences)} cells {np.mean(differences):+.2f} points (limit 2), "
          f"largest {np.abs(differences).max():.1f} (limit 12)")
    print(f"centre error where both succeed: rms ratio Alea / Open3D {ours / max(theirs, 1e-15):.3f} "
          f"(n = {len(centres)}; limit 0.9 to 1.1)")


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""Seconds to read ten million points: Alea, PCL, Open3D and a plain read of the same bytes, interleaved.

reading_benchmark.py FOLDER [--points N] [--rounds R] [--more] [--files NAME...] [--program BENCHMARK_READING]

benchmark_reading writes the files (x y z as floats; text with four decimals) and reads them for Alea, PCL and the
plain read; Open3D reads here. In each round every reader reads every file once, in an order drawn anew. Medians.
The times are kept in FOLDER/times.json; --more reads the files that are there again and adds to them, for a machine
that is quiet only now and then (--rounds 0: write the files alone; --files: read only these).
"""
import argparse
import json
import pathlib
import random
import statistics
import subprocess
import time

import open3d

FILES = ("t.ply", "t.pcd", "ascii.pcd", "ascii.ply", "t.xyz")
READERS = ("plain", "alea", "pcl", "open3d")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--points", type=int, default=10_000_000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--more", action="store_true")
    parser.add_argument("--files", nargs="+", choices=FILES, default=FILES)
    parser.add_argument("--program", default="build/release/bin/benchmark_reading")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    points = 0 if options.more else options.points
    server = subprocess.Popen([options.program, str(options.folder), str(points)], stdin=subprocess.PIPE,
                              stdout=subprocess.PIPE, text=True)
    server.stdout.readline()  # the files are written

    def seconds(reader, path):
        if reader == "open3d":
            start = time.perf_counter()
            if len(open3d.io.read_point_cloud(str(path)).points) != options.points:
                raise SystemExit(f"{path}: Open3D did not read every point")
            return time.perf_counter() - start
        server.stdin.write(f"{reader} {path}\n")
        server.stdin.flush()
        return float(server.stdout.readline())

    every = [(reader, name) for name in FILES for reader in READERS if not (reader == "pcl" and name == "t.xyz")]
    jobs = [job for job in every if job[1] in options.files]
    kept = options.folder / "times.json"
    earlier = json.loads(kept.read_text()) if options.more and kept.exists() else {}
    times = {job: earlier.get(" ".join(job), []) for job in every}
    rng = random.Random(sum(map(len, times.values())))
    for _ in range(options.rounds):
        for reader, name in rng.sample(jobs, len(jobs)):
            times[reader, name].append(seconds(reader, options.folder / name))
            kept.write_text(json.dumps({" ".join(job): values for job, values in times.items()}))
    server.stdin.close()
    server.wait()
    print(f"{options.points} points")
    print("| file | rounds | Alea | plain read | PCL | Open3D | Alea / plain | PCL / Alea | Open3D / Alea |\n"
          "|---|---|---|---|---|---|---|---|---|")
    for name in FILES:
        rounds = len(times["plain", name])
        if rounds == 0:
            continue
        m = {reader: statistics.median(times[reader, name]) for reader in READERS if (reader, name) in times}
        pcl = f"{m['pcl']:.2f} | " if "pcl" in m else "not read | "
        ratio = f"{m['pcl'] / m['alea']:.1f}" if "pcl" in m else "-"
        print(f"| {name} | {rounds} | {m['alea']:.3f} | {m['plain']:.3f} | {pcl}{m['open3d']:.2f} | {m['alea'] / m['plain']:.1f} | "
              f"{ratio} | {m['open3d'] / m['alea']:.1f} |")


if __name__ == "__main__":
    main()

"""Pictures relit by prt against Blender's Cycles: same mesh, same band-limited light, same bounces, same camera.

usage: compare.py PRT WORKDIR MESH PROBE [--bounces N] [--size N] [--spp N] [--limit X]

Prints one line per picture: relative RMSE of (relit - Cycles) and of (path traced by prt - Cycles) over the pixels
that the mesh covers whole. Exit status 1 when one is above the limit, 77 when Blender is not installed.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ALBEDO = [0.7, 0.5, 0.3]


def run(*command):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def camera_for(positions):
    low, high = positions.min(axis=0), positions.max(axis=0)
    center, radius = (low + high) / 2, float(np.linalg.norm(high - low)) / 2
    eye = center + np.array([0.45, 0.35, 0.82]) * radius * 4.2
    return {"eye": eye.tolist(), "target": center.tolist(), "up": [0, 1, 0], "vfov_deg": 30}


def main():
    parser = argparse.ArgumentParser()
    for name in ("prt", "work", "mesh", "probe"):
        parser.add_argument(name)
    parser.add_argument("--bounces", type=int, default=3)
    parser.add_argument("--size", type=int, default=320)
    parser.add_argument("--spp", type=int, default=2048)
    parser.add_argument("--rays", type=int, default=4096)
    parser.add_argument("--limit", type=float, default=0.02)
    args = parser.parse_args()
    if not shutil.which("blender"):
        print("Blender is not installed: apt-get install blender python3-numpy")
        return 77
    os.makedirs(args.work, exist_ok=True)
    path = lambda name: os.path.join(args.work, name)

    run(args.prt, "light", args.probe, "--bands", 5, "--window", "fejer", "-o", path("light.exr"))
    run(args.prt, "bake", args.mesh, "-o", path("project.prt"), "--set", f"transfer.bounces={args.bounces}",
        "--set", f"transfer.rays={args.rays}", "--set", f"material.albedo={json.dumps(ALBEDO)}",
        "--set", "transfer.threshold=0")
    run(args.prt, "export", path("project.prt"), "--npy", path("arrays"))
    camera = camera_for(np.load(path("arrays/positions.npy")))
    with open(path("camera.json"), "w") as file:
        json.dump(camera, file)
    view = ["--env", path("light.exr"), "--camera", path("camera.json"), "--size", f"{args.size}x{args.size}"]
    run(args.prt, "relight", path("project.prt"), *view, "-o", path("relit.exr"))
    run(args.prt, "reference", path("project.prt"), *view, "--spp", args.spp // 2, "--bounces", args.bounces,
        "-o", path("reference.exr"))
    with open(path("task.json"), "w") as file:
        json.dump({"arrays": path("arrays"), "environment": path("light.exr"), "albedo": ALBEDO, "camera": camera,
                   "size": [args.size, args.size], "spp": args.spp, "bounces": args.bounces}, file)
    run("blender", "-b", "--factory-startup", "--python-exit-code", 1, "-P", os.path.join(HERE, "render_cycles.py"), "--",
        path("task.json"), path("cycles.exr"))

    worst = 0
    for ours in ("relit", "reference"):
        result = json.loads(run(args.prt, "--json", "compare", path(ours + ".exr"), path("cycles.exr")))
        worst = max(worst, result["relative_rmse"])
        print(f"{os.path.basename(args.mesh):28s} {os.path.basename(args.probe):28s} {args.bounces} bounces "
              f"{ours:9s} - cycles: {100 * result['relative_rmse']:.2f} %")
    return 0 if worst <= args.limit else 1


sys.exit(main())

#!/usr/bin/env python3
"""Pictures of prt against Blender's Cycles: same surface, same band-limited light, same bounces, same camera.

usage: compare.py PRT WORKDIR INPUT PROBE [--bounces N] [--size N] [--spp N] [--rays N] [--limit X]

INPUT is a mesh or a scene with Lambert materials. Cycles renders twice with different seeds, so that its noise cancels in
mean((ours - first)(ours - second)); so does prt's own path tracer. Prints, over the pixels that the surface covers whole, the relative
error of the relit picture, with the 95 % interval that it has, and that of the path-traced one. Exit status 1 when one is above the
limit, 77 when there is nothing to compare with: no Blender, no such input.
"""
import argparse
import array
import ast
import json
import math
import os
import shutil
import sys

from blender import BLENDER_ENVIRONMENT, HERE, run

ALBEDO = [0.7, 0.5, 0.3]  # of meshes; scenes have their own


def read_npy(path, kind):
    """Rows of a two-dimensional little-endian array, without numpy."""
    with open(path, "rb") as file:
        file.seek(8)
        header = ast.literal_eval(file.read(int.from_bytes(file.read(2), "little")).decode())
        values = array.array(kind, file.read())
    width = header["shape"][1] if len(header["shape"]) > 1 else 1
    return [values[i:i + width] for i in range(0, len(values), width)]


def camera_for(arrays):
    """Looks at the first object from above its front right."""
    objects = read_npy(os.path.join(arrays, "object.npy"), "i")
    points = [p for p, o in zip(read_npy(os.path.join(arrays, "positions.npy"), "f"), objects) if o[0] == 0]
    low, high = [min(axis) for axis in zip(*points)], [max(axis) for axis in zip(*points)]
    center = [(a + b) / 2 for a, b in zip(low, high)]
    radius = math.dist(low, high) / 2
    eye = [c + 4.2 * radius * d for c, d in zip(center, (0.45, 0.35, 0.82))]
    return {"eye": eye, "target": center, "up": [0, 1, 0], "vfov_deg": 30}


class Comparison:
    def __init__(self, args):
        self.args = args
        self.worst = 0
        os.makedirs(args.work, exist_ok=True)

    def path(self, name):
        return os.path.join(self.args.work, name)

    def bake(self):
        """Light that five bands hold whole, and the surface baked."""
        args = self.args
        run(args.prt, "light", args.probe, "--bands", 5, "--window", "fejer", "-o", self.path("light.exr"))
        albedo = [] if args.input.endswith(".json") else ["--set", f"material.albedo={json.dumps(ALBEDO)}"]
        run(args.prt, "bake", args.input, "-o", self.path("project.prt"), *albedo, "--set", f"transfer.bounces={args.bounces}",
            "--set", f"transfer.rays={args.rays}", "--set", "transfer.threshold=0")
        run(args.prt, "export", self.path("project.prt"), "--npy", self.path("arrays"))

    def render(self):
        """The same view relit, path traced twice, and rendered twice by Cycles."""
        args = self.args
        camera = camera_for(self.path("arrays"))
        with open(self.path("camera.json"), "w") as file:
            json.dump(camera, file)
        view = ["--env", self.path("light.exr"), "--camera", self.path("camera.json"), "--size", f"{args.size}x{args.size}"]
        run(args.prt, "relight", self.path("project.prt"), *view, "-o", self.path("relit.exr"))
        for seed in (1, 2):
            run(args.prt, "--seed", seed, "reference", self.path("project.prt"), *view, "--spp", args.spp // 4, "--bounces",
                args.bounces, "-o", self.path(f"traced{seed}.exr"))
            with open(self.path("task.json"), "w") as file:
                json.dump({"arrays": self.path("arrays"), "environment": self.path("light.exr"), "camera": camera,
                           "size": [args.size, args.size], "spp": args.spp, "bounces": args.bounces, "seed": seed}, file)
            run("blender", "-b", "--factory-startup", "--python-exit-code", 1, "-P", os.path.join(HERE, "render_cycles.py"),
                "--", self.path("task.json"), self.path(f"cycles{seed}.exr"), env=BLENDER_ENVIRONMENT)

    def between(self, image, first, second):
        """mean((image - first)(image - second)), relative, its interval; and what it is relative to."""
        out = run(self.args.prt, "--json", "compare", self.path(image), self.path(first), "--second-reference", self.path(second))
        return json.loads(out)["noise_free"]

    def judge(self, what, error, interval=""):
        self.worst = max(self.worst, error)
        print(f"{os.path.basename(self.args.input)}, {os.path.basename(self.args.probe)}, {self.args.bounces} bounces: "
              f"{what} - Cycles {100 * error:.2f} %{interval}", flush=True)

    def compare(self):
        relit = self.between("relit.exr", "cycles1.exr", "cycles2.exr")
        self.judge("relit", relit["relative"], f" ({100 * relit['low']:.2f} to {100 * relit['high']:.2f} %)")
        # A traced picture brings noise of its own: what it differs from its twin by.
        traced = self.between("traced1.exr", "cycles1.exr", "cycles2.exr")
        noise = self.between("traced1.exr", "traced2.exr", "cycles1.exr")
        signal = relit["mean_square"] / relit["relative"] ** 2 if relit["relative"] > 0 else traced["mean_square"] / traced["relative"] ** 2
        self.judge("path traced", math.sqrt(max(0.0, traced["mean_square"] - noise["mean_square"]) / signal))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("prt", "work", "input", "probe"):
        parser.add_argument(name)
    parser.add_argument("--bounces", type=int, default=3)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--spp", type=int, default=1024, help="of each of the two renders")
    parser.add_argument("--rays", type=int, default=4096)
    parser.add_argument("--limit", type=float, default=0.02)
    parser.add_argument("--full-run-only", action="store_true", help="skip unless PRT_FULL is set, as the tests do")
    args = parser.parse_args()
    if args.full_run_only and not os.environ.get("PRT_FULL"):
        print("skipped: part of the full run, ./dev test --full")
        return 77
    missing = [p for p in (args.input, args.probe) if not p.startswith("builtin:") and not os.path.exists(p)]
    if missing:
        print(f"skipped: {missing[0]} is not here")
        return 77
    if not shutil.which("blender", path=BLENDER_ENVIRONMENT["PATH"]):
        print("skipped: Blender is not installed (apt-get install blender python3-numpy)")
        return 77
    comparison = Comparison(args)
    comparison.bake()
    comparison.render()
    comparison.compare()
    return 0 if comparison.worst <= args.limit else 1


if __name__ == "__main__":
    sys.exit(main())

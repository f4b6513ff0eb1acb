#!/usr/bin/env python3
"""Radiance transfer textures of patches against Blender's Cycles: same surface, same band-limited circle light, same bounces.

usage: compare_patch.py PRT WORKDIR MODEL [--views N,N,..] [--texels N] [--bounces N] [--limit X]

MODEL is weave or a built-in height map. Cycles renders copies of the exported patch with parallel rays along a view at a cell centre;
its pixels are averaged over the texels of the plane midway in depth. It renders twice with different seeds, so that its noise cancels
in mean((ours - first)(ours - second)). Exit status 1 when a relative error is above the limit, 77 when there is no Blender.
"""
import argparse
import json
import math
import os
import shutil
import sys

from blender import BLENDER_ENVIRONMENT, HERE, run


def view_centre(index, side):
    """Cell centre on the Shirley-Chiu square (libprt/basis/view_square.h), written anew."""
    a, b = (2 * ((index % side) + 0.5) / side - 1, 2 * ((index // side) + 0.5) / side - 1)
    if abs(a) > abs(b):
        r, phi = a, math.pi / 4 * (b / a)
    else:
        r, phi = b, math.pi / 2 - math.pi / 4 * (a / b) if b else 0
    scale = math.sqrt(2 - r * r)
    return [r * math.cos(phi) * scale, r * math.sin(phi) * scale, 1 - r * r]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("prt", "work", "model"):
        parser.add_argument(name)
    parser.add_argument("--views", default="27,14,1", help="cells of the 8 x 8 square")
    parser.add_argument("--texels", type=int, default=32)
    parser.add_argument("--bounces", type=int, default=2)
    parser.add_argument("--size", type=int, default=480)
    parser.add_argument("--spp", type=int, default=12, help="of each of the two renders")
    parser.add_argument("--rays", type=int, default=2048)
    parser.add_argument("--limit", type=float, default=0.03)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--full-run-only", action="store_true", help="skip unless PRT_FULL is set, as the tests do")
    args = parser.parse_args()
    if args.full_run_only and not os.environ.get("PRT_FULL"):
        print("skipped: part of the full run, ./dev test --full")
        return 77
    if not shutil.which("blender", path=BLENDER_ENVIRONMENT["PATH"]):
        print("skipped: Blender is not installed (apt-get install blender python3-numpy)")
        return 77
    os.makedirs(args.work, exist_ok=True)
    path = lambda name: os.path.join(args.work, name)
    model = ["patch.model=weave"] if args.model == "weave" else ["patch.model=heightfield", f"patch.heightmap=builtin:{args.model}"]
    settings = model + ["patch.albedo=0.7,0.5,0.3", f"rtt.texels={args.texels}", f"rtt.bounces={args.bounces}", f"rtt.rays={args.rays}",
                        "rtt.supersamples=6", "transfer.rays=16", *args.set]
    words = [word for setting in settings for word in ("--set", setting)]
    circle = ["--set", "lights[0].kind=circle", "--set", "lights[0].direction=0.6,0.7,0.3", "--set", "lights[0].angle=40"]
    run(args.prt, "bake", "builtin:plane", "-o", path("patch.prt"), *words, *circle)
    run(args.prt, "export", path("patch.prt"), "--npy", path("arrays"), "--exr", path("light"))
    run(args.prt, "bake", path("patch.prt"), "--set", "lights[0].kind=environment", "--set", "lights[0].path=light/light_bands.exr")
    views = []
    for index in map(int, args.views.split(",")):
        direction = view_centre(index, 8)
        ours = path(f"ours_{index}.exr")
        run(args.prt, "rtt", path("patch.prt"), "-o", ours, "--zoom", 1, "--view", ",".join(f"{x:.9f}" for x in direction))
        views.append({"index": index, "direction": direction, "ours": os.path.abspath(ours)})
    with open(path("task.json"), "w") as file:
        json.dump({"arrays": path("arrays"), "environment": path("light/light_bands.exr"), "views": views, "texels": args.texels,
                   "size": args.size, "spp": args.spp, "bounces": args.bounces, "work": os.path.abspath(args.work)}, file)
    out = run("blender", "-b", "--factory-startup", "--python-exit-code", 1, "-P", os.path.join(HERE, "render_patch.py"), "--",
              path("task.json"), env=BLENDER_ENVIRONMENT)
    worst = 0
    for line in out.splitlines():
        if line.startswith("RESULT "):
            result = json.loads(line[7:])
            worst = max(worst, result["relative"])
            print(f"{args.model}, view {result['index']} at {result['angle']:.1f} degrees: prt - Cycles {100 * result['relative']:.2f} % "
                  f"(noise of one render {100 * result['noise']:.2f} %, means {result['ours']:.5f} and {result['cycles']:.5f})", flush=True)
    return 0 if 0 < worst <= args.limit else 1


if __name__ == "__main__":
    sys.exit(main())

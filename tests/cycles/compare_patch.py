#!/usr/bin/env python3
"""Radiance transfer textures of patches against Blender's Cycles: same surface, same band-limited circle light, same bounces.

usage: compare_patch.py PRT WORKDIR MODEL [--views N,N,..] [--between N] [--texels N] [--bounces N] [--limit X]

MODEL is weave or a built-in height map. Cycles renders copies of the exported patch with parallel rays along a view at a cell centre;
its pixels are averaged over the texels of the plane midway in depth. It renders twice with different seeds, so that its noise cancels
in mean((ours - first)(ours - second)). Exit status 1 when a relative error is above the limit, 77 when there is no Blender.
With --between the views are N spread over those that must be interpolated, and all together may be off by 1.2 times what the table
differs from the patch itself, traced by prt from the same views.
"""
import argparse
import json
import math
import os
import shutil
import sys

from blender import BLENDER_ENVIRONMENT, HERE, run


def view_at(x, y):
    """Direction of a place on the Shirley-Chiu square (libprt/basis/view_square.h), written anew."""
    a, b = 2 * x - 1, 2 * y - 1
    if abs(a) > abs(b):
        r, phi = a, math.pi / 4 * (b / a)
    else:
        r, phi = b, math.pi / 2 - math.pi / 4 * (a / b) if b else 0
    scale = math.sqrt(2 - r * r)
    return [r * math.cos(phi) * scale, r * math.sin(phi) * scale, 1 - r * r]


def places(args):
    """Names and places on the view square: centres of cells, or points of an R2 sequence between them."""
    if not args.between:
        return [(index, ((index % 8) + 0.5) / 8, ((index // 8) + 0.5) / 8) for index in map(int, args.views.split(","))]
    inside = lambda t: 1 / 16 + (t % 1) * 7 / 8
    return [(i, inside(0.5 + 0.7548776662 * (i + 1)), inside(0.5 + 0.5698402910 * (i + 1))) for i in range(args.between)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("prt", "work", "model"):
        parser.add_argument(name)
    parser.add_argument("--views", default="27,14,1", help="cells of the 8 x 8 square")
    parser.add_argument("--between", type=int, default=0, help="so many views between the cells' centres instead")
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
    views, predicted = [], []
    for index, x, y in places(args):
        direction = view_at(x, y)
        ours = path(f"ours_{index}.exr")
        run(args.prt, "rtt", path("patch.prt"), "-o", ours, "--zoom", 1, "--view", ",".join(f"{x:.9f}" for x in direction))
        if args.between:
            exact = path(f"exact_{index}.exr")
            run(args.prt, "rtt", path("patch.prt"), "-o", exact, "--zoom", 1, "--exact", "--view", ",".join(f"{x:.9f}" for x in direction))
            report = json.loads(run(args.prt, "--json", "compare", ours, exact))
            predicted.append(report["relative_rmse"] ** 2)
        views.append({"index": index, "direction": direction, "ours": os.path.abspath(ours)})
    with open(path("task.json"), "w") as file:
        json.dump({"arrays": path("arrays"), "environment": path("light/light_bands.exr"), "views": views, "texels": args.texels,
                   "size": args.size, "spp": args.spp, "bounces": args.bounces, "work": os.path.abspath(args.work)}, file)
    out = run("blender", "-b", "--factory-startup", "--python-exit-code", 1, "-P", os.path.join(HERE, "render_patch.py"), "--",
              path("task.json"), env=BLENDER_ENVIRONMENT)
    worst, squares = 0, []
    for line in out.splitlines():
        if line.startswith("RESULT "):
            result = json.loads(line[7:])
            worst = max(worst, result["relative"])
            squares.append(result["relative"] ** 2)
            print(f"{args.model}, view {result['index']} at {result['angle']:.1f} degrees: prt - Cycles {100 * result['relative']:.2f} % "
                  f"(noise of one render {100 * result['noise']:.2f} %, means {result['ours']:.5f} and {result['cycles']:.5f})", flush=True)
    if not args.between:
        return 0 if 0 < worst <= args.limit else 1
    together, expected = (math.sqrt(sum(x) / len(x)) for x in (squares, predicted))
    print(f"{args.model}, {len(squares)} views between centres: prt - Cycles {100 * together:.2f} %, interpolating costs {100 * expected:.2f} %",
          flush=True)
    return 0 if 0 < together <= 1.2 * expected else 1


if __name__ == "__main__":
    sys.exit(main())

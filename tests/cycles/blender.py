"""How the comparisons run other programs."""
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))

# Blender's Python looks for its library beside the first python3 on the path: that must be Debian's, which has numpy.
BLENDER_ENVIRONMENT = {**os.environ, "PATH": "/usr/bin:/bin"}


def run(*command, env=None):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=env)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout

#!/usr/bin/env python3
"""The command line: help, versions, wrong usage: usage.py PLUGRAY"""

import os
import pty
import re
import select
import subprocess
import sys
import time

from command import Command
from tap import check, check_equal, done

plugray = Command(sys.argv[1])
plugray.write("box.x3dv", "#X3D V3.3 utf8\nShape { geometry Box { } }\n")
plugray.write("base.frag", "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n")

version = plugray.expect(0, "--version")
check(version.stdout.startswith("plugray ") and version.stdout.count("\n") == 1, "the version is a line")
for command in ("render", "link", "dump", "check", "plugs", "info", "chart"):
    text = plugray.expect(0, command, "--help")
    check(text.stdout.startswith(f"Usage: plugray {command}") and not text.stderr,
          f"{command} --help says how it is used")
    check(f"  {command} " in plugray.run("--help").stdout, f"--help names {command}")

WRONG = [
    ([], "which command?"),
    (["paint"], "there is no command paint"),
    (["studio", "box.x3dv"], "studio is not in this version"),
    (["render"], "SCENE is missing"),
    (["render", "box.x3dv"], "at least one of -o, --probe, --pick, --stats is needed"),
    (["render", "box.x3dv", "other.x3dv", "-o", "a.png"], "one word too many: other.x3dv"),
    (["render", "box.x3dv", "-o"], "-o lacks its value"),
    (["render", "box.x3dv", "-o", "a.jpg"], "ends in .png, .exr or .npy"),
    (["render", "box.x3dv", "-o", "a.png", "--fast"], "there is no option --fast"),
    (["render", "box.x3dv", "-o", "a.png", "--transparent=yes"], "--transparent takes no value"),
    (["render", "box.x3dv", "-o", "a.png", "--size", "640"], "--size takes WxH"),
    (["render", "box.x3dv", "-o", "a.png", "--size", "0x10"], "--size takes WxH"),
    (["render", "box.x3dv", "-o", "a.png", "--size", "10x99999"], "--size takes WxH"),
    (["render", "box.x3dv", "-o", "a.png", "--size", "10x10 "], "--size takes WxH"),
    (["render", "box.x3dv", "-o", "a.png", "--backend", "vulkan"], "--backend takes auto|egl|osmesa"),
    (["render", "box.x3dv", "-o", "a.png", "--step", "0"], "--step takes a number above 0"),
    (["render", "box.x3dv", "-o", "a.png", "--step", "nan"], "--step takes a number above 0"),
    (["render", "box.x3dv", "-o", "a.png", "--step", "1x"], "--step takes a number above 0"),
    (["render", "box.x3dv", "-o", "a.png", "--error", "0"], "--error takes a number above 0 and at most 1"),
    (["render", "box.x3dv", "-o", "a.png", "--error", "1/0"], "or a fraction, not '1/0'"),
    (["render", "box.x3dv", "-o", "a.png", "--error", "1/255", "--step", "1"], "exclude each other"),
    (["render", "box.x3dv", "-o", "a.png", "--method", "magic"],
     "--method takes auto|midpoint|preintegrated|cells"),
    (["render", "box.x3dv", "-o", "a.png", "--samples", "0"], "--samples takes a whole number"),
    (["render", "box.x3dv", "-o", "a.png", "--repeat", "1.5"], "--repeat takes a whole number"),
    (["render", "box.x3dv", "--stats=xml"], "--stats takes json or nothing"),
    (["render", "box.x3dv", "--probe", "1"], "--probe takes X,Y"),
    (["render", "box.x3dv", "--probe", "-1,0"], "--probe takes X,Y"),
    (["render", "box.x3dv", "--probe", "640,0"], "outside the 640x480 pixels"),
    (["render", "box.x3dv", "--size", "8x4", "--probe", "0,4"], "outside the 8x4 pixels"),
    (["render", "box.x3dv", "--pick", "1,x"], "--pick takes X,Y"),
    (["render", "box.x3dv", "--size", "8x4", "--pick", "8,0"], "--pick 8,0 lies outside the 8x4 pixels"),
    (["render", "box.x3dv", "-o", "a.png", "--dialect", "2006"], "--dialect takes 2005|final"),
    (["render", "box.x3dv", "-o", "a.png", "--set", "Box.size"], "--set takes DEF.field=VALUE"),
    (["render", "box.x3dv", "-o", "a.png", "--set", "Nobody.size=1"], "no node has the DEF name Nobody"),
    (["render", "box.x3dv", "-o", "a.png", "--time", "-1"], "--time takes seconds from 0 to 1e9"),
    (["render", "box.x3dv", "-o", "a.png", "--frames", "0"], "--frames takes a whole number"),
    (["render", "box.x3dv", "-o", "a.png", "--frames", "2", "--fps", "0"], "--fps takes a number above 0"),
    (["render", "box.x3dv", "-o", "a.png", "--fps", "2"], "--fps goes with --frames"),
    (["dump", "box.x3dv"], "-d DIR is missing"),
    (["check"], "SCENE is missing"),
    (["check", "box.x3dv", "--format", "xml"], "--format takes text|json|sarif"),
    (["check", "box.x3dv", "--trust", "--backend", "glut"], "--backend takes auto|egl|osmesa"),
    (["link"], "BASE is missing"),
    (["link", "base.frag", "--stage", "tess"], "--stage takes vertex|geometry|fragment"),
    (["link", "base.frag", "--glsl", "120"], "--glsl takes 330|410|450|300es"),
    (["link", "base.frag", "--stage", "vertex"], "base.frag has no vertex stage"),
]
for arguments, message in WRONG:
    run = plugray.expect(2, *arguments, stderr=message)
    check(not run.stdout, "nothing on standard output")
check_equal(sorted(path.name for path in plugray.folder.iterdir()), ["base.frag", "box.x3dv"],
            "wrong usage writes no file")

# ---- progress


def read_slowly(stderr, wait):
    """Runs check on standard input that comes when `wait` returns."""
    with subprocess.Popen([plugray.program, "check", "-"], stdin=subprocess.PIPE, stderr=stderr) as process:
        wait()
        process.stdin.write(plugray.read("box.x3dv").encode())
        process.stdin.close()
        return process.wait(), process.stderr.read() if process.stderr else b""


def read_until(terminal, text, seconds=60):
    """What comes from the terminal until it holds `text` or the time is over."""
    shown, end = b"", time.monotonic() + seconds
    while text not in shown and time.monotonic() < end:
        if select.select([terminal], [], [], 0.1)[0]:
            shown += os.read(terminal, 4096)
    return shown


check_equal(read_slowly(subprocess.PIPE, lambda: time.sleep(1.6)), (0, b""),
            "no progress where standard error is no terminal")
ours, theirs = pty.openpty()
shown = b""


def wait_for_progress():
    global shown
    shown = read_until(ours, b" s")


status, _ = read_slowly(theirs, wait_for_progress)
check(status == 0 and re.search(rb"plugray: reading, \d+ s", shown), "progress on a terminal after a second", shown)
shown = read_until(ours, b"\r\x1b[K")
check(shown.endswith(b"\r\x1b[K"), "the line is taken away at the end", shown)
os.close(theirs)
os.close(ours)
done()

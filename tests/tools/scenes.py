#!/usr/bin/env python3
"""check, dump, plugs and info, that need no GL: scenes.py PLUGRAY"""

import json
import re
import subprocess
import sys

from command import Command
from tap import check, check_equal, done

plugray = Command(sys.argv[1])

BOX = """#X3D V3.3 utf8
Shape {
  appearance Appearance {
    material DEF Paint UnlitMaterial { emissiveColor 0.25 0.5 0.75 }
    effects DEF Glow Effect {
      language "GLSL"
      inputOutput SFFloat amount 0.5
      parts EffectPart { type "FRAGMENT" url "data:text/plain,
        uniform float amount;
        void PLUG_fragment_modify(inout vec4 color) { color.g += amount; }
      " }
    }
  }
  geometry Box { size 2 2 2 }
}
"""
VOLUME = """#X3D V3.3 utf8
VolumeData {
  dimensions 1 1 1
  voxels PixelTexture3D { image 1 2 2 2 0 255 0 255 0 255 0 255 }
  renderStyle OpacityMapVolumeStyle { }
}
"""
plugray.write("box.x3dv", BOX)
plugray.write("volume.x3dv", VOLUME)

# ---- check

clean = plugray.expect(0, "check", "box.x3dv", "volume.x3dv")
check(not clean.stdout and "error" not in clean.stderr and "warning" not in clean.stderr,
      "clean scenes have no problems", clean.stderr)
plugray.expect(0, "check", "-", stdin=BOX)
warned = plugray.write("warned.x3dv", BOX.replace("geometry Box {", "geometry Box { sise 1"))
run = plugray.expect(0, "check", "warned.x3dv", stderr="warned.x3dv:14:18: warning: ")
check("[unknown-field]\n      geometry Box { sise 1" in run.stderr,
      "the author's line stands below, indented", run.stderr)
caret = [line for line in run.stderr.splitlines() if line.strip() == "^"]
check_equal(caret[:1], ["    " + " " * 17 + "^"], "the caret stands under the column")
plugray.expect(1, "check", "warned.x3dv", "--strict")
plugray.write("broken.x3dv", BOX.replace("amount; }", "amuont; }"))
broken = plugray.expect(1, "check", "broken.x3dv", stderr="broken.x3dv:10:66: error: ")
check("[glsl]" in broken.stderr, "GLSL errors stand at the author's line in the scene", broken.stderr)
plugray.expect(1, "check", "nowhere.x3dv", stderr="nowhere.x3dv:1:1: error: ")
plugray.expect(1, "check", "nowhere.x3dv", "box.x3dv", stderr="[missing-file]")

run = plugray.expect(1, "check", "--format", "json", "broken.x3dv", "warned.x3dv", "box.x3dv")
check(not run.stderr, "with --format json nothing is said on standard error", run.stderr)
items = [item for item in json.loads(run.stdout) if item["severity"] != "info"]
check_equal([(i["file"], i["line"], i["column"], i["severity"], i["code"]) for i in items],
            [("broken.x3dv", 10, 66, "error", "glsl"), ("warned.x3dv", 14, 18, "warning", "unknown-field")],
            "JSON has the place, severity and code of each")
check(all(isinstance(i["message"], str) and isinstance(i["notes"], list) for i in items),
      "JSON has message and notes of each")
check_equal(json.loads(plugray.expect(0, "check", "--format", "json", "box.x3dv").stdout), [],
            "no problem is an empty array")

missing = json.loads(plugray.expect(1, "check", "--format", "json", "nowhere.x3dv").stdout)
check_equal([(i["file"], i["line"], i["column"]) for i in missing], [("nowhere.x3dv", 1, 1)],
            "JSON has what concerns a whole file at 1:1, as the text has")
# Data that cannot be had hide no faults of what would show them.
plugray.write("lost.x3dv", VOLUME.replace("PixelTexture3D { image 1 2 2 2 0 255 0 255 0 255 0 255 }",
                                          'ImageTexture3D { url "lost.nrrd" }').replace(
    "renderStyle OpacityMapVolumeStyle { }",
    """renderStyle OpacityMapVolumeStyle { transferFunction ImageTexture { url "lost.png" } }
  effects Effect { language "GLSL" parts EffectPart { type "FRAGMENT" url "data:text/plain,
    void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) { color.a = amuont; }" } }"""))
run = plugray.expect(1, "check", "lost.x3dv", stderr="lost.x3dv:7:86: error: ")
check_equal(re.findall(r"^lost.x3dv:(\d+):\d+: error: .*\[(.*)\]$", run.stderr, re.M),
            [("4", "missing-file"), ("5", "missing-file"), ("7", "glsl")],
            "a missing volume does not hide its other faults")
plugray.write("shapeless.x3dv", BOX.replace("amount; }", "amuont; }").replace(
    "Box { size 2 2 2 }", "IndexedFaceSet { coordIndex [ 0 1 2 -1 ] }"))
run = plugray.expect(1, "check", "shapeless.x3dv", stderr="shapeless.x3dv:10:66: error: ")
check("shapeless.x3dv:14:29: error: " in run.stderr, "nor do faulty coordinates", run.stderr)

run = plugray.expect(1, "check", "--format=sarif", "broken.x3dv", "warned.x3dv")
sarif = json.loads(run.stdout)
check_equal((sarif["version"], len(sarif["runs"])), ("2.1.0", 1), "SARIF is 2.1.0 with one run")
driver = sarif["runs"][0]["tool"]["driver"]
results = [r for r in sarif["runs"][0]["results"] if r["level"] != "note"]
check_equal([(r["ruleId"], r["level"]) for r in results], [("glsl", "error"), ("unknown-field", "warning")],
            "SARIF has a result for each problem")
check(all(driver["rules"][r["ruleIndex"]]["id"] == r["ruleId"] for r in results),
      "each result leads to its rule")
place = results[1]["locations"][0]["physicalLocation"]
check_equal((place["artifactLocation"]["uri"], place["region"]["startLine"], place["region"]["startColumn"]),
            ("warned.x3dv", 14, 18), "each result has its place")
plugray.write("steering.x3dv", BOX.replace("geometry Box {", "geometry Box { sise\u009b2J\x1b[2J\x7f 1"))
run = plugray.run("check", "steering.x3dv")
check("sise" in run.stderr and not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f]", run.stderr),
      "text from files does not steer a terminal", ascii(run.stderr))
plugray.write("umläut b.x3dv", BOX.replace("geometry Box {", '# "ä"\ngeometry Box { sise 1'))
sarif = json.loads(plugray.expect(0, "check", "--format", "sarif", "umläut b.x3dv").stdout)
results = [r for r in sarif["runs"][0]["results"] if r["ruleId"] == "unknown-field"]
uri = results[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
check_equal(uri, "uml%C3%A4ut%20b.x3dv", "SARIF escapes file names as URIs")

# ---- files

plugray.write("other/box.x3dv", BOX)
plugray.write("scene/inline.x3dv", '#X3D V3.3 utf8\nInline { url "../other/box.x3dv" }\n')
plugray.expect(1, "check", "scene/inline.x3dv", stderr="scene/inline.x3dv:2:15: error: ")
check("[not-allowed]" in plugray.run("check", "scene/inline.x3dv").stderr, "files elsewhere are refused")
plugray.expect(0, "check", "scene/inline.x3dv", "--allow", "other")
plugray.write("net.x3dv", '#X3D V3.3 utf8\nInline { url "http://127.0.0.1:9/box.x3dv" }\n')
plugray.expect(1, "check", "net.x3dv", stderr="[not-allowed]")
plugray.expect(1, "check", "net.x3dv", "--allow-network", stderr="net.x3dv:2:15: error: ")
check("no way to read over the network" in plugray.run("check", "net.x3dv", "--allow-network").stderr,
      "--allow-network says that there is no way")
plugray.expect(0, "check", "box.x3dv", "--set", "Glow.amount=0.25", "--set", "Paint.emissiveColor=1 0 0")
plugray.expect(2, "check", "box.x3dv", "--set", "Glow.amount=much", stderr="[bad-value]")
plugray.expect(2, "check", "box.x3dv", "--set", "Paint.colour=1 0 0", stderr="has no field colour")
plugray.expect(0, "check", "volume.x3dv", "--dialect", "2005")

# ---- dump

plugray.expect(0, "dump", "box.x3dv", "-d", "a/b")
plugray.expect(0, "dump", "volume.x3dv", "-d", "a/b")
files = sorted(path.name for path in (plugray.folder / "a/b").iterdir())
check_equal(files, sorted(f"{kind}-1.{stage}{end}" for kind in ("surface", "volume")
                          for stage in ("frag", "vert") for end in ("", ".map")),
            "dump writes each stage of each program, and its map")
for name in files:
    if name.endswith((".frag", ".vert")):
        valid = subprocess.run(["glslangValidator", str(plugray.folder / "a/b" / name)],
                               capture_output=True, encoding="utf-8")
        check(valid.returncode == 0, f"glslangValidator accepts {name}", valid.stdout)
        rows = plugray.read(f"a/b/{name}.map").splitlines()
        check(len(rows) == len(plugray.read(f"a/b/{name}").splitlines()) and
              all(re.fullmatch(r"\d+\t.+:\d+:\d+\t.+", row) for row in rows),
              f"{name}.map has a row for each line")
check(re.search(r"\tbox.x3dv:10:\d+\tGlow$", plugray.read("a/b/surface-1.frag.map"), re.M),
      "the map leads to the line in the scene, and names the effect")
plugray.write("file", "")
plugray.expect(3, "dump", "box.x3dv", "-d", "file", stderr="[output]")

# ---- plugs, info

listing = plugray.expect(0, "plugs", "box.x3dv").stdout
check(re.search(r"^fragment_modify \(.*\) fragment\n    offered by .*\n    used by Glow at box.x3dv:10:",
                listing, re.M), "plugs tells who offers and who uses a plug", listing[:2000])
listing = plugray.expect(0, "plugs").stdout
for plug in ("fragment_modify", "vertex_eye_space", "light_scale", "volume_sample", "volume_composite"):
    check(re.search(rf"^{plug} \(", listing, re.M), f"plugs without a scene lists {plug}")
text = plugray.expect(0, "info", "box.x3dv").stdout
check(re.search(r"^nodes: 6$", text, re.M) and "    UnlitMaterial 1\n" in text, "info counts nodes", text)
check(re.search(r"surface-1: [1-9]\d* instructions, 0 fetches", text), "info counts instructions", text)
text = plugray.expect(0, "info", "volume.x3dv").stdout
check("PixelTexture3D at volume.x3dv:4:10: 2x2x2, 1 of uint8, 8 bytes, values 0 to 255" in text,
      "info tells size, type, bytes and values of volumes", text)
check(re.search(r"volume-1: \d+ instructions, [1-9]\d* fetches", text), "info counts fetches", text)
done()

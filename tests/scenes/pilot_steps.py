#!/usr/bin/env python3
"""--error E where no bound of the error is known: which steps pilot drawings choose, and when they are made."""

from harness import load_json
from pilot_data import CAMERA, NO_LIGHT, SCENES, SHELL, check_estimate, composed, differences, draw, known, suite, truth, volume
from scenes import constant, scene, voxels

RUNGS = (1, 0.5, 0.25, 0.125, 0.0625)


@suite.case
def rungs():
    "no step much shorter than needed is taken, and none that is too long; what is out of reach is said"
    name = "two components"
    wrong = {step: max(differences(draw(name, "--step", step)[0], truth(name))) for step in RUNGS}
    for error in (1 / 16, 1 / 60, 1 / 100, 1 / 400):
        said, plan = check_estimate(name, error)
        needed = next((i for i, step in enumerate(RUNGS) if wrong[step] <= error), len(RUNGS) - 1)
        taken = RUNGS.index(plan["step"])
        suite.check(f"{name}, --error {error:.4f}: steps of 1/{2**taken}, 1/{2**needed} would do",
                    needed <= taken <= needed + 1, wrong, said)
    said, plan = check_estimate("cartoon", 1 / 4000)
    suite.check("out of reach: the shortest steps, and what they reach",
                plan["step"] == RUNGS[-1] and said["value"] > 1 / 4000 and "out of reach" in plan["why"], said, plan)


@suite.case
def long_rays():
    "where the shortest steps are more than the renderer takes at once, rays are cut into slabs, or the steps stay longer"
    length = 800  # most of the pilots' rays are beside, between it and a small volume that has nothing
    values = [(37 * i * i + 11 * i) % 251 // (1 if i % 7 else 40) for i in range(length)]
    data = voxels(1, (1, 1, length), values)
    style = composed("OpacityMapVolumeStyle { transferFunction PixelTexture { image 3 1 4 "
                     "0x00000000 0x40802001 0xff806002 } }", "EdgeEnhancementVolumeStyle { }")
    for name, fields in (("slabs", ""), ("no slabs", "writeDepth TRUE")):
        SCENES[name] = ("OrthoViewpoint { position 0 0 10 fieldOfView -.001 -.001 .006 .006 }\n", NO_LIGHT,
                        f"VolumeData {{ dimensions {1 / length} {1 / length} 1 voxels {data} {fields} "
                        f"renderStyle {style} }}\n",
                        f"Transform {{ translation 0.005 0.005 0 children VolumeData {{ voxels {constant(0)} "
                        f"dimensions {3 * '0.001 '} }} }}\n")
    known["slabs"] = known["no slabs"] = draw("slabs", "--step", 1 / 128)[0]
    said, plan = check_estimate("slabs", 1 / 4000)
    suite.check("slabs: all rungs", plan["step"] == RUNGS[-1], plan)
    said, plan = check_estimate("no slabs", 1 / 4000)
    suite.check("no slabs: longer steps", RUNGS[-1] < plan["step"] < 1, plan)


@suite.case
def nothing_for_nothing():
    "no pilots with fixed steps, without an error, or where a bound is known"
    for name, arguments in (("shaded", ("--step", "0.5")), ("shaded", ())):
        told = draw(name, *arguments)[1]
        suite.check(f"{' '.join(arguments) or 'default'}: half a voxel, nothing measured",
                    "pilots" not in told["plan"] and told["plan"]["step"] == 0.5 and told["error"]["value"] is None,
                    told["plan"], told["error"])
    suite.check("by default the picture is that of half a voxel",
                draw("shaded")[0] == draw("shaded", "--step", "0.5", "--method", "preintegrated")[0])
    SCENES["bounded"] = (CAMERA, volume(style=SHELL))
    told = draw("bounded", "--error", 1 / 64)[1]
    suite.check("bounded", told["error"]["kind"] == "bounded" and "pilots" not in told["plan"], told["plan"])
    told = draw("shaded", "--error", 1 / 64)[1]
    suite.check("else they are counted", told["plan"].get("pilots", {}).get("wall_ms", 0) > 0, told["plan"])


@suite.case
def same_every_time():
    "what is chosen depends on the scene alone: not on the renderer, the size of the picture or how often it is drawn"
    picture, told = draw("shaded", "--error", 1 / 64)
    for arguments in (("--backend", "egl"), ("--backend", "osmesa"), ("--repeat", "2")):
        again, told_again = draw("shaded", "--error", 1 / 64, *arguments)
        suite.check(" ".join(arguments), again == picture and told_again["error"] == told["error"],
                    told["error"], told_again["error"])
    result = suite.render(scene(*SCENES["shaded"]), "--error", 1 / 64, "--stats", "json", size="300x300")
    larger = load_json(result.output)
    suite.check("a larger picture", larger["error"] == told["error"] and larger["plan"]["step"] == told["plan"]["step"],
                told["error"], larger["error"])


suite.run()

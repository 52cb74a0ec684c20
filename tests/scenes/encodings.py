#!/usr/bin/env python3
"""The same scene in both encodings, compressed, from standard input, in parts, with what XML allows."""

import gzip
import subprocess

from harness import HEADER, Suite, opacity, premultiplied
from scenes import constant, effect, front_scene, quad, volume

suite = Suite()

FOG = premultiplied((0.2,) * 3, opacity(0.2, 1, 0.5))
CLASSIC = front_scene(volume(constant(51, (2, 2, 2))))
VOXELS = "1 2 2 2 51 51 51 51 51 51 51 51"
XML = f"""<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE X3D PUBLIC "ISO//Web3D//DTD X3D 4.0//EN" "https://www.web3d.org/specifications/x3d-4.0.dtd">
<X3D profile='Immersive' version='4.0' xmlns:xsd='http://www.w3.org/2001/XMLSchema-instance'>
  <head><meta name='title' content='a volume'/><component name='VolumeRendering' level='2'/></head>
  <Scene>
    <OrthoViewpoint position='0 0 10' fieldOfView='-1 -1 1 1'/>
    <NavigationInfo headlight='false'/>
    <VolumeData><PixelTexture3D containerField='voxels' image='{VOXELS}'/></VolumeData>
  </Scene>
</X3D>
"""
RED = "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) { color = vec4(1.0, 0.0, 0.0, 1.0); }"
GREEN = "void PLUG_fragment_modify(inout vec4 color) { color = vec4(0.0, 1.0, 0.0, 1.0); }"


def xml(body):
    return XML[: XML.index("    <VolumeData>")] + body + "\n  </Scene>\n</X3D>\n"


def drawn(name, content, *arguments, files=None):
    result = suite.command("render", name, "--size", "1x1", "--no-cache", "--probe", "0,0", *arguments,
                           files={name: content, **(files or {})})
    return [float(word) for word in result.output.split()]


@suite.case
def kinds_of_files():
    "x3d, x3dv, wrl, each also compressed"
    wrl = CLASSIC.replace(HEADER, "#VRML V2.0 utf8\n")
    for name, content in (("a.x3dv", CLASSIC), ("a.x3d", XML), ("a.wrl", wrl),
                          ("a.x3dv", gzip.compress(CLASSIC.encode())), ("a.x3d", gzip.compress(XML.encode())),
                          ("a.x3dz", gzip.compress(XML.encode())), ("a.x3dvz", gzip.compress(CLASSIC.encode())),
                          ("a.wrz", gzip.compress(wrl.encode())), ("no-ending", XML), ("ending.txt", CLASSIC)):
        packed = ", gzip" if isinstance(content, bytes) else ""
        suite.close(f"{name}{packed}", drawn(name, content), FOG)


@suite.case
def standard_input():
    "SCENE - is standard input"
    for name, text in (("classic", CLASSIC), ("XML", XML), ("gzip", gzip.compress(CLASSIC.encode()))):
        done = subprocess.run([suite.program, "render", "-", "--size", "1x1", "--no-cache", "--probe", "0,0"],
                              input=text if isinstance(text, bytes) else text.encode(),
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                              cwd=suite.new_folder())
        suite.equal(f"{name}: status", done.returncode, 0)
        suite.close(name, [float(word) for word in done.stdout.split()], FOG)


@suite.case
def effects_in_xml():
    "an Effect without containerField goes to effects; CDATA without data:; parts by attribute"
    part = f"<EffectPart type='FRAGMENT'><![CDATA[{RED}]]></EffectPart>"
    shape = ("<Shape><Appearance><UnlitMaterial/>%s</Appearance><IndexedFaceSet coordIndex='0 1 2 3 -1'>"
             "<Coordinate point='-1 -1 0, 1 -1 0, 1 1 0, -1 1 0'/></IndexedFaceSet></Shape>")
    green = f"<EffectPart type='FRAGMENT'><![CDATA[{GREEN}]]></EffectPart>"
    data = f"<PixelTexture3D containerField='voxels' image='{VOXELS}'/>"
    cases = {
        "volume": (f"<VolumeData>{data}<Effect>{part}</Effect></VolumeData>", (1, 0, 0, 1)),
        "volume, containerField": (
            f"<VolumeData>{data}<Effect containerField='effects'>{part}</Effect></VolumeData>", (1, 0, 0, 1)),
        "shape": (shape % f"<Effect>{green}</Effect>", (0, 1, 0, 1)),
        "attribute": (shape % f"<Effect><EffectPart type='FRAGMENT' url='\"data:text/plain,{GREEN}\"'/></Effect>",
                      (0, 1, 0, 1)),
        "language GLSL": (shape % f"<Effect language='GLSL'>{green}</Effect>", (0, 1, 0, 1)),
        "upper-case TRUE": (shape % f"<Effect enabled='TRUE'>{green}</Effect>", (0, 1, 0, 1)),
        "DEF and USE": (f"<Group><Effect DEF='E' enabled='true'>{green}</Effect></Group>"
                        + shape % "<Effect USE='E'/>", (0, 1, 0, 1)),
    }
    for name, (body, expected) in cases.items():
        suite.close(name, drawn("a.x3d", xml(body)), expected)


@suite.case
def fields_in_xml():
    "author's fields: values as attributes, nodes as children"
    code = ("uniform float a; uniform vec3 b; uniform sampler2D t;\n"
            "void PLUG_fragment_modify(inout vec4 color) { color.rgb = vec3(a, b.y, texture2D(t, vec2(0.5)).b); }")
    body = ("<Shape><Appearance><UnlitMaterial/><Effect>"
            "<field name='a' type='SFFloat' accessType='inputOutput' value='.25'/>"
            "<field name='b' type='SFVec3f' accessType='initializeOnly' value='0 .5 0'/>"
            "<field name='t' type='SFNode' accessType='inputOutput'><PixelTexture image='1 1 3 0x0000CC'/></field>"
            f"<EffectPart type='FRAGMENT'><![CDATA[{code}]]></EffectPart></Effect></Appearance>"
            "<IndexedFaceSet coordIndex='0 1 2 3 -1'><Coordinate point='-1 -1 0, 1 -1 0, 1 1 0, -1 1 0'/>"
            "</IndexedFaceSet></Shape>")
    suite.close("", drawn("a.x3d", xml(body)), (0.25, 0.5, 0.8, 1))


@suite.case
def urls():
    "the first url that loads counts; folders are those of the referring file"
    def scene(url):
        return front_scene(quad("UnlitMaterial { }", f'Effect {{ parts EffectPart {{ type "FRAGMENT" url [ {url} ] }} }}'))

    files = {"glsl/green.frag": GREEN, "parts/part.x3dv": HEADER + quad(
        "UnlitMaterial { }", 'Effect { parts EffectPart { type "FRAGMENT" url "glsl/green.frag" } }'),
        "parts/glsl/green.frag": GREEN.replace("0.0, 1.0, 0.0", "0.0, 0.5, 0.0")}
    suite.close("one", drawn("a.x3dv", scene('"glsl/green.frag"'), files=files), (0, 1, 0, 1))
    suite.close("the second", drawn("a.x3dv", scene('"none.frag" "glsl/green.frag"'), files=files), (0, 1, 0, 1))
    suite.close("data: without a type", drawn("a.x3dv", scene(f'"data:,{GREEN}"')), (0, 1, 0, 1))
    suite.close("no percent decoding",
                drawn("a.x3dv", scene('"data:text/plain,void PLUG_fragment_modify(inout vec4 c)'
                                      '{ int m = 7 %20; c = vec4(0.0, float(m) * 0.125, 0.0, 1.0); }"')),
                (0, 0.875, 0, 1))
    suite.close("of an Inline", drawn("a.x3dv", front_scene('Inline { url "parts/part.x3dv" }\n'), files=files),
                (0, 0.5, 0, 1))


@suite.case
def inline_and_externproto():
    "a scene in parts, of both encodings"
    part = xml(f"<VolumeData><PixelTexture3D containerField='voxels' image='{VOXELS}'/></VolumeData>")
    suite.close("XML in classic", drawn("a.x3dv", front_scene('Inline { url "p.x3d" }\n'), files={"p.x3d": part}), FOG)
    suite.close("classic in XML", drawn("a.x3d", xml("<Inline url='\"p.x3dv\"'/>"), files={"p.x3dv": HEADER + volume(
        constant(51, (2, 2, 2)))}), FOG)
    library = HEADER + "PROTO Fog [ initializeOnly SFVec3f size 1 1 1 ] {\n" + volume(
        constant(51, (2, 2, 2))).replace("dimensions 1 1 1", "dimensions IS size") + "}\n"
    use = 'EXTERNPROTO Fog [ initializeOnly SFVec3f size ] "lib.x3dv#Fog"\nFog { size 1 1 2 }\n'
    suite.close("EXTERNPROTO", drawn("a.x3dv", front_scene(use), files={"lib.x3dv": library}),
                premultiplied((0.2,) * 3, opacity(0.2, 2, (2 / 8) ** (1 / 3))))


@suite.case
def allowed_folders():
    "--allow opens another folder"
    folder = suite.new_folder()
    scene = front_scene(quad("UnlitMaterial { }", 'Effect { parts EffectPart { type "FRAGMENT" url "../far/green.frag" } }'))
    arguments = ("render", "scene/a.x3dv", "--size", "1x1", "--no-cache", "--probe", "0,0")
    files = {"scene/a.x3dv": scene, "far/green.frag": GREEN}
    refused = suite.command(*arguments, files=files, status=1, folder=folder)
    suite.equal("refused", [m[5] for m in refused.messages()], ["not-allowed"])
    suite.close("drawn without it", [float(w) for w in refused.output.split()], (1, 1, 1, 1))
    allowed = suite.command(*arguments, "--allow", "far", folder=folder)
    suite.close("allowed", [float(w) for w in allowed.output.split()], (0, 1, 0, 1))


@suite.case
def unknown_things():
    "unknown nodes and fields are warnings at their place, and all else is drawn"
    text = front_scene("Whatever { size 1 children [ Shape { } ] }\n",
                       volume(constant(51, (2, 2, 2)), fields="someField 3"))
    result = suite.render(text, "--probe", "8,8")
    suite.close("drawn", [float(w) for w in result.output.split()], FOG)
    suite.equal("warnings", sorted(m[3::2] for m in result.messages()),
                [("warning", "unknown-field"), ("warning", "unknown-node")])
    body = "<Whatever size='1'><Shape/></Whatever><VolumeData someField='3'><PixelTexture3D containerField='voxels' image='%s'/></VolumeData>"
    result = suite.render(xml(body % VOXELS), "--probe", "8,8")
    suite.close("XML, drawn", [float(w) for w in result.output.split()], FOG)
    suite.equal("XML, warnings", sorted(m[3::2] for m in result.messages()),
                [("warning", "unknown-field"), ("warning", "unknown-node")])


@suite.case
def usage():
    "wrong usage is exit status 2"
    folder = suite.new_folder()
    suite.command("check", "a.x3dv", files={"a.x3dv": CLASSIC}, folder=folder)
    for arguments in (("a.x3dv",), ("a.x3dv", "--probe", "1"), ("a.x3dv", "--probe", "999,0"),
                      ("a.x3dv", "--size", "0x4", "--probe", "0,0"), ("a.x3dv", "-o", "a.gif"),
                      ("a.x3dv", "--step", "-1", "--probe", "0,0"), ("a.x3dv", "--nonsense"),
                      ("a.x3dv", "--error", "2", "--probe", "0,0"), ("--probe", "0,0")):
        result = suite.command("render", *arguments, status=None, folder=folder)
        suite.equal(" ".join(arguments), result.status, 2)


suite.run()

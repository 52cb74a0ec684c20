#!/usr/bin/env python3
"""Every plug in effects/ stands in docs/plugs.md with its stage and number of parameters, and every
plug in docs/plugs.md stands in effects/. usage: plugs.py SOURCE-ROOT"""
import os
import re
import sys

COMMENT = re.compile(r"/\*\s*PLUG\s*:\s*(\w+)\s*((?:\([^*]*?\)\s*)+)\*/")
ROW = re.compile(r"^\|\s*`(\w+)`\s*\|(.*)\|\s*$")


def commas_outside(text):
    depth = commas = 0
    for character in text:
        depth += {"(": 1, ")": -1}.get(character, 0)
        commas += character == "," and depth == 0
    return commas


def count_parameters(text):
    return commas_outside(text) + 1 if text.strip() else 0


def argument_lists(text):
    """The contents of the outer parentheses: "(a, f(b)) (c)" gives "a, f(b)" and "c"."""
    depth, start, lists = 0, 0, []
    for position, character in enumerate(text):
        if character == "(":
            depth += 1
            start = position + 1 if depth == 1 else start
        elif character == ")":
            depth -= 1
            if depth == 0:
                lists.append(text[start:position])
    return lists


def plugs_of_effects(root):
    plugs = {}
    for folder, _, names in os.walk(os.path.join(root, "effects")):
        for name in sorted(names):
            if not name.endswith(".glsl"):
                continue
            stage = "vertex" if ".vert." in name else "geometry" if ".geom." in name else "fragment"
            with open(os.path.join(folder, name), encoding="ascii") as file:
                for plug, lists in COMMENT.findall(file.read()):
                    counts = {count_parameters(one) for one in argument_lists(lists)}
                    plugs.setdefault((plug, stage), set()).update(counts)
    return plugs


def plugs_of_docs(root):
    plugs, stage = {}, None
    with open(os.path.join(root, "docs", "plugs.md"), encoding="utf-8") as file:
        for line in file:
            if line.startswith("## "):
                found = re.search(r"(vertex|geometry|fragment) stage", line)
                stage = found.group(1) if found else None
            row = ROW.match(line)
            if not row:
                continue
            cells = [cell.strip() for cell in row.group(2).split("|")]
            where, parameters = (stage, cells[0]) if stage else (cells[0], cells[1])
            lists = re.findall(r"`([^`]*)`", parameters) or [""]
            plugs[row.group(1), where] = {count_parameters(one) for one in lists}
    return plugs


def main():
    effects, docs = plugs_of_effects(sys.argv[1]), plugs_of_docs(sys.argv[1])
    number = failures = 0
    for plug in sorted(set(effects) | set(docs)):
        number += 1
        fine = effects.get(plug) == docs.get(plug)
        failures += not fine
        print("%s %d - %s, %s stage" % ("ok" if fine else "not ok", number, *plug))
        if not fine:
            print("# effects: %s, docs: %s parameters" % (effects.get(plug), docs.get(plug)))
    number += 1
    enough = len(effects) >= 20
    print("%s %d - plugs are found at all" % ("ok" if enough else "not ok", number))
    print("1..%d" % number)
    sys.exit(1 if failures or not enough else 0)


main()

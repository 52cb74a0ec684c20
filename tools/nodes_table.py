"""The table of nodes, x3d/nodes.def, as Python sees it."""

import pathlib
import re

TOP = pathlib.Path(__file__).resolve().parent.parent
TABLE = TOP / "x3d" / "nodes.def"
TYPES = TOP / "include" / "plugray" / "x3d.h"

TEXT = r'"((?:[^"\\]|\\.)*)"'
FIELD = re.compile(
    rf"FIELD\((\w+), (\w+), (\w+), {TEXT}, (ANY|\w+\([^)]*\)), NODES\({TEXT}\), ([\w| ]+)\)")
NODE = re.compile(rf"NODE\((\w+), {TEXT}, {TEXT}, {TEXT}, ([\w| ]+)\)")
SHARED = re.compile(r"#define SHARED_(\w+) ((?:.*\\\n)*.*)")
ALIAS = re.compile(r"^ALIAS\((\w+), (\w+), ([\w| ]+)\)", re.M)
FIELD_ALIAS = re.compile(r"^FIELD_ALIAS\((\w+), (\w+), (\w+), ([\w| ]+)\)", re.M)
OTHER_DEFAULT = re.compile(
    rf"^DEFAULT_2005(?:_FROM)?\((\w+), (\w+), (?:{TEXT}|(\w+))\)", re.M)

TYPE_NAMES = dict(re.findall(r'PLR_TYPE\((\w+), "(\w+)"', TYPES.read_text(encoding="utf-8")))


class Field:
    def __init__(self, match):
        (self.name, kind, self.access, default, self.bounds, self.nodes, self.flags) = match.groups()
        self.type = TYPE_NAMES[kind]
        self.default = re.sub(r"\\(.)", r"\1", default)


class Node:
    def __init__(self, match, body):
        self.name, self.component, self.bases, self.container, self.flags = match.groups()
        self.shared = re.findall(r"^SHARED_(\w+)", body, re.M)
        self.fields = [Field(field) for field in FIELD.finditer(body)]


class Table:
    """`shared`: fields by abstract type; `nodes` in the order of the file; aliases and other defaults
    as tuples of what their rows say."""

    def __init__(self):
        text = TABLE.read_text(encoding="utf-8")
        self.shared = {name: [Field(field) for field in FIELD.finditer(body)]
                       for name, body in SHARED.findall(text)}
        self.nodes = [Node(node, text[node.end():text.index("END_NODE", node.end())])
                      for node in NODE.finditer(text)]
        self.aliases = ALIAS.findall(text)
        self.field_aliases = FIELD_ALIAS.findall(text)
        self.other_defaults = OTHER_DEFAULT.findall(text)

#!/usr/bin/env python3
"""The documents agree with the program's tables: documents.py SOURCE-ROOT PLUGRAY"""

import pathlib
import re
import shutil
import subprocess
import sys

from tap import check, check_equal, done, skip

root = pathlib.Path(sys.argv[1])
plugray = sys.argv[2]


def text_of(path):
    return (root / path).read_text(encoding="utf-8")


# ---- codes of diagnostics

codes = {code: severity.lower() for code, severity in
         re.findall(r'^PLR_CODE\(\w+, "([^"]+)", PLR_(\w+)', text_of("include/plugray/codes.def"), re.M)}
documented = dict(re.findall(r"^### (\S+) \((\w+)\)$", text_of("docs/diagnostics.md"), re.M))
check_equal(documented, codes, "docs/diagnostics.md has each code with its severity")
sections = re.split(r"^###? .*$", text_of("docs/diagnostics.md"), flags=re.M)
check(sum(len(section.split()) > 7 for section in sections) >= len(codes),
      "each code is explained by more than a word")

# ---- options

table = {}
listing = subprocess.run([plugray, "--list-options"], check=True, capture_output=True, encoding="utf-8")
for line in listing.stdout.splitlines():
    kind, command, *rest = line.split("\t")
    if kind == "command":
        table[command] = set()
    else:
        table[command].add((rest[0], rest[1]))
check(len(table) >= 6, "the program lists its commands")

page = text_of("docs/plugray.1")


def options_of(section):
    found = set()
    for line in re.findall(r"^\.It Fl (.*)$", section, re.M):
        words = [word for word in line.split() if word not in ("Ar", "Op")]
        value = words[1] if len(words) > 1 else ""
        found.add(("-" + words[0], f"[{value}]" if " Op " in f" {line} " else value))
    return found


sections = re.split(r"^\.S[sh] (.*)$", page, flags=re.M)
sections = dict(zip(sections[1::2], sections[2::2]))
shared = options_of(sections["Options for scenes"])
named = set(re.findall(r"\w+", " ".join(re.findall(r"^\.Cm (.*)$", sections["Options for scenes"], re.M))))
for command, options in table.items():
    own = [body for title, body in sections.items() if title.startswith(f"plugray {command} ")]
    found = options_of(own[0]) if own else set()
    if command in named:
        found |= shared
    check_equal(sorted(found), sorted(options), f"the manual page has the options of {command}")
    help_text = subprocess.run([plugray, command, "--help"], capture_output=True, encoding="utf-8")
    missing = [option for option, value in options
               if f"  {option}{' ' if value else ''}{value}" not in help_text.stdout]
    check(help_text.returncode == 0 and not missing, f"{command} --help has its options", missing)

if shutil.which("man"):
    checked = subprocess.run(["man", "--warnings", "-l", str(root / "docs/plugray.1")],
                             capture_output=True, encoding="utf-8", errors="replace",
                             env={"PATH": "/usr/bin:/bin", "LC_ALL": "C", "MANPAGER": "cat"})
    check(checked.returncode == 0 and not checked.stderr, "the manual page has no faults",
          checked.stderr)
else:
    skip("the manual page has no faults", "there is no man")

# ---- completions

generate = str(root / "tools/completions/generate")
scripts = {shell: subprocess.run([generate, shell, plugray], capture_output=True, encoding="utf-8").stdout
           for shell in ("bash", "zsh", "fish")}
for shell, script in scripts.items():
    missing = []
    for command, options in table.items():
        for option, _ in options:
            spelt = option if shell != "fish" else \
                (f"-l {option[2:]}" if option.startswith("--") else f"-s {option[1:]}")
            if spelt not in script or command not in script:
                missing.append(f"{command} {option}")
    check(not missing, f"the completion for {shell} has every option", missing)
    if shutil.which(shell):
        checked = subprocess.run([shell, "-n"], input=script, capture_output=True, encoding="utf-8")
        check(checked.returncode == 0, f"{shell} can read its completion", checked.stderr)
    else:
        skip(f"{shell} can read its completion", f"there is no {shell}")


def complete(*words):
    """What bash offers for the last word."""
    quoted = " ".join(f"'{word}'" for word in words)
    script = scripts["bash"] + f"\nCOMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _plugray; " \
                               'printf "%s\\n" "${COMPREPLY[@]}"'
    return subprocess.run(["bash", "-c", script], capture_output=True, encoding="utf-8").stdout.split()


check_equal(complete("plugray", "re"), ["render"], "bash completes commands")
check_equal(complete("plugray", "render", "--back"), ["--backend"], "bash completes options")
check_equal(complete("plugray", "render", "--backend", ""), ["auto", "egl", "osmesa"],
            "bash completes values")

# ---- links between documents

pages = [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").glob("*.md"))]
broken = [f"{page.relative_to(root)}: {target}" for page in pages
          for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8"))
          if not (page.parent / target).exists()]
check(not broken, "links between documents lead somewhere", *broken)
# ---- the gallery

gallery = subprocess.run([sys.executable, root / "tools" / "gallery", "--check"], capture_output=True, encoding="utf-8")
check(gallery.returncode == 0, "docs/gallery.md fits the scenes and their effects", gallery.stderr)
pictures = re.findall(r"!\[[^\]]*\]\(([^)]*)\)", text_of("docs/gallery.md"))
missing = [name for name in pictures if not (root / "docs" / name).exists()]
check(len(pictures) >= 9 and not missing, "every figure of the gallery has its picture", *missing)

done()

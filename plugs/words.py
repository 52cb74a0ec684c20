"""Turns words.def into a constant hash table, so that a word costs one probe and no set-up.

Usage: words.py words.def words_table.h"""
import sys


def hash_of(word):
    """FNV-1a of 32 bits: the hash of plugs/lexer.c."""
    value = 2166136261
    for byte in word.encode():
        value = (value ^ byte) * 16777619 & 0xFFFFFFFF
    return value


def read(path):
    rows = []
    for line in open(path, encoding="utf-8"):
        if line.strip() and not line.startswith("#"):
            fields = line.split()
            rows.append((fields[0], fields[1].split("|"), fields[2] if len(fields) > 2 else None))
    names = [row[0] for row in rows]
    assert len(set(names)) == len(names), "a word stands twice"
    return rows


def main(source, target):
    rows = read(source)
    size = 1
    while size < 4 * len(rows):
        size *= 2
    slots = [0] * size
    for number, (word, _, _) in enumerate(rows, 1):
        slot = hash_of(word) % size
        while slots[slot]:
            slot = (slot + 1) % size
        slots[slot] = number
    out = ["/* generated from words.def */", "#ifndef PLR_WORDS_TABLE", "enum {", "    PLR_WORD_NONE,"]
    out += [f"    PLR_WORD_{word}," for word, _, _ in rows]
    out += ["    PLR_WORD_COUNT", "};", "#else",
            "static const plr_word words[] = {", "    {NULL, 0, 0, NULL},"]
    for word, kinds, replacement in rows:
        flags = " | ".join(f"PLR_WORD_IS_{kind.upper()}" for kind in kinds)
        text = f'"{replacement}"' if replacement else "NULL"
        out.append(f'    {{"{word}", {len(word)}, {flags}, {text}}},')
    out += ["};", f"static const unsigned short word_slots[{size}] = {{"]
    for start in range(0, size, 16):
        out.append("    " + ", ".join(str(n) for n in slots[start:start + 16]) + ",")
    out += ["};", "#endif", ""]
    with open(target, "w", encoding="utf-8") as file:
        file.write("\n".join(out))


if __name__ == "__main__":
    main(*sys.argv[1:3])

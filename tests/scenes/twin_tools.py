"""What the tests of twins do with programs: count what they do, take something away from them."""

import re
import struct
import subprocess

# Opcodes of the SPIR-V specification, 3.42, that stand in functions and do no work: OpNop, OpLine,
# OpFunction, OpFunctionParameter, OpFunctionEnd, OpVariable, OpLoopMerge, OpSelectionMerge, OpLabel, OpNoLine.
IDLE = {0, 8, 54, 55, 56, 59, 246, 247, 248, 317}
# OpImageSample* .. OpImageDrefGather
FETCHES = range(87, 98)
FUNCTION, FUNCTION_END = 54, 56


def count_words(data):
    """Instructions and texture fetches in the functions of a module."""
    words = struct.unpack(f"<{len(data) // 4}I", data)
    at, inside, instructions, fetches = 5, False, 0, 0
    while at < len(words):
        size, opcode = words[at] >> 16, words[at] & 0xFFFF
        inside = inside or opcode == FUNCTION
        instructions += inside and opcode not in IDLE
        fetches += inside and opcode in FETCHES
        inside = inside and opcode != FUNCTION_END
        at += size
    return instructions, fetches


def count(path, stage, folder):
    """The same of a file of GLSL after spirv-opt -O; None if it does not compile."""
    run = lambda *words: subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        check=False).returncode == 0
    if not (run("glslangValidator", "-G", "--aml", "--amb", "-S", stage, path, "-o", "plain.spv")
            and run("spirv-opt", "-O", "plain.spv", "-o", "fast.spv")):
        return None
    with open(f"{folder}/fast.spv", "rb") as file:
        return count_words(file.read())


# ---- taking away

TOKEN = re.compile(r"//[^\n]*|/\*.*?\*/|[A-Za-z_]\w*|[0-9][\w.]*(?:[eE][+-]?[0-9]+)?|"
                   r"<<=|>>=|\+\+|--|&&|\|\||[-+*/=<>!&|^]=|<<|>>|\S", re.S)


class Token:
    def __init__(self, match):
        self.text, self.start, self.end = match.group(), match.start(), match.end()


def tokens_of(text):
    return [Token(m) for m in TOKEN.finditer(text) if not m.group().startswith(("//", "/*"))]


def partners(tokens):
    """The index of the bracket that closes the one at an index."""
    stack, found = [], {}
    for i, token in enumerate(tokens):
        if token.text in ("(", "{", "["):
            stack.append(i)
        elif token.text in (")", "}", "]"):
            found[stack.pop()] = i
    return found


def statement_end(tokens, pairs, i):
    """The index behind the statement that begins at i."""
    word = tokens[i].text
    if word == "{":
        return pairs[i] + 1
    if word in ("if", "for", "while"):
        end = statement_end(tokens, pairs, pairs[i + 1] + 1)
        if word == "if" and end < len(tokens) and tokens[end].text == "else":
            end = statement_end(tokens, pairs, end + 1)
        return end
    while tokens[i].text != ";":
        i = pairs[i] + 1 if i in pairs else i + 1
    return i + 1


def cut(text, tokens, first, last, instead=""):
    """The text without tokens first..last (the latter excluded)."""
    return text[:tokens[first].start] + instead + text[tokens[last - 1].end:]


def statements(text):
    """Yields (what, text without it) for every statement of main(), nested ones too; of an `if`, a loop
    also without its condition; of a declaration also without its value."""
    tokens = tokens_of(text)
    pairs = partners(tokens)
    main = next(i for i in range(len(tokens)) if tokens[i].text == "main")
    opening = next(i for i in range(main, len(tokens)) if tokens[i].text == "{")
    pending = [(opening + 1, pairs[opening])]
    while pending:
        i, end = pending.pop()
        while i < end:
            behind = statement_end(tokens, pairs, i)
            yield " ".join(text[tokens[i].start:tokens[behind - 1].end].split()), cut(text, tokens, i, behind, ";")
            word = tokens[i].text
            if word == "{":
                pending.append((i + 1, behind - 1))
            elif word in ("if", "for", "while"):
                body = pairs[i + 1] + 1
                if word == "if":
                    done = statement_end(tokens, pairs, body)
                    yield (f"if {text[tokens[i + 1].start:tokens[body - 1].end]}",
                           cut(text, tokens, i, body) if done == behind else
                           text[:tokens[i].start] + text[tokens[body].start:tokens[done - 1].end]
                           + text[tokens[behind - 1].end:])
                    if done < behind:
                        pending.append((done + 1, behind))
                pending.append((body, statement_end(tokens, pairs, body)))
            i = behind


ENDS = {")", "]"}
# no functions, or conversions that may be left out of the text
NOT_TAKEN = {"if", "for", "while", "float", "uint", "vec2", "vec3"}
OPERATORS = {"*", "/", "+", "-", "&", "|", "&&", "||", "<<", ">>"}


def operand_end(tokens, pairs, i):
    """The index behind the operand that begins at i: signs, a name or bracket, calls, members."""
    while tokens[i].text in ("-", "!", "~", "+"):
        i += 1
    i = pairs[i] + 1 if i in pairs else i + 1
    while i < len(tokens) and tokens[i].text in ("(", "[", "."):
        i = pairs[i] + 1 if i in pairs else i + 2
    return i


def expressions(text):
    """Yields (what, text without it): the operand on the right of each operator, the sign before each
    operand, and the function around each first argument."""
    tokens = tokens_of(text)
    pairs = partners(tokens)
    main = next(i for i in range(len(tokens)) if tokens[i].text == "main")
    opening = next(i for i in range(main, len(tokens)) if tokens[i].text == "{")
    for i in range(opening + 1, pairs[opening]):
        token, before = tokens[i], tokens[i - 1]
        binary = before.text in ENDS or re.match(r"[\w]", before.text)
        if token.text in OPERATORS and binary and before.text != "return":
            end = operand_end(tokens, pairs, i + 1)
            if token.text in ("+", "-"):  # a whole term
                while tokens[end].text in ("*", "/"):
                    end = operand_end(tokens, pairs, end + 1)
            yield " ".join(text[token.start:tokens[end - 1].end].split()), cut(text, tokens, i, end)
        elif token.text in ("-", "!") and not binary:
            yield f"sign before {tokens[i + 1].text}", cut(text, tokens, i, i + 1)
        elif token.text == "(" and re.match(r"[A-Za-z_]", before.text) and before.text not in NOT_TAKEN:
            end = i + 1
            while end < pairs[i] and tokens[end].text != ",":
                end = pairs[end] + 1 if end in pairs else end + 1
            inside = text[tokens[i].end:tokens[end - 1].end]
            yield (f"function {before.text}({' '.join(inside.split())} ...)",
                   text[:before.start] + f"({inside})" + text[tokens[pairs[i]].end:])

"""Writes DICOM files: what the tests need of PS3.5 and PS3.10, made by hand.

A data set is a dictionary from tags (0xGGGGEEEE) to values; the VR of each tag stands in VRS. A
value is a string, a number, a list of these, bytes, or, for SQ, a list of data sets.
"""

import struct
import zlib

IMPLICIT = "1.2.840.10008.1.2"
LITTLE = "1.2.840.10008.1.2.1"
BIG = "1.2.840.10008.1.2.2"
DEFLATED = "1.2.840.10008.1.2.1.99"
RLE = "1.2.840.10008.1.2.5"
JPEG = "1.2.840.10008.1.2.4.50"
JPEG_LOSSLESS = "1.2.840.10008.1.2.4.70"
JPEG_2000 = "1.2.840.10008.1.2.4.90"

CT = "1.2.840.10008.5.1.4.1.1.2"

VRS = {
    0x00020002: "UI", 0x00020003: "UI", 0x00020010: "UI",
    0x00080016: "UI", 0x00080018: "UI", 0x00080060: "CS",
    0x00180050: "DS", 0x00180088: "DS",
    0x0020000D: "UI", 0x0020000E: "UI", 0x00200013: "IS", 0x00200032: "DS", 0x00200037: "DS",
    0x00209113: "SQ", 0x00209116: "SQ",
    0x00280002: "US", 0x00280004: "CS", 0x00280006: "US", 0x00280008: "IS", 0x00280010: "US",
    0x00280011: "US", 0x00280030: "DS", 0x00280100: "US", 0x00280101: "US", 0x00280102: "US",
    0x00280103: "US", 0x00280120: "US", 0x00280121: "US", 0x00281050: "DS", 0x00281051: "DS",
    0x00281052: "DS", 0x00281053: "DS", 0x00281056: "CS", 0x00283000: "SQ",
    0x00289110: "SQ", 0x00289132: "SQ", 0x00289145: "SQ",
    0x3004000C: "DS",
    0x52009229: "SQ", 0x52009230: "SQ",
    0x7FE00008: "OF", 0x7FE00009: "OD", 0x7FE00010: "OW",
}
LONG = ("OB", "OW", "OF", "OD", "SQ", "UN", "UT")
UNDEFINED = 0xFFFFFFFF


def number(value):
    """At most 16 characters, as DS wants."""
    if isinstance(value, int):
        return str(value)
    for digits in range(16, 0, -1):
        text = f"{value:.{digits}g}"
        if len(text) <= 16:
            return text
    raise ValueError(value)


def encode_value(vr, value, order, explicit):
    if isinstance(value, bytes):
        return value
    if vr == "SQ":
        return b"".join(
            struct.pack(order + "HHI", 0xFFFE, 0xE000, len(item)) + item
            for item in (encode(one, order, explicit) for one in value))
    values = value if isinstance(value, (list, tuple)) else [value]
    codes = {"US": "H", "SS": "h", "OW": "H", "OF": "f", "OD": "d"}
    if vr in codes:
        return struct.pack(f"{order}{len(values)}{codes[vr]}", *values)
    text = "\\".join(one if isinstance(one, str) else number(one) for one in values).encode()
    return text + (b"\0" if vr == "UI" else b" ") * (len(text) % 2)


def element(tag, value, order="<", explicit=True, vr=None, length=None):
    vr = vr or VRS[tag]
    data = encode_value(vr, value, order, explicit)
    length = len(data) if length is None else length
    head = struct.pack(order + "HH", tag >> 16, tag & 0xFFFF)
    if not explicit:
        return head + struct.pack(order + "I", length) + data
    if vr in LONG:
        return head + vr.encode() + struct.pack(order + "HI", 0, length) + data
    return head + vr.encode() + struct.pack(order + "H", length) + data


def encode(data_set, order="<", explicit=True):
    return b"".join(element(tag, data_set[tag], order, explicit) for tag in sorted(data_set))


def dicom(data_set, syntax=LITTLE, tail=b""):
    """A whole file; `tail` is appended to the data set as it is."""
    meta = encode({0x00020002: CT, 0x00020003: data_set.get(0x00080018, "1.2.3"),
                   0x00020010: syntax})
    length = struct.pack("<HH2sHI", 2, 0, b"UL", 4, len(meta))
    body = encode(data_set, ">" if syntax == BIG else "<", syntax != IMPLICIT) + tail
    if syntax == DEFLATED:
        packer = zlib.compressobj(9, zlib.DEFLATED, -15)
        body = packer.compress(body) + packer.flush()
        body += b"\0" * (len(body) % 2)
    return b"\0" * 128 + b"DICM" + length + meta + body


def fragments(frames):
    """Encapsulated pixel data: one fragment a frame, without an offset table."""
    items = b"".join(
        struct.pack("<HHI", 0xFFFE, 0xE000, len(f) + len(f) % 2) + f + b"\0" * (len(f) % 2)
        for f in [b"", *frames])
    return (struct.pack("<HH2sHI", 0x7FE0, 0x0010, b"OB", 0, UNDEFINED) + items
            + struct.pack("<HHI", 0xFFFE, 0xE0DD, 0))


def rle_bytes(data):
    """PackBits, one segment."""
    out, i = b"", 0
    while i < len(data):
        run = 1
        while i + run < len(data) and run < 128 and data[i + run] == data[i]:
            run += 1
        if run > 1:
            out += bytes([257 - run, data[i]])
            i += run
        else:
            start = i
            while i < len(data) and i - start < 128 and data[i:i + 1] != data[i + 1:i + 2]:
                i += 1
            out += bytes([i - start - 1]) + data[start:i]
    return out + b"\0" * (len(out) % 2)


def rle_frame(planes):
    """PS3.5 annex G: planes of bytes, the most significant first."""
    segments = [rle_bytes(plane) for plane in planes]
    offsets, at = [], 64
    for segment in segments:
        offsets.append(at)
        at += len(segment)
    return struct.pack("<16I", len(segments), *(offsets + [0] * (15 - len(offsets)))) + b"".join(
        segments)


def jpeg_lossless(columns, rows, values, bits, components=1):
    """ITU-T T.81, process 14, first-order prediction: every difference as five bits of category,
    then its own bits; the components of a pixel one after the other."""
    out, pending, count = bytearray(), 0, 0
    step, line = components, columns * components

    def put(value, size):
        nonlocal pending, count
        pending, count = pending << size | value, count + size
        while count >= 8:
            count -= 8
            byte = pending >> count & 0xFF
            out.extend((byte, 0) if byte == 0xFF else (byte,))
        pending &= (1 << count) - 1

    for at, value in enumerate(values):
        before = (values[at - step] if at % line >= step
                  else values[at - line] if at >= line else 1 << bits - 1)
        difference = (value - before + 32768) % 65536 - 32768
        size = abs(difference).bit_length()
        put(size, 5)
        if size < 16:
            put(difference + (difference < 0) * ((1 << size) - 1), size)
    put((1 << -count % 8) - 1, -count % 8)
    each = range(1, components + 1)
    frame = struct.pack(">BHHB", bits, rows, columns, components)
    parts = ((0xC3, frame + b"".join(bytes([c, 0x11, 0]) for c in each)),
             (0xC4, bytes([0] + [0] * 4 + [17] + [0] * 11) + bytes(range(17))),
             (0xDA, bytes([components]) + b"".join(bytes([c, 0]) for c in each) + b"\1\0\0"))
    head = b"".join(bytes([0xFF, mark]) + struct.pack(">H", len(data) + 2) + data
                    for mark, data in parts)
    return b"\xff\xd8" + head + bytes(out) + b"\xff\xd9"


def image(columns, rows, values, position=(0, 0, 0), orientation=(1, 0, 0, 0, 1, 0),
          spacing=(1, 1), series="1.2.3.4", number_of=1, bits=16, signed=False, big=False, **more):
    """A monochrome slice with the fields that a CT has; `more` are further tags ("x00281052").
    A tag whose value is None is left out."""
    stored = more.pop("stored", bits)
    if isinstance(values, bytes):
        pixels = values
    else:
        code = {8: "B", 16: "H", 32: "I"}[bits]
        mask = (1 << bits) - 1
        pixels = struct.pack(f"<{len(values)}{code}", *(v & mask for v in values))
        pixels += b"\0" * (len(pixels) % 2)
        if big:  # words of 16 bits, whatever is in them (PS3.5, annex D)
            pixels = b"".join(pixels[i:i + 2][::-1] for i in range(0, len(pixels), 2))
    result = {
        0x00080016: CT, 0x00080018: f"{series}.{number_of}", 0x00080060: "CT",
        0x0020000D: "1.2.3", 0x0020000E: series, 0x00200013: number_of,
        0x00200032: list(position), 0x00200037: list(orientation),
        0x00280002: 1, 0x00280004: "MONOCHROME2", 0x00280010: rows, 0x00280011: columns,
        0x00280030: [spacing[1], spacing[0]], 0x00280100: bits, 0x00280101: stored,
        0x00280102: stored - 1, 0x00280103: int(signed), 0x7FE00010: pixels,
    }
    for name, value in more.items():
        result[int(name[1:], 16)] = value
    return {tag: value for tag, value in result.items() if value is not None}

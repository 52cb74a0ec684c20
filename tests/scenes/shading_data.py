"""A volume whose gradient is known exactly."""

import struct


def ramp(slope, size=8):
    """A float NRRD of a linear function of the texture coordinates, 1/2 in the middle."""

    def value(*index):
        return 0.5 + sum(a * ((i + 0.5) / size - 0.5) for a, i in zip(slope, index))

    values = [value(i, j, k) for k in range(size) for j in range(size) for i in range(size)]
    head = (
        f"NRRD0004\ntype: float\ndimension: 3\nsizes: {size} {size} {size}\n"
        "encoding: raw\nendian: little\n\n"
    )
    return head.encode() + struct.pack(f"<{len(values)}f", *values)

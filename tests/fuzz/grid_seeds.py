"""Seeds of the target 'grid': samples of a solid, .vol."""

import math
import struct

from seed_files import write


def grid(n=(4, 3, 5), box=(-1, -1, -1, 1, 1, 1), version=3, encoding=1, channels=1, values=None, claimed=None):
    if values is None:
        at = lambda i, c: box[c] + (box[c + 3] - box[c]) * i / max(n[c] - 1, 1)
        values = [math.dist((at(x, 0), at(y, 1), at(z, 2)), (0, 0, 0)) - 0.7
                  for z in range(n[2]) for y in range(n[1]) for x in range(n[0])]
    head = struct.pack("<3sB5i6f", b"VOL", version, encoding, *(claimed or n), channels, *box)
    return head + struct.pack(f"<{len(values)}f", *values)


def grids():
    write("grid", "read-sphere.vol", grid())
    write("grid", "read-two.vol", grid((2, 2, 2), values=[-1, 1, 1, 1, 1, 1, 1, 1]))
    write("grid", "read-zeros.vol", grid((3, 3, 3), values=[0.0] * 27))
    write("grid", "read-steep.vol", grid((3, 2, 2), values=[1e14, -1e14, 0] * 4))
    write("grid", "nan.vol", grid((2, 2, 2), values=[math.nan] * 8))
    write("grid", "infinite.vol", grid((2, 2, 2), values=[-math.inf] * 8))
    write("grid", "cut.vol", grid()[:-3])
    write("grid", "head.vol", grid()[:40])
    write("grid", "version.vol", grid(version=2))
    write("grid", "encoding.vol", grid(encoding=3))
    write("grid", "channels.vol", grid(channels=3))
    write("grid", "many.vol", grid(claimed=(2**31 - 1, 2**31 - 1, 2**31 - 1)))
    write("grid", "negative.vol", grid(claimed=(-4, 3, 5)))
    write("grid", "one.vol", grid((1, 3, 5)))
    write("grid", "flat.vol", grid(box=(-1, -1, 0, 1, 1, 0)))
    write("grid", "far.vol", grid(box=(1e9, -1, -1, 2e9, 1, 1)))

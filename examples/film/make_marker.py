#!/usr/bin/python3
"""Draws marker.png, a template for froude track --template: what film.toml's lens shows of a disc of 18 mm on a black sticker
at 3 mm a pixel, with its blur of 0.7 px. In practice it is a piece cut out of a frame.

    make_marker.py FILE
"""
import math
import struct
import sys
import zlib

SIDE, RADIUS, BLUR, DISC, STICKER = 25, 6.0, 0.7, 210, 20  # px and grey levels


def level(x, y):
    inside = RADIUS - math.hypot(x - SIDE // 2, y - SIDE // 2)
    return round(STICKER + (DISC - STICKER) * 0.5 * math.erfc(-inside / (math.sqrt(2) * BLUR)))


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


rows = b"".join(b"\0" + bytes(level(x, y) for x in range(SIDE)) for y in range(SIDE))
with open(sys.argv[1], "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIDE, SIDE, 8, 0, 0, 0, 0))
               + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))

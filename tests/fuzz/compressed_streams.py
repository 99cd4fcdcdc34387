"""Streams of compressed geometry for make_seeds.py, made by rule or by the libraries' encoders."""

import base64
import struct

CORNERS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def varint(number):
    data = b""
    while number > 127:
        data += bytes([number & 127 | 128])
        number >>= 7
    return data + bytes([number])


def zigzag(number, bits):
    return (number << 1 ^ number >> bits - 1) & (1 << bits) - 1


def meshopt_attributes(elements):
    """Version 0 of meshoptimizer's vertex codec: the bytes of each column, as differences in groups of
    16, none of them packed (mode 3); elements are of equal length, up to 16 of them. At the end is the
    element that the first one differs from."""
    stride = len(elements[0])
    base = elements[0]
    data = b"\xa0"
    for k in range(stride):
        before, deltas = base[k], b""
        for element in elements:
            difference = (element[k] - before + 128) % 256 - 128
            deltas += bytes([zigzag(difference, 8)])
            before = element[k]
        data += b"\x03" + deltas.ljust(16, b"\0")
    return data + bytes(max(0, 32 - stride)) + base


def meshopt_indices(indices):
    """The codec of index sequences, version 1: differences from the first of two baselines."""
    data, before = b"\xd1", 0
    for index in indices:
        data += varint(zigzag(index - before, 32) << 1)
        before = index
    return data + bytes(4)


def draco_triangle(**more):
    """Draco's sequential mesh of CORNERS: indices and values as they are, one attribute."""
    claims = {"triangles": 1, "points": 3, "kind": 1, "version": b"\x02\x02"} | more
    return (b"DRACO" + claims["version"] + bytes([claims["kind"], 0]) + b"\0\0"
            + varint(claims["triangles"]) + varint(claims["points"]) + b"\1" + bytes([0, 1, 2])
            + b"\1" + b"\1" + bytes([0, 9, 3, 0]) + b"\0" + b"\0" + CORNERS)


# A grid of 4 x 4 squares with positions, normals and colours, by Draco's own encoder (edgebreaker).
DRACO_GRID = base64.b64decode(
    "RFJBQ08CAgEBAAAAGSACIAMACu/T6lOt6lPVqhr/ARH/AsxC/wLMQgP/AAAAAAABAAABAAkDAAACAQEJAwABAwECBAQBAgEB"
    "AQEADwMVLj0KJyEFkQIGqKZ06v+h////DwD8f/8PAABA/wcAQIAIAABEAAQEAgAAAAD/PwAAAAAAAAAAAAAAAAAAAACAPw4A"
    "AwEBAYAEuT7/////////90kBAyLfnv8DAAD/AQAACgEBAQARAzEzIQUvkQIhBQbkTf5ff4D+//7/AAABAP9/AIAAAAAAAID/"
    "PwAAAAAAAgAAAAACAAAAAAAAAAAA//8AAA==")
# The same triangles by meshoptimizer's encoder of index buffers.
MESHOPT_GRID = base64.b64decode(
    "4f4eEA4QDhAOzh4WDhUOFA7OHhQOFA4UDs4eFA4UDhQODwoAdodWZ3iphmWJaJgBaQAA")

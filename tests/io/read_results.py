"""Opens result files with Python's own parsers (xml, csv, json, struct, zlib, ast): nothing of libdsc.

    read_results.py FOLDER

FOLDER holds one surface as s.ply, s.vtp, s.csv, s.off, s.obj, s.stl, the voxels as v.vol, v.longvol
and v.npy, and truth.json with what has to be in them; numbers in it are hexadecimal floats.
Exits with 1 and a line a mistake.
"""
import ast
import base64
import csv
import json
import os
import struct
import sys
import xml.etree.ElementTree
import zlib

folder = sys.argv[1]
mistakes = []


def path(name):
    return os.path.join(folder, name)


def read(name):
    with open(path(name), "rb") as file:
        return file.read()


def expect(holds, what):
    if not holds:
        mistakes.append(what)


with open(path("truth.json"), encoding="utf-8") as file:
    truth = json.load(file)
POINTS = [float.fromhex(x) for x in truth["positions"]]
FACES = truth["faces"]
SCALAR = [float.fromhex(x) for x in truth["scalar"]]
VECTOR = [float.fromhex(x) for x in truth["vector"]]
VOXELS = bytes(truth["voxels"])
SIZE = truth["size"]


def same(a, b):
    """To the last bit: -0.0 and 0.0 differ."""
    return struct.pack("<%dd" % len(a), *a) == struct.pack("<%dd" % len(b), *b)


def check_ply():
    head, body = read("s.ply").split(b"end_header\n", 1)
    lines = head.decode("ascii").split("\n")
    expect(lines[0] == "ply" and lines[1].startswith("format binary_little_endian 1.0"), "ply: its head")
    codes = {"double": "d", "float": "f", "int": "i", "int32": "i", "uint": "I", "uchar": "B", "uint8": "B"}
    elements = []
    for words in (line.split() for line in lines):
        if words[:1] == ["element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            elements[-1][2].append(words[1:])
    columns, offset = {}, 0
    for element, count, properties in elements:
        for _ in range(count):
            for words in properties:
                if words[0] == "list":
                    (n,) = struct.unpack_from("<" + codes[words[1]], body, offset)
                    offset += struct.calcsize(codes[words[1]])
                    code = "<%d%s" % (n, codes[words[2]])
                    value = list(struct.unpack_from(code, body, offset))
                else:
                    code = "<" + codes[words[0]]
                    (value,) = struct.unpack_from(code, body, offset)
                offset += struct.calcsize(code)
                columns.setdefault((element, words[-1]), []).append(value)
    expect(offset == len(body), "ply: %d bytes of %d" % (offset, len(body)))
    points = [x for p in zip(*(columns["vertex", c] for c in "xyz")) for x in p]
    expect(same(points, POINTS), "ply: its points")
    faces = [v for (e, name), v in columns.items() if e == "face" and name.startswith("vertex_ind")]
    expect(faces == [FACES], "ply: its faces")
    expect(same(columns["vertex", "heat"], SCALAR), "ply: its scalars")
    vector = [x for p in zip(*(columns["face", c] for c in ("gx", "gy", "gz"))) for x in p]
    expect(same(vector, VECTOR), "ply: its vectors")


def check_vtp():
    root = xml.etree.ElementTree.fromstring(read("s.vtp"))
    expect(root.attrib["byte_order"] == "LittleEndian", "vtp: its byte order")
    size = {"UInt32": "I", "UInt64": "Q"}[root.attrib["header_type"]]
    appended = root.find("AppendedData")
    expect(appended.attrib["encoding"] == "base64", "vtp: its encoding")
    text = appended.text.strip()
    expect(text[0] == "_", "vtp: the underscore before its data")
    piece = root.find("PolyData/Piece")
    codes = {"Float64": "d", "Int32": "i", "Int64": "q", "UInt8": "B", "Float32": "f"}

    def values(section, name):
        for array in piece.find(section):
            if name is None or array.attrib.get("Name") == name:
                # One stream of base64: the number of bytes, then the bytes.
                at = 1 + int(array.attrib["offset"])
                head = struct.calcsize(size)
                digits = -(-head // 3) * 4
                (count,) = struct.unpack("<" + size, base64.b64decode(text[at:at + digits])[:head])
                digits = -(-(head + count) // 3) * 4
                data = base64.b64decode(text[at:at + digits], validate=True)[head:]
                code = codes[array.attrib["type"]]
                return list(struct.unpack("<%d%s" % (count // struct.calcsize(code), code), data))
        return []

    expect(same(values("Points", None), POINTS), "vtp: its points")
    corners, ends = values("Polys", "connectivity"), values("Polys", "offsets")
    faces = [corners[a:b] for a, b in zip([0] + ends, ends)]
    expect(faces == FACES, "vtp: its faces")
    expect(same(values("PointData", "heat"), SCALAR), "vtp: its scalars")
    expect(same(values("CellData", "gradient"), VECTOR), "vtp: its vectors")


def check_csv():
    with open(path("s.csv"), newline="", encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    expect(same([float(row[c]) for row in rows for c in "xyz"], POINTS), "csv: its points")
    expect(same([float(row["heat"]) for row in rows], SCALAR), "csv: its scalars")


def check_off():
    words = read("s.off").decode("ascii").split()
    counts = [int(w) for w in words[1:4]]
    expect(words[0] == "OFF" and counts[:2] == [len(POINTS) // 3, len(FACES)], "off: its head")
    at = 4 + len(POINTS)
    expect(same([float(w) for w in words[4:at]], POINTS), "off: its points")
    faces = []
    while at < len(words):
        n = int(words[at])
        faces.append([int(w) for w in words[at + 1:at + 1 + n]])
        at += 1 + n
    expect(faces == FACES, "off: its faces")


def check_obj():
    points, faces = [], []
    for line in read("s.obj").decode("ascii").split("\n"):
        words = line.split()
        if words[:1] == ["v"]:
            points += [float(w) for w in words[1:]]
        elif words[:1] == ["f"]:
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    expect(same(points, POINTS), "obj: its points")
    expect(faces == FACES, "obj: its faces")


def check_stl():
    raw = read("s.stl")
    (count,) = struct.unpack_from("<I", raw, 80)
    expect(count == sum(len(face) - 2 for face in FACES), "stl: its number of triangles")
    expect(len(raw) == 84 + 50 * count, "stl: its length")
    known = {struct.pack("<3f", *POINTS[i:i + 3]) for i in range(0, len(POINTS), 3)}
    for t in range(count):
        at = 84 + 50 * t + 12
        expect(all(raw[at + 12 * k:at + 12 * k + 12] in known for k in range(3)), "stl: triangle %d" % t)


def check_volumes():
    for name, width in (("v.vol", 1), ("v.longvol", 8)):
        head, body = read(name).split(b"\n.\n", 1)
        keys = dict(line.split(": ", 1) for line in head.decode("ascii").split("\n"))
        expect([int(keys[k]) for k in "XYZ"] == SIZE, name + ": its size")
        if keys["Version"] == "3":
            body = zlib.decompress(body)
        code = {1: "B", 8: "Q"}[width]
        expect(bytes(struct.unpack("<%d%s" % (len(body) // width, code), body)) == VOXELS, name + ": its voxels")
    raw = read("v.npy")
    expect(raw[:6] == b"\x93NUMPY", "npy: its magic")
    (length,) = struct.unpack_from("<H", raw, 8)
    header = ast.literal_eval(raw[10:10 + length].decode("latin1"))
    expect(header["shape"] == tuple(reversed(SIZE)) and not header["fortran_order"], "npy: its shape")
    expect(header["descr"] in ("|u1", "|b1") and raw[10 + length:] == VOXELS, "npy: its voxels")


for check in (check_ply, check_vtp, check_csv, check_off, check_obj, check_stl, check_volumes):
    try:
        check()
    except (KeyError, ValueError, IndexError, TypeError, AttributeError, struct.error, zlib.error) as error:
        mistakes.append("%s: %r" % (check.__name__.replace("volumes", "vol, longvol, npy"), error))
for mistake in mistakes:
    print(mistake)
sys.exit(1 if mistakes else 0)

"""Opens result files with Python's own parsers (xml, csv, json, struct, zlib, ast): nothing of libdsc.

    read_results.py FOLDER FORM...

FOLDER holds what is to be checked: one surface as s.ply, s.vtp, s.csv, s.off, s.obj, s.stl, s.glb,
s.html, the voxels as v.vol, v.longvol, v.npy (these three are the form `volumes`) and v.vti, other
values as w.vti, a picture as s.png; and truth.json with what has to be in them; its floats are
hexadecimal. Exits with 1 and a line a mistake.
"""
import ast
import base64
import csv
import html.parser
import json
import math
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


def floats_of(name):
    return [float.fromhex(x) for x in truth.get(name, [])]


POINTS = floats_of("positions")
FACES = truth.get("faces")
SCALAR = floats_of("scalar")
VECTOR = floats_of("vector")
VOXELS = bytes(truth.get("voxels", []))
SIZE = truth.get("size")


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


def check_vti():
    for name, kind, values in (("v.vti", "UInt8", list(VOXELS)), ("w.vti", "Float64", floats_of("doubles"))):
        # XML up to the bytes that are appended to it.
        head, rest = read(name).split(b'<AppendedData encoding="raw">', 1)
        root = xml.etree.ElementTree.fromstring(head + b"</VTKFile>")
        before, data = rest.split(b"_", 1)
        expect(before.strip() == b"" and data.endswith(b"\n</AppendedData>\n</VTKFile>\n"), name + ": around its data")
        data = data[:-len(b"\n</AppendedData>\n</VTKFile>\n")]
        attributes = root.attrib
        expect(attributes["type"] == "ImageData" and attributes["byte_order"] == "LittleEndian" and
               attributes["header_type"] == "UInt64", name + ": its head")
        image, piece = root.find("ImageData"), root.find("ImageData/Piece")
        extent = [str(n) for size in SIZE for n in (0, size - 1)]
        expect(image.attrib["WholeExtent"].split() == extent and piece.attrib["Extent"].split() == extent,
               name + ": its extent")
        for key, what in (("Origin", "origin"), ("Spacing", "spacing"), ("Direction", "direction")):
            expect(same([float(x) for x in image.attrib[key].split()], floats_of(what)), name + ": its " + what)
        (array,) = piece.find("PointData")
        expect(piece.find("PointData").attrib["Scalars"] == array.attrib["Name"], name + ": its scalars")
        expect((array.attrib["type"], array.attrib["format"], array.attrib["offset"]) == (kind, "appended", "0"),
               name + ": its array")
        if "compressor" in attributes:
            expect(attributes["compressor"] == "vtkZLibDataCompressor", name + ": its compressor")
            blocks, full, last = struct.unpack_from("<3Q", data)
            sizes = struct.unpack_from("<%dQ" % blocks, data, 24)
            at, raw = 24 + 8 * blocks, b""
            for i, size in enumerate(sizes):
                block = zlib.decompress(data[at:at + size])
                expect(len(block) == (last if last and i == blocks - 1 else full), "%s: block %d" % (name, i))
                raw, at = raw + block, at + size
        else:
            (count,) = struct.unpack_from("<Q", data)
            raw, at = data[8:8 + count], 8 + count
        expect(at == len(data), name + ": its length")
        code = {"UInt8": "B", "Float64": "d"}[kind]
        expect(raw == struct.pack("<%d%s" % (len(values), code), *values), name + ": its values")


def as_float(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def vectors(numbers):
    return list(zip(*[iter(numbers)] * 3))


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def face_normal(face):
    """Of a fan about the face's first corner, by area."""
    points = vectors(POINTS)
    total = [0.0] * 3
    origin = points[face[0]]
    for a, b in zip(face[1:], face[2:]):
        p, q = ([x - o for x, o in zip(points[v], origin)] for v in (a, b))
        for k in range(3):
            total[k] += p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3]
    return unit(total)


def edges(polygons):
    """Directed edges of the boundary of the polygons together."""
    found = set()
    for polygon in polygons:
        for a, b in zip(polygon, polygon[1:] + polygon[:1]):
            if (b, a) in found:
                found.remove((b, a))
            else:
                found.add((a, b))
    return found


def check_glb():
    raw = read("s.glb")
    magic, version, length, text = struct.unpack_from("<4s3I", raw)
    expect((magic, version, length, raw[16:20]) == (b"glTF", 2, len(raw), b"JSON"), "glb: its head")
    scene = json.loads(raw[20:20 + text].decode("utf-8"))
    size, kind = struct.unpack_from("<I4s", raw, 20 + text)
    binary = raw[28 + text:]
    expect(kind == b"BIN\0" and size == len(binary) == scene["buffers"][0]["byteLength"], "glb: its chunks")
    (node,) = scene["nodes"]
    (primitive,) = scene["meshes"][node["mesh"]]["primitives"]
    used = []

    def values(accessor, code, count):
        accessor = scene["accessors"][accessor]
        expect({5126: "f", 5125: "I", 5123: "H"}[accessor["componentType"]] == code, "glb: the type of its numbers")
        expect({"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]] == count, "glb: the shape of its arrays")
        view = scene["bufferViews"][accessor["bufferView"]]
        form = "<%d%s" % (accessor["count"] * count, code)
        expect(view["byteLength"] == struct.calcsize(form), "glb: the length of an array")
        used.append((view["byteOffset"], view["byteOffset"] + view["byteLength"]))
        numbers = list(struct.unpack_from(form, binary, view["byteOffset"]))
        for name, extreme in (("min", min), ("max", max)):
            if name in accessor:
                expect([as_float(x) for x in accessor[name]] == [extreme(numbers[k::count]) for k in range(count)], "glb: its " + name)
        return numbers

    attributes = primitive["attributes"]
    expect(sorted(attributes) == ["COLOR_0", "NORMAL", "POSITION", "_HEAT"], "glb: its attributes")
    middle = node["translation"]
    positions = values(attributes["POSITION"], "f", 3)
    expect(positions == [as_float(x - middle[i % 3]) for i, x in enumerate(POINTS)], "glb: its positions")
    expect(values(attributes["_HEAT"], "f", 1) == [as_float(x) for x in SCALAR], "glb: its scalars")
    expect(values(attributes["COLOR_0"], "H", 4) == truth["colours"], "glb: its colours")
    normals = vectors(values(attributes["NORMAL"], "f", 3))
    around = [[0.0] * 3 for _ in normals]
    for face in FACES:
        for v in face:
            around[v] = [a + b for a, b in zip(around[v], face_normal(face))]
    expect(all(math.dist(n, unit(a)) < 1e-6 for n, a in zip(normals, around) if any(a)), "glb: its normals")
    # Triangles in the order of the faces, each face's with its edges as the boundary.
    triangles = [list(t) for t in vectors(values(primitive["indices"], "I", 1))]
    expect(len(triangles) == sum(len(face) - 2 for face in FACES), "glb: its number of triangles")
    for f, face in enumerate(FACES):
        own, triangles = triangles[:len(face) - 2], triangles[len(face) - 2:]
        expect(edges(own) == edges([face]), "glb: face %d" % f)
    end = 0
    for first, last in sorted(used):
        expect(0 <= first - end < 4, "glb: bytes that are no array's")
        end = last
    expect(0 <= len(binary) - end < 4, "glb: its end")


def check_png():
    raw = read("s.png")
    expect(raw[:8] == b"\x89PNG\r\n\x1a\n", "png: its signature")
    chunks, at = [], 8
    while at < len(raw):
        size, kind = struct.unpack_from(">I4s", raw, at)
        data = raw[at + 8:at + 8 + size]
        (check,) = struct.unpack_from(">I", raw, at + 8 + size)
        expect(check == zlib.crc32(kind + data), "png: the checksum of %r" % kind)
        chunks.append((kind, data))
        at += 12 + size
    expect(chunks[0][0] == b"IHDR" and chunks[-1] == (b"IEND", b""), "png: its chunks")
    width, height, depth, colour, _, _, interlaced = struct.unpack(">2I5B", chunks[0][1])
    expect([width, height] == truth["picture_size"], "png: its size")
    expect((depth, colour, interlaced) == (8, 2, 0), "png: bytes of red, green and blue")
    data = zlib.decompress(b"".join(d for kind, d in chunks if kind == b"IDAT"))
    stride = 3 * width
    expect(len(data) == height * (1 + stride), "png: its length")
    above, pixels = bytes(stride), b""
    for y in range(height):
        filtered = data[y * (1 + stride)]
        row = bytearray(data[y * (1 + stride) + 1:(y + 1) * (1 + stride)])
        for i in range(stride):
            a, b, c = row[i - 3] if i >= 3 else 0, above[i], above[i - 3] if i >= 3 else 0
            nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]  # Paeth's
            row[i] = (row[i] + (0, a, b, (a + b) // 2, nearest)[filtered]) & 255
        above = bytes(row)
        pixels += above
    expect(pixels.hex() == truth["pixels"], "png: its pixels")


class Page(html.parser.HTMLParser):
    """The text of each script by its id."""

    def __init__(self, text):
        super().__init__()
        self.scripts, self.id = {}, None
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.id = dict(attributes).get("id") if tag == "script" else None
        if self.id is not None:
            expect(self.id not in self.scripts, "html: two of " + self.id)
            self.scripts[self.id] = ""

    def handle_endtag(self, tag):
        self.id = None

    def handle_data(self, data):
        if self.id is not None:
            self.scripts[self.id] += data


def check_html():
    scripts = Page(read("s.html").decode("utf-8")).scripts
    page = json.loads(scripts["manifest"])
    expect(b"WebGLRenderer" in zlib.decompress(base64.b64decode(scripts["three"], validate=True)), "html: three.js")

    def integers(block, components):
        """libdsc/page/packing.h, backwards."""
        planes = zlib.decompress(base64.b64decode(scripts[block], validate=True))
        total = len(planes) // 4
        n = total // components
        expect(4 * n * components == len(planes), "html: the length of " + block)
        values = [0] * total
        for c in range(components):
            value = 0
            for i in range(n):
                z = sum(planes[byte * total + c * n + i] << 8 * byte for byte in range(4))
                value = (value + (z >> 1 ^ -(z & 1)) + 2**31) % 2**32 - 2**31
                values[i * components + c] = value
        return values

    def floats(block, components):
        values = integers(block, components)
        return list(struct.unpack("<%df" % len(values), struct.pack("<%di" % len(values), *values)))

    points = vectors(POINTS)
    expect([page["vertices"], page["faces"], page["corners"]] ==
           [len(points), len(FACES), sum(map(len, FACES))], "html: its numbers")
    # Positions, with the errors of libdsc/page/arrays.h.
    expect(page["lattice"] == truth["lattice"], "html: whether its points are on a lattice")
    places = vectors(integers("positions", 3) if page["lattice"] else floats("positions", 3))
    error = 1e-9 if page["lattice"] else 2.0**-24
    close = [abs(k - (x - o) / s) <= error for place, point in zip(places, points)
             for k, x, o, s in zip(place, point, page["origin"], page["step"])]
    expect(len(close) == len(POINTS) and all(close), "html: its points")
    extent = max(max(p[k] for p in points) - min(p[k] for p in points) for k in range(3))
    expect(page["lattice"] or max(page["step"]) <= extent, "html: the scale of its points")
    sides = page["sides"]
    expect((sides > 0) == (len(set(map(len, FACES))) == 1), "html: whether its faces are alike")
    corners = integers("corners", max(1, sides))
    sizes = [sides] * page["faces"] if sides else integers("sizes", 1)
    ends = [sum(sizes[:i]) for i in range(len(sizes) + 1)]
    expect([corners[a:b] for a, b in zip(ends, ends[1:])] == FACES, "html: its faces")
    # Fields.
    said = [[field["name"], field["on"], len(field["parts"])] for field in page["fields"]]
    expect(said == truth["fields"], "html: its fields")
    for i, field in enumerate(page["fields"]):
        wanted = VECTOR if len(field["parts"]) == 3 else SCALAR
        scale = 2.0**field["exponent"]
        got = [x * scale for x in floats("field%d" % i, len(field["parts"]))]
        least = 1e-15 * max((abs(x) for x in wanted if math.isfinite(x)), default=0)
        right = [a == b or abs(a - b) <= max(2.0**-24 * abs(b), least) for a, b in zip(got, wanted)]
        expect(len(got) == len(wanted) and all(right), "html: the values of " + field["name"])
    # Normals: octahedral coordinates.
    wanted = vectors(floats_of("normals"))
    expect(page["normals"] == bool(wanted), "html: whether it has normals")
    if wanted:
        kept = [k / 32767 for k in integers("normals", 2)]
        expect(len(kept) == 2 * len(wanted), "html: the number of its normals")
        for x, y, u in zip(kept[::2], kept[1::2], wanted):
            z = 1 - abs(x) - abs(y)
            if z < 0:
                x, y = math.copysign(1 - abs(y), x), math.copysign(1 - abs(x), y)
            expect(math.dist(unit((x, y, z)), u) <= 1e-4, "html: a normal")


checks = {"ply": check_ply, "vtp": check_vtp, "csv": check_csv, "off": check_off, "obj": check_obj, "stl": check_stl,
          "volumes": check_volumes, "vti": check_vti, "glb": check_glb, "png": check_png, "html": check_html}
for form in sys.argv[2:]:
    try:
        checks[form]()
    except (KeyError, ValueError, IndexError, TypeError, AttributeError, ZeroDivisionError, struct.error, zlib.error,
            xml.etree.ElementTree.ParseError) as error:
        mistakes.append("check_%s: %r" % (form.replace("volumes", "vol, longvol, npy"), error))
for mistake in mistakes:
    print(mistake)
sys.exit(1 if mistakes or len(sys.argv) < 3 else 0)

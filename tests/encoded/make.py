#!/usr/bin/env python3
"""Makes the files in this folder: pictures and models that encoders of other projects wrote, for tests of decoders.

    pip install alktx2==0.1.7 dracopy==2.2.0 meshopt==0.1.0 numpy==2.4.6 pillow==13.0.0
    tests/encoded/make.py

alktx2 brings the encoder of Basis Universal, dracopy that of Draco, meshopt that of meshoptimizer, and Pillow libwebp.

All pictures show the same: 61 × 47 texels with the codes (4x, 5y, 77) and alpha 255 − 2x. All models are a torus
around the y axis, of the radii 2 and 0.75, in steps of u around the axis and v around the tube, both from 0 to 1.
"""

import json
import struct
from math import ceil, cos, pi, sin
from pathlib import Path

import alktx2
import DracoPy
import meshopt
import numpy as np
from PIL import Image

HERE = Path(__file__).parent
WIDTH, HEIGHT = 61, 47
AROUND, ACROSS = 24, 16
FLOAT, UNSIGNED_SHORT, UNSIGNED_BYTE, SHORT, BYTE = 5126, 5123, 5121, 5122, 5120


def picture():
    image = Image.new("RGBA", (WIDTH, HEIGHT))
    for y in range(HEIGHT):
        for x in range(WIDTH):
            image.putpixel((x, y), (4 * x, 5 * y, 77, 255 - 2 * x))
    return image


def ktx2(name, has_alpha, **settings):
    texels = picture().tobytes()
    file = alktx2.encode_raw_rgba_to_ktx2(texels, WIDTH, HEIGHT, has_alpha, check_for_alpha=has_alpha, **settings)
    (HERE / name).write_bytes(file)


def torus():
    """Positions, normals, texture coordinates and triangles."""
    positions, normals, uvs = [], [], []
    for i in range(AROUND + 1):
        for j in range(ACROSS + 1):
            u, v = i / AROUND, j / ACROSS
            a, b = 2 * pi * u, 2 * pi * v
            normal = (cos(b) * cos(a), sin(b), cos(b) * sin(a))
            normals.append(normal)
            positions.append((2 * cos(a) + 0.75 * normal[0], 0.75 * normal[1], 2 * sin(a) + 0.75 * normal[2]))
            uvs.append((u, v))
    triangles = []
    for i in range(AROUND):
        for j in range(ACROSS):
            corner = i * (ACROSS + 1) + j
            other = corner + ACROSS + 1
            triangles += [(corner, corner + 1, other), (corner + 1, other + 1, other)]
    arrays = [np.array(values, np.float32) for values in (positions, normals, uvs)]
    return *arrays, np.array(triangles, np.uint32)


class Model:
    """A GLB in the making. Its first buffer is in the file, its second only announced."""

    def __init__(self):
        self.bin = b""
        self.fallback = 0
        self.json = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {}}]}],
            "accessors": [],
            "bufferViews": [],
        }

    def append(self, data):
        self.bin += bytes(-len(self.bin) % 4)
        self.bin += data
        return len(self.bin) - len(data)

    def compressed(self, extension, data, stride, count, mode, filter=None):
        """Adds a buffer view for `count` elements that `data` encodes."""
        offset = self.append(data)
        length = count * stride
        more = {"filter": filter} if filter else {}
        view = {"buffer": 1, "byteOffset": self.fallback, "byteLength": length}
        if mode == "ATTRIBUTES":
            view["byteStride"] = stride
        view["extensions"] = {
            extension: {
                "buffer": 0,
                "byteOffset": offset,
                "byteLength": len(data),
                "byteStride": stride,
                "count": count,
                "mode": mode,
                **more,
            }
        }
        self.fallback += ceil(length / 4) * 4
        self.json["bufferViews"].append(view)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, view, component, kind, count, normalized=False):
        more = {} if view is None else {"bufferView": view}
        self.json["accessors"].append(
            {"componentType": component, "type": kind, "count": count, "normalized": normalized, **more}
        )
        return len(self.json["accessors"]) - 1

    @property
    def primitive(self):
        return self.json["meshes"][0]["primitives"][0]

    def write(self, name, extension, *others):
        self.json["extensionsUsed"] = self.json["extensionsRequired"] = [extension, *others]
        self.json["buffers"] = [{"byteLength": len(self.bin)}]
        if self.fallback:
            fallback = {"byteLength": self.fallback, "extensions": {extension: {"fallback": True}}}
            self.json["buffers"].append(fallback)
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        body = self.bin + bytes(-len(self.bin) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(body), b"BIN\0") + body
        (HERE / name).write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def meshopt_ext():
    """Version 0: plain positions, octahedral normals of 8 bits, exponential texture coordinates, triangles."""
    name = "EXT_meshopt_compression"
    positions, normals, uvs, triangles = torus()
    count = len(positions)
    model = Model()

    def attribute(semantic, rows, filter, component, kind, normalized=False):
        stride = rows.dtype.itemsize * rows.shape[1]
        data = meshopt.encode_gltf_buffer(rows, "ATTRIBUTES", 0)
        view = model.compressed(name, data, stride, count, "ATTRIBUTES", filter)
        accessor = model.accessor(view, component, kind, count, normalized)
        model.primitive["attributes"][semantic] = accessor

    attribute("POSITION", positions, None, FLOAT, "VEC3")
    with_sign = np.hstack([normals, np.ones((count, 1), np.float32)])
    attribute("NORMAL", meshopt.encode_filter_oct(with_sign, 4, 8), "OCTAHEDRAL", BYTE, "VEC3", True)
    attribute("TEXCOORD_0", meshopt.encode_filter_exp(uvs, 15), "EXPONENTIAL", FLOAT, "VEC2")
    indices = triangles.astype(np.uint16).flatten()
    data = meshopt.encode_gltf_buffer(indices, "TRIANGLES", 0)
    view = model.compressed(name, data, 2, len(indices), "TRIANGLES")
    model.primitive["indices"] = model.accessor(view, UNSIGNED_SHORT, "SCALAR", len(indices))
    model.write("meshopt_ext.glb", name, "KHR_mesh_quantization")


def meshopt_khr():
    """Version 1, compressed hardest: positions of 16 bits, octahedral normals of 16 bits, colours, a sequence of
    indices, and two instances with filtered quaternions."""
    name = "KHR_meshopt_compression"
    positions, normals, _, triangles = torus()
    count = len(positions)
    model = Model()

    def view(rows, filter=None):
        stride = rows.dtype.itemsize * rows.shape[1]
        data = meshopt.encode_vertex_buffer_level(rows, 3, 1)
        return model.compressed(name, data, stride, len(rows), "ATTRIBUTES", filter)

    attributes = model.primitive["attributes"]
    # From -4 to 4 in 65536 steps, with a fourth that fills the stride.
    steps = np.round((positions + 4) / 8 * 65535).astype(np.uint16)
    rows = np.hstack([steps, np.zeros((count, 1), np.uint16)])
    attributes["POSITION"] = model.accessor(view(rows), UNSIGNED_SHORT, "VEC3", count, True)
    with_sign = np.hstack([normals, np.ones((count, 1), np.float32)])
    rows = meshopt.encode_filter_oct(with_sign, 8, 12)
    attributes["NORMAL"] = model.accessor(view(rows, "OCTAHEDRAL"), SHORT, "VEC3", count, True)
    colors = np.tile(np.array([1.0, 0.5, 0.25, 1.0], np.float32), (count, 1))
    rows = meshopt.encode_filter_color(colors, 4, 8)
    attributes["COLOR_0"] = model.accessor(view(rows, "COLOR"), UNSIGNED_BYTE, "VEC4", count, True)
    indices = triangles.astype(np.uint32).flatten()
    data = meshopt.encode_gltf_buffer(indices, "INDICES", 1)
    sequence = model.compressed(name, data, 4, len(indices), "INDICES")
    model.primitive["indices"] = model.accessor(sequence, 5125, "SCALAR", len(indices))
    # A quarter turn around x, and a half turn around the diagonal of y and z.
    half = 0.5**0.5
    quaternions = np.array([[half, 0, 0, half], [0, half, half, 0]], np.float32)
    rows = meshopt.encode_filter_quat(quaternions, 8, 16)
    rotation = model.accessor(view(rows, "QUATERNION"), SHORT, "VEC4", 2, True)
    rows = meshopt.encode_filter_exp(np.array([[1, 2, 3], [-4.5, 0.125, 1000]], np.float32), 20)
    translation = model.accessor(view(rows, "EXPONENTIAL"), FLOAT, "VEC3", 2)
    model.json["nodes"][0]["extensions"] = {
        "EXT_mesh_gpu_instancing": {"attributes": {"ROTATION": rotation, "TRANSLATION": translation}}
    }
    model.write("meshopt_khr.glb", name, "KHR_mesh_quantization", "EXT_mesh_gpu_instancing")


def draco(file, level):
    """Positions of 14 bits, normals of 10 and texture coordinates of 12. The attributes are in the order of DracoPy."""
    name = "KHR_draco_mesh_compression"
    positions, normals, uvs, triangles = torus()
    data = DracoPy.encode(
        positions,
        triangles,
        quantization_bits=14,
        compression_level=level,
        normals=normals.astype(np.float64),
        tex_coord=uvs.astype(np.float64),
        normal_quantization_bits=10,
        tex_coord_quantization_bits=12,
    )
    model = Model()
    offset = model.append(data)
    model.json["bufferViews"].append({"buffer": 0, "byteOffset": offset, "byteLength": len(data)})
    decoded = DracoPy.decode(data)
    count = len(decoded.points)
    ids = {kind: [it["unique_id"] for it in decoded.attributes if it["attribute_type"] == kind][0] for kind in (0, 1, 3)}
    for semantic, kind, shape in (("POSITION", 0, "VEC3"), ("NORMAL", 1, "VEC3"), ("TEXCOORD_0", 3, "VEC2")):
        model.primitive["attributes"][semantic] = model.accessor(None, FLOAT, shape, count)
    model.primitive["indices"] = model.accessor(None, 5125, "SCALAR", triangles.size)
    attributes = {"POSITION": ids[0], "NORMAL": ids[1], "TEXCOORD_0": ids[3]}
    model.primitive["extensions"] = {name: {"bufferView": 0, "attributes": attributes}}
    model.write(file, name)


def main():
    picture().save(HERE / "alpha.webp", quality=80, alpha_quality=100, method=6)
    ktx2("etc1s_alpha.ktx2", True, codec="etc1s", quality=100)
    ktx2("etc1s_levels.ktx2", False, codec="etc1s", quality=100, mipmaps=True)
    ktx2("uastc_alpha.ktx2", True, codec="uastc")
    ktx2("uastc_zstd.ktx2", False, codec="uastc", zstd_supercompression_level=6)
    meshopt_ext()
    meshopt_khr()
    draco("draco.glb", 7)
    draco("draco_sequential.glb", 0)


if __name__ == "__main__":
    main()

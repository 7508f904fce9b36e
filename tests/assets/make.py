"""Writes the meshes beside this file, with trimesh and meshio, and the same geometry as NFF.

    pip install trimesh==5.2.0 meshio==5.3.5 && python make.py

Coordinates are multiples of 1/16, which every format holds exactly.
"""

import pathlib

import meshio
import numpy as np
import trimesh

HERE = pathlib.Path(__file__).parent
VIEW = """v
from 3 -8 4
at 0 0 0
up 0 0 1
angle 40
hither 0.01
resolution 64 64
b 0.18 0.18 0.18
l 5 -9 12
"""


def exact(points):
    return np.round(np.asarray(points) * 16) / 16


def nff(name, points, faces):
    with open(HERE / name, "w") as out:
        out.write(VIEW)
        out.write("f 1 1 1 1 0 0 0 1\n")
        for face in faces:
            out.write(f"p {len(face)}\n")
            for index in face:
                out.write(" ".join(repr(float(x)) for x in points[index]) + "\n")


def triangles():
    ball = trimesh.creation.icosphere(subdivisions=1, radius=1.5)
    box = trimesh.creation.box(extents=(1, 2, 3))
    box.apply_translation((1.5, 1, -0.5))
    both = trimesh.util.concatenate(ball, box)
    mesh = trimesh.Trimesh(exact(both.vertices), both.faces, process=False)
    mesh.export(HERE / "trimesh.ply", encoding="binary")
    mesh.export(HERE / "trimesh-text.ply", encoding="ascii")
    mesh.export(HERE / "trimesh.stl")
    mesh.export(HERE / "trimesh-text.stl", file_type="stl_ascii")
    mesh.export(HERE / "trimesh.glb")
    for name, data in trimesh.exchange.gltf.export_gltf(trimesh.Scene(mesh)).items():
        name = "trimesh.gltf" if name.endswith(".gltf") else name
        (HERE / name).write_bytes(data)
    material = trimesh.visual.material.SimpleMaterial(
        diffuse=[255, 51, 0, 255], name="brick"
    )
    uv = np.zeros((len(mesh.vertices), 2))
    mesh.visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
    text, files = trimesh.exchange.obj.export_obj(
        mesh, return_texture=True, mtl_name="trimesh.mtl"
    )
    (HERE / "trimesh.obj").write_text(text)
    for name, data in files.items():
        (HERE / name).write_bytes(data)
    nff("triangles.nff", mesh.vertices, mesh.faces)


def polygons():
    """A prism of five sides: five quadrilaterals, and two ends of triangles."""
    angles = 2 * np.pi * np.arange(5) / 5
    ring = np.stack([2 * np.cos(angles), 2 * np.sin(angles), 0 * angles], axis=1)
    # The sides are parallelograms, and so exactly flat.
    points = np.concatenate([exact(ring) + (0, 0, -1), exact(ring) + (0.25, 0, 1.5)])
    sides = [[i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i] for i in range(5)]
    ends = [[0, i + 1, i] for i in (1, 2, 3)] + [[5, 5 + i, 6 + i] for i in (1, 2, 3)]
    mesh = meshio.Mesh(points, [("quad", sides), ("triangle", ends)])
    meshio.write(HERE / "meshio.obj", mesh)
    meshio.write(HERE / "meshio.ply", mesh)
    meshio.write(HERE / "meshio-text.ply", mesh, binary=False)
    nff("polygons.nff", points, sides + ends)


triangles()
polygons()

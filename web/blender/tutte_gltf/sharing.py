"""Lets the primitives of an exported mesh share their vertices, so that they are one mesh to the encoder: smaller, and
without cracks where two materials meet."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Vertices:
    """The vertex arrays of a primitive, and the number of its first vertex in them."""

    attributes: dict
    targets: list
    base: int


def shared(primitives):
    """Per primitive its vertices; in one set of arrays if all primitives have arrays of the same kinds."""
    own = [Vertices(p.attributes, p.targets, 0) for p in primitives]
    if len(own) < 2 or len({_kinds(vertices) for vertices in own}) > 1:
        return own
    attributes = _joined([v.attributes for v in own])
    targets = own[0].targets and [_joined(parts) for parts in zip(*(v.targets for v in own))]
    counts = [v.attributes['POSITION'].count for v in own]
    bases = np.cumsum([0, *counts[:-1]]).tolist()
    return [Vertices(attributes, targets, base) for base in bases]


def _kinds(vertices):
    """What must be equal before arrays can be joined."""
    return tuple(tuple((name, accessor.component_type, accessor.type, accessor.normalized)
                       for name, accessor in sorted(arrays.items()))
                 for arrays in (vertices.attributes, *(vertices.targets or ())))


def _joined(parts):
    """Dictionaries of accessors, joined name by name."""
    return {name: _joined_accessor([part[name] for part in parts]) for name in parts[0]}


def _joined_accessor(accessors):
    from io_scene_gltf2.io.com.gltf2_io import Accessor
    from io_scene_gltf2.io.exp.gltf2_io_binary_data import BinaryData

    first = accessors[0]
    data = b''.join(accessor.buffer_view.data for accessor in accessors)
    bounded = first.min is not None and first.max is not None
    return Accessor(
        buffer_view=BinaryData(data, first.buffer_view.bufferViewTarget),
        byte_offset=None,
        component_type=first.component_type,
        count=sum(accessor.count for accessor in accessors),
        extensions=None,
        extras=None,
        max=np.max([accessor.max for accessor in accessors], axis=0).tolist() if bounded else None,
        min=np.min([accessor.min for accessor in accessors], axis=0).tolist() if bounded else None,
        name=None,
        normalized=first.normalized,
        sparse=None,
        type=first.type,
    )

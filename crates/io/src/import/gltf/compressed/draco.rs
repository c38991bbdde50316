//! Primitives with `KHR_draco_mesh_compression`.

use super::Room;
use crate::import::error::ImportError;
use crate::import::gltf::accessor::Component;
use crate::import::gltf::buffers::Buffers;
use crate::import::gltf::document::{Accessor, BufferView, Document, Kind, Primitive};
use crate::import::source::quote;
use draco_core::{DecodeLimits, DecoderBuffer, ErrorKind, Mesh, MeshDecoder};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Bytes that the decoder takes for a face beside its attributes.
const PER_FACE: u64 = 64;

const TRIANGLES: u32 = 4;
const UNSIGNED_INT: u32 = 5125;

/// A decoded stream and the accessors that were made of it.
struct Decoded {
    mesh: Mesh,
    indices: Option<usize>,
    attributes: HashMap<(u32, u32, Kind, bool), usize>,
}

/// Decodes all primitives that have the extension.
pub(super) fn primitives(
    document: &mut Document,
    buffers: &mut Buffers,
    room: &mut Room,
) -> Result<(), ImportError> {
    let mut streams: HashMap<usize, Decoded> = HashMap::new();
    let mut meshes = std::mem::take(&mut document.meshes);
    for (m, mesh) in meshes.iter_mut().enumerate() {
        for (p, primitive) in mesh.primitives.iter_mut().enumerate() {
            let extensions = primitive.extensions.as_ref();
            let Some(compressed) = extensions.and_then(|it| it.draco.as_ref()) else {
                continue;
            };
            let place = format!("meshes[{m}].primitives[{p}]");
            let view = compressed.buffer_view;
            let decoded = decoded(&mut streams, view, document, buffers, room, &place)
                .and_then(|stream| replaced(primitive, stream, document, buffers, room, &place));
            if !room.spared(decoded)? {
                // The accessors of a primitive that cannot be decoded have no values.
                primitive.attributes.clear();
            }
        }
    }
    document.meshes = meshes;
    Ok(())
}

/// The data in a buffer view, which several primitives may share.
fn decoded<'s>(
    streams: &'s mut HashMap<usize, Decoded>,
    view: usize,
    document: &Document,
    buffers: &Buffers,
    room: &mut Room,
    place: &str,
) -> Result<&'s mut Decoded, ImportError> {
    Ok(match streams.entry(view) {
        Entry::Occupied(known) => known.into_mut(),
        Entry::Vacant(new) => {
            let (source, _) = buffers.view(document, view, place, room.blame)?;
            new.insert(decode(source, room, place)?)
        }
    })
}

/// Gives a primitive the decoded data.
fn replaced(
    primitive: &mut Primitive,
    stream: &mut Decoded,
    document: &mut Document,
    buffers: &mut Buffers,
    room: &mut Room,
    place: &str,
) -> Result<(), ImportError> {
    let extensions = primitive.extensions.as_ref();
    let compressed = extensions.and_then(|it| it.draco.as_ref());
    for (name, &id) in compressed.into_iter().flat_map(|it| &it.attributes) {
        let attribute = primitive.attributes.get_mut(name);
        let Some(attribute) = attribute else { continue };
        let here = format!("{place}.attributes.{name}");
        *attribute = stream.attribute(id, *attribute, document, buffers, room, &here)?;
    }
    primitive.indices = Some(stream.indices(document, buffers, room, place)?);
    primitive.mode = TRIANGLES;
    Ok(())
}

fn decode(source: &[u8], room: &mut Room, place: &str) -> Result<Decoded, ImportError> {
    let limits = DecodeLimits::default()
        .with_max_faces(room.left / PER_FACE)
        .with_max_points(room.left / PER_FACE)
        .with_max_decoded_bytes(room.left / 2);
    let mut mesh = Mesh::new();
    let mut stream = DecoderBuffer::new(source).with_limits(limits);
    let decoded = MeshDecoder::new().decode(&mut stream, &mut mesh);
    decoded.map_err(|error| match error.kind() {
        ErrorKind::LimitExceeded => room.too_big(place),
        _ => {
            let why = quote(error.to_string().as_bytes());
            let why = format!("the Draco data are invalid: {}", why.trim_matches('`'));
            room.blame.bad(place, why)
        }
    })?;
    Ok(Decoded {
        mesh,
        indices: None,
        attributes: HashMap::new(),
    })
}

impl Decoded {
    /// The number of an accessor with the corners of all triangles.
    fn indices(
        &mut self,
        document: &mut Document,
        buffers: &mut Buffers,
        room: &mut Room,
        place: &str,
    ) -> Result<usize, ImportError> {
        if let Some(known) = self.indices {
            return Ok(known);
        }
        let faces = self.mesh.faces();
        room.take(size_of_val(faces) as u64, place)?;
        let corners = faces
            .iter()
            .flatten()
            .flat_map(|point| point.0.to_le_bytes());
        let bytes: Vec<u8> = corners.collect();
        let accessor = Accessor {
            component_type: UNSIGNED_INT,
            count: bytes.len() as u64 / 4,
            ..Accessor::of(Kind::Scalar)
        };
        let index = append(accessor, bytes, document, buffers);
        self.indices = Some(index);
        Ok(index)
    }

    /// The number of an accessor like `like` with the attribute `id`.
    fn attribute(
        &mut self,
        id: u32,
        like: usize,
        document: &mut Document,
        buffers: &mut Buffers,
        room: &mut Room,
        place: &str,
    ) -> Result<usize, ImportError> {
        let blame = room.blame;
        let like = blame.get(&document.accessors, like, "accessors", place)?;
        let (kind, component_type, normalized) = (like.kind, like.component_type, like.normalized);
        let key = (id, component_type, kind, normalized);
        if let Some(&known) = self.attributes.get(&key) {
            return Ok(known);
        }
        let attribute = self.mesh.attribute_by_unique_id(id);
        let attribute = attribute
            .ok_or_else(|| blame.bad(place, format!("Draco attribute {id} is missing")))?;
        let width = usize::from(attribute.num_components());
        if width != kind.width() {
            let why = format!("Draco attribute {id} has {width} components");
            return Err(blame.bad(place, why));
        }
        let component = Component::of(component_type);
        let component = component.ok_or_else(|| {
            blame.bad(place, format!("componentType {component_type} is unknown"))
        })?;
        let count = self.mesh.num_points();
        // The numbers, and their bytes.
        room.take((count * width * (4 + component.size())) as u64, place)?;
        let numbers = attribute.read_f32s(count, width);
        let mut bytes = Vec::with_capacity(numbers.len() * component.size());
        for number in numbers {
            component.write(number, &mut bytes);
        }
        let accessor = Accessor {
            component_type,
            normalized,
            count: count as u64,
            ..Accessor::of(kind)
        };
        let index = append(accessor, bytes, document, buffers);
        self.attributes.insert(key, index);
        Ok(index)
    }
}

/// Adds an accessor for all of `bytes`, and returns its number.
fn append(
    mut accessor: Accessor,
    bytes: Vec<u8>,
    document: &mut Document,
    buffers: &mut Buffers,
) -> usize {
    let byte_length = bytes.len() as u64;
    document.buffer_views.push(BufferView {
        buffer: buffers.push(bytes),
        byte_offset: 0,
        byte_length,
        byte_stride: None,
        extensions: None,
    });
    accessor.buffer_view = Some(document.buffer_views.len() - 1);
    document.accessors.push(accessor);
    document.accessors.len() - 1
}

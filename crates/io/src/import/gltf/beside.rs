//! Properties that have no effect because of others, such as the translation of a node that has a matrix, and values
//! that none of the specification's is.

use super::accessor::Component;
use super::document::{ABSENT, BufferView, Document, Material, Node, Primitive};
use super::document_materials::AlphaMode;
use super::map_kinds::{MapKind, all_maps};
use super::maps;
use super::unused::Unused;
use crate::import::notes::Notes;

/// The kind of notes on values of which there is a list.
const CODES: &str = "unknown codes";

/// Adds the properties of `document` that others leave without an effect, and notes values that do not exist.
pub(super) fn find(document: &Document, unused: &mut Unused, notes: &mut Notes) {
    for (index, node) in document.nodes.iter().enumerate() {
        in_node(document, node, index, unused, notes);
    }
    let mut is_skinned = vec![false; document.meshes.len()];
    let skinned = document.nodes.iter().filter(|node| node.skin.is_some());
    for mesh in skinned.filter_map(|node| node.mesh) {
        if let Some(is_skinned) = is_skinned.get_mut(mesh) {
            *is_skinned = true;
        }
    }
    for (index, mesh) in document.meshes.iter().enumerate() {
        let here = format!("meshes[{index}]");
        let targets = targets_of(&mesh.primitives);
        note_weights(mesh.weights.as_deref(), targets, &here, notes);
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            in_attributes(primitive, (index, i), is_skinned[index], unused);
            #[cfg(feature = "draco")]
            in_compressed(document, primitive, (index, i), unused);
            note_variants(document, primitive, (index, i), notes);
        }
    }
    for (index, camera) in document.cameras.iter().enumerate() {
        if camera.perspective.is_some() && camera.orthographic.is_some() {
            let why = "the camera has a perspective";
            unused.of("cameras", index, "orthographic", why);
        }
    }
    let lights = document.extensions.lights.iter();
    for (index, light) in lights.flat_map(|it| &it.lights).enumerate() {
        if light.spot.is_some() && light.kind != "spot" {
            let list = "extensions.KHR_lights_punctual.lights";
            unused.of(list, index, "spot", "the light is no spot");
        }
    }
    for (index, material) in document.materials.iter().enumerate() {
        in_material(material, index, unused);
    }
    in_textures(document, unused, notes);
    in_buffers(document, unused);
    in_clips(document, unused);
}

fn in_textures(document: &Document, unused: &mut Unused, notes: &mut Notes) {
    for (index, texture) in document.textures.iter().enumerate() {
        let found = texture.image();
        let extensions = &texture.extensions;
        for (name, own) in [
            ("EXT_texture_webp", &extensions.webp),
            ("KHR_texture_basisu", &extensions.basisu),
        ] {
            let own = own.as_ref().and_then(|it| it.source);
            if own.is_some() && own != found && found.is_some() {
                let property = format!("extensions.{name}.source");
                unused.of("textures", index, &property, "another picture is used");
            }
        }
    }
    for (index, image) in document.images.iter().enumerate() {
        if image.uri.is_some() && image.buffer_view.is_some() {
            unused.of("images", index, "bufferView", "the image has a URI");
        }
    }
    for (index, sampler) in document.samplers.iter().enumerate() {
        for (name, code, known) in [
            ("magFilter", sampler.mag_filter, maps::MAG_FILTERS),
            ("minFilter", sampler.min_filter, maps::MIN_FILTERS),
            ("wrapS", sampler.wrap_s, maps::WRAPS),
            ("wrapT", sampler.wrap_t, maps::WRAPS),
        ] {
            if let Some(code) = code.filter(|code| !known.contains(code)) {
                let usual = known[0];
                notes.add(CODES, || {
                    format!("samplers[{index}].{name} {code} is unknown: {usual} is used")
                });
            }
        }
    }
}

fn in_clips(document: &Document, unused: &mut Unused) {
    for (index, clip) in document.animations.iter().enumerate() {
        let list = format!("animations[{index}].channels");
        let mut is_used = vec![false; clip.samplers.len()];
        for (i, channel) in clip.channels.iter().enumerate() {
            let target = &channel.target;
            let mut no = |property: &str, why: &'static str| {
                let pattern = format!("animations[].channels[].target.{property}");
                unused.add(pattern, || format!("{list}[{i}].target.{property}"), why);
            };
            match target.path.as_str() {
                "pointer" if target.node.is_some() => no("node", "the path is a pointer"),
                "pointer" => {}
                _ if target.extensions.is_some() => no("extensions", "the path is no pointer"),
                _ => {}
            }
            if let Some(is_used) = is_used.get_mut(channel.sampler) {
                *is_used = true;
            }
        }
        for (i, _) in is_used.iter().enumerate().filter(|(_, is_used)| !**is_used) {
            let first = || format!("animations[{index}].samplers[{i}]");
            let pattern = "animations[].samplers[]".to_owned();
            unused.add(pattern, first, "nothing refers to it");
        }
    }
}

fn targets_of(primitives: &[Primitive]) -> usize {
    let counts = primitives.iter().map(|primitive| primitive.targets.len());
    counts.max().unwrap_or(0)
}

fn note_weights(weights: Option<&[f64]>, targets: usize, here: &str, notes: &mut Notes) {
    let count = weights.map_or(0, <[f64]>::len);
    if count > targets {
        notes.add("weights without a morph target", || {
            format!("{here}.weights has {count} numbers for {targets} morph targets")
        });
    }
}

fn in_node(document: &Document, node: &Node, index: usize, unused: &mut Unused, notes: &mut Notes) {
    let mut no = |property: &str, why: &'static str| unused.of("nodes", index, property, why);
    let parts = [
        ("translation", node.translation.is_some()),
        ("rotation", node.rotation.is_some()),
        ("scale", node.scale.is_some()),
    ];
    let parts = parts.into_iter().filter(|(_, is_there)| *is_there);
    let extensions = node.extensions.as_ref();
    let has_light = extensions.is_some_and(|it| it.light.is_some());
    let is_skinned = node.skin.is_some() && node.mesh.is_some();
    if is_skinned && node.children.is_empty() && node.camera.is_none() && !has_light {
        const WHY: &str = "a skin places the mesh";
        parts.for_each(|(name, _)| no(name, WHY));
        if node.matrix.is_some() {
            no("matrix", WHY);
        }
    } else if node.matrix.is_some() {
        parts.for_each(|(name, _)| no(name, "the node has a matrix"));
    }
    let has_copies = extensions.is_some_and(|it| it.instancing.is_some());
    if has_copies && is_skinned {
        let why = "a skin places the mesh";
        no("extensions.EXT_mesh_gpu_instancing", why);
    }
    match node.mesh {
        None => {
            for (name, is_there) in [
                ("skin", node.skin.is_some()),
                ("weights", node.weights.is_some()),
                ("extensions.EXT_mesh_gpu_instancing", has_copies),
            ] {
                if is_there {
                    no(name, "the node has no mesh");
                }
            }
        }
        Some(mesh) => {
            let mesh = document.meshes.get(mesh);
            let targets = mesh.map_or(0, |mesh| targets_of(&mesh.primitives));
            note_weights(
                node.weights.as_deref(),
                targets,
                &format!("nodes[{index}]"),
                notes,
            );
        }
    }
}

fn in_attributes(
    primitive: &Primitive,
    (mesh, index): (usize, usize),
    is_skinned: bool,
    unused: &mut Unused,
) {
    for name in primitive.attributes.keys() {
        let other = match name.split_once('_') {
            Some(("JOINTS", set)) => format!("WEIGHTS_{set}"),
            Some(("WEIGHTS", set)) => format!("JOINTS_{set}"),
            _ => continue,
        };
        let why = match primitive.attributes.contains_key(&other) {
            true if is_skinned => continue,
            true => "no node of the mesh has a skin",
            false => "joints and weights are used together",
        };
        let pattern = format!("meshes[].primitives[].attributes.{name}");
        let first = || format!("meshes[{mesh}].primitives[{index}].attributes.{name}");
        unused.add(pattern, first, why);
    }
}

fn note_variants(
    document: &Document,
    primitive: &Primitive,
    (mesh, index): (usize, usize),
    notes: &mut Notes,
) {
    let here = format!("meshes[{mesh}].primitives[{index}].extensions");
    let Some(extensions) = &primitive.extensions else {
        return;
    };
    let known = document.extensions.variants.as_ref();
    let known = known.map_or(0, |it| it.variants.len());
    let mappings = extensions.variants.iter().flat_map(|it| &it.mappings);
    for (i, mapping) in mappings.enumerate() {
        let place = || format!("{here}.KHR_materials_variants.mappings[{i}]");
        if mapping.material >= document.materials.len() {
            notes.add("variants that do not exist", || match mapping.material {
                ABSENT => format!("{}.material is missing", place()),
                material => format!("{}.material: materials[{material}] does not exist", place()),
            });
        }
        if let Some(variant) = mapping.variants.iter().find(|variant| **variant >= known) {
            notes.add("variants that do not exist", || match *variant {
                ABSENT => format!("{}.variants names none", place()),
                _ => format!("{}.variants: variants[{variant}] does not exist", place()),
            });
        }
    }
}

/// Adds what the compressed data of a primitive say themselves.
#[cfg(feature = "draco")]
fn in_compressed(
    document: &Document,
    primitive: &Primitive,
    (mesh, index): (usize, usize),
    unused: &mut Unused,
) {
    let extensions = primitive.extensions.as_ref();
    let Some(compressed) = extensions.and_then(|it| it.draco.as_ref()) else {
        return;
    };
    let here = format!("meshes[{mesh}].primitives[{index}]");
    let known = document.accessors.len();
    if primitive.indices.is_some_and(|accessor| accessor < known) {
        for property in ["count", "type", "componentType"] {
            unused.idle(format!("accessors[].{property}"));
        }
    }
    for name in compressed.attributes.keys() {
        if primitive.attributes.contains_key(name) {
            unused.idle("accessors[].count".to_owned());
            continue;
        }
        let shown = crate::import::source::quote_up_to(64, name.as_bytes());
        let own = "extensions.KHR_draco_mesh_compression.attributes";
        let pattern = format!("meshes[].primitives[].{own}.{shown}");
        let why = "the primitive has no such attribute";
        unused.add(pattern, || format!("{here}.{own}.{shown}"), why);
    }
    if primitive.mode != 4 {
        let pattern = "meshes[].primitives[].mode".to_owned();
        let why = "compressed triangles are separate";
        unused.add(pattern, || format!("{here}.mode"), why);
    }
}

fn in_material(material: &Material, index: usize, unused: &mut Unused) {
    let mut no = |property: &str, why: &'static str| unused.of("materials", index, property, why);
    if material.alpha_cutoff.is_some() && material.alpha_mode != AlphaMode::Mask {
        no("alphaCutoff", "the alpha mode is not MASK");
    }
    let extensions = material.extensions.as_deref();
    let is_older = extensions.is_some_and(|it| it.specular_glossiness.is_some());
    if is_older && material.pbr_metallic_roughness.is_some() {
        const WHY: &str = "KHR_materials_pbrSpecularGlossiness takes its place";
        no("pbrMetallicRoughness", WHY);
    }
    for (kind, map) in all_maps(material) {
        let moved = map.extensions.transform.as_ref();
        let moved = moved.and_then(|it| it.tex_coord);
        if moved.is_some() && map.tex_coord.is_some() && moved != map.tex_coord {
            let property = format!("{}.texCoord", kind.path());
            no(&property, "KHR_texture_transform has another");
        }
    }
    let Some(extensions) = extensions.filter(|it| it.unlit.is_some()) else {
        return;
    };
    const WHY: &str = "the material is unlit";
    if material.emissive_factor.is_some() {
        no("emissiveFactor", WHY);
    }
    for (kind, _) in all_maps(material) {
        if !matches!(kind, MapKind::BaseColor | MapKind::Diffuse) {
            no(kind.path(), WHY);
        }
    }
    for (name, is_there) in [
        ("emissive_strength", extensions.emissive_strength.is_some()),
        ("ior", extensions.ior.is_some()),
        ("transmission", extensions.transmission.is_some()),
        ("volume", extensions.volume.is_some()),
        ("specular", extensions.specular.is_some()),
        ("clearcoat", extensions.clearcoat.is_some()),
        ("sheen", extensions.sheen.is_some()),
        ("anisotropy", extensions.anisotropy.is_some()),
        ("iridescence", extensions.iridescence.is_some()),
        ("dispersion", extensions.dispersion.is_some()),
        (
            "diffuse_transmission",
            extensions.diffuse_transmission.is_some(),
        ),
    ] {
        if is_there {
            no(&format!("extensions.KHR_materials_{name}"), WHY);
        }
    }
}

fn in_buffers(document: &Document, unused: &mut Unused) {
    let mut is_index = vec![false; document.accessors.len()];
    for primitive in document.meshes.iter().flat_map(|mesh| &mesh.primitives) {
        if let Some(is_index) = primitive.indices.and_then(|it| is_index.get_mut(it)) {
            *is_index = true;
        }
    }
    let mut has_elements = vec![false; document.buffer_views.len()];
    for (index, accessor) in document.accessors.iter().enumerate() {
        let component = Component::of(accessor.component_type);
        let is_wide = matches!(component, Some(Component::F32 | Component::U32));
        if accessor.normalized && (is_wide || is_index[index]) {
            let why = match is_index[index] {
                true => "indices are whole numbers",
                false => "only integers of 8 or 16 bits can be normalised",
            };
            unused.of("accessors", index, "normalized", why);
        }
        match accessor.buffer_view {
            Some(view) => {
                if let Some(has_elements) = has_elements.get_mut(view) {
                    *has_elements = true;
                }
            }
            None if accessor.byte_offset > 0 => {
                let why = "the accessor has no buffer view";
                unused.of("accessors", index, "byteOffset", why);
            }
            None => {}
        }
    }
    for (index, view) in document.buffer_views.iter().enumerate() {
        if is_compressed(view, index, unused) {
            continue;
        }
        if view.byte_stride.is_some() && !has_elements[index] {
            let why = "only accessors have elements apart";
            unused.of("bufferViews", index, "byteStride", why);
        }
    }
    // Only the first buffer without a URI may be in the file.
    let others = document.buffers.iter().skip(1);
    for _ in others.filter(|buffer| buffer.uri.is_none()) {
        unused.idle("buffers[].byteLength".to_owned());
    }
}

/// Whether `view` is compressed. Then its own range is that of data which the model does not contain.
fn is_compressed(view: &BufferView, index: usize, unused: &mut Unused) -> bool {
    let Some(extensions) = view.extensions.as_deref() else {
        return false;
    };
    if extensions.ext.is_none() && extensions.khr.is_none() {
        return false;
    }
    if extensions.ext.is_some() && extensions.khr.is_some() {
        let property = "extensions.KHR_meshopt_compression";
        let why = "EXT_meshopt_compression is used";
        unused.of("bufferViews", index, property, why);
    }
    for (name, is_there) in [
        ("buffer", view.buffer != ABSENT),
        ("byteOffset", view.byte_offset > 0),
        ("byteLength", view.byte_length > 0),
        ("byteStride", view.byte_stride.is_some()),
    ] {
        if is_there {
            unused.idle(format!("bufferViews[].{name}"));
        }
    }
    true
}

//! Entries of a model's lists to which nothing refers that is shown.

use super::Reader;
use super::document::{Document, Primitive};
use super::map_kinds::{ShownBy, all_maps};
use super::materials::MaterialKey;
use super::unused::Unused;

/// The entries of a list that something refers to.
struct Marks {
    list: &'static str,
    marks: Vec<bool>,
}

impl Marks {
    fn new(list: &'static str, count: usize) -> Self {
        let marks = vec![false; count];
        Self { list, marks }
    }

    /// Marks an entry, if it exists. Returns whether it is the first time.
    fn mark(&mut self, index: usize) -> bool {
        let mark = self.marks.get_mut(index);
        mark.is_some_and(|mark| !std::mem::replace(mark, true))
    }

    fn mark_all(&mut self, indices: impl IntoIterator<Item = usize>) {
        for index in indices {
            self.mark(index);
        }
    }

    /// Adds the entries without a mark.
    fn report(&self, unused: &mut Unused, why: &'static str) {
        for (index, _) in self.marks.iter().enumerate().filter(|(_, mark)| !**mark) {
            unused.of(self.list, index, "", why);
        }
    }
}

/// Adds the accessors, views and buffers of `document` to which nothing in it refers.
pub(super) fn find_parts(document: &Document, unused: &mut Unused) {
    let mut accessors = Marks::new("accessors", document.accessors.len());
    let mut views = Marks::new("bufferViews", document.buffer_views.len());
    let mut buffers = Marks::new("buffers", document.buffers.len());
    for primitive in document.meshes.iter().flat_map(|mesh| &mesh.primitives) {
        accessors.mark_all(primitive.indices);
        accessors.mark_all(primitive.attributes.values().copied());
        let targets = primitive.targets.iter().flat_map(|target| target.values());
        accessors.mark_all(targets.copied());
        #[cfg(feature = "draco")]
        views.mark_all(
            (primitive.extensions.iter())
                .filter_map(|it| it.draco.as_ref())
                .map(|it| it.buffer_view),
        );
    }
    let extensions = document
        .nodes
        .iter()
        .filter_map(|node| node.extensions.as_ref());
    let copies = extensions.filter_map(|it| it.instancing.as_ref());
    accessors.mark_all(copies.flat_map(|it| it.attributes.values().copied()));
    accessors.mark_all((document.skins.iter()).filter_map(|skin| skin.inverse_bind_matrices));
    for sampler in document.animations.iter().flat_map(|clip| &clip.samplers) {
        accessors.mark_all([sampler.input, sampler.output]);
    }
    for accessor in &document.accessors {
        views.mark_all(accessor.buffer_view);
        if let Some(sparse) = &accessor.sparse {
            views.mark_all([sparse.indices.buffer_view, sparse.values.buffer_view]);
        }
    }
    views.mark_all(document.images.iter().filter_map(|image| image.buffer_view));
    for view in &document.buffer_views {
        let extensions = view.extensions.iter();
        let compressed = extensions.flat_map(|it| [&it.ext, &it.khr]);
        buffers.mark(view.buffer);
        buffers.mark_all(compressed.flatten().map(|it| it.buffer));
    }
    for list in [accessors, views, buffers] {
        list.report(unused, "nothing refers to it");
    }
}

impl Reader<'_> {
    /// Adds what is not in the chosen scene, whose trees of nodes begin at `roots`.
    pub(super) fn find_unshown(&mut self, roots: &[usize]) {
        let document = self.document;
        let all_lights = document.extensions.lights.as_ref();
        let all_lights = all_lights.map_or(0, |it| it.lights.len());
        let mut nodes = Marks::new("nodes", document.nodes.len());
        let mut meshes = Marks::new("meshes", document.meshes.len());
        let mut cameras = Marks::new("cameras", document.cameras.len());
        let mut lights = Marks::new("extensions.KHR_lights_punctual.lights", all_lights);
        let mut skins = Marks::new("skins", document.skins.len());
        let mut materials = Marks::new("materials", document.materials.len());
        let mut textures = Marks::new("textures", document.textures.len());
        let mut images = Marks::new("images", document.images.len());
        let mut samplers = Marks::new("samplers", document.samplers.len());
        let mut stack = roots.to_vec();
        while let Some(index) = stack.pop() {
            if !nodes.mark(index) {
                continue;
            }
            stack.extend(&self.children[index]);
            let node = &document.nodes[index];
            meshes.mark_all(node.mesh);
            cameras.mark_all(node.camera);
            skins.mark_all(node.skin);
            let extensions = node.extensions.iter();
            lights.mark_all(extensions.filter_map(|it| Some(it.light.as_ref()?.light)));
        }
        let all = document.meshes.iter().enumerate();
        for (m, mesh) in all.filter(|(m, _)| meshes.marks[*m]) {
            for (i, primitive) in mesh.primitives.iter().enumerate() {
                materials.mark_all(primitive.material);
                let extensions = primitive.extensions.iter();
                let variants = extensions.filter_map(|it| it.variants.as_ref());
                materials.mark_all(variants.flat_map(|it| &it.mappings).map(|it| it.material));
                self.find_unused_attributes(primitive, &format!("meshes[{m}].primitives[{i}]"));
            }
        }
        let shown = document.materials.iter().zip(&materials.marks);
        let shown = shown.filter(|(_, mark)| **mark);
        for (_, map) in shown.flat_map(|(material, _)| all_maps(material)) {
            if let (true, Some(texture)) =
                (textures.mark(map.index), document.textures.get(map.index))
            {
                images.mark_all(texture.image());
                samplers.mark_all(texture.sampler);
            }
        }
        // Joints place a skin, whether they are in the scene or not.
        let joints = (document.skins.iter().zip(&skins.marks)).filter(|(_, mark)| **mark);
        nodes.mark_all(joints.flat_map(|(skin, _)| skin.joints.iter().copied()));
        for list in [
            nodes, meshes, cameras, lights, skins, materials, textures, images, samplers,
        ] {
            list.report(&mut self.unused, "the scene does not show it");
        }
    }

    /// Adds the vertex attributes of the primitive at `here` that only maps show which its material has not.
    fn find_unused_attributes(&mut self, primitive: &Primitive, here: &str) {
        let index = self.material_index(primitive);
        let key = MaterialKey(index.filter(|index| *index < self.document.materials.len()));
        let source = key.0.map(|index| &self.document.materials[index]);
        let mut sets = self.uv_sets(&key);
        for (kind, map) in source.into_iter().flat_map(all_maps) {
            if kind.shown_by() != ShownBy::None {
                let moved = map.extensions.transform.as_ref();
                let set = moved.and_then(|it| it.tex_coord).or(map.tex_coord);
                sets.push(set.unwrap_or(0));
            }
        }
        let names: Vec<String> = sets.iter().map(|set| format!("TEXCOORD_{set}")).collect();
        let has_tangents = self.has_tangents(&key);
        for name in primitive.attributes.keys() {
            let why = match name.as_str() {
                "TANGENT" if !has_tangents => "no map of the material bends normals",
                name if name.starts_with("TEXCOORD_") && !names.iter().any(|it| it == name) => {
                    "no map of the material lies in it"
                }
                _ => continue,
            };
            let pattern = format!("meshes[].primitives[].attributes.{name}");
            self.unused
                .add(pattern, || format!("{here}.attributes.{name}"), why);
        }
    }
}

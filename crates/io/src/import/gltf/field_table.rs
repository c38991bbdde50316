//! The properties of glTF 2.0 and of the extensions that are read, and which of them have no effect.

use super::field_forms::Form::*;
use super::field_forms::Use::{Idle, Read, Unused};
use super::field_forms::{Form, Object, objects};
use super::material_fields::{MATERIAL, NO_EXTENSIONS};

/// A model.
pub(super) static ROOT: Object = Object {
    is_extensions: false,
    fields: DOCUMENT.fields,
};

const MODES: Form = Word(&["ATTRIBUTES", "TRIANGLES", "INDICES"]);
const FILTERS: Form = Word(&["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"]);
const SHAPES: Form = Word(&["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"]);
const LIGHTS: Form = Word(&["point", "directional", "spot"]);
const CAMERAS: Form = Word(&["perspective", "orthographic"]);
const INTERPOLATIONS: Form = Word(&["LINEAR", "STEP", "CUBICSPLINE"]);

objects! {
    object DOCUMENT {
        asset: One(&ASSET);
        extensionsUsed: Texts;
        extensionsRequired: Texts;
        accessors: Many(&ACCESSOR);
        animations: Many(&ANIMATION);
        buffers: Many(&BUFFER);
        bufferViews: Many(&BUFFER_VIEW);
        cameras: Many(&CAMERA);
        images: Many(&IMAGE);
        materials: Many(&MATERIAL);
        meshes: Many(&MESH);
        nodes: Many(&NODE);
        samplers: Many(&SAMPLER);
        scene: Whole;
        scenes: Many(&SCENE);
        skins: Many(&SKIN);
        textures: Many(&TEXTURE);
        extensions: One(&DOCUMENT_EXTENSIONS);
    }
    extensions DOCUMENT_EXTENSIONS {
        KHR_lights_punctual: One(&LIGHT_LIST);
        KHR_materials_variants: One(&VARIANT_LIST);
        KHR_xmp: Any, Idle;
        KHR_xmp_json_ld: Any, Idle;
    }
    object ASSET {
        version: Text;
        minVersion: Text;
        generator: Text, Idle;
        copyright: Text, Idle;
        extensions: One(&DESCRIPTIONS);
    }
    extensions DESCRIPTIONS {
        KHR_xmp: Any, Idle;
        KHR_xmp_json_ld: Any, Idle;
    }
    object ACCESSOR {
        name: Text, Idle;
        bufferView: Whole;
        byteOffset: Whole;
        componentType: Whole;
        normalized: Flag;
        count: Whole;
        type: SHAPES;
        max: List, Idle;
        min: List, Idle;
        sparse: One(&SPARSE);
        extensions: One(&NO_EXTENSIONS);
    }
    object SPARSE {
        count: Whole;
        indices: One(&SPARSE_INDICES);
        values: One(&SPARSE_VALUES);
        extensions: One(&NO_EXTENSIONS);
    }
    object SPARSE_INDICES {
        bufferView: Whole;
        byteOffset: Whole;
        componentType: Whole;
        extensions: One(&NO_EXTENSIONS);
    }
    object SPARSE_VALUES {
        bufferView: Whole;
        byteOffset: Whole;
        extensions: One(&NO_EXTENSIONS);
    }
    object ANIMATION {
        name: Text;
        channels: Many(&CHANNEL);
        samplers: Many(&ANIMATION_SAMPLER);
        extensions: One(&NO_EXTENSIONS);
    }
    object CHANNEL {
        sampler: Whole;
        target: One(&CHANNEL_TARGET);
        extensions: One(&NO_EXTENSIONS);
    }
    object CHANNEL_TARGET {
        node: Whole;
        path: Text;
        extensions: One(&TARGET_EXTENSIONS);
    }
    extensions TARGET_EXTENSIONS {
        KHR_animation_pointer: One(&POINTER);
    }
    object POINTER {
        pointer: Text;
    }
    object ANIMATION_SAMPLER {
        input: Whole;
        output: Whole;
        interpolation: INTERPOLATIONS;
        extensions: One(&NO_EXTENSIONS);
    }
    object BUFFER {
        name: Text, Idle;
        uri: Text;
        byteLength: Whole;
        extensions: One(&BUFFER_EXTENSIONS);
    }
    extensions BUFFER_EXTENSIONS {
        EXT_meshopt_compression: Any, Idle;
        KHR_meshopt_compression: Any, Idle;
    }
    object BUFFER_VIEW {
        name: Text, Idle;
        buffer: Whole;
        byteOffset: Whole;
        byteLength: Whole;
        byteStride: Whole;
        target: Whole, Idle;
        extensions: One(&VIEW_EXTENSIONS);
    }
    extensions VIEW_EXTENSIONS {
        EXT_meshopt_compression: One(&COMPRESSED_VIEW);
        KHR_meshopt_compression: One(&COMPRESSED_VIEW);
    }
    object COMPRESSED_VIEW {
        buffer: Whole;
        byteOffset: Whole;
        byteLength: Whole;
        byteStride: Whole;
        count: Whole;
        mode: MODES;
        filter: FILTERS;
    }
    object CAMERA {
        name: Text;
        type: CAMERAS, Unused("its lens says what it is");
        perspective: One(&PERSPECTIVE);
        orthographic: One(&ORTHOGRAPHIC);
        extensions: One(&NO_EXTENSIONS);
    }
    object PERSPECTIVE {
        yfov: Number;
        aspectRatio: Number;
        znear: Number;
        zfar: Number;
        extensions: One(&NO_EXTENSIONS);
    }
    object ORTHOGRAPHIC {
        ymag: Number;
        xmag: Number;
        znear: Number;
        zfar: Number;
        extensions: One(&NO_EXTENSIONS);
    }
    object IMAGE {
        name: Text;
        uri: Text;
        bufferView: Whole;
        mimeType: Text, Idle;
        extensions: One(&NO_EXTENSIONS);
    }
    object MESH {
        name: Text;
        primitives: Many(&PRIMITIVE);
        weights: List;
        extensions: One(&NO_EXTENSIONS);
    }
    object PRIMITIVE {
        attributes: Attributes;
        indices: Whole;
        material: Whole;
        mode: Whole;
        targets: ManyAttributes;
        extensions: One(&PRIMITIVE_EXTENSIONS);
    }
    extensions PRIMITIVE_EXTENSIONS {
        KHR_materials_variants: One(&MAPPINGS);
        #[cfg(feature = "draco")]
        KHR_draco_mesh_compression: One(&COMPRESSED_PRIMITIVE);
        EXT_mesh_manifold: Any, Idle;
    }
    object MAPPINGS {
        mappings: Many(&MAPPING);
    }
    object MAPPING {
        name: Text, Idle;
        material: Whole;
        variants: Wholes;
    }
    #[cfg(feature = "draco")]
    object COMPRESSED_PRIMITIVE {
        bufferView: Whole;
        attributes: Attributes;
    }
    object NODE {
        name: Text;
        children: Wholes;
        matrix: Numbers(16);
        translation: Numbers(3);
        rotation: Numbers(4);
        scale: Numbers(3);
        mesh: Whole;
        camera: Whole;
        skin: Whole;
        weights: List;
        extensions: One(&NODE_EXTENSIONS);
    }
    extensions NODE_EXTENSIONS {
        KHR_lights_punctual: One(&NODE_LIGHT);
        EXT_mesh_gpu_instancing: One(&INSTANCING);
        KHR_node_visibility: One(&VISIBILITY);
    }
    object NODE_LIGHT {
        light: Whole;
    }
    object INSTANCING {
        attributes: Attributes;
    }
    object VISIBILITY {
        visible: Flag;
    }
    object SAMPLER {
        name: Text, Idle;
        magFilter: Whole;
        minFilter: Whole;
        wrapS: Whole;
        wrapT: Whole;
        extensions: One(&NO_EXTENSIONS);
    }
    object SCENE {
        name: Text;
        nodes: Wholes;
        extensions: One(&DESCRIPTIONS);
    }
    object SKIN {
        name: Text, Idle;
        inverseBindMatrices: Whole;
        joints: Wholes;
        skeleton: Whole, Idle;
        extensions: One(&NO_EXTENSIONS);
    }
    object TEXTURE {
        name: Text, Idle;
        sampler: Whole;
        source: Whole;
        extensions: One(&TEXTURE_EXTENSIONS);
    }
    extensions TEXTURE_EXTENSIONS {
        EXT_texture_webp: One(&TEXTURE_SOURCE);
        KHR_texture_basisu: One(&TEXTURE_SOURCE);
    }
    object TEXTURE_SOURCE {
        source: Whole;
    }
    object LIGHT_LIST {
        lights: Many(&LIGHT);
    }
    object LIGHT {
        name: Text;
        type: LIGHTS;
        color: Numbers(3);
        intensity: Number;
        range: Number, Unused("light falls off with the square of the distance and has no end");
        spot: One(&SPOT);
        extensions: One(&NO_EXTENSIONS);
    }
    object SPOT {
        innerConeAngle: Number;
        outerConeAngle: Number;
    }
    object VARIANT_LIST {
        variants: Many(&VARIANT);
    }
    object VARIANT {
        name: Text;
    }
}

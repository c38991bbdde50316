//! What a native scene may say. These types are the format: their docs are the JSON Schema's
//! descriptions, so they speak to whoever writes a scene.

use super::values::{
    AttenuationName, AxisAngle, Color, Count, Direction, NonNegative, Positive, Scale, Size, Stops,
    ToneName, TransferName, Vector, ViewAngle, elements,
};
use glam::{DVec3, Vec3};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;
use toml::Spanned;

/// A glimray scene. Right-handed, +Y up; lengths in metres or any one unit; colours are linear
/// `[r, g, b]` or sRGB `"#rrggbb"`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "glimray scene")]
pub(super) struct SceneFile {
    /// The picture: its size, samples and tone. Flags of the command line win over it.
    #[serde(default)]
    pub output: OutputTable,
    /// What rays see that hit nothing. Black if left out.
    #[serde(default = "black")]
    pub background: Color,
    /// Light that is everywhere, multiplied by the ambient coefficient of a material. None if left
    /// out.
    #[serde(default = "black")]
    pub ambient: Color,
    /// The camera. If there is none at all, one is placed that sees everything.
    #[schemars(with = "Option<CameraTable>")]
    pub camera: Option<Spanned<CameraTable>>,
    /// Several cameras, chosen by `--camera NAME`; the first is the default.
    #[serde(default)]
    #[schemars(with = "Vec<CameraTable>")]
    pub cameras: Vec<Spanned<CameraTable>>,
    /// Materials by name.
    #[serde(default)]
    pub materials: BTreeMap<String, MaterialTable>,
    /// The surfaces.
    #[serde(default)]
    #[schemars(with = "Vec<ObjectTable>")]
    pub objects: Vec<Spanned<ObjectTable>>,
    /// The lights.
    #[serde(default)]
    #[schemars(with = "Vec<LightTable>")]
    pub lights: Vec<Spanned<LightTable>>,
}

/// The picture.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct OutputTable {
    /// Width and height in pixels; [640, 480] if left out.
    pub size: Size,
    /// Samples per pixel; 1 if left out.
    pub samples: Count,
    /// Exposure in stops, before the tone curve; 0 if left out.
    pub exposure_ev: Stops,
    /// The tone curve; none if left out.
    pub tone: ToneName,
    /// The transfer function of stored values; srgb if left out.
    pub transfer: TransferName,
}

impl Default for OutputTable {
    fn default() -> Self {
        Self {
            size: Size([640, 480]),
            samples: Count(1),
            exposure_ev: Stops(0.0),
            tone: ToneName::None,
            transfer: TransferName::Srgb,
        }
    }
}

/// A pinhole camera.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraTable {
    /// The name for `--camera`.
    #[serde(default)]
    pub name: String,
    /// Where it stands.
    pub look_from: Vector,
    /// What is in the middle of the picture.
    #[schemars(with = "Vector")]
    pub look_at: Spanned<Vector>,
    /// What is upwards in the picture; [0, 1, 0] if left out.
    #[schemars(with = "Option<Direction>")]
    pub up: Option<Spanned<Direction>>,
    /// The vertical angle of view in degrees; 60 if left out.
    #[serde(default = "sixty")]
    pub fov_y_deg: ViewAngle,
}

/// How a surface answers light.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct MaterialTable {
    /// Phong coefficients.
    pub phong: PhongTable,
    /// Whether both sides are lit alike (true if left out), or only the one the normal points to.
    pub two_sided: bool,
}

impl Default for MaterialTable {
    fn default() -> Self {
        Self {
            phong: PhongTable::default(),
            two_sided: true,
        }
    }
}

/// Phong coefficients.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct PhongTable {
    /// The colour of the surface; light grey if left out.
    pub diffuse: Color,
    /// The colour of highlights; none if left out.
    pub specular: Color,
    /// The exponent of highlights: the higher, the smaller; 32 if left out.
    pub shininess: NonNegative,
    /// What the ambient light is multiplied by; the diffuse colour if left out.
    pub ambient: Option<Color>,
}

impl Default for PhongTable {
    fn default() -> Self {
        Self {
            diffuse: Color(Vec3::splat(0.8)),
            specular: Color(Vec3::ZERO),
            shininess: NonNegative(32.0),
            ambient: None,
        }
    }
}

/// One surface: exactly one of sphere, plane, triangle and mesh.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectTable {
    /// A sphere.
    pub sphere: Option<SphereTable>,
    /// An infinite plane.
    pub plane: Option<PlaneTable>,
    /// A triangle.
    pub triangle: Option<Box<TriangleTable>>,
    /// The triangles of an OBJ file.
    pub mesh: Option<MeshTable>,
    /// The name of a material, or a material. Light grey if left out, or what the mesh file says.
    #[schemars(with = "Option<MaterialRef>")]
    pub material: Option<Spanned<MaterialRef>>,
    /// Where to put it.
    #[schemars(with = "Option<TransformTable>")]
    pub transform: Option<Spanned<TransformTable>>,
    /// Whether it is in the scene at all (true if left out).
    #[serde(default = "yes")]
    pub visible: bool,
}

/// A sphere.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereTable {
    /// Its centre.
    pub center: Vector,
    /// Its radius, greater than 0.
    pub radius: Positive,
}

/// An infinite plane.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaneTable {
    /// Any point on it.
    pub point: Vector,
    /// The direction it faces; [0, 1, 0] if left out.
    #[serde(default = "upwards")]
    pub normal: Direction,
}

/// A triangle.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TriangleTable {
    /// Its three corners.
    #[serde(deserialize_with = "three")]
    pub vertices: [Vector; 3],
    /// The normals at its corners, for smooth shading; flat if left out.
    #[serde(default, deserialize_with = "maybe_three")]
    pub normals: Option<[Direction; 3]>,
    /// Names of the materials at its corners, which blend in between, in place of `material`.
    #[serde(default, deserialize_with = "maybe_three")]
    #[schemars(with = "Option<[String; 3]>")]
    pub materials: Option<[Spanned<String>; 3]>,
}

/// The triangles of a file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshTable {
    /// The path of an OBJ file, from the scene's folder downwards.
    #[schemars(with = "String")]
    pub file: Spanned<String>,
}

/// Scaled first, then rotated, then moved.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct TransformTable {
    /// How far to move it.
    pub translate: Vector,
    /// Degrees to turn it round the x, then the y, then the z axis of the world,
    /// counter-clockwise when the axis points at you.
    pub rotate_deg: Vector,
    /// A factor for all axes, or one for each; not 0, negative ones mirror.
    pub scale: Scale,
}

impl Default for TransformTable {
    fn default() -> Self {
        Self {
            translate: Vector(DVec3::ZERO),
            rotate_deg: Vector(DVec3::ZERO),
            scale: Scale(DVec3::ONE),
        }
    }
}

/// One light: exactly one of point, directional and spot.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LightTable {
    /// Shines from a point to all sides.
    pub point: Option<PointTable>,
    /// Shines along one direction everywhere, like the sun.
    pub directional: Option<DirectionalTable>,
    /// Shines from a point into a cone.
    pub spot: Option<SpotTable>,
}

/// A point light.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PointTable {
    /// Where it is.
    pub position: Vector,
    /// Its colour; white if left out.
    #[serde(default = "white")]
    pub color: Color,
    /// What the colour is multiplied by; 1 if left out.
    #[serde(default = "one")]
    pub intensity: NonNegative,
    /// How it fades with distance; inverse-square if left out.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

/// A light at infinity.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct DirectionalTable {
    /// Where its light goes.
    pub direction: Direction,
    /// Its colour; white if left out.
    #[serde(default = "white")]
    pub color: Color,
    /// What the colour is multiplied by; 1 if left out.
    #[serde(default = "one")]
    pub intensity: NonNegative,
}

/// A spot light.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SpotTable {
    /// Where it is.
    pub position: Vector,
    /// What its axis goes through.
    #[schemars(with = "Vector")]
    pub look_at: Spanned<Vector>,
    /// Degrees off the axis up to which it has its full strength; 80 % of `outer_deg` if left out.
    #[schemars(with = "Option<AxisAngle>")]
    pub inner_deg: Option<Spanned<AxisAngle>>,
    /// Degrees off the axis from which on it is dark; 30 if left out.
    #[serde(default = "thirty")]
    pub outer_deg: AxisAngle,
    /// Its colour; white if left out.
    #[serde(default = "white")]
    pub color: Color,
    /// What the colour is multiplied by; 1 if left out.
    #[serde(default = "one")]
    pub intensity: NonNegative,
    /// How it fades with distance; inverse-square if left out.
    #[serde(default)]
    pub attenuation: AttenuationName,
}

/// The name of a material, or a material.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(super) enum MaterialRef {
    Name(String),
    Inline(MaterialTable),
}

impl<'de> Deserialize<'de> for MaterialRef {
    // By hand: serde's untagged enums lose the place of an error.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrTable;
        impl<'de> Visitor<'de> for NameOrTable {
            type Value = MaterialRef;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the name of a material, or a table")
            }
            fn visit_str<E: de::Error>(self, name: &str) -> Result<MaterialRef, E> {
                Ok(MaterialRef::Name(name.to_owned()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialRef, A::Error> {
                let table = de::value::MapAccessDeserializer::new(map);
                MaterialTable::deserialize(table).map(MaterialRef::Inline)
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}

// Serde's own arrays ignore elements beyond the last.
fn three<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<[T; 3], D::Error> {
    elements(from, "three elements, one for each corner")
}

fn maybe_three<'de, T, D>(from: D) -> Result<Option<[T; 3]>, D::Error>
where
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    three(from).map(Some)
}

fn black() -> Color {
    Color(Vec3::ZERO)
}

fn white() -> Color {
    Color(Vec3::ONE)
}

fn one() -> NonNegative {
    NonNegative(1.0)
}

fn sixty() -> ViewAngle {
    ViewAngle(60.0)
}

fn thirty() -> AxisAngle {
    AxisAngle(30.0)
}

fn upwards() -> Direction {
    Direction(DVec3::Y)
}

fn yes() -> bool {
    true
}

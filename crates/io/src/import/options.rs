//! Options for importing a scene or model file.

use glam::{DAffine3, DMat3, DVec3};
use glimray_scene::{BuiltIn, LightTransport};
use std::num::NonZero;
use std::ops::Neg;
use std::path::PathBuf;

/// Options for importing a scene file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Folders besides the scene's own whose files the scene may refer to, for [`super::load_with`].
    pub allow_dirs: Vec<PathBuf>,
    /// `KEY=VALUE` pairs. Each replaces or adds one value of a native scene, such as
    /// `camera.fov_y_deg=30`, `objects.0.sphere.radius=2` or `output.tone=aces`. Values are TOML; a bare
    /// word is a string.
    pub overrides: Vec<String>,
    /// The scene of a glTF model to import, by its name or number; `None` is the model's default.
    pub scene: Option<String>,
    /// The clip of a glTF model to play, by its name or number; `None` is all that fit together.
    pub clip: Option<String>,
    /// The variant of a glTF model's materials, by its name or number; `None` is the model's default.
    pub variant: Option<String>,
    /// The axis of a model that points up; `None` for the usual one of its format: +Z in STL, otherwise
    /// +Y. Scenes that are not models ignore it.
    pub up: Option<Axis>,
    /// The longest side that pictures of textures and backgrounds may have, in texels: larger ones are halved until
    /// they fit, which [`glimray_scene::Scene::skipped`] reports. `None` is no limit.
    pub texture_limit: Option<NonZero<u32>>,
    /// Width and height of the picture that a model without a camera is framed for; `None` for the scene's
    /// own size.
    pub size: Option<(u32, u32)>,
    /// The integrator that the scene will be rendered with; `None` for the scene's own. [`Self::environment`] takes the
    /// place of added lamps where paths are traced.
    pub integrator: Option<LightTransport>,
    /// Whether the classical colours of materials with several maps are computed.
    pub baking: Baking,
    /// Parts of a studio added to a model that lacks them.
    pub staging: Staging,
    /// Replaces or changes the background.
    pub environment: Environment,
    /// Whether a model whose name has no known extension is told by its contents, for [`super::load_with`].
    pub by_content: bool,
    /// The text that an empty native file stands for; `None` refuses it.
    pub instead_of_empty: Option<&'static str>,
}

/// Whether [`glimray_scene::Scene::bake_classical_maps`] is called. Only classical shading shows the result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Baking {
    /// No.
    #[default]
    Never,
    /// If the scene's own integrator is classical.
    IfClassical,
    /// Yes.
    Always,
}

/// A replacement or change of a scene's background.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Environment {
    /// Replaces the background; `None` keeps it.
    pub source: Option<EnvironmentSource>,
    /// Factor on the radiance of the background, 0 or more; `None` is 1.
    pub strength: Option<f32>,
    /// Turns the picture of the background about +Y, in degrees, counter-clockwise seen from above.
    pub rotation_deg: Option<f64>,
}

/// Where the picture of an environment comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum EnvironmentSource {
    /// An equirectangular picture: PNG, JPEG, WebP, HDR or EXR.
    File(PathBuf),
    /// The clear sky of [`glimray_scene::sky`].
    Sky {
        /// Angle of the sun above the horizon in degrees, 0 to 90.
        elevation_deg: f64,
        /// Angle of the sun from −Z towards +X in degrees.
        azimuth_deg: f64,
    },
    /// A built-in environment.
    BuiltIn(BuiltIn),
}

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// +X.
    X,
    /// +Y.
    Y,
    /// +Z.
    Z,
}

impl Axis {
    /// The rotation from axes in which `self` points up to axes in which +Y does.
    pub fn turn(self) -> DAffine3 {
        let turned = |axis: DVec3| DVec3::from(self.upright(axis.to_array()));
        let axes = DMat3::from_cols(turned(DVec3::X), turned(DVec3::Y), turned(DVec3::Z));
        DAffine3::from_mat3(axes)
    }

    /// Turns a vector from axes in which `self` points up to axes in which +Y does.
    pub fn upright<T: Neg<Output = T>>(self, [x, y, z]: [T; 3]) -> [T; 3] {
        match self {
            Self::X => [-y, x, z],
            Self::Y => [x, y, z],
            Self::Z => [x, z, -y],
        }
    }
}

/// The studio that a model is shown in. Each part is added only where the model has none of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Staging {
    /// A camera that frames the model, also if its own see nothing that is lit. Without it the camera is at the origin and
    /// looks along −Z.
    pub camera: bool,
    /// That camera in place of the model's own.
    pub fit: bool,
    /// Lamps and ambient light, also if the model's own lights are weak.
    pub lights: bool,
    /// A gradient behind the model, whose light is a part of that of the studio; black without it.
    pub background: bool,
    /// A ground below the model.
    pub ground: Ground,
}

/// The ground below a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// There is none.
    None,
    /// A surface that receives the model's shadow, if the model has no lights or weak ones.
    Default,
    /// That surface in any case.
    Surface,
    /// A shadow catcher in any case, and a transparent background: see [`glimray_scene::Material::shadow_catcher`].
    Shadow,
}

impl Staging {
    /// Nothing is added.
    pub const NONE: Self = Self {
        camera: false,
        fit: false,
        lights: false,
        background: false,
        ground: Ground::None,
    };
}

impl Default for Staging {
    /// Everything is added.
    fn default() -> Self {
        Self {
            camera: true,
            fit: false,
            lights: true,
            background: true,
            ground: Ground::Default,
        }
    }
}

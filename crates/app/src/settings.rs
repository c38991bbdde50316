//! The render settings that a user may override, one row each. The command line, what overrides resolve to, the flags
//! without effect, the report, the window's panel and its copied command lines follow from the rows.

use super::value_forms::{CROP, Control, Count, Form, Limit, OFFSET, Real, SIZE, Switch};
use super::value_names::{ANTIALIAS, BSDF_MODELS, FILTERS, INTEGRATORS, TRIANGLE_TESTS};
use glimray_render::{Antialias, BsdfModel, Integrator, RayOffset, RenderSettings, TriangleTest};
use glimray_scene::Filter;

/// A setting as users see it.
pub struct Setting {
    /// The name of its member in [`RenderSettings`], and in reports.
    pub name: &'static str,
    /// The flag.
    pub flag: &'static str,
    /// The placeholder of the flag's value in the help; empty for switches.
    pub value: &'static str,
    /// The help of the flag in one sentence: range and default too.
    pub help: &'static str,
    /// The paragraph that the long help adds.
    pub details: &'static str,
    /// The setting in the middle of a sentence.
    pub noun: &'static str,
    /// The other setting that must have a certain value, else this one has no effect.
    pub scope: Option<Scope>,
    /// Whether the defaults of earlier rows depend on it.
    pub leads: bool,
    /// Whether it is in reports.
    pub is_reported: bool,
    /// The row in the window's panel; `None` if there is none, or one of its own.
    pub row: Option<Row>,
    /// How it is edited.
    pub control: fn() -> Control,
    /// The value as the flag takes it; `None` if only the absence of the flag says it.
    pub text: fn(&RenderSettings) -> Option<String>,
    /// Overrides it with the flag's value.
    pub give: fn(&mut PictureOverrides, &str) -> Result<(), String>,
    /// Whether it is overridden.
    pub is_given: fn(&PictureOverrides) -> bool,
    /// Copies it from the first settings to the second.
    pub copy: fn(&RenderSettings, &mut RenderSettings),
}

/// The value of another setting without which a setting has no effect.
pub struct Scope {
    /// The flag of the other setting.
    pub flag: &'static str,
    /// The name of the value.
    pub value: &'static str,
    /// The name of such pictures, in the middle of a sentence.
    pub noun: &'static str,
}

/// A row in the window's panel.
pub struct Row {
    /// The section.
    pub section: Section,
    /// The label.
    pub label: &'static str,
    /// By how much a number changes when it is dragged by a point.
    pub speed: f64,
    /// The unit after a number.
    pub unit: &'static str,
}

/// A section of the window's panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// Samples of a pixel.
    Sampling,
    /// Rays of a sample.
    Rays,
}

const PATHS: Option<Scope> = Some(Scope {
    flag: "--integrator",
    value: "path",
    noun: "paths",
});

const ADAPTIVE: Option<Scope> = Some(Scope {
    flag: "--antialias",
    value: "adaptive",
    noun: "adaptive sampling",
});

/// A row of the panel that is no number.
const fn row(section: Section, label: &'static str) -> Option<Row> {
    dragged(section, label, 0.0, "")
}

/// A row of the panel with a number.
const fn dragged(
    section: Section,
    label: &'static str,
    speed: f64,
    unit: &'static str,
) -> Option<Row> {
    Some(Row {
        section,
        label,
        speed,
        unit,
    })
}

/// Declares [`SETTINGS`] and [`PictureOverrides`] from rows: `member: type, form { columns }`.
macro_rules! settings {
    ($($name:ident: $type:ty, $form:expr, { $($column:ident: $value:expr),+ $(,)? })+) => {
        /// The settings of a picture that a user has chosen; others are the scene's, or have their default.
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct PictureOverrides {
            $(#[doc = concat!("See [`RenderSettings::", stringify!($name), "`].")] pub $name: Option<$type>,)+
            /// Keep features in the film, to denoise it; without a choice where the scene is denoised.
            pub denoise: Option<bool>,
        }

        impl PictureOverrides {
            /// Changes the settings that are overridden.
            pub fn apply(&self, settings: &mut RenderSettings) {
                $(settings.$name = self.$name.unwrap_or(settings.$name);)+
            }
        }

        /// All settings, in the order of the help.
        pub const SETTINGS: &[Setting] = &[$(Setting {
            $($column: $value,)+
            name: stringify!($name),
            control: || $form.control(|settings| &mut settings.$name),
            text: |settings| $form.write(&settings.$name),
            give: |overrides, text| {
                overrides.$name = Some($form.read(text)?);
                Ok(())
            },
            is_given: |overrides| overrides.$name.is_some(),
            copy: |from, to| to.$name = from.$name,
            ..Setting::EMPTY
        }),+];
    };
}

settings! {
    size: (u32, u32), SIZE, {
        flag: "--size", value: "WxH", noun: "the size",
        help: "Width and height in pixels [default: the scene's, else 640x480; 800x600 for models]",
    }
    samples: u32, Count(1..=65_536), {
        flag: "--samples", value: "N", noun: "the samples",
        help: "Samples per pixel, 1 to 65536 [default: the scene's; 8 of models, which are denoised, also with more; else \
            64 for --integrator path, 16 with a lens, an area light or motion blur; else 1]",
        is_reported: true, row: dragged(Section::Sampling, "Samples", 0.25, ""),
    }
    antialias: Antialias, ANTIALIAS, {
        flag: "--antialias", value: "ANTIALIAS", noun: "the sample placement",
        help: "Distribution of the samples within a pixel [default: stratified for more than one sample, else none]",
        row: row(Section::Sampling, "Antialias"),
    }
    noise: f32, Real(1e-6..=1.0), {
        flag: "--noise", value: "NOISE", noun: "the noise limit",
        help: "Noise threshold of adaptive sampling, 0.000001 to 1 [default: the scene's, else 0.01]",
        details: "Keep sampling pixels whose estimated error exceeds this (or, early on, whose neighbour differs by more). \
            Errors are measured on the square root of luminance, where 1 is white.",
        scope: ADAPTIVE, row: dragged(Section::Sampling, "Noise", 0.0005, ""),
    }
    max_depth: u32, Count(0..=1000), {
        flag: "--max-depth", value: "N", noun: "the depth",
        help: "Bounces after the first hit, 0 to 1000; 0 is local shading only [default: the scene's, else 5; 0 for .scene; \
            16 for --integrator path; 8 for models by --integrator whitted]",
        is_reported: true, row: dragged(Section::Rays, "Max depth", 0.05, ""),
    }
    min_throughput: f32, Real(0.0..=1.0), {
        flag: "--min-throughput", value: "FRACTION", noun: "the minimum throughput",
        help: "Terminate reflection and refraction rays below this throughput, 0 to 1 [default: 1/512]",
        row: dragged(Section::Rays, "Min throughput", 0.0005, ""),
    }
    transparent_shadows: bool, Switch, {
        flag: "--transparent-shadows", noun: "transparent shadows",
        help: "Path tracing: let all glass filter shadow rays in straight lines, which loses caustics",
        details: "Without it smooth thin walls do so, and paths find the light behind other glass.",
        scope: PATHS, is_reported: true, row: row(Section::Rays, "Clear shadows"),
    }
    bsdf: BsdfModel, BSDF_MODELS, {
        flag: "--bsdf", value: "BSDF", noun: "the way materials scatter",
        help: "How metallic-roughness materials scatter in path-traced pictures [default: full]",
        scope: PATHS, is_reported: true, row: row(Section::Rays, "Scattering"),
    }
    clamp_indirect: Option<f32>, Limit(1e-6..=1e6), {
        flag: "--clamp-indirect", value: "RADIANCE", noun: "the clamp of indirect light",
        help: "Path tracing: clamp what a sample gains at once from indirect light to this radiance, above 0 to 1e6 \
            [default: no limit]",
        details: "It removes fireflies, and light: the report's energy_cut says how much.",
        scope: PATHS, is_reported: true, row: dragged(Section::Rays, "Clamp indirect", 0.1, ""),
    }
    filter: Filter, FILTERS, {
        flag: "--filter", value: "FILTER", noun: "the filter",
        help: "Reconstruction filter [default: the scene's, else box]",
        row: row(Section::Sampling, "Filter"),
    }
    filter_radius: f32, Real(0.01..=16.0), {
        flag: "--filter-radius", value: "PIXELS", noun: "the filter's radius",
        help: "Radius of the reconstruction filter, 0.01 to 16 [default: box 0.5, tent 1, mitchell 2, others 1.5]",
        row: dragged(Section::Sampling, "Filter radius", 0.01, " px"),
    }
    light_samples: f32, Real(0.001..=1000.0), {
        flag: "--light-samples", value: "FACTOR", noun: "the light samples",
        help: "Multiply the sample count of every area light by this, 0.001 to 1000 [default: the scene's, else 1]",
        row: dragged(Section::Sampling, "Light samples", 0.02, " ×"),
    }
    integrator: Integrator, INTEGRATORS, {
        flag: "--integrator", value: "INTEGRATOR", noun: "the integrator",
        help: "Integrator or debug view [default: the scene's, else path for models and whitted for scenes]",
        leads: true, is_reported: true,
    }
    triangle_test: TriangleTest, TRIANGLE_TESTS, {
        flag: "--triangle-test", value: "TRIANGLE_TEST", noun: "the triangle test",
        help: "Ray–triangle intersection algorithm [default: watertight]",
        row: row(Section::Rays, "Triangle test"),
    }
    offset: RayOffset, OFFSET, {
        flag: "--offset", value: "bound|fixed:EPS", noun: "the ray offset",
        help: "Origin of reflected, refracted and shadow rays: bound or fixed:EPS",
        details: "bound moves it by the rounding error of the hit point. fixed:EPS moves it by EPS along the normal, which \
            shows shadow acne where EPS is too small, and light leaks and missing contact shadows where it is too large \
            [default: bound]",
    }
    brute_force: bool, Switch, {
        flag: "--no-bvh", noun: "brute force",
        help: "Test every primitive for every ray instead of traversing the BVH: the same picture, but slow",
        row: row(Section::Rays, "Brute force"),
    }
    seed: u32, Count(0..=u32::MAX), {
        flag: "--seed", value: "N", noun: "the seed",
        help: "Random seed; the same scene, settings and seed give the same picture [default: 0]",
        is_reported: true, row: dragged(Section::Sampling, "Seed", 0.1, ""),
    }
    crop: Option<[u32; 4]>, CROP, {
        flag: "--crop", value: "X0,Y0,X1,Y1", noun: "the region",
        help: "Render only columns X0 to X1-1 and rows Y0 to Y1-1, in pixels from the top left",
    }
}

impl Setting {
    const EMPTY: Self = Self {
        name: "",
        flag: "",
        value: "",
        help: "",
        details: "",
        noun: "",
        scope: None,
        leads: false,
        is_reported: false,
        row: None,
        control: || Control::Text,
        text: |_| None,
        give: |_, _| Ok(()),
        is_given: |_| false,
        copy: |_, _| {},
    };

    /// The setting with this flag.
    pub fn of(flag: &str) -> Option<&'static Self> {
        SETTINGS.iter().find(|setting| setting.flag == flag)
    }

    /// The first part of the help, without the default.
    pub fn tip(&self) -> &'static str {
        let (tip, _) = self.help.split_once(" [default").unwrap_or((self.help, ""));
        tip
    }

    /// Whether the setting has an effect on a picture with these settings.
    pub fn applies(&self, settings: &RenderSettings) -> bool {
        let scope = self.scope.as_ref();
        scope.is_none_or(|scope| scope.found(settings).as_deref() == Some(scope.value))
    }

    /// Sets it to the flag's value.
    ///
    /// # Errors
    /// Why the flag takes no such value.
    pub fn set(&self, settings: &mut RenderSettings, text: &str) -> Result<(), String> {
        let mut overrides = PictureOverrides::default();
        (self.give)(&mut overrides, text)?;
        overrides.apply(settings);
        Ok(())
    }
}

impl Scope {
    /// The value that the other setting has.
    pub fn found(&self, settings: &RenderSettings) -> Option<String> {
        Setting::of(self.flag).and_then(|setting| (setting.text)(settings))
    }
}

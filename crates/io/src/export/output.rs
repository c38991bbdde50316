//! The defaults of pictures, and the background.

use super::pictures::Role;
use super::{ExportError, Writer, exact};
use crate::import::native::file::{
    BackgroundTable, ColorOrBackground, OutputTable, SkyTable, Spanned,
};
use crate::import::native::values::{Angle, BackdropValue, Number, Size, differing};
use glam::Vec3;
use glimray_scene::{Background, BuiltIn, Origin, OutputDefaults, Pattern, sky};

impl Writer<'_> {
    pub fn background(&mut self) -> Result<Option<Spanned<ColorOrBackground>>, ExportError> {
        let table = match self.scene.background {
            Background::Color(color) => {
                let color = differing(color, Vec3::ZERO).map(ColorOrBackground::Color);
                return Ok(color.map(Into::into));
            }
            Background::Gradient { bottom, top } => BackgroundTable {
                bottom: Some(bottom.into()),
                top: Some(top.into()),
                ..BackgroundTable::default()
            },
            Background::Picture {
                picture,
                strength,
                rotation,
            } => {
                let (degrees, radians) = exact::angle(rotation, |degrees| degrees.abs() < 360.0);
                let table = BackgroundTable {
                    strength: differing(strength, 1.0),
                    rotation_deg: differing(degrees.unwrap_or(0.0), 0.0),
                    rotation: radians.map(Number),
                    ..BackgroundTable::default()
                };
                self.environment(picture, table)?
            }
        };
        let background = match table {
            BackgroundTable {
                environment: Some(name),
                strength: None,
                rotation_deg: None,
                rotation: None,
                ..
            } => ColorOrBackground::Name(name),
            table => ColorOrBackground::Table(Box::new(table)),
        };
        Ok(Some(background.into()))
    }

    /// `table` with the picture of the background.
    fn environment(
        &mut self,
        picture: usize,
        table: BackgroundTable,
    ) -> Result<BackgroundTable, ExportError> {
        // Textures write their images first: this image may be among them, under the same name.
        for texture in &self.scene.textures {
            if let Pattern::Picture { picture, .. } = texture.pattern {
                self.picture(picture, self.role(picture))?;
            }
        }
        let shown = &self.scene.pictures[picture];
        Ok(match (BuiltIn::of(shown), &shown.origin) {
            (Some(environment), _) => BackgroundTable {
                environment: Some(environment.into()),
                ..table
            },
            (None, &Origin::Sky { elevation, azimuth }) => BackgroundTable {
                sky: Some(sky(elevation, azimuth).into()),
                ..table
            },
            (None, _) => BackgroundTable {
                picture: Some(self.picture(picture, Role::Color)?.into()),
                ..table
            },
        })
    }

    pub fn output(&self) -> OutputTable {
        let plain = OutputDefaults::default();
        let OutputDefaults {
            size,
            integrator,
            samples,
            antialias,
            filter,
            filter_radius,
            noise,
            light_samples,
            max_depth,
            exposure_ev,
            auto_exposure,
            tone,
            path_tone,
            transfer,
            fps,
            duration,
            shutter,
            backdrop,
            denoise,
        } = self.scene.output.clone();
        OutputTable {
            size: (size != plain.size).then(|| Size(size.into())),
            integrator: differing(integrator, plain.integrator),
            samples: differing(samples, self.scene.default_samples()),
            antialias: antialias.map(Into::into),
            noise: differing(noise, plain.noise),
            max_depth: differing(max_depth, integrator.max_depth()),
            filter: differing(filter, plain.filter),
            filter_radius: filter_radius.map(Into::into),
            light_samples: differing(light_samples, plain.light_samples),
            exposure_ev: differing(exposure_ev, plain.exposure_ev),
            auto_exposure: auto_exposure.then_some(true),
            tone: tone.map(Into::into),
            path_tone: differing(path_tone, plain.path_tone),
            transfer: differing(transfer, plain.transfer),
            fps: differing(fps, plain.fps),
            duration: duration.map(Into::into),
            shutter: differing(
                [shutter.open, shutter.close],
                [plain.shutter.open, plain.shutter.close],
            ),
            denoise: denoise.then_some(true),
            backdrop: BackdropValue::of(backdrop),
        }
    }
}

/// The place of the sun, in the nearest degrees.
fn sky(elevation: f64, azimuth: f64) -> SkyTable {
    let degrees = |radians: f64, default| {
        let near = exact::degrees(radians).unwrap_or_else(|| radians.to_degrees());
        differing::<_, Angle>(near, default)
    };
    SkyTable {
        elevation_deg: degrees(elevation, sky::SUN_ELEVATION_DEG),
        azimuth_deg: degrees(azimuth, sky::SUN_AZIMUTH_DEG),
    }
}

//! Scene-wide settings: output, background, ambient light and shadows.

use super::pictures::Role;
use super::text::{Table, color, list, number, number32};
use super::{ExportError, Writer, exact};
use glam::Vec3;
use glimray_scene::{
    Antialias, Backdrop, Background, Filter, LightTransport, Origin, OutputDefaults, Shadows,
    ToneCurve, Transfer, sky,
};

impl Writer<'_> {
    /// Keys outside of tables.
    pub fn root(&mut self) -> Result<(), ExportError> {
        let scene = self.scene;
        let mut table = Table::default();
        let is_black = |c: Vec3| c.to_array().iter().all(|x| x.to_bits() == 0);
        match &scene.background {
            Background::Color(plain) => {
                table.put_if(!is_black(*plain), "background", color(*plain))
            }
            Background::Gradient { bottom, top } => {
                let mut inner = Table::default();
                inner.put("bottom", color(*bottom));
                inner.put("top", color(*top));
                table.put("background", inner.inline());
            }
            Background::Picture { .. } => table.put("background", self.background_picture()?),
        }
        table.put_if(!is_black(scene.ambient), "ambient", color(scene.ambient));
        let is_filtered = scene.shadows == Shadows::Filtered;
        table.put_if(is_filtered, "shadows", "\"filtered\"");
        table.put_if(scene.staged, "staged", "true");
        if !table.is_empty() {
            self.text.gap();
            self.text.lines(&table);
        }
        Ok(())
    }

    fn background_picture(&mut self) -> Result<String, ExportError> {
        let Background::Picture {
            picture,
            strength,
            rotation,
        } = self.scene.background
        else {
            return Ok(String::new());
        };
        let mut table = Table::default();
        // Textures write their images first: this image may be among them, under the same name.
        for texture in &self.scene.textures {
            if let glimray_scene::Pattern::Picture { picture, .. } = texture.pattern {
                self.picture(picture, self.role(picture))?;
            }
        }
        match sky(&self.scene.pictures[picture].origin) {
            Some(sky) => {
                if sky.is_empty() && strength == 1.0 && rotation.to_bits() == 0 {
                    return Ok("\"sky\"".to_owned());
                }
                table.put("sky", sky.inline());
            }
            None => table.put("picture", self.picture(picture, Role::Color)?),
        }
        table.put_if(strength != 1.0, "strength", number32(strength));
        if rotation.to_bits() != 0 {
            let degrees = exact::degrees(rotation).filter(|degrees| degrees.abs() < 360.0);
            match degrees {
                Some(degrees) => table.put("rotation_deg", number(degrees)),
                None => table.put("rotation", number(rotation)),
            }
        }
        Ok(table.inline())
    }

    pub fn output(&mut self) {
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
        let mut table = Table::default();
        let size_text = list([size.0.to_string(), size.1.to_string()]);
        table.put_if(size != plain.size, "size", size_text);
        let is_path = integrator == LightTransport::Path;
        table.put_if(is_path, "integrator", "\"path\"");
        let is_said = samples != self.scene.default_samples();
        table.put_if(is_said, "samples", samples.to_string());
        if let Some(antialias) = antialias {
            table.put(
                "antialias",
                match antialias {
                    Antialias::None => "\"none\"",
                    Antialias::Stratified => "\"stratified\"",
                    Antialias::Adaptive => "\"adaptive\"",
                },
            );
        }
        table.put_if(denoise, "denoise", "true");
        table.put_if(noise != plain.noise, "noise", number32(noise));
        table.put_if(
            max_depth != integrator.max_depth(),
            "max_depth",
            max_depth.to_string(),
        );
        table.put_if(
            filter != plain.filter,
            "filter",
            match filter {
                Filter::Box => "\"box\"",
                Filter::Tent => "\"tent\"",
                Filter::Gaussian => "\"gaussian\"",
                Filter::BlackmanHarris => "\"blackman-harris\"",
                Filter::Mitchell => "\"mitchell\"",
            },
        );
        if let Some(radius) = filter_radius {
            table.put("filter_radius", number32(radius));
        }
        let factor = number32(light_samples);
        table.put_if(
            light_samples != plain.light_samples,
            "light_samples",
            factor,
        );
        table.put_if(
            exposure_ev != plain.exposure_ev,
            "exposure_ev",
            number32(exposure_ev),
        );
        table.put_if(auto_exposure, "auto_exposure", "true");
        if let Some(tone) = tone {
            table.put("tone", tone_name(tone));
        }
        let path_name = tone_name(path_tone);
        table.put_if(path_tone != plain.path_tone, "path_tone", path_name);
        table.put_if(
            transfer != plain.transfer,
            "transfer",
            match transfer {
                Transfer::Srgb => "\"srgb\"",
                Transfer::Linear => "\"linear\"",
            },
        );
        table.put_if(fps != plain.fps, "fps", number(fps));
        if let Some(duration) = duration {
            table.put("duration", number(duration));
        }
        if shutter.open == 0.0 {
            table.put_if(shutter.close != 0.0, "shutter", number(shutter.close));
        } else {
            table.put(
                "shutter",
                list([number(shutter.open), number(shutter.close)]),
            );
        }
        match backdrop {
            Backdrop::Background => {}
            Backdrop::Color(plain) => table.put("backdrop", color(plain)),
            Backdrop::Transparent => table.put("backdrop", "\"transparent\""),
        }
        if !table.is_empty() {
            self.text.gap();
            self.text.head("[output]");
            self.text.lines(&table);
        }
    }
}

/// The place of the sun in a sky, in the nearest degrees; `None` if the picture is another one.
fn sky(origin: &Origin) -> Option<Table> {
    let Origin::Sky { elevation, azimuth } = *origin else {
        return None;
    };
    let mut table = Table::default();
    for (key, radians, default) in [
        ("elevation_deg", elevation, sky::SUN_ELEVATION_DEG),
        ("azimuth_deg", azimuth, sky::SUN_AZIMUTH_DEG),
    ] {
        let degrees = exact::degrees(radians).unwrap_or_else(|| radians.to_degrees());
        table.put_if(degrees != default, key, number(degrees));
    }
    Some(table)
}

fn tone_name(tone: ToneCurve) -> &'static str {
    match tone {
        ToneCurve::None => "\"none\"",
        ToneCurve::Aces => "\"aces\"",
        ToneCurve::Agx => "\"agx\"",
        ToneCurve::Reinhard => "\"reinhard\"",
        ToneCurve::Neutral => "\"neutral\"",
    }
}

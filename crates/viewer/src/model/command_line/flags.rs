//! The flags for everything that differs from the scene.

use super::{Pasted, Shown, resolve};
use glam::DVec3;
use glimray_app::flag_values::{
    background, exposure, fov_y, fps, orthographic, section, shutter, time, vector,
};
use glimray_app::overrides::RenderOverrides;
use glimray_app::settings::SETTINGS;
use glimray_app::value_forms::{Form, joined};
use glimray_app::value_names::{TONES, TRANSFERS};
use glimray_scene::{Backdrop, Background, Camera, Scene, Section, Shutter};

/// Flags, and the picture that a line with them shows.
pub(super) struct Flags<'a> {
    scene: &'a Scene,
    overrides: RenderOverrides,
    picture: Pasted,
    /// The flags and their values.
    pub arguments: Vec<String>,
    /// The differences for which there is no flag, a few words each.
    pub left_out: Vec<&'static str>,
}

impl<'a> Flags<'a> {
    /// All flags that `shown` needs if a line without them shows `scene`.
    ///
    /// # Errors
    /// The scene has no camera.
    pub fn new(shown: &Shown, scene: &'a Scene) -> Result<Self, String> {
        let mut overrides = RenderOverrides::default();
        overrides.camera.has_environment = shown.options.environment.source.is_some();
        let mut flags = Self {
            scene,
            picture: resolve(&overrides, scene)?,
            overrides,
            arguments: Vec::new(),
            left_out: Vec::new(),
        };
        flags.camera(shown);
        // Other settings have defaults that depend on those that lead.
        let (first, others) = SETTINGS
            .iter()
            .partition::<Vec<_>, _>(|setting| setting.leads);
        for setting in first.into_iter().chain(others) {
            let wanted = (setting.text)(shown.settings);
            flags.add(
                setting.noun,
                |picture| (setting.text)(&picture.settings) != wanted,
                [(setting.flag, wanted.as_deref())],
                |overrides| (setting.give)(&mut overrides.picture, wanted.as_deref()?).ok(),
            );
        }
        flags.background(shown);
        flags.section(shown);
        flags.tone(shown);
        flags.timing(shown);
        Ok(flags)
    }

    /// Adds `flags` if what is shown differs from the picture so far. `change` makes the same change to the overrides; `None`
    /// tells that the flags cannot be given.
    fn add<const N: usize>(
        &mut self,
        what: &'static str,
        differs: impl Fn(&Pasted) -> bool,
        flags: [(&'static str, Option<&str>); N],
        change: impl FnOnce(&mut RenderOverrides) -> Option<()>,
    ) {
        if !differs(&self.picture) {
            return;
        }
        let mut overrides = self.overrides.clone();
        let picture = change(&mut overrides).and_then(|()| resolve(&overrides, self.scene).ok());
        if let Some(picture) = picture {
            self.overrides = overrides;
            self.picture = picture;
            let words = flags
                .into_iter()
                .flat_map(|(flag, value)| [Some(flag), value]);
            let words = words.flatten().filter(|word| !word.is_empty());
            self.arguments.extend(words.map(str::to_owned));
        }
        if differs(&self.picture) {
            self.left_out.push(what);
        }
    }

    /// Adds one flag. `read` takes its value, unless that is out of range, and `place` is where it goes.
    fn add_one<T>(
        &mut self,
        what: &'static str,
        differs: impl Fn(&Pasted) -> bool,
        (flag, text): (&'static str, Option<String>),
        read: impl Fn(&str) -> Result<T, String>,
        place: impl Fn(&mut RenderOverrides) -> &mut Option<T>,
    ) {
        let text = text.as_deref();
        self.add(what, differs, [(flag, text)], |overrides| {
            *place(overrides) = Some(read(text?).ok()?);
            Some(())
        });
    }

    fn camera(&mut self, shown: &Shown) {
        let (wanted, now, scene) = (shown.camera, shown.time, self.scene);
        self.add_one(
            "the time",
            |picture| picture.time != now,
            ("--time", Some(now.to_string())),
            time,
            |overrides| &mut overrides.moment.time,
        );
        // A lens is only available through the camera that has it.
        let has_lens = |index: &usize| {
            let mut scene = scene.clone();
            scene.camera_index = *index;
            scene.frame(now).camera.lens == wanted.lens
        };
        let index = (0..scene.cameras.len()).find(has_lens);
        self.add_one(
            "the camera's lens",
            |picture| picture.camera.lens != wanted.lens,
            ("--camera", index.map(|index| index.to_string())),
            |name| Ok(name.to_owned()),
            |overrides| &mut overrides.camera.name,
        );
        self.add(
            "the planes between which the camera sees",
            |picture| picture.camera.clip != wanted.clip,
            [],
            |_| None,
        );
        // All three at once, because animated values must not remain.
        let [from, at, up] = place(wanted).map(|at| joined(at.to_array()));
        let flags = [("--look-from", &from), ("--look-at", &at), ("--up", &up)];
        // With a letter, `--up` is the axis of the model.
        let is_free = shown.options.up.is_none();
        self.add(
            "the camera position",
            |picture| place(&picture.camera) != place(wanted),
            flags.map(|(flag, text)| (flag, Some(&**text))),
            |overrides| {
                let camera = &mut overrides.camera;
                camera.look_from = Some(vector(&from).ok().filter(|_| is_free)?);
                camera.look_at = Some(vector(&at).ok()?);
                camera.up = Some(vector(&up).ok()?);
                Some(())
            },
        );
        let what = "the camera's angle of view";
        let differs = |picture: &Pasted| !same_projection(wanted, &picture.camera);
        match wanted.orthographic_height {
            Some(height) => self.add_one(
                what,
                differs,
                ("--orthographic", Some(height.to_string())),
                orthographic,
                |overrides| &mut overrides.camera.orthographic_height,
            ),
            None => self.add_one(
                what,
                differs,
                ("--fov-y", Some(degrees(wanted.fov_y).to_string())),
                fov_y,
                |overrides| &mut overrides.camera.fov_y_deg,
            ),
        }
    }

    /// One flag is for both: beside `--environment` a colour is a backdrop, else the background.
    fn background(&mut self, shown: &Shown) {
        let has_environment = self.overrides.camera.has_environment;
        let (wanted, backdrop) = (shown.background, shown.settings.backdrop);
        let text = match backdrop {
            Backdrop::Transparent => Some("transparent".to_owned()),
            Backdrop::Color(color) if has_environment => Some(joined(color.to_array())),
            Backdrop::Color(_) | Backdrop::Background => None,
        };
        self.add_one(
            "the backdrop",
            |picture| picture.settings.backdrop != backdrop,
            ("--background", text),
            background,
            |overrides| &mut overrides.camera.background,
        );
        let is_free = self.overrides.camera.background.is_none() && !has_environment;
        let text = match wanted {
            Background::Color(color) if is_free => Some(joined(color.to_array())),
            _ => None,
        };
        self.add_one(
            "the background",
            |picture| picture.background != *wanted,
            ("--background", text),
            background,
            |overrides| &mut overrides.camera.background,
        );
    }

    fn section(&mut self, shown: &Shown) {
        let text = match shown.section {
            Some(Section { normal, offset }) => joined([normal.x, normal.y, normal.z, offset]),
            None => "none".to_owned(),
        };
        self.add_one(
            "the section plane",
            |picture| picture.section != shown.section,
            ("--section", Some(text)),
            section,
            |overrides| &mut overrides.camera.section,
        );
    }

    fn tone(&mut self, shown: &Shown) {
        let wanted = shown.tone;
        let text = match wanted.auto_exposure {
            true => format!("auto{:+}", wanted.exposure_ev),
            false => wanted.exposure_ev.to_string(),
        };
        self.add_one(
            "the exposure",
            |Pasted { tone, .. }| {
                (tone.exposure_ev, tone.auto_exposure) != (wanted.exposure_ev, wanted.auto_exposure)
            },
            ("--exposure", Some(text)),
            exposure,
            |overrides| &mut overrides.tone.exposure,
        );
        self.add_one(
            "the tone curve",
            |picture| picture.tone.curve != wanted.curve,
            ("--tone", TONES.write(&wanted.curve)),
            |text| TONES.read(text),
            |overrides| &mut overrides.tone.curve,
        );
        self.add_one(
            "the transfer function",
            |picture| picture.tone.transfer != wanted.transfer,
            ("--transfer", TRANSFERS.write(&wanted.transfer)),
            |text| TRANSFERS.read(text),
            |overrides| &mut overrides.tone.transfer,
        );
        let flag = match wanted.denoise {
            true => "--denoise",
            false => "--no-denoise",
        };
        self.add(
            "denoising",
            |picture| picture.tone.denoise != wanted.denoise,
            [(flag, None)],
            |overrides| {
                overrides.tone.denoise = Some(wanted.denoise);
                overrides.picture.denoise = Some(wanted.denoise);
                Some(())
            },
        );
    }

    fn timing(&mut self, shown: &Shown) {
        let (rate, wanted) = (shown.fps, shown.shutter);
        self.add_one(
            "the frame rate",
            |picture| picture.fps != rate,
            ("--fps", Some(rate.to_string())),
            fps,
            |overrides| &mut overrides.timing.fps,
        );
        let Shutter { open, close } = wanted;
        let text = match open == 0.0 && close >= 0.0 {
            true => close.to_string(),
            false => format!("{open}..{close}"),
        };
        self.add_one(
            "the shutter",
            |picture| picture.shutter != wanted,
            ("--shutter", Some(text)),
            shutter,
            |overrides| &mut overrides.timing.shutter,
        );
    }
}

fn place(camera: &Camera) -> [DVec3; 3] {
    [camera.look_from, camera.look_at, camera.up]
}

fn same_projection(a: &Camera, b: &Camera) -> bool {
    a.orthographic_height == b.orthographic_height
        && (a.orthographic_height.is_some() || a.fov_y == b.fov_y)
}

/// The number of degrees that converts back to exactly these radians, if there is one; else the nearest.
fn degrees(radians: f64) -> f64 {
    let middle = radians.to_degrees();
    let near = [
        middle,
        middle.next_up(),
        middle.next_down(),
        middle.next_up().next_up(),
        middle.next_down().next_down(),
    ];
    let exact = near
        .into_iter()
        .find(|degrees| degrees.to_radians() == radians);
    // Prefers round numbers among several that convert to the same radians.
    let round = (middle * 1e6).round() / 1e6;
    if round.to_radians() == radians {
        return round;
    }
    exact.unwrap_or(middle)
}

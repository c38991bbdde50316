//! The animations of a native scene: their targets, and whether these accept them.

mod curve;

use super::Texts;
use super::cameras::{MAX_RADIUS, MAX_RATIO};
use super::file::{
    AnimationTable, OF_CAMERAS, OF_LIGHTS, OF_MATERIALS, OF_NODES, PropertyName, SceneFile, Spanned,
};
use super::lights::NamedLight;
use super::materials;
use super::nodes::Nodes;
use crate::import::error::ImportError;
use crate::import::notes::Notes;
use crate::import::source::quote;
use crate::import::suggest;
use PropertyName as P;
use glimray_scene::{
    Camera, CameraProperty, Curve, LightKind, LightProperty, MaterialProperty, Target, Track,
    Values,
};
use std::collections::{HashMap, HashSet};
use toml::Value;

/// The targets that animations may name.
pub(super) struct Found<'a> {
    pub nodes: &'a Nodes<'a>,
    pub cameras: &'a [Camera],
    /// If the intensity of a light is animated, its colour becomes the colour before intensity.
    pub lights: &'a mut [NamedLight],
    /// Materials by name.
    pub materials: &'a HashMap<String, usize>,
}

/// The tracks of all animations in `file`. Notes about animations without effect go to `notes`.
pub(super) fn tracks(
    file: &SceneFile,
    found: Found,
    texts: &Texts,
    notes: &mut Notes,
) -> Result<Vec<Track>, ImportError> {
    let mut reader = Reader {
        file,
        found,
        texts,
        given: HashSet::new(),
        made: Vec::new(),
        notes,
    };
    for table in &file.animation {
        reader.record(table)?;
    }
    for table in &file.animation {
        reader.track(table.get_ref())?;
    }
    Ok(reader.made)
}

/// The target of an animation: "object", "camera", "light" or "material", and its name or names.
type Subject<'a> = (&'static str, Vec<&'a Spanned<String>>);

struct Reader<'a> {
    file: &'a SceneFile,
    found: Found<'a>,
    texts: &'a Texts<'a>,
    /// Every animated property.
    given: HashSet<(&'static str, &'a str, PropertyName)>,
    made: Vec<Track>,
    notes: &'a mut Notes,
}

impl<'a> Reader<'a> {
    /// Records the target of `table`, which must not have another animation.
    fn record(&mut self, table: &'a Spanned<AnimationTable>) -> Result<(), ImportError> {
        let subjects = subjects(table.get_ref());
        let [(kind, names)] = &subjects[..] else {
            let why = "an animation needs exactly one target".to_owned();
            let todo = "Give it one of `object`, `objects`, `camera`, `light` and `material`";
            return Err(self.texts.malformed(table.span(), why, todo));
        };
        let property = &table.property;
        // Several keys for one property.
        let moved = match *property.get_ref() {
            P::Rotation | P::Angles => P::RotateDeg,
            P::FovY => P::FovYDeg,
            other => other,
        };
        for name in names {
            if !self.given.insert((kind, name.get_ref(), moved)) {
                let quoted = quote(name.as_bytes());
                let why = format!("a second animation of the same property of the {kind} {quoted}");
                let todo = "Put all keys into one animation";
                return Err(self.texts.malformed(property.span(), why, todo));
            }
        }
        Ok(())
    }

    fn track(&mut self, table: &'a AnimationTable) -> Result<(), ImportError> {
        let mut curve = curve::curve(table, self.texts)?;
        let Some((kind, names)) = subjects(table).into_iter().next() else {
            return Ok(());
        };
        let Some(&name) = names.first() else {
            let why = "`objects` is empty".to_owned();
            let todo = "Name the objects that move";
            return Err(self.texts.malformed(table.property.span(), why, todo));
        };
        let targets = match kind {
            "object" => {
                let property = self.property(table, kind, OF_NODES)?;
                let mut targets = Vec::new();
                for name in names {
                    let nodes = self.found.nodes;
                    let nodes = nodes.all(name.get_ref(), name.span(), self.texts)?;
                    targets.extend(nodes.iter().map(|&node| Target::Node(node, property)));
                }
                targets
            }
            "camera" => self.camera(table, name, &curve)?,
            "light" => self.light(table, name, &mut curve)?,
            _ => self.material(table, name)?,
        };
        if targets.is_empty() {
            let quoted = quote(name.as_bytes());
            self.notes.add("skipped animations", || {
                format!("animation of {quoted} skipped: the object is nowhere in the scene")
            });
            return Ok(());
        }
        self.made.push(Track { targets, curve });
        Ok(())
    }

    fn camera(
        &self,
        table: &AnimationTable,
        name: &Spanned<String>,
        curve: &Curve,
    ) -> Result<Vec<Target>, ImportError> {
        let cameras = self.found.cameras.iter().map(|camera| camera.name.as_str());
        let index = self.named(name, "camera", cameras)?;
        let camera = &self.found.cameras[index];
        let property = self.property(table, "camera", OF_CAMERAS)?;
        let refuse = |why: &str, todo| {
            let why = format!("{why}, but {} has none", quote(camera.name.as_bytes()));
            Err(self.texts.malformed(table.property.span(), why, todo))
        };
        if property == CameraProperty::LookAt && camera.target.is_some() {
            let why = "the camera already looks at an object".to_owned();
            let todo = "Animate that object, or give `look_at` a point";
            return Err(self.texts.malformed(table.property.span(), why, todo));
        }
        if property == CameraProperty::OrthographicHeight && camera.orthographic_height.is_none() {
            let todo = "Set the camera's `orthographic` to a height";
            return refuse("this needs an orthographic height", todo);
        }
        let is_of_lens = matches!(
            property,
            CameraProperty::FocusDistance | CameraProperty::LensRadius
        );
        let Some(lens) = &camera.lens else {
            return match is_of_lens {
                true => refuse("this needs a lens", "Give the camera a `lens`"),
                false => Ok(vec![Target::Camera(index, property)]),
            };
        };
        let Values::Scalar(values) = &curve.values else {
            return Ok(vec![Target::Camera(index, property)]);
        };
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(0.0, f64::max);
        let is_bad = match property {
            CameraProperty::FocusDistance => lens.radius > MAX_RATIO * least,
            CameraProperty::LensRadius => most > MAX_RADIUS.min(MAX_RATIO * lens.focus_distance),
            _ => false,
        };
        if is_bad {
            let why = "the lens gets out of proportion: its radius must be at most 1e9, and at most \
                       a million times its focus distance";
            let todo = "Make the lens smaller, or its focus distance greater";
            return Err(self
                .texts
                .malformed(table.keys.span(), why.to_owned(), todo));
        }
        Ok(vec![Target::Camera(index, property)])
    }

    fn light(
        &mut self,
        table: &AnimationTable,
        name: &Spanned<String>,
        curve: &mut Curve,
    ) -> Result<Vec<Target>, ImportError> {
        let lights = self.found.lights.iter();
        let lights = lights.map(|light| light.name.as_deref().unwrap_or_default());
        let index = self.named(name, "light", lights)?;
        let property = self.property(table, "light", OF_LIGHTS)?;
        let is_paced = self.given.contains(&("light", name.as_str(), P::Intensity));
        let light = &mut self.found.lights[index];
        let kind = light.light.kind;
        let is_without = match property {
            LightProperty::Position => matches!(kind, LightKind::Directional { .. }),
            LightProperty::Direction => !matches!(
                kind,
                LightKind::Directional { .. } | LightKind::Spot { .. } | LightKind::Disc { .. }
            ),
            _ => false,
        };
        if is_without {
            let why = "this kind of light has no such property".to_owned();
            let todo = "Animate a key of its own table";
            return Err(self.texts.malformed(table.property.span(), why, todo));
        }
        match (&mut curve.values, property) {
            // Replaces the factor in the light's own table.
            (Values::Scalar(values), LightProperty::Intensity) => {
                light.light.color = light.color;
                light.factor = values.iter().copied().fold(0.0, f64::max);
            }
            (Values::Vector(values), LightProperty::Color) => {
                let most = values.iter().map(|color| color.max_element());
                light.peak = most.fold(0.0, f64::max);
                if !is_paced {
                    values.iter_mut().for_each(|color| *color *= light.factor);
                }
            }
            _ => {}
        }
        let radiance = kind.radiance().unwrap_or(1.0).max(1.0);
        if light.peak * light.factor * radiance > f64::from(f32::MAX) {
            let why =
                "`color` times `intensity` gets out of range: at most 3.4e38 is allowed".to_owned();
            return Err(self
                .texts
                .malformed(table.keys.span(), why, "Lower one of them"));
        }
        Ok(vec![Target::Light(index, property)])
    }

    fn material(
        &self,
        table: &AnimationTable,
        name: &Spanned<String>,
    ) -> Result<Vec<Target>, ImportError> {
        let text = name.as_str();
        let index = materials::named(self.found.materials, text, name.span(), self.texts)?;
        let property = self.property(table, "material", OF_MATERIALS)?;
        let mut targets = vec![Target::Material(index, property)];
        // A material without an ambient colour of its own uses its diffuse colour at all times.
        let own = self.file.materials.get(text);
        let has_own = own.and_then(|material| material.phong.as_ref());
        let has_own = has_own.is_some_and(|phong| phong.ambient.is_some());
        let is_animated = self.given.contains(&("material", text, P::Ambient));
        if property == MaterialProperty::Diffuse && !has_own && !is_animated {
            targets.push(Target::Material(index, MaterialProperty::Ambient));
        }
        Ok(targets)
    }

    /// The index of `name` among `names`, which are unique or empty.
    fn named<'n>(
        &self,
        name: &Spanned<String>,
        kind: &str,
        names: impl Iterator<Item = &'n str> + Clone,
    ) -> Result<usize, ImportError> {
        let text = name.as_str();
        let found = names.clone().position(|known| known == text);
        found.filter(|_| !text.is_empty()).ok_or_else(|| {
            let known = names.filter(|name| !name.is_empty());
            let why = suggest::unknown(kind, text, known);
            let todo = format!("Add that `name` to a {kind}, or use an existing one");
            self.texts.malformed(name.span(), why, &todo)
        })
    }

    /// The host equivalent of the property that `table` animates.
    fn property<T: Copy>(
        &self,
        table: &AnimationTable,
        kind: &str,
        properties: &[(PropertyName, T)],
    ) -> Result<T, ImportError> {
        let wanted = *table.property.get_ref();
        let found = properties.iter().find(|(name, _)| *name == wanted);
        found.map(|(_, property)| *property).ok_or_else(|| {
            let names = properties
                .iter()
                .filter_map(|(name, _)| Value::try_from(name).ok());
            let names: Vec<_> = names.map(|it| it.to_string().replace('"', "`")).collect();
            let article = if kind == "object" { "an" } else { "a" };
            let why = format!("{article} {kind} has no such property");
            let todo = format!("Allowed here: {}", names.join(", "));
            self.texts.malformed(table.property.span(), why, &todo)
        })
    }
}

fn subjects(table: &AnimationTable) -> Vec<Subject<'_>> {
    let named = [
        ("object", &table.object),
        ("camera", &table.camera),
        ("light", &table.light),
        ("material", &table.material),
    ];
    let given = named.into_iter();
    let one = given.filter_map(|(kind, name)| Some((kind, vec![name.as_ref()?])));
    let several = (table.objects.iter()).map(|names| ("object", names.iter().collect()));
    one.chain(several).collect()
}

//! The textures of a material: their thumbnails, and how their pictures lie on the surface.

use crate::model::texture_slots::{NORMAL_MAP, TextureSlot};
use crate::ui::panels::icon::{edge, named, on_screen};
use crate::ui::panels::properties::fields::{Chosen, Drawing, Edited, Fields, Limits, choose};
use crate::ui::panels::properties::material_rows::edit;
use eframe::egui::{self, Rect, StrokeKind, Ui, vec2};
use glam::{DVec2, Vec3};
use glimray_scene::{
    Material, Pattern, Scene, Space, Target, Texture, TextureProperty, UvTransform, Wrap,
};

/// Side of a thumbnail, in points.
const THUMBNAIL: f32 = 40.0;
/// Size of the letters of buttons, in points.
const LETTERS: f32 = 11.0;
/// Width of a button that opens a picture, in points.
const OPEN: f32 = 50.0;
/// The fold of how a picture lies on the surface.
const PLACEMENT: &str = "Placement";
/// The row of the strength of the normal map.
const BUMPS: &str = "Bump strength";

/// The rows of all textures that a material can have.
pub fn show(fields: &mut Fields, index: usize) {
    let material = &fields.scene.materials[index];
    let is_used = material.texture_indices().next().is_some();
    fields.section("Textures", is_used, |fields| {
        if fields.is_drawn() && is_used && lacks_coordinates(fields.scene, index) {
            fields.note(
                "A mesh with this material has no texture coordinates: its textures show one colour.",
            );
        }
        for slot in TextureSlot::of(material) {
            row(fields, index, slot);
            let texture = slot.get(material);
            if let Some(texture) = texture {
                placement(fields, slot, texture);
            }
            if texture.is_some() && slot.title == NORMAL_MAP {
                bumps(fields, index, material);
            }
        }
    });
}

/// Whether pictures cannot be laid on a mesh that has the material.
fn lacks_coordinates(scene: &Scene, index: usize) -> bool {
    let meshes = scene.instances.iter().map(|it| &scene.meshes[it.mesh]);
    let mut users =
        meshes.filter(|mesh| mesh.materials.first().copied() == u32::try_from(index).ok());
    users.any(|mesh| mesh.uvs.is_empty() && !mesh.positions.is_empty())
}

fn bumps(fields: &mut Fields, index: usize, material: &Material) {
    let tip = "Factor on the tilt of the normals of the map, 0 to 1000.";
    let set = edit(index, |own: &mut Material, to: f64| {
        own.normal_scale = to as f32;
    });
    let limits = Limits::between(0.0, 1000.0);
    fields.number((BUMPS, tip), f64::from(material.normal_scale), limits, set);
}

/// The row of one texture: a thumbnail, the textures to choose from, and buttons for its picture.
fn row(fields: &mut Fields, index: usize, slot: &'static TextureSlot) {
    let scene = fields.scene;
    let now = slot.get(&scene.materials[index]);
    let label = (slot.title, slot.tip);
    let options = match fields.is_drawn() {
        true => options(fields, scene),
        false => Vec::new(),
    };
    let set =
        move |scene: &mut Scene, Chosen(to): Chosen<Option<usize>>| slot.set(scene, index, to);
    let mut opens = false;
    let thumbnail = now.map(|texture| {
        let draw = |ui: &mut Ui, drawing: &mut Drawing| Thumbnail::of(ui, drawing, scene, texture);
        fields.draw(draw)
    });
    fields.field(label, slot.title, Chosen(now), set, |ui, by, mixed| {
        let gap = ui.spacing().item_spacing.x;
        let chosen = match thumbnail.flatten() {
            None => {
                let mut chosen = None;
                let width = ui.available_width() - OPEN - gap;
                // Without any texture there is nothing to choose.
                if !scene.textures.is_empty() {
                    let size = vec2(width, ui.spacing().interact_size.y);
                    let choice = |ui: &mut Ui| choose(ui, label, by, now, mixed[0], &options);
                    chosen = ui.allocate_ui(size, choice).inner;
                }
                let width = ui.available_width();
                opens = button(ui, width, "Open…", slot, "Open a picture");
                chosen
            }
            Some(thumbnail) => {
                thumbnail.show(ui);
                let buttons = |ui: &mut Ui| {
                    ui.spacing_mut().item_spacing.y = gap;
                    let chosen = choose(ui, label, by, now, mixed[0], &options);
                    let is_removed = ui.horizontal(|ui| {
                        let width = (ui.available_width() - gap) / 2.0;
                        opens = button(ui, width, "Replace…", slot, "Open another picture");
                        let tip = "Show the colour or the number alone";
                        button(ui, width, "Remove", slot, tip)
                    });
                    match is_removed.inner {
                        true => Some(None),
                        false => chosen,
                    }
                };
                ui.vertical(buttons).inner
            }
        };
        chosen.map(|chosen| Edited::whole(Chosen(chosen)))
    });
    if opens {
        fields.draw(|_, drawing| drawing.opens = Some((index, slot)));
    }
}

/// A button of this width, with small letters.
fn button(ui: &mut Ui, width: f32, text: &str, slot: &TextureSlot, tip: &str) -> bool {
    let name = format!("{} {}", text.trim_end_matches('…'), slot.title);
    ui.spacing_mut().button_padding.x = 1.0;
    let button = egui::Button::new(egui::RichText::new(text).size(LETTERS));
    let size = vec2(width, ui.spacing().interact_size.y);
    let button = ui.add_sized(size, button);
    named(&button, &name);
    button.on_hover_text(tip).clicked()
}

/// The textures of the scene, and none.
fn options(fields: &mut Fields, scene: &Scene) -> Vec<(Option<usize>, String)> {
    let names = fields.draw(|_, drawing| {
        let named = |texture: &Texture| match texture.pattern {
            Pattern::Checker { .. } => "Checker".to_owned(),
            Pattern::Stripes { .. } => "Stripes".to_owned(),
            Pattern::Gradient { .. } => "Gradient".to_owned(),
            Pattern::Noise { .. } => "Noise".to_owned(),
            Pattern::Picture { picture, .. } => {
                let picture = &scene.pictures[picture];
                let name = (drawing.names.iter())
                    .find(|(known, _)| known.as_ptr() == std::sync::Arc::as_ptr(picture));
                name.map_or_else(|| "Picture".to_owned(), |(_, name)| name.clone())
            }
        };
        scene.textures.iter().map(named).collect::<Vec<_>>()
    });
    let names = names.unwrap_or_default().into_iter().enumerate();
    let textures = names.map(|(index, name)| {
        let label = format!("{name} (texture {})", index + 1);
        (Some(index), label)
    });
    std::iter::once((None, "None".to_owned()))
        .chain(textures)
        .collect()
}

/// A small look of a texture.
enum Thumbnail {
    Picture(egui::TextureId, egui::Vec2, String),
    Pattern(Pattern),
}

impl Thumbnail {
    fn of(ui: &Ui, drawing: &mut Drawing, scene: &Scene, texture: usize) -> Self {
        match scene.textures[texture].pattern.clone() {
            Pattern::Picture { picture, .. } => {
                let picture = &scene.pictures[picture];
                let handle = drawing.thumbnails.of(ui.ctx(), picture);
                let tip = format!("{} × {} texels", picture.width, picture.height);
                Self::Picture(handle.id(), handle.size_vec2(), tip)
            }
            pattern => Self::Pattern(pattern),
        }
    }

    fn show(self, ui: &mut Ui) {
        let size = vec2(THUMBNAIL, THUMBNAIL);
        let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
        let frame = match self {
            Self::Picture(id, size, tip) => {
                let scale = THUMBNAIL / size.max_elem();
                let rect = Rect::from_center_size(rect.center(), size * scale);
                let whole = Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
                ui.painter().image(id, rect, whole, egui::Color32::WHITE);
                response.on_hover_text(tip);
                rect
            }
            Self::Pattern(pattern) => {
                pattern_in(ui, rect, pattern);
                rect
            }
        };
        let stroke = egui::Stroke::new(1.0, edge(ui.visuals()));
        ui.painter()
            .rect_stroke(frame, 2.0, stroke, StrokeKind::Inside);
    }
}

/// Paints the colours of a pattern.
fn pattern_in(ui: &Ui, rect: Rect, pattern: Pattern) {
    const CELLS: usize = 4;
    let (a, b) = match pattern {
        Pattern::Checker { a, b }
        | Pattern::Stripes { a, b }
        | Pattern::Gradient { a, b }
        | Pattern::Noise { a, b, .. } => (a, b),
        Pattern::Picture { .. } => return,
    };
    let share = |x: usize, y: usize| match pattern {
        Pattern::Checker { .. } => ((x + y) % 2) as f32,
        Pattern::Stripes { .. } => (x % 2) as f32,
        Pattern::Gradient { .. } => x as f32 / (CELLS - 1) as f32,
        // Of no order.
        _ => ((7 * x + 11 * y + x * y * 5) % 8) as f32 / 7.0,
    };
    let cell = rect.size() / CELLS as f32;
    for (x, y) in (0..CELLS * CELLS).map(|index| (index % CELLS, index / CELLS)) {
        let min = rect.min + vec2(x as f32, y as f32) * cell;
        let color: Vec3 = a.lerp(b, share(x, y));
        (ui.painter()).rect_filled(Rect::from_min_size(min, cell), 0.0, on_screen(color));
    }
}

/// How a picture lies on the surface, in a fold.
fn placement(fields: &mut Fields, slot: &'static TextureSlot, index: usize) {
    let scene = fields.scene;
    let texture = &scene.textures[index];
    let Pattern::Picture { nearest, wrap, .. } = texture.pattern else {
        return;
    };
    let placed = UvTransform::of(texture.pattern_from_space);
    // A picture in space can be turned out of its plane.
    if texture.space == Space::World && placed.is_none() {
        return;
    }
    fields.part((slot.title, PLACEMENT), |fields| {
        let users = if fields.is_drawn() {
            users(scene, index)
        } else {
            0
        };
        if users > 1 {
            fields.note(&format!("{users} rows of materials have this texture."));
        }
        match placed {
            Some(placed) => transform(fields, index, placed),
            None => fields.note("The placement has shear, which these rows cannot express."),
        }
        wrapping(fields, index, wrap);
        let tip = "Show texels as squares where they look larger than a pixel.";
        fields.toggle(("Sharp texels", tip), nearest, move |scene, to| {
            if let Pattern::Picture { nearest, .. } = &mut scene.textures[index].pattern {
                *nearest = to;
            }
        });
    });
}

/// Number of slots of materials that have a texture.
fn users(scene: &Scene, index: usize) -> usize {
    let used = scene.materials.iter().flat_map(Material::texture_indices);
    used.filter(|used| *used == index).count()
}

fn transform(fields: &mut Fields, index: usize, placed: UvTransform) {
    let with = |change: fn(&mut UvTransform, DVec2)| {
        move |scene: &mut Scene, to: DVec2| {
            let texture = &scene.textures[index];
            if let Some(mut placed) = UvTransform::of(texture.pattern_from_space) {
                change(&mut placed, to);
                let placed = placed.pattern_from_uv();
                // Tangents follow the texture coordinates.
                scene.change_mappings(|scene| scene.textures[index].pattern_from_space = placed);
            }
        }
    };
    let at = |property| Target::Texture(index, property);
    let tip = "Shift of the picture's coordinates, in widths and heights of the picture.";
    let (label, limits) = (("Offset", tip), Limits::LENGTH);
    let set = with(|placed, to| placed.offset = to);
    fields
        .driven_by(at(TextureProperty::Offset))
        .pair(label, placed.offset, limits, set);
    let tip = "How many times the picture is repeated.";
    let set = with(|placed, to| placed.scale = to);
    fields
        .driven_by(at(TextureProperty::Scale))
        .pair(("Repeats", tip), placed.scale, limits, set);
    let tip = "Rotation of the picture's coordinates in degrees, counter-clockwise.";
    let set = with(|placed, to| placed.rotation = to.x.to_radians());
    let degrees = placed.rotation.to_degrees();
    fields.driven_by(at(TextureProperty::Rotation)).number(
        ("Turn", tip),
        degrees,
        Limits::ANGLE,
        move |scene, to| set(scene, DVec2::splat(to)),
    );
}

fn wrapping(fields: &mut Fields, index: usize, wrap: [Wrap; 2]) {
    let options = [
        (Wrap::Repeat, "Repeat"),
        (Wrap::Clamp, "Stretch the edge"),
        (Wrap::Mirror, "Mirror"),
    ];
    let labels = [
        ("Wrap u", "How the picture goes on to the left and right."),
        ("Wrap v", "How the picture goes on above and below."),
    ];
    for (axis, label) in labels.into_iter().enumerate() {
        fields.choice(label, wrap[axis], &options, move |scene, to| {
            if let Pattern::Picture { wrap, .. } = &mut scene.textures[index].pattern {
                wrap[axis] = to;
            }
        });
    }
}

//! Rows with a label and a value. Every edit becomes a named change of the scene, of all that is selected and has the row.

mod moment;
mod number;
mod peers;

pub use moment::Moment;
pub use number::Limits;
pub use peers::{Chosen, Compared, Edited, Key, Options, Peers};

use crate::model::objects::{self, EditError};
use crate::model::texture_slots::TextureSlot;
use crate::ui::panels::icon::{edge, named};
use crate::ui::panels::row;
use crate::ui::theme;
use crate::ui::thumbnails::Thumbnails;
use eframe::egui::{self, Ui, vec2};
use glam::{DVec2, DVec3, Vec3};
use glimray_scene::{ObjectRef, Picture, Scene, Target};
use number::{Name, drag};
use peers::{Parts, apply_to};
use std::any::TypeId;
use std::collections::HashMap;
use std::sync::{Arc, Weak};

/// Width of the letter of an axis.
const AXIS: f32 = 8.0;
/// Text in place of values that differ among what is selected.
const MIXED: &str = "—";

/// A change of the scene.
pub struct Change {
    /// A description, such as "change diffuse of glass".
    pub name: String,
    /// Applies the change.
    pub apply: Box<Apply>,
}

/// An edit of a row, which changes all that is selected and has the row.
pub struct Edit {
    /// A description, such as "change radius of 3 items".
    pub name: String,
    /// The row.
    pub key: Key,
    /// Applies the edit to what is shown and to the rows of the others.
    pub apply: Box<ApplyToAll>,
}

/// A change that can fail, of several rows.
type ApplyToAll = dyn FnOnce(&mut Scene, Peers) -> Result<(), EditError>;

/// A change that can fail.
type Apply = dyn FnOnce(&mut Scene) -> Result<(), EditError>;

/// The label and the tooltip of a row.
type Label<'a> = (&'static str, &'a str);

/// The input and the output of rows that are drawn.
#[derive(Default)]
pub struct Drawing {
    /// The rows of the others that are selected.
    pub others: Arc<HashMap<Key, Compared>>,
    /// The options of what is shown.
    pub options: Options,
    /// The thumbnails of pictures.
    pub thumbnails: Thumbnails,
    /// The picture of a material, once there is one.
    pub ball: Option<egui::TextureId>,
    /// The index of the material that the picture is to show.
    pub ball_of: Option<usize>,
    /// Changes of what is shown alone.
    pub changes: Vec<Change>,
    /// The edits of rows.
    pub edits: Vec<Edit>,
    /// The names of the files of pictures that were opened.
    pub names: Vec<(Weak<Picture>, String)>,
    /// The material and its slot for which a picture is to be opened.
    pub opens: Option<(usize, &'static TextureSlot)>,
}

/// Rows that are drawn, or read so that an edit of other rows changes these too.
enum Sheet<'a> {
    Drawn(&'a mut Ui, &'a mut Drawing),
    Read(&'a mut Peers),
}

/// The rows of one object.
pub struct Fields<'a> {
    sheet: Sheet<'a>,
    pub scene: &'a Scene,
    /// The scene at the time that is shown.
    pub moment: &'a Moment<'a>,
    /// The object's label.
    pub subject: String,
    /// The animated property that the next row shows.
    driver: Option<Target>,
    /// The part of the rows to which a label belongs, where several have the same.
    part: &'static str,
}

impl<'a> Fields<'a> {
    /// Rows that are drawn.
    pub fn drawn(
        ui: &'a mut Ui,
        drawing: &'a mut Drawing,
        (scene, moment): (&'a Scene, &'a Moment<'a>),
        subject: String,
    ) -> Self {
        Self::new(Sheet::Drawn(ui, drawing), (scene, moment), subject)
    }

    /// Rows that are not drawn: they are added to those of `peers`.
    pub fn read(peers: &'a mut Peers, (scene, moment): (&'a Scene, &'a Moment<'a>)) -> Self {
        Self::new(Sheet::Read(peers), (scene, moment), String::new())
    }

    fn new(
        sheet: Sheet<'a>,
        (scene, moment): (&'a Scene, &'a Moment<'a>),
        subject: String,
    ) -> Self {
        Self {
            sheet,
            scene,
            moment,
            subject,
            driver: None,
            part: "",
        }
    }

    /// Draws something that is no row, if rows are drawn.
    pub fn draw<R>(&mut self, content: impl FnOnce(&mut Ui, &mut Drawing) -> R) -> Option<R> {
        match &mut self.sheet {
            Sheet::Drawn(ui, drawing) => Some(content(ui, drawing)),
            Sheet::Read(_) => None,
        }
    }

    /// Whether rows are drawn.
    pub fn is_drawn(&self) -> bool {
        matches!(self.sheet, Sheet::Drawn(..))
    }

    /// The materials of an object, each once.
    pub fn materials_of(&mut self, object: ObjectRef) -> Vec<usize> {
        match &mut self.sheet {
            Sheet::Drawn(..) => objects::materials_of(self.scene, object),
            Sheet::Read(peers) => peers.materials_of(self.scene, object),
        }
    }

    /// Whether the rows of a material are not among those of the others yet. Drawn rows come once.
    pub fn is_new_material(&mut self, index: usize) -> bool {
        match &mut self.sheet {
            Sheet::Drawn(..) => true,
            Sheet::Read(peers) => peers.materials.insert(index),
        }
    }

    /// Disables the next row if a track animates `target`.
    pub fn driven_by(&mut self, target: Target) -> &mut Self {
        self.driver = Some(target);
        self
    }

    /// Disables the next row if a track animates `target`, if there is one.
    pub fn may_be_driven_by(&mut self, target: Option<Target>) -> &mut Self {
        self.driver = target;
        self
    }

    /// Requests a change.
    pub fn request(&mut self, change: Change) {
        self.draw(|_, drawing| drawing.changes.push(change));
    }

    /// Requests a change of one property.
    pub fn change(
        &mut self,
        property: &str,
        apply: impl FnOnce(&mut Scene) -> Result<(), EditError> + 'static,
    ) {
        let property = property.to_lowercase();
        self.request(Change {
            name: format!("change {property} of {}", self.subject),
            apply: Box::new(apply),
        });
    }

    /// A row of any kind. `content` draws its field and edits the value; its last argument says which parts of the value
    /// are others in what else is selected.
    pub fn field<T: Parts>(
        &mut self,
        label: Label,
        property: &'static str,
        value: T,
        set: impl FnOnce(&mut Scene, T) -> Result<(), EditError> + 'static,
        content: impl FnOnce(&mut Ui, Option<egui::Id>, [bool; 3]) -> Option<Edited<T>>,
    ) {
        let driver = self.driver.take();
        let is_driven = driver.is_some_and(|driver| self.moment.drives(driver));
        let key = (self.part, property, TypeId::of::<T>());
        let (ui, drawing) = match &mut self.sheet {
            Sheet::Read(peers) => {
                if !is_driven {
                    peers.add(key, value, set);
                }
                return;
            }
            Sheet::Drawn(ui, drawing) => (ui, drawing),
        };
        let others = drawing.others.get(&key);
        let mixed = others.map_or([false; 3], |others| others.differs_from(value));
        let edited = row::row(ui, label, |ui, labelled_by| {
            ui.add_enabled_ui(!is_driven, |ui| content(ui, labelled_by, mixed))
                .inner
        });
        if let Some(edited) = edited {
            self.edit(key, edited, set);
        }
    }

    /// Requests an edit of a row of all that is selected and has it.
    fn edit<T: Parts>(
        &mut self,
        key: Key,
        edited: Edited<T>,
        set: impl FnOnce(&mut Scene, T) -> Result<(), EditError> + 'static,
    ) {
        let subject = self.subject.clone();
        self.draw(|_, drawing| {
            let subject = match drawing.others.get(&key) {
                None => subject,
                Some(others) => format!("{} items", others.count + 1),
            };
            drawing.edits.push(Edit {
                name: format!("change {} of {subject}", key.1.to_lowercase()),
                key,
                apply: Box::new(move |scene, peers| {
                    set(scene, edited.value)?;
                    apply_to(peers, edited, scene)
                }),
            });
        });
    }

    /// Changes a property without a row of all that is selected and has it, if `is_asked`.
    pub fn change_all(
        &mut self,
        property: &'static str,
        is_asked: bool,
        set: impl FnOnce(&mut Scene) + 'static,
    ) {
        let key = (self.part, property, TypeId::of::<bool>());
        let set = always(move |scene: &mut Scene, _: bool| set(scene));
        match &mut self.sheet {
            Sheet::Read(peers) => peers.add(key, true, set),
            Sheet::Drawn(..) if is_asked => self.edit(key, Edited::whole(true), set),
            Sheet::Drawn(..) => {}
        }
    }

    /// A row with a number.
    pub fn number(
        &mut self,
        label: Label,
        value: f64,
        limits: Limits,
        set: impl FnOnce(&mut Scene, f64) + 'static,
    ) {
        let (name, tip) = label;
        // A value that is edited elsewhere may have other limits there.
        let set = move |scene: &mut Scene, to: f64| {
            set(scene, to.clamp(limits.least, limits.most));
        };
        self.field(label, name, value, always(set), |ui, labelled_by, mixed| {
            let width = ui.available_width();
            let name = Name::Label(labelled_by);
            let value = drag(ui, name, tip, value, mixed[0], limits, width)?;
            Some(Edited::whole(value))
        });
    }

    /// A row with a vector.
    pub fn vector(
        &mut self,
        label: Label,
        value: DVec3,
        limits: Limits,
        set: impl FnOnce(&mut Scene, DVec3) + 'static,
    ) {
        self.try_vector(label, value, limits, always(set));
    }

    /// A row with a vector whose change can fail.
    pub fn try_vector(
        &mut self,
        label: Label,
        value: DVec3,
        limits: Limits,
        set: impl FnOnce(&mut Scene, DVec3) -> Result<(), EditError> + 'static,
    ) {
        let (name, tip) = label;
        self.field(label, name, value, set, |ui, _, mixed| {
            let edited = axes(
                ui,
                (name, tip),
                value.to_array(),
                &["x", "y", "z"],
                limits,
                mixed,
            )?;
            Some(Edited {
                value: DVec3::from(edited.value),
                parts: edited.parts,
            })
        });
    }

    /// A row with two numbers, along u and v.
    pub fn pair(
        &mut self,
        label: Label,
        value: DVec2,
        limits: Limits,
        set: impl FnOnce(&mut Scene, DVec2) + 'static,
    ) {
        let (name, tip) = label;
        self.field(label, name, value, always(set), |ui, _, mixed| {
            let edited = axes(
                ui,
                (name, tip),
                value.to_array(),
                &["u", "v"],
                limits,
                mixed,
            )?;
            Some(Edited {
                value: DVec2::from(edited.value),
                parts: edited.parts,
            })
        });
    }

    /// A linear colour: a button for the hue, and a number for each component, which may exceed 1.
    pub fn color(
        &mut self,
        (label, tip): Label,
        value: Vec3,
        set: impl FnOnce(&mut Scene, Vec3) + 'static,
    ) {
        let tip = match self.is_drawn() {
            true => format!("{tip}\nLinear red, green and blue (Rec. 709), 0 or more."),
            false => String::new(),
        };
        let tip = tip.as_str();
        self.field((label, tip), label, value, always(set), |ui, _, mixed| {
            color_field(ui, (label, tip), value, mixed)
        });
    }

    /// Whether an option of what is shown is on; `usual` until the user changes it.
    pub fn option_value(&mut self, label: &str, usual: bool) -> bool {
        let kept = match &self.sheet {
            Sheet::Drawn(ui, _) => {
                let id = egui::Id::unique((label, &self.subject));
                ui.data(|data| data.get_temp(id))
            }
            Sheet::Read(peers) => peers.options.get(label).copied(),
        };
        kept.unwrap_or(usual)
    }

    /// A check box for `value`, kept while the window is open without changing the scene. Returns its new
    /// value when it is clicked.
    pub fn option(&mut self, (label, tip): Label, mut value: bool) -> Option<bool> {
        let id = egui::Id::unique((label, &self.subject));
        self.draw(|ui, drawing| {
            drawing.options.insert(label, value);
            row::row(ui, ("", tip), |ui, _| {
                let response = ui.checkbox(&mut value, label).on_hover_text(tip);
                response.changed().then(|| {
                    ui.data_mut(|data| data.insert_temp(id, value));
                    value
                })
            })
        })
        .flatten()
    }

    /// A row with a check box.
    pub fn toggle(
        &mut self,
        (label, tip): Label,
        value: bool,
        set: impl FnOnce(&mut Scene, bool) + 'static,
    ) {
        self.field(("", tip), label, value, always(set), |ui, _, mixed| {
            let mut now = value;
            let check = egui::Checkbox::new(&mut now, label).indeterminate(mixed[0]);
            let response = ui.add(check).on_hover_text(tip);
            response.changed().then_some(Edited::whole(now))
        });
    }

    /// A row with a choice.
    pub fn choice<T: Copy + PartialEq + Send + Sync + 'static>(
        &mut self,
        label: Label,
        value: T,
        options: &[(T, impl AsRef<str>)],
        set: impl FnOnce(&mut Scene, T) + 'static,
    ) {
        self.try_choice(label, value, options, always(set));
    }

    /// A row with a choice whose change can fail.
    pub fn try_choice<T: Copy + PartialEq + Send + Sync + 'static>(
        &mut self,
        label: Label,
        value: T,
        options: &[(T, impl AsRef<str>)],
        set: impl FnOnce(&mut Scene, T) -> Result<(), EditError> + 'static,
    ) {
        let set = move |scene: &mut Scene, Chosen(value): Chosen<T>| set(scene, value);
        self.field(
            label,
            label.0,
            Chosen(value),
            set,
            |ui, labelled_by, mixed| {
                let chosen = choose(ui, label, labelled_by, value, mixed[0], options)?;
                Some(Edited::whole(Chosen(chosen)))
            },
        );
    }

    /// A heading.
    pub fn heading(&mut self, text: &str) {
        self.draw(|ui, _| row::heading(ui, text));
    }

    /// A note.
    pub fn note(&mut self, text: &str) {
        self.draw(|ui, _| ui.weak(text));
    }

    /// Rows below a heading that folds them.
    pub fn section(&mut self, title: &str, is_open: bool, rows: impl FnOnce(&mut Fields)) {
        let (scene, subject, part) = ((self.scene, self.moment), self.subject.clone(), self.part);
        match &mut self.sheet {
            Sheet::Read(_) => rows(self),
            Sheet::Drawn(ui, drawing) => row::section(ui, title, is_open, |ui| {
                rows(&mut Fields {
                    part,
                    ..Fields::drawn(ui, drawing, scene, subject)
                });
            }),
        }
    }

    /// Rows of a part, below a line that folds them. Other parts may have rows with the same labels.
    pub fn part(&mut self, (part, title): (&'static str, &str), rows: impl FnOnce(&mut Fields)) {
        let (scene, subject) = ((self.scene, self.moment), self.subject.clone());
        let before = std::mem::replace(&mut self.part, part);
        match &mut self.sheet {
            Sheet::Read(_) => rows(self),
            Sheet::Drawn(ui, drawing) => {
                let fold = egui::CollapsingHeader::new(title).id_salt(part);
                let fold = fold.show_unindented(ui, |ui| {
                    rows(&mut Fields {
                        part,
                        ..Fields::drawn(ui, drawing, scene, subject)
                    });
                });
                named(&fold.header_response, &format!("{title} of {part}"));
            }
        }
        self.part = before;
    }
}

/// A change that cannot fail.
fn always<T>(
    set: impl FnOnce(&mut Scene, T),
) -> impl FnOnce(&mut Scene, T) -> Result<(), EditError> {
    move |scene, value| {
        set(scene, value);
        Ok(())
    }
}

/// Numbers with the letters of their axes.
fn axes<const N: usize>(
    ui: &mut Ui,
    (label, tip): Label,
    value: [f64; N],
    letters: &[&str; N],
    limits: Limits,
    mixed: [bool; 3],
) -> Option<Edited<[f64; N]>> {
    ui.spacing_mut().item_spacing.x = 2.0;
    let width = (ui.available_width() - 10.0) / N as f32 - AXIS;
    let colors = theme::axes(ui.visuals());
    let mut edited: Option<Edited<[f64; N]>> = None;
    for (axis, name) in letters.iter().enumerate() {
        let size = vec2(AXIS, ui.spacing().interact_size.y);
        let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
        let font = egui::TextStyle::Small.resolve(ui.style());
        let (center, letter) = (egui::Align2::CENTER_CENTER, name.to_uppercase());
        (ui.painter()).text(rect.center(), center, letter, font, colors[axis]);
        let name = format!("{label} {name}");
        let own = value[axis];
        if let Some(now) = drag(ui, Name::Own(&name), tip, own, mixed[axis], limits, width) {
            let edited = edited.get_or_insert(Edited {
                value,
                parts: [false; 3],
            });
            edited.value[axis] = now;
            edited.parts[axis] = true;
        }
    }
    edited
}

/// A button for the hue, and a number for each component.
fn color_field(
    ui: &mut Ui,
    (label, tip): Label,
    value: Vec3,
    mixed: [bool; 3],
) -> Option<Edited<Vec3>> {
    ui.spacing_mut().item_spacing.x = 3.0;
    let button = 22.0;
    ui.spacing_mut().interact_size.x = button;
    // egui draws the button's outline in this colour.
    let edge = edge(ui.visuals());
    ui.visuals_mut().widgets.inactive.bg_fill = edge;
    // A colour brighter than white keeps its brightness when its hue changes.
    let scale = value.max_element().max(1.0);
    let mut shown = (value / scale).to_array();
    let mut edited = None;
    let response = ui.color_edit_button_rgb(&mut shown);
    named(&response, &format!("{label} colour"));
    if response.on_hover_text(tip).changed() {
        edited = Some(Edited::whole(Vec3::from(shown) * scale));
    }
    let width = (ui.available_width() - 6.0) / 3.0;
    for (part, name) in ["red", "green", "blue"].into_iter().enumerate() {
        let name = format!("{label} {name}");
        let (own, is_mixed) = (f64::from(value[part]), mixed[part]);
        let limits = Limits::AMOUNT;
        if let Some(now) = drag(ui, Name::Own(&name), tip, own, is_mixed, limits, width) {
            let edited = edited.get_or_insert(Edited {
                value,
                parts: [false; 3],
            });
            edited.value[part] = now as f32;
            edited.parts[part] = true;
        }
    }
    edited
}

/// A drop-down of options. Returns another one that is chosen, or any if those of the selection are `mixed`.
pub fn choose<T: Copy + PartialEq>(
    ui: &mut Ui,
    (label, tip): Label,
    labelled_by: Option<egui::Id>,
    value: T,
    mixed: bool,
    options: &[(T, impl AsRef<str>)],
) -> Option<T> {
    let now = options.iter().find(|(option, _)| *option == value);
    let now = match mixed {
        true => MIXED,
        false => now.map_or("Several", |(_, name)| name.as_ref()),
    };
    let mut chosen = None;
    let width = ui.available_width();
    let response = egui::ComboBox::from_id_salt(label)
        .width(width)
        .truncate()
        .selected_text(now)
        .show_ui(ui, |ui| {
            for (option, name) in options {
                let is_it = *option == value && !mixed;
                if ui.selectable_label(is_it, name.as_ref()).clicked() {
                    chosen = Some(*option);
                }
            }
        })
        .response;
    let response = match labelled_by {
        Some(id) => response.labelled_by(id),
        None => response,
    };
    response.on_hover_text(tip);
    chosen.filter(|chosen| mixed || *chosen != value)
}

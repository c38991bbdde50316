//! The layout of panels: tiles that can be dragged, resized and closed.

use crate::model::preferences::Preferences;
use eframe::egui;
use egui_tiles::{Container, Linear, LinearDir, Shares, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

/// A panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Panel {
    /// The rendered picture.
    Picture,
    /// The contents of the scene.
    Outline,
    /// The properties of the selection.
    Properties,
    /// Render settings and tone mapping.
    Render,
    /// The rays of a pixel.
    Rays,
    /// The ray view.
    Outside,
    /// The time panel.
    Time,
}

impl Panel {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Picture,
        Self::Outline,
        Self::Properties,
        Self::Render,
        Self::Rays,
        Self::Outside,
        Self::Time,
    ];

    /// The title of its tab.
    pub fn title(self) -> &'static str {
        match self {
            Self::Picture => "Picture",
            Self::Outline => "Outline",
            Self::Properties => "Properties",
            Self::Render => "Render",
            Self::Rays => "Rays",
            Self::Outside => "Rays in space",
            Self::Time => "Time",
        }
    }
}

/// Window size of the default layout, in points.
const USUAL: [f32; 2] = [1280.0, 750.0];
/// Window size below which side panels are not restored, in points.
const LEAST: f32 = 200.0;
/// Minimum fraction of the picture, horizontally and vertically.
const PICTURE: f32 = 0.4;

/// Minimum fraction of the picture when a panel is widened.
const LEAST_PICTURE: f32 = 0.2;

/// The panels and their layout.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Layout {
    /// The tiles.
    pub tree: Tree<Panel>,
    /// Size of the area that the fractions refer to, in points.
    #[serde(default)]
    room: Option<[f32; 2]>,
    /// Preferred sizes of side panels, restored when there is room.
    #[serde(default)]
    preferred_sizes: Vec<PreferredSize>,
    /// The layout before all panels were hidden.
    #[serde(default)]
    before: Option<Box<Self>>,
    /// The layout before the ray inspector showed its panels.
    #[serde(default)]
    before_rays: Option<Box<Self>>,
    /// Whether the time panel was hidden because nothing moves.
    #[serde(default)]
    is_time_folded: bool,
    /// Whether the last scene was animated.
    #[serde(default)]
    is_animated: Option<bool>,
}

/// A tile that was shrunk.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct PreferredSize {
    tile: TileId,
    /// The tile's previous width or height, in points.
    preferred: f32,
    /// The tile's reduced size. If its current size differs, the user has resized it since.
    given: f32,
}

impl Default for Layout {
    /// The default layout: the picture in the middle, the outline on the left, settings on the right.
    fn default() -> Self {
        let mut tiles = Tiles::default();
        let mut pane = |panel| tiles.insert_pane(panel);
        let (picture, outline) = (pane(Panel::Picture), pane(Panel::Outline));
        let properties = pane(Panel::Properties);
        let (render, rays, time) = (pane(Panel::Render), pane(Panel::Rays), pane(Panel::Time));
        let outside = tiles.insert_pane(Panel::Outside);
        let upper = tiles.insert_tab_tile(vec![render, rays]);
        let mut side = Linear::new(LinearDir::Vertical, vec![upper, outside]);
        side.shares.set_share(upper, 0.6);
        side.shares.set_share(outside, 0.4);
        let side = tiles.insert_container(Container::Linear(side));
        // Hidden until rays are inspected.
        tiles.set_visible(outside, false);
        let mut middle = Linear::new(LinearDir::Vertical, vec![picture, time]);
        middle.shares.set_share(picture, 640.0);
        middle.shares.set_share(time, 110.0);
        let middle = tiles.insert_container(Container::Linear(middle));
        let left = tiles.insert_vertical_tile(vec![outline, properties]);
        let mut root = Linear::new(LinearDir::Horizontal, vec![left, middle, side]);
        for (tile, width) in [(left, 280.0), (middle, 714.0), (side, 286.0)] {
            root.shares.set_share(tile, width);
        }
        let root = tiles.insert_container(Container::Linear(root));
        Self {
            tree: Tree::new(egui::Id::unique("panels"), root, tiles),
            room: Some(USUAL),
            preferred_sizes: Vec::new(),
            before: None,
            before_rays: None,
            is_time_folded: false,
            is_animated: None,
        }
    }
}

impl Layout {
    /// The saved layout; the default one if a panel of this version is missing.
    pub fn kept(preferences: &Preferences) -> Self {
        let kept: Option<Self> = preferences.layout();
        let is_whole = |layout: &Self| {
            let is_there = |panel| layout.find(panel).is_some();
            layout.tree.root().is_some() && Panel::ALL.into_iter().all(is_there)
        };
        kept.filter(is_whole).unwrap_or_default()
    }

    /// Side panels keep their sizes until the picture becomes too small, and regain them when there is room:
    /// a larger window shows a larger picture.
    pub fn resize(&mut self, room: [f32; 2]) {
        // A minimised window is temporary.
        if room.iter().any(|length| *length < LEAST) {
            return;
        }
        let Some(before) = self.room.replace(room) else {
            return;
        };
        let (Some(mut tile), true) = (self.find(Panel::Picture), before != room) else {
            return;
        };
        while let Some(parent) = self.tree.tiles.parent_of(tile) {
            let tiles = &self.tree.tiles;
            let preferred_sizes = &mut self.preferred_sizes;
            let is_visible = |child: TileId| tiles.is_visible(child);
            if let Some(Tile::Container(Container::Linear(linear))) = tiles.get(parent) {
                let side = match linear.dir {
                    LinearDir::Horizontal => 0,
                    LinearDir::Vertical => 1,
                };
                let shares = resized(
                    linear,
                    tile,
                    is_visible,
                    preferred_sizes,
                    before[side],
                    room[side],
                );
                if let Some(Tile::Container(Container::Linear(linear))) =
                    self.tree.tiles.get_mut(parent)
                {
                    linear.shares = shares;
                }
            }
            tile = parent;
        }
    }

    /// Whether a panel is visible.
    pub fn is_visible(&self, panel: Panel) -> bool {
        self.find(panel).is_some_and(|id| self.tree.is_visible(id))
    }

    /// Shows a panel or hides it.
    pub fn set_visible(&mut self, panel: Panel, visible: bool) {
        if panel == Panel::Time {
            self.is_time_folded = false;
        }
        if let Some(id) = self.find(panel) {
            self.tree.set_visible(id, visible);
            if visible {
                self.tree.make_active(|tile, _| tile == id);
            }
        }
    }

    /// Hides the time panel when a static scene is opened, and shows it again with the next animated scene. The
    /// user's choice holds until then.
    pub fn set_animated(&mut self, is_animated: bool) {
        if self.is_animated.replace(is_animated) == Some(is_animated) {
            return;
        }
        if is_animated && self.is_time_folded {
            self.set_visible(Panel::Time, true);
        } else if !is_animated && self.is_visible(Panel::Time) {
            self.set_visible(Panel::Time, false);
            self.is_time_folded = true;
        }
    }

    /// Hides everything except the picture, or restores the previous layout.
    pub fn toggle_all(&mut self) {
        let others = || {
            Panel::ALL
                .into_iter()
                .filter(|panel| *panel != Panel::Picture)
        };
        if others().any(|panel| self.is_visible(panel)) {
            self.before = None;
            self.before = Some(Box::new(self.clone()));
            others().for_each(|panel| self.set_visible(panel, false));
        } else if let Some(before) = self.before.take() {
            *self = *before;
        } else {
            // They were hidden individually.
            let usual = Self::default();
            let shown = others().filter(|panel| usual.is_visible(*panel));
            shown.for_each(|panel| {
                if let Some(id) = self.find(panel) {
                    self.tree.set_visible(id, true);
                }
            });
        }
    }

    /// Shows the panels of the ray inspector, wide enough to be read.
    pub fn show_rays(&mut self, width: f32) {
        if self.before_rays.is_none() {
            self.before_rays = Some(Box::new(self.clone()));
        }
        self.set_visible(Panel::Rays, true);
        self.set_visible(Panel::Outside, true);
        self.widen(Panel::Rays, width);
    }

    /// Restores the layout from before [`Layout::show_rays`]. Other panels that were shown or hidden since stay so.
    pub fn hide_rays(&mut self) {
        let Some(before) = self.before_rays.take() else {
            return;
        };
        let others = Panel::ALL.into_iter();
        let others =
            others.filter(|panel| !matches!(panel, Panel::Rays | Panel::Outside | Panel::Render));
        let now: Vec<_> = others
            .map(|panel| (panel, self.is_visible(panel)))
            .collect();
        let room = self.room;
        *self = *before;
        for (panel, is_visible) in now {
            if self.is_visible(panel) != is_visible {
                self.set_visible(panel, is_visible);
            }
        }
        if let Some(room) = room {
            self.resize(room);
        }
    }

    /// Makes a panel at least so wide, in points, at the picture's expense. The picture keeps a share of
    /// the room.
    pub fn widen(&mut self, panel: Panel, width: f32) {
        let (Some(mut tile), Some(picture), Some([room, _])) =
            (self.find(panel), self.find(Panel::Picture), self.room)
        else {
            return;
        };
        let mut holders = vec![picture];
        while let Some(parent) = holders
            .last()
            .and_then(|tile| self.tree.tiles.parent_of(*tile))
        {
            holders.push(parent);
        }
        while let Some(parent) = self.tree.tiles.parent_of(tile) {
            let visible: Vec<TileId> = (self.tree.tiles.iter())
                .filter(|(id, _)| self.tree.tiles.is_visible(**id))
                .map(|(id, _)| *id)
                .collect();
            if let Some(Tile::Container(Container::Linear(linear))) =
                self.tree.tiles.get_mut(parent)
                && linear.dir == LinearDir::Horizontal
                && let Some(&giver) = (linear.children.iter()).find(|id| holders.contains(id))
            {
                let shown = linear.children.iter().filter(|id| visible.contains(id));
                let total: f32 = shown.map(|id| linear.shares[*id]).sum();
                let (now, gives) = (linear.shares[tile], linear.shares[giver]);
                let more = (width * total / room - now).min(gives - LEAST_PICTURE * total);
                if giver != tile && more > 0.0 {
                    linear.shares.set_share(tile, now + more);
                    linear.shares.set_share(giver, gives - more);
                }
                return;
            }
            tile = parent;
        }
    }

    /// The rectangle of a panel in the last frame, in points; `None` if it is hidden.
    pub fn rect(&self, panel: Panel) -> Option<egui::Rect> {
        self.tree.tiles.rect(self.find(panel)?)
    }

    fn find(&self, panel: Panel) -> Option<TileId> {
        self.tree.tiles.find_pane(&panel)
    }
}

/// Fractions of a row or column with the picture as child `picture`, after its length has changed.
fn resized(
    linear: &Linear,
    picture: TileId,
    is_visible: impl Fn(TileId) -> bool,
    preferred_sizes: &mut Vec<PreferredSize>,
    before: f32,
    now: f32,
) -> Shares {
    /// Tolerance for rounding, in points.
    const SAME: f32 = 0.5;
    let mut shares = linear.shares.clone();
    let total: f32 = (linear.children.iter())
        .filter(|child| is_visible(**child))
        .map(|child| shares[*child])
        .sum();
    let points = before / total.max(f32::MIN_POSITIVE);
    let mut beside = 0.0;
    let mut preferred = Vec::new();
    for &child in linear.children.iter().filter(|child| **child != picture) {
        let length = shares[child] * points;
        let size = preferred_sizes.iter().find(|size| size.tile == child);
        let size = size.filter(|size| (size.given - length).abs() < SAME);
        let length = size.map_or(length, |size| size.preferred);
        preferred.push((child, length));
        beside += if is_visible(child) { length } else { 0.0 };
    }
    let shrunk = ((1.0 - PICTURE) * now / beside.max(f32::MIN_POSITIVE)).min(1.0);
    for &(tile, preferred) in &preferred {
        let given = preferred * shrunk;
        shares.set_share(tile, given);
        preferred_sizes.retain(|size| size.tile != tile);
        if shrunk < 1.0 {
            preferred_sizes.push(PreferredSize {
                tile,
                preferred,
                given,
            });
        }
    }
    shares.set_share(picture, now - beside * shrunk);
    shares
}

//! The position of the picture in the window.

use eframe::egui::{Pos2, Rect, Vec2};
use glam::{DVec2, dvec2};

/// The rectangle of a picture on the screen, and its size in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// The whole picture, in points.
    pub rect: Rect,
    /// Width and height in the picture's pixels.
    pub size: (u32, u32),
}

impl Viewport {
    /// A picture of `size` centred in `space`, at one picture pixel per screen pixel, or smaller if it does
    /// not fit. Its corner is aligned to screen pixels.
    pub fn fitting(space: Rect, size: (u32, u32), pixels_per_point: f32) -> Self {
        Self::scaled(space, size, pixels_per_point, 1.0)
    }

    /// Like [`Self::fitting`], but enlarged if there is room.
    pub fn filling(space: Rect, size: (u32, u32), pixels_per_point: f32) -> Self {
        Self::scaled(space, size, pixels_per_point, f32::INFINITY)
    }

    fn scaled(space: Rect, size: (u32, u32), pixels_per_point: f32, limit: f32) -> Self {
        let pixels = Vec2::new(size.0 as f32, size.1 as f32);
        let available = space.size() * pixels_per_point;
        // Differences below a pixel are ignored: sizes in points are not whole pixels.
        let scale = match (available / pixels).min_elem() {
            enlarged if enlarged > 1.0 => enlarged.min(limit),
            _ => ((available + Vec2::splat(1.0)) / pixels)
                .min_elem()
                .min(1.0),
        };
        let extent = pixels * scale / pixels_per_point;
        let corner = space.center() - extent / 2.0;
        let corner = (corner.to_vec2() * pixels_per_point).round() / pixels_per_point;
        Self {
            rect: Rect::from_min_size(corner.to_pos2(), extent),
            size,
        }
    }

    /// The rectangle of a picture of another size: the same height and its own aspect ratio, because a
    /// camera's field of view is vertical.
    pub fn under(&self, size: (u32, u32)) -> Rect {
        let framing = self.framing(size);
        // Coarse pictures are rounded up to whole pixels.
        let pixel = self.rect.height() / size.1.max(1) as f32;
        match (framing.width() - self.rect.width()).abs() > 2.0 * pixel {
            true => framing,
            false => self.rect,
        }
    }

    /// The part of this picture that one of another aspect ratio shows, on the screen: as high, and narrower or
    /// wider, because a camera's field of view is vertical.
    pub fn framing(&self, (width, height): (u32, u32)) -> Rect {
        let high = self.rect.height();
        let wide = high * width as f32 / height.max(1) as f32;
        Rect::from_center_size(self.rect.center(), Vec2::new(wide, high))
    }

    /// Whether picture pixels match screen pixels exactly.
    pub fn is_exact(&self, pixels_per_point: f32) -> bool {
        (self.rect.width() * pixels_per_point - self.size.0 as f32).abs() < 0.5
    }

    /// Width and height in the picture's pixels.
    pub fn extent(&self) -> DVec2 {
        dvec2(self.size.0.into(), self.size.1.into())
    }

    /// Converts a point on the screen to a position in the picture, in pixels from its upper left corner.
    pub fn position(&self, point: Pos2) -> DVec2 {
        let off = point - self.rect.min;
        self.length(off)
    }

    /// Converts a distance on the screen to pixels of the picture.
    pub fn length(&self, length: Vec2) -> DVec2 {
        let scale = f64::from(self.size.0) / f64::from(self.rect.width());
        dvec2(length.x.into(), length.y.into()) * scale
    }

    /// Converts a position in the picture to a point on the screen.
    pub fn point(&self, position: DVec2) -> Pos2 {
        let scale = f64::from(self.rect.width()) / f64::from(self.size.0);
        let off = position * scale;
        self.rect.min + Vec2::new(off.x as f32, off.y as f32)
    }

    /// The screen rectangle of a part of the picture: x, y, width and height in its pixels.
    pub fn part(&self, [x, y, width, height]: [u32; 4]) -> Rect {
        let corner = dvec2(x.into(), y.into());
        let extent = dvec2(width.into(), height.into());
        Rect::from_two_pos(self.point(corner), self.point(corner + extent))
    }

    /// The pixel at a point on the screen.
    pub fn pixel(&self, point: Pos2) -> Option<[u32; 2]> {
        let position = self.position(point);
        let is_inside = position.cmpge(DVec2::ZERO).all() && position.cmplt(self.extent()).all();
        is_inside.then_some([position.x as u32, position.y as u32])
    }
}

/// Magnifies the picture on the screen without rendering it anew, down to single pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelZoom {
    /// At least 1.
    scale: f32,
    /// The share of the unmagnified picture that lies left of and above it, 0 to `scale` − 1.
    shift: Vec2,
}

impl Default for PixelZoom {
    fn default() -> Self {
        Self {
            scale: 1.0,
            shift: Vec2::ZERO,
        }
    }
}

impl PixelZoom {
    /// The largest magnification.
    pub const MAX: f32 = 64.0;
    /// By what two steps of the wheel magnify.
    const TWO_STEPS: f64 = 2.0;

    /// How much larger than usual the picture is, 1 to [`Self::MAX`].
    pub fn scale(&self) -> f32 {
        self.scale
    }

    /// Whether the picture is magnified.
    pub fn is_active(&self) -> bool {
        self.scale > 1.0
    }

    /// Magnifies by steps of the wheel, or reduces by negative ones. The point `at`, given as shares of the
    /// picture's width and height, stays where it is on the screen.
    pub fn zoom(&mut self, steps: f64, at: Vec2) {
        let factor = Self::TWO_STEPS.powf(steps / 2.0) as f32;
        let scale = (self.scale * factor).clamp(1.0, Self::MAX);
        let shift = self.shift + at * (scale - self.scale);
        self.scale = scale;
        self.shift = shift.clamp(Vec2::ZERO, Vec2::splat(scale - 1.0));
    }

    /// Where a picture is that is otherwise at `viewport`.
    pub fn of(&self, viewport: Viewport) -> Viewport {
        let extent = viewport.rect.size();
        let corner = viewport.rect.min - self.shift * extent;
        Viewport {
            rect: Rect::from_min_size(corner, extent * self.scale),
            ..viewport
        }
    }
}

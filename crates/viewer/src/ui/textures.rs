//! Registers screens as egui textures.

use super::thumbnails::Thumbnails;
use eframe::egui::TextureId;
use eframe::egui_wgpu::RenderState;
use eframe::wgpu::FilterMode;
use glimray_render::Screen;

/// Screens registered with egui. Those unused in a frame are released.
pub struct Textures {
    state: RenderState,
    known: Vec<Known>,
    /// Small copies of the pictures of the scene.
    pub thumbnails: Thumbnails,
}

struct Known {
    screen: Screen,
    filter: FilterMode,
    id: TextureId,
    is_used: bool,
}

impl Textures {
    pub fn new(state: RenderState) -> Self {
        Self {
            state,
            known: Vec::new(),
            thumbnails: Thumbnails::default(),
        }
    }

    /// Called before the first [`Self::id`] of a frame.
    pub fn begin_frame(&mut self) {
        for known in &mut self.known {
            known.is_used = false;
        }
    }

    /// The texture of a screen, with linear or nearest filtering.
    pub fn id(&mut self, screen: &Screen, is_smooth: bool) -> TextureId {
        let filter = match is_smooth {
            true => FilterMode::Linear,
            false => FilterMode::Nearest,
        };
        let known = (self.known.iter_mut()).find(|k| k.screen == *screen && k.filter == filter);
        if let Some(known) = known {
            known.is_used = true;
            return known.id;
        }
        let mut renderer = self.state.renderer.write();
        let id = renderer.register_native_texture(&self.state.device, screen.view(), filter);
        self.known.push(Known {
            screen: screen.clone(),
            filter,
            id,
            is_used: true,
        });
        id
    }

    /// Called after the last use in a frame.
    pub fn end(&mut self) {
        let mut renderer = self.state.renderer.write();
        self.known.retain(|known| {
            if !known.is_used {
                renderer.free_texture(&known.id);
            }
            known.is_used
        });
    }
}

//! The backdrop, which paths from the camera see where there is nothing.

use super::*;
use glimray_scene::Backdrop;

/// A backdrop without numbers.
#[derive(Clone, Copy, Debug, serde::Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum BackdropName {
    Transparent,
}

either! {
    /// `"transparent"`, or a colour.
    BackdropValue { Name(BackdropName), Color(Color) },
    "\"transparent\" or a colour: [r, g, b] or \"#rrggbb\"",
    str: Color or Name, seq: Color
}

impl BackdropValue {
    /// The value of a backdrop; `None` for the background.
    pub fn of(backdrop: Backdrop) -> Option<Self> {
        match backdrop {
            Backdrop::Background => None,
            Backdrop::Color(color) => Some(Self::Color(color.into())),
            Backdrop::Transparent => Some(Self::Name(BackdropName::Transparent)),
        }
    }

    /// The backdrop.
    pub fn backdrop(&self) -> Backdrop {
        match self {
            Self::Name(BackdropName::Transparent) => Backdrop::Transparent,
            Self::Color(color) => Backdrop::Color(color.0),
        }
    }
}

//! The panels: one file and one function each.

mod broken;
mod icon;
mod menu;
mod messages;
mod outline;
mod picture;
mod properties;
mod rays;
mod render;
mod status;
mod time;
mod words;

pub use menu::menu;
pub use messages::messages;
pub use outline::outline;
pub use picture::picture;
pub use properties::properties;
pub use rays::rays;
pub use rays::space::outside;
pub use render::render;
pub use status::status;
pub use time::time;

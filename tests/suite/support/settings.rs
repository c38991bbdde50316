//! Values of every setting that has a flag.

use glimray_app::settings::Setting;
use glimray_app::value_forms::Control;

/// Values of a setting as its flag takes them: both ends of a range, or all names.
pub fn texts(setting: &Setting) -> Vec<String> {
    let texts = |texts: &[&str]| texts.iter().map(|text| (*text).to_owned()).collect();
    match (setting.control)() {
        Control::Switch(_) => texts(&[""]),
        Control::Count(_, range) => [range.start(), range.end()].map(u32::to_string).into(),
        Control::Real(_, range) | Control::Limit(_, range) => {
            [range.start(), range.end()].map(f32::to_string).into()
        }
        Control::Names(names) => names.iter().map(|(name, _)| (*name).to_owned()).collect(),
        Control::Text => match setting.name {
            "size" => texts(&["33x44", "44x33"]),
            "crop" => texts(&["1,2,30,40", "0,0,1,1"]),
            "offset" => texts(&["fixed:0.0001", "fixed:0.0002"]),
            other => panic!("no values of {other}"),
        },
    }
}

//! Sizes in messages: numbers of bytes as people read them.

const UNITS: [&str; 6] = ["KiB", "MiB", "GiB", "TiB", "PiB", "EiB"];

/// `bytes` to one decimal in the largest unit in which it is at least 1, such as `1.5 GiB`; below 1 KiB exactly.
pub fn size(bytes: u64) -> String {
    match bytes {
        1 => return "1 byte".to_owned(),
        0..1024 => return format!("{bytes} bytes"),
        _ => {}
    }
    let rounded = |value: f64| (value * 10.0).round() / 10.0;
    let (mut value, mut unit) = (bytes as f64 / 1024.0, 0);
    while rounded(value) >= 1024.0 {
        value /= 1024.0;
        unit += 1;
    }
    format!("{} {}", rounded(value), UNITS[unit])
}

/// Two sizes that differ, such as what is needed and what is allowed: in bytes if [`size`] shows them alike.
pub fn sizes(bytes: [u64; 2]) -> [String; 2] {
    let shown = bytes.map(size);
    match shown[0] == shown[1] {
        true => bytes.map(|bytes| format!("{bytes} bytes")),
        false => shown,
    }
}

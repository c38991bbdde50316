//! Keeps Mesa's device-select layer quiet. On a machine without a desktop session it asks libwayland
//! for a display, which answers `error: XDG_RUNTIME_DIR is invalid or not set in the environment.` on
//! our standard error, where scripts look for our own errors. The layer has nothing to select there,
//! so it is switched off, by starting the program once more with the variable that does so: changing
//! one's own environment is not safe in a running process. Can go when the layer asks silently.

/// Replaces this process by one with `NODEVICE_SELECT=1` where the message would appear; returns
/// where it would not, or when the program cannot be started again.
#[cfg(target_os = "linux")]
pub fn silence_device_select() {
    use std::os::unix::process::CommandExt as _;
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if is_set("XDG_RUNTIME_DIR") || is_set("NODEVICE_SELECT") {
        return;
    }
    let Ok(program) = std::env::current_exe() else {
        return;
    };
    let mut arguments = std::env::args_os();
    let mut again = std::process::Command::new(program);
    if let Some(name) = arguments.next() {
        again.arg0(name);
    }
    // Only comes back if it fails; then the message is the lesser evil.
    let _ = again.args(arguments).env("NODEVICE_SELECT", "1").exec();
}

/// Other systems have no such layer.
#[cfg(not(target_os = "linux"))]
pub fn silence_device_select() {}

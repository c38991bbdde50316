//! Silences Mesa's device-select layer. On a machine without a desktop session the layer asks libwayland for
//! a display, and libwayland prints `error: XDG_RUNTIME_DIR is invalid or not set in the environment.` to
//! standard error, where scripts look for glimray's errors. The layer has nothing to select there, so it is
//! switched off. A running process cannot safely change its own environment, so the program is executed
//! again with the variable that switches the layer off. This can be removed once the layer is silent.

/// Replaces this process by one with `NODEVICE_SELECT=1` if the message would appear. Returns if it would
/// not, or if the program cannot be executed again.
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
    // Returns only on failure. The message is then acceptable.
    let _ = again.args(arguments).env("NODEVICE_SELECT", "1").exec();
}

/// Other systems have no such layer.
#[cfg(not(target_os = "linux"))]
pub fn silence_device_select() {}

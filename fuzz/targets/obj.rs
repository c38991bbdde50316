#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    glimray_fuzz::obj(bytes);
});

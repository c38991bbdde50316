//! Picture files: reading returns what was written, and a file is complete or absent.

use crate::support::skip::{Need, skip};
use exr::prelude::{FlatSamples, ReadChannels, ReadLayers};
use glimray::image::Image;
use glimray::output::{
    self, Channel, Format, ImageLayer, LayeredImage, OutputError, Place, SaveOptions,
};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A picture with many levels, values outside [0, 1] and no two equal rows.
fn sample(width: u32, height: u32) -> Image {
    let pixel = |i: u32| {
        let (x, y) = ((i % width) as f32, (i / width) as f32);
        [
            x / width as f32,
            y / height as f32 * 2.0,
            0.25 * (x - y),
            1.0,
        ]
    };
    Image {
        width,
        height,
        pixels: (0..width * height).map(pixel).collect(),
    }
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// The error message, with the folder replaced by `DIR`.
fn message(error: &OutputError, folder: &Path) -> String {
    error
        .to_string()
        .replace(&folder.display().to_string(), "DIR")
}

/// The names of all entries of the folder, including hidden files.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .expect("a readable folder")
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

fn nearest_level(value: f32) -> u8 {
    (f64::from(value).clamp(0.0, 1.0) * 255.0).round() as u8
}

#[test]
fn png_stores_the_nearest_levels() {
    let folder = folder();
    let path = folder.path().join("a.png");
    let image = sample(37, 11);
    output::save(&path, &image).expect("saved");
    let read = image::open(&path).expect("a picture");
    assert_eq!(
        read.color(),
        image::ColorType::Rgb8,
        "an opaque picture needs no alpha"
    );
    let read = read.into_rgb8();
    assert_eq!(read.dimensions(), (37, 11));
    for (pixel, stored) in image.pixels.iter().zip(read.pixels()) {
        assert_eq!([pixel[0], pixel[1], pixel[2]].map(nearest_level), stored.0);
    }
}

/// A part of a picture has its data window inside of the display window.
#[test]
fn exr_tells_where_a_part_lies_in_its_picture() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let image = sample(5, 3);
    let options = SaveOptions {
        place: Some(Place {
            corner: (7, 9),
            whole: (40, 30),
        }),
        ..SaveOptions::default()
    };
    output::save_with(&path, &image, &options).expect("saved");
    let meta = exr::meta::MetaData::read_from_file(&path, false).expect("a header");
    let header = &meta.headers[0];
    let position = header.own_attributes.layer_position;
    assert_eq!((position.x(), position.y()), (7, 9));
    assert_eq!((header.layer_size.x(), header.layer_size.y()), (5, 3));
    let display = header.shared_attributes.display_window;
    assert_eq!((display.position.x(), display.position.y()), (0, 0));
    assert_eq!((display.size.x(), display.size.y()), (40, 30));
    let read = exr::prelude::read_first_rgba_layer_from_file(
        &path,
        |size, _| vec![[0.0; 4]; size.area()],
        |pixels: &mut Vec<[f32; 4]>, at, (r, g, b, a): (f32, f32, f32, f32)| {
            pixels[at.y() * 5 + at.x()] = [r, g, b, a];
        },
    );
    let read = read.expect("a picture").layer_data.channel_data.pixels;
    assert_eq!(read, image.pixels);
}

/// OpenEXR's colours are multiplied by the opacity (its technical introduction, "Premultiplied vs. Un-Premultiplied").
#[test]
fn exr_stores_colors_multiplied_by_the_opacity() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let image = Image {
        width: 2,
        height: 1,
        pixels: vec![[0.5, 2.0, 1.0, 0.25], [1.0, 1.0, 1.0, 0.0]],
    };
    output::save(&path, &image).expect("saved");
    let read = image::open(&path).expect("a picture").into_rgba32f();
    assert_eq!(read.get_pixel(0, 0).0, [0.125, 0.5, 0.25, 0.25]);
    assert_eq!(read.get_pixel(1, 0).0, [0.0; 4]);
}

#[test]
fn png_stores_opacity_if_there_is_any() {
    let folder = folder();
    let path = folder.path().join("a.png");
    let mut image = sample(3, 3);
    image.pixels[4][3] = 0.5;
    output::save(&path, &image).expect("saved");
    let read = image::open(&path).expect("a picture").into_rgba8();
    assert_eq!(read.get_pixel(1, 1).0[3], 128);
    assert_eq!(read.get_pixel(0, 0).0[3], 255);
}

#[test]
fn an_opaque_picture_keeps_its_opacity_if_that_is_asked_for() {
    let folder = folder();
    let options = SaveOptions {
        opacity: true,
        ..SaveOptions::default()
    };
    for (name, colors) in [
        ("a.png", image::ColorType::Rgba8),
        ("a.exr", image::ColorType::Rgba32F),
        ("a.jpg", image::ColorType::Rgb8),
        ("a.hdr", image::ColorType::Rgb32F),
    ] {
        let path = folder.path().join(name);
        output::save_with(&path, &sample(3, 3), &options).expect("saved");
        assert_eq!(
            image::open(&path).expect("a picture").color(),
            colors,
            "{name}"
        );
    }
}

#[test]
fn values_outside_the_range_are_clamped_and_nan_becomes_black() {
    let folder = folder();
    let path = folder.path().join("a.png");
    let image = Image {
        width: 2,
        height: 1,
        pixels: vec![
            [-1.0, 7.0, f32::NAN, 1.0],
            [f32::INFINITY, f32::NEG_INFINITY, 0.5, 1.0],
        ],
    };
    output::save(&path, &image).expect("saved");
    let read = image::open(&path).expect("a picture").into_rgb8();
    assert_eq!(read.into_raw(), [0, 255, 0, 255, 0, 128]);
}

#[test]
fn exr_stores_floats_exactly() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let image = sample(37, 11);
    output::save(&path, &image).expect("saved");
    let read = image::open(&path).expect("a picture").into_rgba32f();
    let read: Vec<_> = read.pixels().map(|pixel| pixel.0).collect();
    assert_eq!(read, image.pixels);
}

#[test]
fn hdr_stores_values_within_one_percent_and_none_below_zero() {
    let folder = folder();
    let path = folder.path().join("a.hdr");
    let image = sample(37, 11);
    output::save(&path, &image).expect("saved");
    let read = image::open(&path).expect("a picture").into_rgb32f();
    for (pixel, stored) in image.pixels.iter().zip(read.pixels()) {
        // RGBE: the three mantissas of 8 bits share the exponent of the largest.
        let largest = pixel[..3].iter().fold(0.0_f32, |a, &b| a.max(b));
        for (value, stored) in pixel.iter().zip(stored.0) {
            let expected = value.max(0.0);
            assert!(
                (expected - stored).abs() <= largest / 100.0,
                "{expected} came back as {stored}"
            );
        }
    }
}

#[test]
fn jpeg_of_higher_quality_is_larger_and_more_accurate() {
    let folder = folder();
    let image = sample(64, 48);
    let error_and_size = |quality| {
        let path = folder.path().join(format!("{quality}.jpg"));
        let options = SaveOptions {
            quality,
            ..SaveOptions::default()
        };
        output::save_with(&path, &image, &options).expect("saved");
        let read = image::open(&path).expect("a picture").into_rgb8();
        let off: f64 = image
            .pixels
            .iter()
            .zip(read.pixels())
            .flat_map(|(pixel, stored)| [0, 1, 2].map(|c| (pixel[c], stored.0[c])))
            .map(|(value, stored)| f64::from(nearest_level(value).abs_diff(stored)))
            .sum();
        let size = fs::metadata(&path).expect("a file").len();
        (off / (64.0 * 48.0 * 3.0), size)
    };
    let (fine, coarse) = (error_and_size(100), error_and_size(10));
    assert!(
        fine.0 < 2.0,
        "{} levels off on average at quality 100",
        fine.0
    );
    assert!(
        fine.0 < coarse.0 && fine.1 > coarse.1,
        "{fine:?} {coarse:?}"
    );
}

#[test]
fn a_picture_is_the_same_bytes_every_time() {
    let folder = folder();
    for ending in ["png", "jpg", "exr", "hdr"] {
        let paths = ["a", "b"].map(|stem| folder.path().join(stem).with_extension(ending));
        for path in &paths {
            output::save(path, &sample(200, 150)).expect("saved");
        }
        let [a, b] = paths.map(|path| fs::read(path).expect("a file"));
        assert!(a == b, "{ending} differs from run to run");
    }
}

#[test]
fn extensions_name_formats_in_either_case() {
    let format = |name: &str| Format::from_path(Path::new(name));
    assert_eq!(format("a.PNG"), Some(Format::Png));
    assert_eq!(format("a.b.jpeg"), Some(Format::Jpeg));
    assert_eq!(format("x/a.Jpg"), Some(Format::Jpeg));
    assert_eq!(format("a.exr"), Some(Format::Exr));
    assert_eq!(format("a.hdr"), Some(Format::Hdr));
    assert_eq!(format("png"), None);
    assert_eq!(format("a.bmp"), None);
}

#[test]
fn a_requested_format_overrides_the_extension() {
    let folder = folder();
    let path = folder.path().join("a.dat");
    let options = SaveOptions {
        format: Some(Format::Png),
        ..SaveOptions::default()
    };
    output::save_with(&path, &sample(4, 4), &options).expect("saved");
    assert!(fs::read(&path).expect("a file").starts_with(b"\x89PNG"));
}

#[test]
fn sizes_beyond_a_formats_limit_are_refused_beforehand() {
    let folder = folder();
    let check = |name: &str, width, height| {
        output::check(
            folder.path().join(name),
            &SaveOptions::default(),
            width,
            height,
        )
    };
    assert!(check("a.jpg", 65_535, 65_535).is_ok());
    assert!(matches!(
        check("a.jpg", 65_536, 1),
        Err(OutputError::TooLarge { .. })
    ));
    assert!(matches!(
        check("a.jpg", 1, 65_536),
        Err(OutputError::TooLarge { .. })
    ));
    assert!(check("a.png", 70_000, 70_000).is_ok());
    assert!(check("a.hdr", 32_767, 70_000).is_ok());
    assert!(matches!(
        check("a.hdr", 32_768, 1),
        Err(OutputError::TooLarge { .. })
    ));
    let error = check("a.jpg", 65_536, 1).expect_err("too wide");
    insta::assert_snapshot!(error, @"cannot write the image (65536×1 pixels): JPEG supports at most 65535×65535. Choose a smaller size or another format.");
}

#[test]
fn a_picture_whose_pixels_do_not_fit_its_size_is_refused() {
    let folder = folder();
    let image = Image {
        width: 3,
        ..sample(2, 2)
    };
    let error = output::save(folder.path().join("a.png"), &image).expect_err("3×2 is not 4");
    insta::assert_snapshot!(error, @"cannot write the image (3×2 pixels): it has 4 pixels. Give it as many as its size requires.");
    assert!(names(folder.path()).is_empty());
}

#[test]
fn extreme_shapes_are_written() {
    let folder = folder();
    for (width, height) in [(1, 1), (16_384, 1), (1, 16_384), (7, 3), (32_767, 2)] {
        for ending in ["png", "jpg", "exr", "hdr"] {
            let path = folder.path().join("a").with_extension(ending);
            output::save(&path, &sample(width, height)).expect("saved");
            let read = image::image_dimensions(&path).expect("a picture");
            assert_eq!(read, (width, height), "{ending}");
        }
    }
}

#[test]
fn messages_say_what_where_why_and_what_to_do() {
    let folder = folder();
    let dir = folder.path();
    fs::write(dir.join("old.png"), "old").expect("a file");
    let keep = SaveOptions {
        clobber: false,
        ..SaveOptions::default()
    };
    let check = |name: &str, options: &SaveOptions| {
        let error = output::check(dir.join(name), options, 1, 1).expect_err(name);
        message(&error, dir)
    };
    let any = SaveOptions::default();
    insta::assert_snapshot!(check("a.bmp", &any), @"cannot determine the image format (DIR/a.bmp): the extension is none of .png, .jpg, .jpeg, .exr, .hdr. Choose one of them or name the format.");
    insta::assert_snapshot!(check("", &any), @"cannot write the file (DIR/): it is a folder. Add a file name.");
    insta::assert_snapshot!(check("no/a.png", &any), @"cannot write the file (DIR/no/a.png): the folder DIR/no does not exist. Create it first.");
    insta::assert_snapshot!(check("old.png", &keep), @"cannot write the file (DIR/old.png): it exists and must not be replaced. Choose another name.");
    if cfg!(unix) {
        insta::assert_snapshot!(check("old.png/a.png", &any), @"cannot write the file (DIR/old.png/a.png): not a directory. Choose another name.");
    }
}

#[test]
fn control_characters_in_a_name_stay_out_of_the_message() {
    let error = output::check("no\n\u{1b}[2J/é😀.png", &SaveOptions::default(), 1, 1);
    insta::assert_snapshot!(error.expect_err("no such folder"), @r"cannot write the file (no\n\u{1b}[2J/é😀.png): the folder no\n\u{1b}[2J does not exist. Create it first.");
}

#[test]
fn odd_names_are_written() {
    let folder = folder();
    // The temporary file's name would exceed the limit of file names.
    let long = format!("{}.png", "ä".repeat(120));
    for name in ["-o.png", "a b\n.png", "😀.png", long.as_str()] {
        output::check(folder.path().join(name), &SaveOptions::default(), 2, 2).expect(name);
        output::save(folder.path().join(name), &sample(2, 2)).expect(name);
    }
    assert_eq!(names(folder.path()).len(), 4);
    let name = format!("{}.png", "a".repeat(260));
    let result = output::check(folder.path().join(name), &SaveOptions::default(), 2, 2);
    assert!(matches!(result, Err(OutputError::Io { .. })), "{result:?}");
}

#[test]
fn checking_creates_and_changes_no_file() {
    let folder = folder();
    let path = folder.path().join("a.png");
    output::check(&path, &SaveOptions::default(), 1, 1).expect("writable");
    assert!(names(folder.path()).is_empty());
    fs::write(&path, "old").expect("a file");
    output::check(&path, &SaveOptions::default(), 1, 1).expect("writable");
    assert_eq!(names(folder.path()), ["a.png"]);
    assert_eq!(fs::read(&path).expect("a file"), b"old");
}

#[test]
fn an_existing_file_is_replaced_only_with_clobber() {
    let folder = folder();
    let path = folder.path().join("a.png");
    fs::write(&path, "old").expect("a file");
    let keep = SaveOptions {
        clobber: false,
        ..SaveOptions::default()
    };
    let result = output::save_with(&path, &sample(2, 2), &keep);
    assert!(
        matches!(result, Err(OutputError::Exists { .. })),
        "{result:?}"
    );
    assert_eq!(fs::read(&path).expect("a file"), b"old");
    output::save(&path, &sample(2, 2)).expect("replaced");
    assert!(image::open(&path).is_ok());
    assert_eq!(names(folder.path()), ["a.png"]);
}

#[test]
fn a_write_protected_file_is_kept() {
    let folder = folder();
    let path = folder.path().join("a.png");
    fs::write(&path, "old").expect("a file");
    let mut permissions = fs::metadata(&path).expect("a file").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).expect("permissions");
    let error = output::save(&path, &sample(2, 2)).expect_err("it is protected");
    insta::assert_snapshot!(message(&error, folder.path()), @"cannot write the file (DIR/a.png): it is write-protected. Choose another name or make it writable.");
    assert_eq!(fs::read(&path).expect("a file"), b"old");
}

#[test]
fn other_files_are_written_atomically_too() {
    let folder = folder();
    let path = folder.path().join("report.json");
    output::check_file(&path, true).expect("writable");
    output::write(&path, b"{}\n", true).expect("written");
    assert_eq!(fs::read(&path).expect("a file"), b"{}\n");
    assert!(matches!(
        output::write(&path, b"", false),
        Err(OutputError::Exists { .. })
    ));
}

/// Temporary files are named after the process; no process has this number.
const DEAD: u32 = u32::MAX;

#[test]
fn temporary_files_of_dead_processes_are_removed_and_others_kept() {
    let folder = folder();
    let dir = folder.path();
    let alive = format!(".a.png.part-{}-Ab12Cd", std::process::id());
    let dead = format!(".a.png.part-{DEAD}-Ab12Cd");
    let other = format!(".b.png.part-{DEAD}-Ab12Cd");
    for name in [
        alive.as_str(),
        &dead,
        &other,
        ".a.png.part-x",
        ".a.png.part-",
    ] {
        fs::write(dir.join(name), "half").expect("a file");
    }
    output::check(dir.join("a.png"), &SaveOptions::default(), 1, 1).expect("writable");
    let left = names(dir);
    assert!(left.contains(&alive) && left.contains(&other), "{left:?}");
    if Path::new("/proc/self").exists() {
        assert!(!left.contains(&dead), "{left:?}");
        assert_eq!(left.len(), 4);
    }
}

#[test]
fn readers_see_either_the_old_picture_or_the_new_one() {
    let folder = folder();
    let path = folder.path().join("a.png");
    let [small, large] = [sample(16, 16), sample(256, 256)];
    output::save(&path, &small).expect("saved");
    let done = std::sync::atomic::AtomicBool::new(false);
    std::thread::scope(|scope| {
        let reader = scope.spawn(|| {
            let mut seen = 0;
            while !done.load(std::sync::atomic::Ordering::SeqCst) {
                let bytes = fs::read(&path).expect("a file at any time");
                let read = image::load_from_memory(&bytes).expect("a whole picture at any time");
                assert!([16, 256].contains(&read.width()));
                seen += 1;
            }
            seen
        });
        for turn in 0..10 {
            let image = if turn % 2 == 0 { &large } else { &small };
            output::save(&path, image).expect("saved");
        }
        done.store(true, std::sync::atomic::Ordering::SeqCst);
        assert!(reader.join().expect("the reader") > 0);
    });
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::io::Read;
    use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt, symlink};
    use std::process::Command;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).expect("a file").permissions().mode() & 0o7777
    }

    #[test]
    fn a_new_file_has_default_permissions() {
        let folder = folder();
        let [ours, theirs] = ["ours.png", "theirs"].map(|name| folder.path().join(name));
        output::save(&ours, &sample(2, 2)).expect("saved");
        fs::write(&theirs, "").expect("a file");
        assert_eq!(mode(&ours), mode(&theirs), "what the umask leaves");
    }

    #[test]
    fn a_replaced_file_keeps_its_permissions() {
        let folder = folder();
        let path = folder.path().join("a.png");
        fs::write(&path, "old").expect("a file");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).expect("permissions");
        output::save(&path, &sample(2, 2)).expect("saved");
        assert_eq!(mode(&path), 0o640);
    }

    #[test]
    fn a_link_stays_and_its_file_is_replaced() {
        let folder = folder();
        let [file, link] = ["real.png", "link.png"].map(|name| folder.path().join(name));
        fs::write(&file, "old").expect("a file");
        symlink(&file, &link).expect("a link");
        output::save(&link, &sample(2, 2)).expect("saved");
        assert!(fs::symlink_metadata(&link).expect("a link").is_symlink());
        assert!(image::open(&file).is_ok());
    }

    #[test]
    fn a_dangling_link_is_kept_and_its_target_is_created() {
        let folder = folder();
        let place = |name: &str| folder.path().join(name);
        fs::create_dir(place("far")).expect("a folder");
        symlink("second.png", place("first.png")).expect("a link");
        symlink("far/away.png", place("second.png")).expect("a link");
        let image = sample(2, 2);
        output::check(place("first.png"), &SaveOptions::default(), 2, 2).expect("it can be made");
        output::save(place("first.png"), &image).expect("saved");
        assert!(place("first.png").is_symlink() && place("second.png").is_symlink());
        let made = fs::read(place("far/away.png")).expect("a picture");
        output::save(place("plain.png"), &image).expect("saved");
        assert!(made == fs::read(place("plain.png")).expect("a picture"));
        assert_eq!(names(&place("far")), ["away.png"]);

        symlink("nowhere/away.png", place("lost.png")).expect("a link");
        let error = output::save(place("lost.png"), &image).expect_err("no folder");
        assert!(
            error.to_string().contains("nowhere does not exist"),
            "{error}"
        );
        assert!(place("lost.png").is_symlink());
    }

    #[test]
    fn a_full_device_is_an_error_in_every_format() {
        let full = Path::new("/dev/full");
        if !full.exists() {
            return skip(Need::Special, "there is no /dev/full");
        }
        for format in [Format::Png, Format::Jpeg, Format::Exr, Format::Hdr] {
            let options = SaveOptions {
                format: Some(format),
                ..SaveOptions::default()
            };
            let error = output::save_with(full, &sample(2, 2), &options).expect_err("it is full");
            assert_eq!(
                error.to_string(),
                "cannot write the file (/dev/full): no space left on device. \
                 Free some space or choose another disk."
            );
        }
        assert!(
            fs::metadata(full)
                .expect("a device")
                .file_type()
                .is_char_device()
        );
    }

    #[test]
    fn a_device_is_written_to_and_not_replaced() {
        let null = Path::new("/dev/null");
        let before = fs::metadata(null).expect("a device").rdev();
        output::check(null, &SaveOptions::default(), 2, 2).expect("a device takes a PNG");
        output::save(null, &sample(2, 2)).expect("swallowed");
        let after = fs::metadata(null).expect("a device");
        assert!(after.file_type().is_char_device() && after.rdev() == before);
    }

    #[test]
    fn a_pipe_gets_the_bytes_and_stays_a_pipe() {
        let folder = folder();
        let path = folder.path().join("pipe.png");
        let made = Command::new("mkfifo").arg(&path).status();
        if !made.is_ok_and(|status| status.success()) {
            return skip(Need::Special, "mkfifo makes no pipe");
        }
        let reader = std::thread::spawn({
            let path = path.clone();
            move || {
                let mut bytes = Vec::new();
                let mut pipe = fs::File::open(path).expect("a pipe");
                pipe.read_to_end(&mut bytes).expect("bytes");
                bytes
            }
        });
        output::check(&path, &SaveOptions::default(), 9, 9).expect("a pipe will do");
        output::save(&path, &sample(9, 9)).expect("sent");
        let bytes = reader.join().expect("the reader");
        assert!(image::load_from_memory(&bytes).is_ok());
        assert!(fs::metadata(&path).expect("a pipe").file_type().is_fifo());
        assert_eq!(names(folder.path()), ["pipe.png"]);
    }

    #[test]
    fn a_folder_that_cannot_hold_files_is_detected_beforehand() {
        // Even root cannot create files there.
        let path = Path::new("/proc/glimray.png");
        if !Path::new("/proc/self").exists() {
            return skip(Need::Special, "there is no /proc");
        }
        for result in [
            output::check(path, &SaveOptions::default(), 1, 1),
            output::save(path, &sample(1, 1)),
        ] {
            assert!(matches!(result, Err(OutputError::Io { .. })), "{result:?}");
        }
    }

    /// Runs `script` in a private mount namespace; `None` if the system does not allow that.
    fn in_private_mounts(script: &str, arguments: &[&Path]) -> Option<std::process::Output> {
        let unshare = |script: &str| {
            Command::new("unshare")
                .args(["--mount", "--map-root-user", "sh", "-c", script, "sh"])
                .arg(env!("CARGO_BIN_EXE_glimray"))
                .args(arguments)
                .output()
        };
        let why = match unshare("mount -t tmpfs none \"$2\"") {
            Ok(probe) if probe.status.success() => return Some(unshare(script).expect("unshare")),
            Ok(probe) => String::from_utf8_lossy(&probe.stderr).trim().to_owned(),
            Err(error) => format!("unshare: {error}"),
        };
        skip(Need::Mounts, why);
        None
    }

    /// Two pictures whose difference `compare --diff` writes, which needs no GPU.
    fn noisy_pair(folder: &Path) -> [PathBuf; 2] {
        let mut state = 1_u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as f32 / 255.0
        };
        ["one.png", "two.png"].map(|name| {
            let pixels = (0..256 * 256)
                .map(|_| [noise(), noise(), noise(), 1.0])
                .collect();
            let path = folder.join(name);
            let image = Image {
                width: 256,
                height: 256,
                pixels,
            };
            output::save(&path, &image).expect("saved");
            path
        })
    }

    #[test]
    fn a_full_disk_leaves_only_the_old_file() {
        let folder = folder();
        let disk = folder.path().join("disk");
        fs::create_dir(&disk).expect("a folder");
        let [one, two] = noisy_pair(folder.path());
        let script = r#"
            mount -t tmpfs -o size=64k none "$2" && printf old > "$2/out.png" || exit 99
            "$1" compare "$3" "$4" --max-share 100 --diff "$2/out.png" > "$2/../figures"
            echo "code $?"; ls -A "$2"; cat "$2/out.png""#;
        let Some(run) = in_private_mounts(script, &[&disk, &one, &two]) else {
            return;
        };
        assert_eq!(String::from_utf8_lossy(&run.stdout), "code 4\nout.png\nold");
        let error = String::from_utf8_lossy(&run.stderr);
        assert!(error.contains("no space left on device"), "{error}");
    }

    #[test]
    fn a_read_only_disk_is_an_error_before_any_work() {
        let folder = folder();
        let disk = folder.path().join("disk");
        fs::create_dir(&disk).expect("a folder");
        let script = r#"
            mount -t tmpfs -o ro none "$2" || exit 99
            "$1" compare nothing.png nothing.png --diff "$2/out.png"
            echo "code $?""#;
        let Some(run) = in_private_mounts(script, &[&disk]) else {
            return;
        };
        assert_eq!(String::from_utf8_lossy(&run.stdout), "code 4\n");
        let error = String::from_utf8_lossy(&run.stderr);
        assert!(
            error.contains("read-only file system. Choose a folder"),
            "{error}"
        );
    }
}

#[test]
fn a_sheet_has_its_pictures_in_rows_and_black_where_there_is_none() {
    let picture = |value: f32| Image {
        width: 2,
        height: 1,
        pixels: vec![[value, 0.0, 0.0, 1.0], [value, 1.0, 0.0, 1.0]],
    };
    let pictures = [0.1, 0.2, 0.3].map(picture);
    let sheet = Image::sheet(&pictures, 2);
    assert_eq!((sheet.width, sheet.height), (4, 2));
    let red: Vec<f32> = sheet.pixels.iter().map(|pixel| pixel[0]).collect();
    assert_eq!(red, [0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.0, 0.0]);
    assert_eq!(sheet.pixels[7], [0.0, 0.0, 0.0, 1.0]);
    // A single one is no wider than it is.
    assert_eq!(Image::sheet(&pictures[..1], 4), pictures[0]);
}

/// Half floats end at 65504, have 11 bits from 2⁻¹⁴ on, and infinities and NaN.
#[test]
fn layers_beyond_half_floats_are_stored_as_32_bit_floats() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let least = f32::powi(2.0, -14);
    let rows: [(&str, [f32; 4], bool); 7] = [
        ("largest", [65504.0, 0.5, -1.0, 0.0], true),
        ("larger", [65505.0, 0.5, -1.0, 0.0], false),
        ("below", [0.0, 0.5, -1e9, 0.0], false),
        ("black", [0.0; 4], true),
        ("dark", [least, 0.0, 0.0, 0.0], true),
        ("beside bright", [1.0, 1e-9, 0.0, 0.0], true),
        (
            "not finite",
            [f32::INFINITY, f32::NAN, f32::NEG_INFINITY, 2.0],
            true,
        ),
    ];
    let channel = |name, values: [f32; 4]| Channel {
        name,
        values: values.to_vec(),
        is_half: true,
    };
    let image = LayeredImage {
        width: 2,
        height: 2,
        // All channels of a layer are stored alike.
        layers: (rows.iter())
            .map(|(name, values, _)| ImageLayer {
                name,
                channels: vec![
                    channel("A", [values[0].abs().min(0.5); 4]),
                    channel("V", *values),
                ],
            })
            .collect(),
        in_parts: false,
    };
    for in_parts in [false, true] {
        let image = LayeredImage {
            in_parts,
            ..image.clone()
        };
        output::save_layers(&path, &image, &SaveOptions::default()).expect("a file");
        let file = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_file(&path)
            .expect("an OpenEXR file");
        let channels: Vec<(String, FlatSamples)> = (file.layer_data.iter())
            .flat_map(|part| {
                let name = part.attributes.layer_name.as_ref().filter(|_| in_parts);
                let prefix = name.map_or(String::new(), |name| format!("{name}."));
                let list = part.channel_data.list.iter();
                list.map(move |it| (format!("{prefix}{}", it.name), it.sample_data.clone()))
            })
            .collect();
        for (name, values, fits) in &rows {
            for end in ["A", "V"] {
                let full = format!("{name}.{end}");
                let found = channels.iter().find(|(name, _)| *name == full);
                let (_, samples) = found.expect("the channel");
                assert_eq!(matches!(samples, FlatSamples::F16(_)), *fits, "{full}");
                let wanted = &values[..];
                let stored: Vec<f32> = samples.values_as_f32().collect();
                let is_kept = |(a, b): (&f32, &f32)| {
                    a == b || (a.is_nan() && b.is_nan()) || (*fits && (a - b).abs() < 1e-8)
                };
                assert!(
                    end == "A" || stored.iter().zip(wanted).all(is_kept),
                    "{full}: {stored:?}"
                );
            }
        }
    }
}

//! The command line as clap sees it. Names here are promises: add to them, rename nothing.

mod flags;
mod motion;
mod values;

#[cfg(feature = "viewer")]
pub use flags::RecordingFlags;
pub use flags::{
    CameraFlags, DevelopFlags, DeviceFlags, LogFlags, OutputFlags, PartFlags, PictureFlags,
    ProgressMode, SceneFlags, SizeFlags,
};
pub use motion::{
    MomentFlags, MotionFlags, Range, RangeFlags, SequenceFlags, SequenceFormat, TurnFlags,
};
pub use values::MAX_FRAME;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use std::path::PathBuf;

/// Ray traces scenes on the GPU, or on the CPU through Mesa's software driver.
#[derive(Debug, Parser)]
#[command(
    name = "glimray",
    version,
    max_term_width = 100,
    arg_required_else_help = true,
    after_help = "Example: glimray demo -o glimray.png\n\n\
        Exit codes: 0 done, 1 internal fault, 2 bad command line, 3 scene or input refused, \
        4 output cannot be written, 5 no usable GPU adapter, 6 the GPU kept failing, \
        7 too big for the memory or the adapter, 8 compare: different, merge: parts missing, 130 Ctrl-C, 143 SIGTERM."
)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a showcase scene that is part of the program: no file needed.
    #[command(after_help = "Example: glimray demo --size 1280x720 --samples 16 -o demo.png")]
    Demo(Box<DemoArgs>),
    /// Render one picture of a scene. What the scene file says is the default; a flag wins.
    #[command(after_help = "Examples:\n  \
            glimray render scene.toml -o picture.png\n  \
            glimray render model.obj --look-from 0,1,4 --look-at 0,0,0 --samples 16 -o model.exr\n  \
            glimray render scene.toml --frame 12 --shutter 0.5 -o frame.png\n  \
            glimray render scene.scene --quiet -o - --format png | display")]
    Render(Box<RenderArgs>),
    /// Render the frames of a moving scene, as numbered files or as a video. A run that was stopped
    /// goes on where it stopped, by the same command.
    #[command(after_help = "Examples:\n  \
            glimray animate scene.toml -o walk.mp4\n  \
            glimray animate scene.toml --frames 0..47 --shutter 180deg -o walk_%04d.png\n  \
            glimray animate scene.toml --loop --fps 12 -o walk.gif\n  \
            glimray animate scene.toml -o walk.mp4 --encode-only --quality 60\n  \
            glimray animate scene.toml --quiet -o - --format y4m | mpv -\n\n\
            The frames of a video are kept as files (walk.mp4.frames/frame_0000.png …), so that it can \
            be written again without rendering. A frame that is there is used if it was written \
            completely, by the same scene, settings, adapter and version; NAME_journal.png.jsonl beside \
            the frames knows. Delete a frame to have just that one rendered again.")]
    Animate(Box<AnimateArgs>),
    /// Render a turn round a model, which repeats without a seam.
    #[command(after_help = "Examples:\n  \
            glimray turntable model.obj -o model.mp4\n  \
            glimray turntable model.obj --seconds 2 --axis z --elevation 30 -o model.gif\n\n\
            The camera goes round the model at a distance from which all of it is seen. Frames are \
            kept and runs go on as with `animate`.")]
    Turntable(Box<TurntableArgs>),
    /// Open a window in which a scene is rendered while one looks at it.
    #[cfg(feature = "viewer")]
    #[command(after_help = "Examples:\n  \
            glimray view\n  \
            glimray view scene.toml\n  \
            glimray view model.obj --look-from 0,1,4 --look-at 0,0,0 --samples 64\n  \
            glimray view scene.toml --frame 12 --shutter 180deg --size 640x360\n\n\
            Without a scene the window shows the demo; files can be dropped on it. The scene is read \
            again when its file changes. Without --size the picture is as large as there is room for. \
            In the window H shows all bindings. On a desktop, glimray alone does the same as \
            glimray view. Settings are kept in viewer.toml in the settings folder, or in the folder that \
            GLIMRAY_SETTINGS names.")]
    View(Box<ViewArgs>),
    /// Write a scene as a native one (.toml) with its meshes and pictures beside it: the same picture,
    /// in words that can be edited.
    #[command(after_help = "Example: glimray convert model.obj -o model.toml\n\n\
            It prints the names of all files. Files beside the scene are never replaced.")]
    Convert(ConvertArgs),
    /// Put films of parts of a picture together: into one film, or into the picture. Parts are regions
    /// (--crop) or ranges of samples (--sample-offset, --sample-count), in any order.
    #[command(after_help = "Examples:\n  \
            glimray render scene.toml --samples 128 --sample-count 64 -o a.film\n  \
            glimray render scene.toml --samples 128 --sample-offset 64 -o b.film\n  \
            glimray merge a.film b.film -o picture.png\n\n\
            The picture is the one that one run renders, to the last bit. What is missing of it is listed, \
            with exit code 8, and nothing is written then.")]
    Merge(MergeArgs),
    /// Say what is in a scene: counts, bounds, cameras, lights, materials, what was skipped.
    #[command(after_help = "Example: glimray inspect scene.toml --json")]
    Inspect(InspectArgs),
    /// Say where the light of one pixel comes from: every ray of it, as a tree, with what it met, how
    /// the surface divides the light, and what it adds.
    #[command(after_help = "Examples:\n  \
            glimray explain scene.toml --pixel 320,240\n  \
            glimray explain scene.toml --pixel 320,240 --sample 0 --json\n  \
            glimray explain scene.toml --size 96x54 --samples 1 --pixel 40,30 --obj rays.obj\n\n\
            What the rays of a sample add is the sample's colour, and the weighted mean of all samples is \
            the pixel, as linear light. Give the flags that the picture was rendered with.")]
    Explain(Box<ExplainArgs>),
    /// List the GPU adapters and their limits, test the one that would be used, and say what to
    /// install when there is none.
    #[command(after_help = "Example: glimray doctor --backend vulkan")]
    Doctor(DoctorArgs),
    /// Compare two pictures: RMSE, PSNR, FLIP, largest difference. Exit code 8 when they differ.
    #[command(
        after_help = "Example: glimray compare a.png b.png --tolerance 3 --max-share 0.1 \
            --diff difference.png\n\n\
            Values are compared as the files store them, 8-bit and 16-bit ones as parts of 1. One \
            level is 1/255."
    )]
    Compare(CompareArgs),
    /// Measure compile, trace and total time, and rays per second, on built-in scenes.
    #[command(after_help = "Example: glimray bench --repeats 5 --json")]
    Bench(BenchArgs),
    /// Print a completion script for a shell.
    #[command(
        after_help = "Example: glimray completions bash > ~/.local/share/bash-completion/completions/glimray"
    )]
    Completions(CompletionsArgs),
    /// Write manual pages: glimray.1, and a page for each command.
    #[command(after_help = "Example: glimray man ~/.local/share/man/man1")]
    Man(ManArgs),
    /// Print the JSON Schema of the native scene format (.toml), for editors.
    #[command(after_help = "Example: glimray schema > glimray.schema.json")]
    Schema,
}

#[derive(Debug, Args)]
pub struct DemoArgs {
    #[command(flatten)]
    pub output: OutputFlags,
    #[command(flatten)]
    pub size: SizeFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
    #[command(flatten)]
    pub log: LogFlags,
}

#[derive(Debug, Args)]
pub struct RenderArgs {
    /// The scene: .scene (course format), .toml (native), .nff or .obj
    pub scene: PathBuf,
    #[command(flatten)]
    pub output: OutputFlags,
    #[command(flatten)]
    pub part: PartFlags,
    #[command(flatten)]
    pub picture: PictureFlags,
    #[command(flatten)]
    pub camera: CameraFlags,
    #[command(flatten)]
    pub moment: MomentFlags,
    #[command(flatten)]
    pub motion: MotionFlags,
    #[command(flatten)]
    pub reading: SceneFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
    #[command(flatten)]
    pub log: LogFlags,
}

#[derive(Debug, Args)]
pub struct AnimateArgs {
    /// The scene: .scene (course format), .toml (native), .nff or .obj
    pub scene: PathBuf,
    #[command(flatten)]
    pub output: SequenceFlags,
    #[command(flatten)]
    pub range: RangeFlags,
    #[command(flatten)]
    pub motion: MotionFlags,
    #[command(flatten)]
    pub picture: PictureFlags,
    #[command(flatten)]
    pub camera: CameraFlags,
    #[command(flatten)]
    pub reading: SceneFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
    #[command(flatten)]
    pub log: LogFlags,
}

#[derive(Debug, Args)]
pub struct TurntableArgs {
    /// The model: any scene that `render` reads
    pub scene: PathBuf,
    #[command(flatten)]
    pub output: SequenceFlags,
    #[command(flatten)]
    pub turn: TurnFlags,
    #[command(flatten)]
    pub picture: PictureFlags,
    #[command(flatten)]
    pub reading: SceneFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
    #[command(flatten)]
    pub log: LogFlags,
}

#[cfg(feature = "viewer")]
#[derive(Debug, Args)]
pub struct ViewArgs {
    /// The scene: any that `render` reads [default: the demo's]
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    pub picture: PictureFlags,
    #[command(flatten)]
    pub camera: CameraFlags,
    #[command(flatten)]
    pub moment: MomentFlags,
    #[command(flatten)]
    pub motion: MotionFlags,
    #[command(flatten)]
    pub reading: SceneFlags,
    #[command(flatten)]
    pub recording: RecordingFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
}

#[derive(Debug, Args)]
pub struct ConvertArgs {
    /// The scene: .scene (course format), .toml (native), .nff or .obj
    pub scene: PathBuf,
    /// The native scene to write [default: the scene's name with .toml, in the current folder]
    #[arg(short, long, value_name = "OUT.toml")]
    pub output: Option<PathBuf>,
    /// Refuse to replace a scene file that is there
    #[arg(long)]
    pub no_clobber: bool,
    #[command(flatten)]
    pub reading: SceneFlags,
}

#[derive(Debug, Args)]
pub struct MergeArgs {
    /// Films of parts of one picture, written by `render` or `merge`
    #[arg(required = true, value_name = "PART")]
    pub parts: Vec<PathBuf>,
    #[command(flatten)]
    pub output: OutputFlags,
    #[command(flatten)]
    pub develop: DevelopFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
}

#[derive(Debug, Args)]
pub struct InspectArgs {
    /// The scene: .scene (course format), .toml (native), .nff or .obj
    pub scene: PathBuf,
    /// Print JSON instead of text
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub reading: SceneFlags,
}

#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// The scene: .scene (course format), .toml (native), .nff or .obj
    pub scene: PathBuf,
    /// The pixel's column and row in the whole picture, from the top-left, which is 0,0
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = values::pixel)]
    pub pixel: [u32; 2],
    /// Only this sample of the pixel, the first being 0 [default: all]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub sample: Option<u32>,
    /// Print JSON instead of text
    #[arg(long)]
    pub json: bool,
    /// Write the rays as lines into this Wavefront OBJ file too, in the scene's units
    #[arg(long, value_name = "FILE.obj")]
    pub obj: Option<PathBuf>,
    #[command(flatten)]
    pub picture: PictureFlags,
    #[command(flatten)]
    pub camera: CameraFlags,
    #[command(flatten)]
    pub moment: MomentFlags,
    #[command(flatten)]
    pub motion: MotionFlags,
    #[command(flatten)]
    pub reading: SceneFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
}

#[derive(Debug, Args)]
pub struct DoctorArgs {
    /// Print JSON instead of text
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub device: DeviceFlags,
}

#[derive(Debug, Args)]
pub struct CompareArgs {
    /// The first picture: PNG, JPEG, OpenEXR or Radiance HDR
    pub a: PathBuf,
    /// The second picture, of the same size
    pub b: PathBuf,
    /// Let a pixel differ by this many levels of 255 in any channel before it counts
    #[arg(long, value_name = "LEVELS", default_value = "0", value_parser = values::tolerance)]
    pub tolerance: f64,
    /// Let this share of the pixels differ by more than the tolerance, in percent
    #[arg(long, value_name = "PERCENT", default_value = "0", value_parser = values::percent)]
    pub max_share: f64,
    /// Write a picture of the differences, scaled so that the largest is white
    #[arg(long, value_name = "OUT.png")]
    pub diff: Option<PathBuf>,
    /// Print JSON instead of text
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct BenchArgs {
    /// How often to render each workload; the median counts
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub repeats: u32,
    /// Only the workloads whose name contains this
    #[arg(long, value_name = "NAME")]
    pub only: Option<String>,
    /// Print JSON instead of text
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub device: DeviceFlags,
}

#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// The shell
    pub shell: Shell,
}

#[derive(Debug, Args)]
pub struct ManArgs {
    /// An existing folder for the pages; pages of the same name are replaced
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
}

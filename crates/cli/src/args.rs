//! The command line as clap declares it. Commands and flags are a stable interface: add to them, rename none.

mod bench;
mod checkpoint;
#[cfg(feature = "archive")]
mod farm;
mod flags;
mod motion;
mod schema;
mod sheet;
mod values;

pub use bench::BenchArgs;
pub use checkpoint::CheckpointFlags;
#[cfg(feature = "archive")]
pub use farm::{
    Engine, FarmCommand, FarmMergeArgs, FarmPlanArgs, FarmRunArgs, FarmStatusArgs, FarmSubmitArgs,
};
#[cfg(feature = "viewer")]
pub use flags::RecordingFlags;
pub use flags::{
    AxisFlags, CameraFlags, DevelopFlags, DeviceFlags, LayerFlags, LogFlags, OutputFlags,
    PartFlags, PictureFlags, ProgressMode, SceneFlags, SettingFlags, SizeFlags,
};
pub use motion::{
    MomentFlags, MotionFlags, Range, RangeFlags, SequenceFlags, SequenceFormat, TurnFlags,
};
pub use schema::{SchemaArgs, Subject};
pub use sheet::{SheetArgs, ThumbnailArgs, VIEWS, View};
pub use values::MAX_FRAME;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use std::path::PathBuf;

/// Ray trace scenes on the GPU, or on the CPU through Mesa's software driver.
#[derive(Debug, Parser)]
#[command(
    name = "glimray",
    version,
    max_term_width = 100,
    arg_required_else_help = true,
    after_help = "Examples:\n  \
            glimray demo -o glimray.png\n  \
            glimray render scene.toml --samples 16 -o picture.png\n  \
            glimray render --help\n\n\
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
    /// Render a built-in showcase scene, path-traced and denoised; no file is needed.
    #[command(after_help = "Example: glimray demo --size 1280x720 --samples 64 -o demo.png")]
    Demo(Box<DemoArgs>),
    /// Render one picture of a scene.
    ///
    /// Settings in the scene file are the defaults; flags override them.
    #[command(after_help = "Examples:\n  \
            glimray render scene.toml -o picture.png\n  \
            glimray render model.obj --look-from 0,1,4 --look-at 0,0,0 --samples 16 -o model.exr\n  \
            glimray render scene.toml --frame 12 --shutter 0.5 -o frame.png\n  \
            glimray render scene.toml --samples 4096 --checkpoint night.ckpt -o night.exr\n  \
            glimray render scene.scene --quiet -o - --format png | display")]
    Render(Box<RenderArgs>),
    /// Render an animation to numbered frames or a video.
    ///
    /// Runs are resumable: after an interruption, the same command renders only the missing frames.
    #[command(after_help = "Examples:\n  \
            glimray animate scene.toml -o walk.mp4\n  \
            glimray animate scene.toml --frames 0..47 --shutter 180deg -o walk_%04d.png\n  \
            glimray animate scene.toml --loop --fps 12 -o walk.gif\n  \
            glimray animate scene.toml -o walk.mp4 --keep-frames\n  \
            glimray animate scene.toml -o walk.mp4 --encode-only --quality 60\n  \
            glimray animate scene.toml --quiet -o - --format y4m | mpv -\n\n\
            The frames of a video are first written as files (walk.mp4.frames/frame_0000.png …), which are removed \
            when the video is complete. With --keep-frames they stay, so the video can be encoded again without rendering. \
            An existing frame is reused if it was written completely by the same scene, settings, adapter and version; \
            the journal NAME_journal.png.jsonl beside the frames records this. To render a single frame again, delete \
            its file.")]
    Animate(Box<AnimateArgs>),
    /// Render a seamless turntable animation of a model.
    ///
    /// The camera circles the model once. Runs are resumable, as with `animate`.
    #[command(after_help = "Examples:\n  \
            glimray turntable model.obj -o model.mp4\n  \
            glimray turntable model.obj --seconds 2 --axis z --elevation 30 -o model.gif\n\n\
            The camera keeps the smallest distance at which all bounded geometry stays in frame for the \
            whole turn.")]
    Turntable(Box<TurntableArgs>),
    /// Render named views of a model in one picture, with axes and a scale bar.
    ///
    /// The views along an axis are orthographic and of one scale. The lamps of a model without lights turn with the camera,
    /// and there is no ground.
    #[command(after_help = "Examples:\n  \
            glimray sheet model.glb -o model.png\n  \
            glimray sheet model.stl --views front,right,top --size 512 -o model.png\n\n\
            The axes are those of --look-from: +y is up, and a model is seen from the front from +z. The title has the size of \
            the model's bounding box in scene units. The report says where each view is, and its scale.")]
    Sheet(Box<SheetArgs>),
    /// Render a small picture of a model or a scene, for file managers.
    ///
    /// A model is framed, and a scene is seen by its own camera. The backdrop is grey, because models may be white or black,
    /// and file managers too.
    #[command(after_help = "Examples:\n  \
            glimray thumbnail model.glb --size 256 -o model.png\n  \
            glimray thumbnail --size %s -o %o %i\n\n\
            The second is the line of a file in ~/.local/share/thumbnailers. Nothing is printed but warnings and errors.")]
    Thumbnail(ThumbnailArgs),
    /// Open a window whose picture refines progressively while you navigate and edit.
    #[cfg(feature = "viewer")]
    #[command(after_help = "Examples:\n  \
            glimray view\n  \
            glimray view scene.toml\n  \
            glimray view model.obj --look-from 0,1,4 --look-at 0,0,0 --samples 64\n  \
            glimray view scene.toml --frame 12 --shutter 180deg --size 640x360\n\n\
            Without a scene the window shows the demo scene; drop a file on it to open that file. The \
            scene is reloaded when its file changes. Without --size the picture fills the available space. \
            H shows the keyboard shortcuts. On a desktop, glimray without arguments opens the window too. \
            Settings are stored in viewer.toml in the user's configuration folder, or in the folder that \
            GLIMRAY_SETTINGS names.")]
    View(Box<ViewArgs>),
    /// Convert a scene to the native format (.toml).
    ///
    /// Meshes and pictures are written beside it. The native scene renders to the same picture and can be
    /// edited as text.
    #[command(after_help = "Example: glimray convert model.obj -o model.toml\n\n\
            The names of all written files are printed. Existing files beside the scene are never replaced.")]
    Convert(ConvertArgs),
    /// Merge films of parts of a picture into one film or into the picture.
    ///
    /// Parts are regions (--crop) or sample ranges (--sample-offset, --sample-count), in any order.
    #[command(after_help = "Examples:\n  \
            glimray render scene.toml --samples 128 --sample-count 64 -o a.film\n  \
            glimray render scene.toml --samples 128 --sample-offset 64 -o b.film\n  \
            glimray merge a.film b.film -o picture.png\n\n\
            The merged picture is bit-identical to one rendered in a single run. If parts are missing, commands \
            that render them are printed, nothing is written, and the exit code is 8. Parts are read one at a \
            time, so that thousands of them take no more memory than two.")]
    Merge(MergeArgs),
    /// Render one picture or film on many machines.
    ///
    /// `plan` cuts it into parts and writes a folder, `run` renders parts, `merge` puts them together to the bytes of one
    /// run. Any batch engine can run, kill and retry them; `submit` writes the scripts for Slurm.
    #[cfg(feature = "archive")]
    #[command(
        subcommand,
        after_help = "Example, on one machine:\n  \
            glimray farm plan scene.toml --samples 4096 --parts 16 -o still.exr\n  \
            glimray farm run still.exr.farm --all --jobs 2\n  \
            glimray farm merge still.exr.farm"
    )]
    Farm(FarmCommand),
    /// Show the contents of a scene: counts, bounds, cameras, lights, materials.
    ///
    /// The list ends with everything that the importer skipped.
    #[command(after_help = "Example: glimray inspect scene.toml --json")]
    Inspect(InspectArgs),
    /// Show all rays of one pixel.
    ///
    /// For every ray it lists the hit, how the surface splits the light, the throughput and the
    /// contribution. With --integrator path it lists the path of each sample: the light samples, the
    /// densities and weights, Russian roulette.
    #[command(after_help = "Examples:\n  \
            glimray explain scene.toml --pixel 320,240\n  \
            glimray explain scene.toml --pixel 320,240 --sample 0 --json\n  \
            glimray explain scene.toml --size 96x54 --samples 1 --pixel 40,30 --obj rays.obj\n  \
            glimray explain scene.toml --integrator path --pixel 320,240 --sample 0\n\n\
            The contributions of a sample's rays add up to the sample's colour. The weighted mean of all \
            samples is the pixel, in linear light. Pass the flags that the picture was rendered with.")]
    Explain(Box<ExplainArgs>),
    /// List GPU adapters and their limits, and run a self-test.
    ///
    /// If there is no adapter, it names the driver packages to install.
    #[command(after_help = "Example: glimray doctor --backend vulkan\n\n\
            Kernels read scenes from images on software adapters and from buffers on others. The variable GLIMRAY_FETCH \
            decides instead: image, buffer or auto.")]
    Doctor(DoctorArgs),
    /// Compare two pictures, or those of two folders: RMSE, PSNR, FLIP, largest difference.
    ///
    /// The exit code is 8 if they differ by more than the flags allow, or a picture is only in one of the folders.
    #[command(after_help = "Examples:\n  \
            glimray compare a.png b.png --tolerance 3 --max-share 0.1 --diff difference.png\n  \
            glimray compare a.png b.png --flip 0.02\n  \
            glimray compare reference new --tolerance 2 --max-share 0.1 --diff difference\n\n\
            Values are compared as stored; 8-bit and 16-bit values are scaled to 0..1. One level is 1/255. \
            The pictures of folders, and of the folders in them, are compared by name in one table; hidden files and files \
            that are not pictures are left out.")]
    Compare(CompareArgs),
    /// Benchmark built-in scenes: rays per second, traversal steps, build rates, start-up.
    #[command(after_help = "Examples:\n  \
            glimray bench --quick\n  \
            glimray bench --repeats 5 --json > new.json\n  \
            glimray bench --only hall --compare old.json\n\n\
            Nodes and primitives are exact: on one adapter they change only with the program. Per ray they are those of rays \
            that are traced one by one. Per packet they are those of 32 or 64 rays that are traced together, where the \
            adapter can do that. The column `walk` says how the rays of Mrays/s were traced.\n\n\
            With --compare, counters that grew by more than 5 % are marked with `!`; the exit code does not depend on it. \
            Adapters, drivers, versions and repeats that differ are named, and figures that only one run has.")]
    Bench(BenchArgs),
    /// Print a shell completion script.
    #[command(
        after_help = "Example: glimray completions bash > ~/.local/share/bash-completion/completions/glimray"
    )]
    Completions(CompletionsArgs),
    /// Write manual pages: glimray.1, and a page for each command and step of a command.
    #[command(after_help = "Example: glimray man ~/.local/share/man/man1")]
    Man(ManArgs),
    /// Print the JSON Schema of native scenes, for editors, or of written JSON.
    #[command(after_help = "Examples:\n  \
            glimray schema > glimray.schema.json\n  \
            glimray schema report > report.schema.json")]
    Schema(SchemaArgs),
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
    /// Scene file: .toml (native), .scene (course format), .nff, .obj, .gltf, .glb, .ply, .stl or .zip
    pub scene: PathBuf,
    #[command(flatten)]
    pub output: OutputFlags,
    #[command(flatten)]
    pub layers: LayerFlags,
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
    /// Scene file: .toml (native), .scene (course format), .nff, .obj, .gltf, .glb, .ply, .stl or .zip
    pub scene: PathBuf,
    #[command(flatten)]
    pub output: SequenceFlags,
    #[command(flatten)]
    pub layers: LayerFlags,
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
    /// Model or scene file, in any format that `render` reads
    pub scene: PathBuf,
    #[command(flatten)]
    pub output: SequenceFlags,
    #[command(flatten)]
    pub turn: TurnFlags,
    #[command(flatten)]
    pub picture: PictureFlags,
    #[command(flatten)]
    pub axis: AxisFlags,
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
    /// Scene file, in any format that `render` reads [default: the demo scene]
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
    /// Scene file: .toml (native), .scene (course format), .nff, .obj, .gltf, .glb, .ply, .stl or .zip
    pub scene: PathBuf,
    /// Output file [default: the scene's name with .toml in the current folder]
    #[arg(short, long, value_name = "OUT.toml")]
    pub output: Option<PathBuf>,
    /// Do not replace an existing scene file
    #[arg(long)]
    pub no_clobber: bool,
    #[command(flatten)]
    pub axis: AxisFlags,
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
    /// The pixels that must be complete, those of `render --crop` [default: the whole picture]
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = values::crop)]
    pub crop: Option<[u32; 4]>,
    /// Write what is there even if parts are missing: pixels without samples are black
    #[arg(long)]
    pub partial: bool,
    /// Refuse parts that were rendered on different adapters, which may round differently
    #[arg(long)]
    pub same_adapter: bool,
    #[command(flatten)]
    pub layers: LayerFlags,
    #[command(flatten)]
    pub develop: DevelopFlags,
    #[command(flatten)]
    pub device: DeviceFlags,
}

#[derive(Debug, Args)]
pub struct InspectArgs {
    /// Scene file: .toml (native), .scene (course format), .nff, .obj, .gltf, .glb, .ply, .stl or .zip
    pub scene: PathBuf,
    /// Print JSON instead of text
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub axis: AxisFlags,
    #[command(flatten)]
    pub reading: SceneFlags,
}

#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// Scene file: .toml (native), .scene (course format), .nff, .obj, .gltf, .glb, .ply, .stl or .zip
    pub scene: PathBuf,
    /// Column and row of the pixel in the whole picture; 0,0 is the top left
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = values::pixel)]
    pub pixel: [u32; 2],
    /// Explain only this sample of the pixel, counted from 0 [default: all]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub sample: Option<u32>,
    /// Print JSON instead of text
    #[arg(long)]
    pub json: bool,
    /// Also write the rays as lines to this Wavefront OBJ file, in scene units
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
    /// First picture: PNG, JPEG, WebP, KTX2, OpenEXR or Radiance HDR; or a folder of pictures
    pub a: PathBuf,
    /// Second picture, of the same size; or the folder with pictures of the same names
    pub b: PathBuf,
    /// Largest difference in any channel, in levels of 1/255, at which two pixels count as equal [default: 0]
    #[arg(long, value_name = "LEVELS", value_parser = values::tolerance)]
    pub tolerance: Option<f64>,
    /// Percentage of pixels that may differ by more than the tolerance [default: 0]
    #[arg(long, value_name = "PERCENT", value_parser = values::percent)]
    pub max_share: Option<f64>,
    /// Largest mean of FLIP, 0 (equal) to 1; without --tolerance and --max-share it is the only limit
    #[arg(long, value_name = "MAX", value_parser = values::flip)]
    pub flip: Option<f64>,
    /// Write a difference image, scaled so that the largest difference is white; for folders, a folder with those of
    /// the pictures that differ
    #[arg(long, value_name = "OUT.png")]
    pub diff: Option<PathBuf>,
    /// Print JSON instead of text
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// Shell to complete for
    pub shell: Shell,
}

#[derive(Debug, Args)]
pub struct ManArgs {
    /// An existing folder for the pages; pages of the same name are replaced
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
}
